// For tests of materials in elements: one cube of a law read by fields, moved by prescribed deformations.
#pragma once

#include <map>
#include <string>

#include "elements/bench.hpp"

namespace kardan::test {

inline FieldMaterial fields(int number, char variant, double density, std::map<std::string, double, std::less<>> values) {
  FieldMaterial m;
  m.number = number;
  m.variant = variant;
  m.keyword = "*MAT_" + std::to_string(number);
  m.density = density;
  m.youngs_modulus = values.contains("e") ? values["e"] : 0;
  m.poissons_ratio = values.contains("pr") ? values["pr"] : 0;
  m.values = std::move(values);
  return m;
}

inline PartIndex solid_part(Bench& b, const FieldMaterial& law) {
  Section section;
  section.kind = ElementKind::solid;
  Material material;
  material.law = law;
  return b.part(section, material);
}

/// nx x ny x nz cubes of edge h.
inline void block_of_cubes(Bench& b, PartIndex p, int nx, int ny, int nz, double h = 1) {
  const auto base = static_cast<NodeIndex>(b.model.nodes.size());
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) b.node(Vec3{h * i, h * j, h * k});
    }
  }
  const NodeIndex row = nx + 1, layer = row * (ny + 1);
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const NodeIndex n = base + (k * (ny + 1) + j) * row + i, m = n + layer;
        b.solid(p, {n, n + 1, n + row + 1, n + row, m, m + 1, m + row + 1, m + row});
      }
    }
  }
}

/// A unit cube that is deformed as x = F X.
struct Cube : Bench {
  explicit Cube(const FieldMaterial& law, double q1 = 1e-300, double q2 = 1e-300) {
    block_of_cubes(*this, test::solid_part(*this, law), 1, 1, 1);
    model.control.bulk_q1 = q1;
    model.control.bulk_q2 = q2;
    start();
  }
  void move(const Mat3& f, double dt) {
    state.clock.dt_previous = dt;
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
      const Vec3 x = f * model.nodes.x[n];
      state.nodes.v[n] = (x - state.nodes.x[n]) / dt;
      state.nodes.x[n] = x;
    }
    forces();
    state.clock.time += dt;
  }
  Mat3 stress() {
    look();
    const StressVector& s = state.results.solid.stress[0];
    return {{{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}}};
  }
};

inline double size_of(const Mat3& a) { return std::sqrt(dot(a[0], a[0]) + dot(a[1], a[1]) + dot(a[2], a[2])); }

}  // namespace kardan::test
