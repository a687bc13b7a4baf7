// Models of bricks made by hand.
#pragma once

#include <array>

#include "handmade_model.hpp"

namespace kardan {

struct Bricks : test::HandmadeModel {
  PartIndex part(const decltype(Material::law)& law) {
    Section section;
    section.kind = ElementKind::solid;
    return HandmadeModel::part(section, material_of(law));
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
};

}  // namespace kardan
