// Models of bricks made by hand.
#pragma once

#include <array>

#include "kardan/model/model.hpp"

namespace kardan {

struct Bricks {
  Model model;

  PartIndex part(decltype(Material::law) law) {
    Section section;
    section.kind = ElementKind::solid;
    const auto p = static_cast<PartIndex>(model.parts.size());
    Material material;
    material.law = law;
    section.id = material.id = p + 1;
    model.sections.push_back(section);
    model.materials.push_back(material);
    Part part;
    part.id = p + 1;
    part.section = part.material = p;
    model.parts.push_back(part);
    return p;
  }
  NodeIndex node(const Vec3& x) {
    const auto n = static_cast<NodeIndex>(model.nodes.size());
    model.nodes.id.push_back(n + 1);
    model.nodes.index_of.emplace(n + 1, n);
    model.nodes.x.push_back(x);
    model.nodes.constrained.push_back(0);
    return n;
  }
  void brick(PartIndex p, const std::array<NodeIndex, 8>& nodes) {
    model.solids.id.push_back(static_cast<UserId>(model.solids.size()) + 1);
    model.solids.part.push_back(p);
    model.solids.nodes.push_back(nodes);
  }
  /// A row of `count` cubes of edge h along z; the nodes of layer k are first + 4 k … first + 4 k + 3, counterclockwise.
  NodeIndex column(PartIndex p, int count, double h, const Vec3& origin = {}) {
    const auto first = static_cast<NodeIndex>(model.nodes.size());
    for (int k = 0; k <= count; ++k)
      for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{h, 0, 0}, Vec3{h, h, 0}, Vec3{0, h, 0}}) node(origin + corner + Vec3{0, 0, h * k});
    for (int k = 0; k < count; ++k) {
      const NodeIndex a = first + 4 * k;
      brick(p, {a, a + 1, a + 2, a + 3, a + 4, a + 5, a + 6, a + 7});
    }
    return first;
  }
  CurveIndex curve(std::vector<double> x, std::vector<double> y) {
    Curve c;
    c.x = std::move(x);
    c.y = std::move(y);
    model.curves.push_back(std::move(c));
    return static_cast<CurveIndex>(model.curves.size()) - 1;
  }
};

}  // namespace kardan
