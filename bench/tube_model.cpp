#include "tube_model.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace kardan::bench {

namespace {

constexpr double width = 160, length = 600, thickness = 1.2, speed = 15, gap = 0.05;

PiecewisePlasticMaterial steel() {
  PiecewisePlasticMaterial m;
  m.density = 7.85e-6;
  m.youngs_modulus = 210;
  m.poissons_ratio = 0.3;
  m.points = 8;
  m.strain = {0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 1.0};
  m.stress = {0.25, 0.27, 0.285, 0.32, 0.36, 0.41, 0.47, 0.55};
  return m;
}

void add_part(Model& model, const decltype(Material::law)& law) {
  Section section;
  section.shell.thickness.fill(thickness);
  section.shell.shrf = 0.8333;
  section.shell.nip = 3;
  model.sections.push_back(section);
  model.materials.emplace_back();
  model.materials.back().law = law;
  Part part;
  part.id = static_cast<UserId>(model.parts.size()) + 1;
  part.section = part.material = static_cast<Index>(model.parts.size());
  model.parts.push_back(part);
}

NodeIndex add_node(Model& model, const Vec3& x) {
  model.nodes.id.push_back(static_cast<UserId>(model.nodes.size()) + 1);
  model.nodes.x.push_back(x);
  model.nodes.constrained.push_back(0);
  return static_cast<NodeIndex>(model.nodes.size()) - 1;
}

void add_shell(Model& model, PartIndex part, const std::array<NodeIndex, 4>& nodes) {
  model.shells.id.push_back(static_cast<UserId>(model.shells.size()) + 1);
  model.shells.part.push_back(part);
  model.shells.nodes.push_back(nodes);
}

/// A dent that starts the first fold: two opposite sides go in, the others out.
Vec3 dented(Vec3 x) {
  const double from = 0.25 * width, wave = 0.8 * width;
  if (x.z < from || x.z > from + wave) return x;
  const double s = 0.004 * width * std::sin(std::numbers::pi * (x.z - from) / wave), tiny = 1e-9;
  const Vec3 flat = x;
  if (flat.x < tiny || flat.x > width - tiny) x.x += (flat.x < width / 2 ? s : -s) * std::sin(std::numbers::pi * flat.y / width);
  else if (flat.y < tiny || flat.y > width - tiny) x.y -= (flat.y < width / 2 ? s : -s) * std::sin(std::numbers::pi * flat.x / width);
  return x;
}

Contact with_itself(std::vector<PartIndex> parts) {
  Contact c;
  c.id = 1;
  c.keyword = "*CONTACT_AUTOMATIC_SINGLE_SURFACE";
  c.single = c.automatic = true;
  c.tracked.kind = ContactSide::Kind::parts;
  c.tracked.parts = std::move(parts);
  c.friction = {0.2, 0.2, 0, 0};
  return c;
}

/// The nodes of a level of the tube, once round.
std::vector<NodeIndex> add_ring(Model& model, int sides, double z) {
  std::vector<NodeIndex> ring;
  for (int i = 0; i < 4 * sides; ++i) {
    const double u = width / sides * (i % sides);
    const Vec3 corner[] = {{u, 0, z}, {width, u, z}, {width - u, width, z}, {0, width - u, z}};
    Vec3 x = dented(corner[i / sides]);
    x.z += gap;
    ring.push_back(add_node(model, x));
  }
  return ring;
}

void add_plate(Model& model, int sides, const std::vector<NodeIndex>& ring) {
  const auto inside = static_cast<NodeIndex>(model.nodes.size());
  for (int j = 1; j < sides; ++j)
    for (int i = 1; i < sides; ++i) add_node(model, {width / sides * i, width / sides * j, length + gap});
  const auto at = [&](int i, int j) {
    if (j == 0) return ring[i];
    if (i == sides) return ring[sides + j];
    if (j == sides) return ring[3 * sides - i];
    if (i == 0) return ring[4 * sides - j];
    return inside + (j - 1) * (sides - 1) + i - 1;
  };
  for (int j = 0; j < sides; ++j)
    for (int i = 0; i < sides; ++i) add_shell(model, 1, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
}

}  // namespace

Model crush_tube(int sides) {
  Model model;
  add_part(model, steel());
  RigidMaterial plate{.density = 7.85e-6, .youngs_modulus = 210, .poissons_ratio = 0.3};
  plate.cmo = 1;
  plate.con1 = 4;
  plate.con2 = 7;
  add_part(model, plate);
  const int levels = static_cast<int>(std::lround(length / (width / sides)));
  std::vector<NodeIndex> below = add_ring(model, sides, 0);
  for (int k = 1; k <= levels; ++k) {
    const std::vector<NodeIndex> ring = add_ring(model, sides, length / levels * k);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t next = (i + 1) % ring.size();
      add_shell(model, 0, {below[i], below[next], ring[next], ring[i]});
    }
    below = ring;
  }
  add_plate(model, sides, below);
  Curve constant;
  constant.x = {0, 1000};
  constant.y = {-speed, -speed};
  model.curves.push_back(constant);
  PrescribedMotion motion;
  motion.body_part = 1;
  motion.dof = 3;
  motion.curve = 0;
  model.prescribed_motions.push_back(motion);
  InitialVelocity initial;
  initial.velocity = {0, 0, -speed};
  RigidWall wall;
  wall.id = 1;
  wall.normal = {0, 0, 1};
  wall.friction = 0.3;
  for (NodeIndex n = 0; n < static_cast<NodeIndex>(model.nodes.size()); ++n) {
    initial.nodes.push_back(n);
    wall.nodes.push_back(n);
  }
  model.initial_velocities.push_back(initial);
  model.rigid_walls.push_back(wall);
  model.contacts.push_back(with_itself({0, 1}));
  model.control.termination.end_time = 1e6;
  return model;
}

Model folded_copies(const Model& tube, const std::vector<Vec3>& x, int count) {
  Model model;
  add_part(model, ElasticMaterial{7.85e-6, 210, 0.3, 0, 0});
  const int across = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int c = 0; c < count; ++c) {
    const auto first = static_cast<NodeIndex>(model.nodes.size());
    const Vec3 shift{400.0 * (c % across), 400.0 * (c / across), 0};
    for (const Vec3& node : x) add_node(model, node + shift);
    for (std::array<NodeIndex, 4> nodes : tube.shells.nodes) {
      for (NodeIndex& n : nodes) n += first;
      add_shell(model, 0, nodes);
    }
  }
  model.contacts.push_back(with_itself({0}));
  model.control.termination.end_time = 1e6;
  return model;
}

}  // namespace kardan::bench
