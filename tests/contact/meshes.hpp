// Plates, blocks and contacts made by hand.
#pragma once

#include <array>
#include <vector>

#include "handmade_model.hpp"

namespace kardan::test {

struct Meshes : HandmadeModel {
  PartIndex shell_part(const decltype(Material::law)& law, double thickness) {
    Section section;
    section.shell.thickness = {thickness, thickness, thickness, thickness};
    section.shell.nip = 3;
    return HandmadeModel::part(section, material_of(law));
  }
  PartIndex solid_part(const decltype(Material::law)& law) {
    Section section;
    section.kind = ElementKind::solid;
    return HandmadeModel::part(section, material_of(law));
  }
  void shell(PartIndex p, const std::array<NodeIndex, 4>& nodes) {
    model.shells.id.push_back(static_cast<UserId>(model.shells.size()) + 1);
    model.shells.part.push_back(p);
    model.shells.nodes.push_back(nodes);
  }
  /// nx * ny quadrilaterals of the parallelogram origin + r along + s across. @return its first node; node (i, j) is first + j (nx + 1) + i
  NodeIndex plate(PartIndex p, int nx, int ny, const Vec3& origin, const Vec3& along, const Vec3& across) {
    const auto first = static_cast<NodeIndex>(model.nodes.size());
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) node(origin + along * (double(i) / nx) + across * (double(j) / ny));
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const NodeIndex n = first + j * (nx + 1) + i;
        shell(p, {n, n + 1, n + nx + 2, n + nx + 1});
      }
    return first;
  }
  /// nx * ny * nz hexahedra. @return its first node; node (i, j, k) is first + (k (ny + 1) + j) (nx + 1) + i
  NodeIndex block(PartIndex p, const std::array<int, 3>& n, const Vec3& origin, const Vec3& size) {
    const auto first = static_cast<NodeIndex>(model.nodes.size());
    const auto at = [&](int i, int j, int k) { return first + (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
    for (int k = 0; k <= n[2]; ++k)
      for (int j = 0; j <= n[1]; ++j)
        for (int i = 0; i <= n[0]; ++i) node(origin + Vec3{size.x * i / n[0], size.y * j / n[1], size.z * k / n[2]});
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          model.solids.id.push_back(static_cast<UserId>(model.solids.size()) + 1);
          model.solids.part.push_back(p);
          model.solids.nodes.push_back({at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1), at(i + 1, j, k + 1),
                                        at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
        }
    return first;
  }
  /// All nodes from `first` on get this velocity.
  void throw_from(NodeIndex first, NodeIndex end, const Vec3& velocity) {
    InitialVelocity v;
    v.velocity = velocity;
    for (NodeIndex n = first; n < end; ++n) v.nodes.push_back(n);
    model.initial_velocities.push_back(v);
  }
  /// A part that stands still.
  PartIndex fixed_shell_part(double thickness) {
    RigidMaterial law{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3};
    law.cmo = 1;
    law.con1 = law.con2 = 7;
    return shell_part(law, thickness);
  }
  /// A free node with mass.
  NodeIndex point(const Vec3& x, double mass, const Vec3& velocity) {
    const NodeIndex n = node(x);
    model.masses.push_back({static_cast<UserId>(model.masses.size()) + 1, n, mass, none});
    throw_from(n, n + 1, velocity);
    return n;
  }
  NodeIndex node_count() const { return static_cast<NodeIndex>(model.nodes.size()); }

  static ContactSide side(std::vector<PartIndex> parts) {
    ContactSide s;
    s.kind = ContactSide::Kind::parts;
    s.parts = std::move(parts);
    return s;
  }
  /// *CONTACT_AUTOMATIC_SINGLE_SURFACE of these parts.
  Contact& single_surface(std::vector<PartIndex> parts) {
    Contact c;
    c.id = static_cast<UserId>(model.contacts.size()) + 1;
    c.keyword = "*CONTACT_AUTOMATIC_SINGLE_SURFACE";
    c.single = c.automatic = true;
    c.tracked = side(std::move(parts));
    return model.contacts.emplace_back(c);
  }
  /// *CONTACT_AUTOMATIC_NODES_TO_SURFACE.
  Contact& nodes_to_surface(std::vector<NodeIndex> tracked, std::vector<PartIndex> reference) {
    Contact c;
    c.id = static_cast<UserId>(model.contacts.size()) + 1;
    c.keyword = "*CONTACT_AUTOMATIC_NODES_TO_SURFACE";
    c.automatic = true;
    c.tracked.kind = ContactSide::Kind::nodes;
    c.tracked.nodes = std::move(tracked);
    c.reference = side(std::move(reference));
    return model.contacts.emplace_back(c);
  }
  /// *CONTACT_AUTOMATIC_SURFACE_TO_SURFACE.
  Contact& surface_to_surface(std::vector<PartIndex> tracked, std::vector<PartIndex> reference) {
    Contact c;
    c.id = static_cast<UserId>(model.contacts.size()) + 1;
    c.keyword = "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE";
    c.automatic = c.two_way = true;
    c.tracked = side(std::move(tracked));
    c.reference = side(std::move(reference));
    return model.contacts.emplace_back(c);
  }
};

inline std::string messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += to_string(d) + "\n";
  return text;
}

}  // namespace kardan::test
