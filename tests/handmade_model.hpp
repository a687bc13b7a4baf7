// What models that tests make by hand begin with.
#pragma once

#include <utility>
#include <vector>

#include "kardan/model/model.hpp"

namespace kardan::test {

struct HandmadeModel {
  Model model;

  /// Nodes are numbered from 1 on.
  NodeIndex node(const Vec3& x) {
    const auto n = static_cast<NodeIndex>(model.nodes.size());
    model.nodes.id.push_back(n + 1);
    model.nodes.index_of.emplace(n + 1, n);
    model.nodes.x.push_back(x);
    model.nodes.constrained.push_back(0);
    return n;
  }
  CurveIndex curve(std::vector<double> x, std::vector<double> y) {
    Curve c;
    c.x = std::move(x);
    c.y = std::move(y);
    model.curves.push_back(c);
    return static_cast<CurveIndex>(model.curves.size()) - 1;
  }
  /// A part of a new section and a new material; the three have one number, from `first_id` on.
  PartIndex part(Section section, Material material, UserId first_id = 1) {
    const auto p = static_cast<PartIndex>(model.parts.size());
    Part entry;
    entry.id = section.id = material.id = first_id + p;
    model.sections.push_back(std::move(section));
    model.materials.push_back(std::move(material));
    entry.section = static_cast<Index>(model.sections.size()) - 1;
    entry.material = static_cast<Index>(model.materials.size()) - 1;
    model.parts.push_back(entry);
    return p;
  }
  template <class Law>
  static Material material_of(const Law& law) {
    Material material;
    material.law = law;
    return material;
  }
};

}  // namespace kardan::test
