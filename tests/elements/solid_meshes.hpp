// Meshes of solids, motions and the law of linear elasticity, for tests of solids.
#pragma once

#include <cmath>
#include <vector>

#include "elements/bench.hpp"

namespace kardan::test {

constexpr double e_modulus = 210e9, density = 7800;
constexpr double lambda = 0.3 * e_modulus / (1.3 * 0.4), mu = e_modulus / 2.6;  // of nu = 0.3

/// nx x ny x nz hexahedra over the box [0, nx] x [0, ny] x [0, nz], nodes moved by `warp`; with `degenerate`, every
/// third cube is two wedges and every other third five tetrahedra.
template <class Warp>
void mesh(Bench& b, PartIndex p, int nx, int ny, int nz, Warp warp, bool degenerate = false) {
  const auto base = static_cast<NodeIndex>(b.model.nodes.size());
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) b.node(warp(Vec3{1.0 * i, 1.0 * j, 1.0 * k}));
    }
  }
  const NodeIndex row = nx + 1, layer = row * (ny + 1);
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const NodeIndex n = base + (k * (ny + 1) + j) * row + i, m = n + layer;
        const std::array<NodeIndex, 8> c{n, n + 1, n + row + 1, n + row, m, m + 1, m + row + 1, m + row};
        if (degenerate && (i + j + k) % 3 == 1) {
          b.solid(p, {c[0], c[1], c[2], c[2], c[4], c[5], c[6], c[6]});
          b.solid(p, {c[0], c[2], c[3], c[3], c[4], c[6], c[7], c[7]});
        } else if (degenerate && (i + j + k) % 3 == 2) {
          const int corner[5][4] = {{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 5, 7, 4}, {2, 7, 5, 6}, {0, 2, 7, 5}};
          for (const auto& t : corner) {
            b.solid(p, {c[t[0]], c[t[1]], c[t[2]], c[t[3]], c[t[3]], c[t[3]], c[t[3]], c[t[3]]});
          }
        } else {
          b.solid(p, c);
        }
      }
    }
  }
}

inline Vec3 identity(const Vec3& x) {
  return x;
}

inline Vec3 distort(const Vec3& x) {
  return x + Vec3{0.13 * std::sin(2.1 * x.x + 1.3 * x.y + x.z), 0.11 * std::cos(1.7 * x.x - 2.3 * x.y + 0.7 * x.z),
                  0.12 * std::sin(0.9 * x.x + 1.9 * x.y - 1.4 * x.z)};
}

/// A velocity gradient with every component.
inline Mat3 some_gradient() {
  return {{{{0.7, -0.2, 0.3}, {0.4, 1.1, -0.6}, {-0.1, 0.5, -0.9}}}};
}

inline Mat3 to_tensor(const StressVector& s) {
  return {{{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}}};
}

inline double size_of(const Mat3& a) {
  return std::sqrt(dot(a[0], a[0]) + dot(a[1], a[1]) + dot(a[2], a[2]));
}

/// Moves the nodes to `x` in one step of dt.
inline void move_to(Bench& b, const std::vector<Vec3>& x, double dt) {
  b.state.clock.dt_previous = dt;
  for (std::size_t n = 0; n < x.size(); ++n) b.state.nodes.v[n] = (x[n] - b.state.nodes.x[n]) / dt;
  b.state.nodes.x = x;
}

/// One step of 1e-8 with a uniform strain rate without spin; returns the stress that it makes.
inline Mat3 strain_and_compute(Bench& b) {
  const double dt = b.state.clock.dt_previous = 1e-8;
  const Mat3 rate = (some_gradient() + transpose(some_gradient())) * 0.5;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) b.state.nodes.v[n] = rate * b.model.nodes.x[n];
  b.forces();
  b.look();
  const Mat3 d =
      rate * inverse(Mat3::identity() - rate * (0.5 * dt)) * dt;  // on the geometry of the middle of the step
  return Mat3::identity() * (lambda * trace(d)) + d * (2 * mu);
}

}  // namespace kardan::test
