// Beams on the bench of the elements' tests.
#pragma once

#include <numbers>
#include <vector>

#include "elements/bench.hpp"
#include "kardan/model/beam_sections.hpp"

namespace kardan::test {

struct BeamBench : Bench {
  PartIndex beam_part(const BeamSection& sizes, double density, double e, double nu) {
    return beam_part(sizes, ElasticMaterial{density, e, nu, 0, 0});
  }
  template <class Law>
  PartIndex beam_part(const BeamSection& sizes, const Law& law) {
    Section section;
    section.kind = ElementKind::beam;
    section.beam = sizes;
    Material material;
    material.law = law;
    return part(section, material);
  }
  Index beam(PartIndex p, NodeIndex a, NodeIndex b, NodeIndex c = none) {
    model.beams.id.push_back(3000 + static_cast<UserId>(model.beams.id.size()));
    model.beams.part.push_back(p);
    model.beams.nodes.push_back({a, b, c});
    return static_cast<Index>(model.beams.id.size()) - 1;
  }
  /// `count` elements from `from` to `to`; the third node lies at `side`. Returns its nodes.
  std::vector<NodeIndex> line(PartIndex p, const Vec3& from, const Vec3& to, int count, const Vec3& side) {
    std::vector<NodeIndex> nodes;
    for (int i = 0; i <= count; ++i) nodes.push_back(node(from + (to - from) * (static_cast<double>(i) / count)));
    const NodeIndex third = node(side);
    for (int i = 0; i < count; ++i) beam(p, nodes[static_cast<std::size_t>(i)], nodes[static_cast<std::size_t>(i) + 1], third);
    return nodes;
  }
  /// Holds a node.
  void clamp(NodeIndex n) { state.nodes.v[n] = state.nodes.omega[n] = Vec3{}; }
  /// Reduces all velocities: dynamic relaxation.
  void slow_down(double factor) {
    for (Vec3& v : state.nodes.v) v *= factor;
    for (Vec3& w : state.nodes.omega) w *= factor;
  }
  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) {
      sum += 0.5 * (state.nodes.mass[n] * dot(state.nodes.v[n], state.nodes.v[n]) +
                    state.nodes.inertia[n] * dot(state.nodes.omega[n], state.nodes.omega[n]));
    }
    return sum;
  }
};

inline BeamSection rectangle(double width, double height, double shrf = 5.0 / 6) {
  BeamSection s;
  s.elform = beam_elform::hughes_liu;
  s.shrf = shrf;
  s.ts = {width, width};
  s.tt = {height, height};
  return s;
}

inline BeamSection tube(double outer, double inner) {
  BeamSection s = rectangle(outer, inner, 0.5);
  s.cst = 1;
  return s;
}

/// The resultants of a rectangle as ELFORM 2 wants them; `shear`: shear area, 0 = none.
inline BeamSection resultant(double width, double height, double shear = 0) {
  BeamSection s;
  s.elform = beam_elform::belytschko_schwer;
  s.area = width * height;
  s.iss = s.area * height * height / 12;
  s.itt = s.area * width * width / 12;
  s.j = s.iss + s.itt;
  s.shear_s = s.shear_t = shear;
  return s;
}

inline BeamSection truss_section(double area) {
  BeamSection s;
  s.elform = beam_elform::truss;
  s.area = area;
  return s;
}

}  // namespace kardan::test
