// The C0 triangle (ELFORM 4): three nodes, one point in the plane, co-rotational.
// Included by translation units that are compiled for one instruction set each; see base/simd.hpp.
//
// Source: Kennedy, Belytschko and Lin 1986, Nucl. Eng. Des. 97, 1-24; Hallquist, LS-DYNA Theory Manual 2006, "C0 triangular shell".
// Membrane and bending strains are those of linear velocities and rotations, constant over the element, as in belytschko_tsay.hpp for a
// repeated third node. The transverse shear is not the one of these fields, which would stiffen a thin plate in bending: along
// every edge the mean shear vanishes in pure bending,
//   A_ij = w_j - w_i + ((wy_i + wy_j) dx - (wx_i + wx_j) dy)/2 = shear along the edge times its length.
// The two edges at a node give its shear vector, and the element takes the mean of its three nodes. With x along side 1-2, node 3
// at (x3, y3):
//   2 d_zx = (2 A_12 + A_13 - A_23)/(3 x2),   2 d_yz = ((1 - 2 r) A_12 + (2 - r) A_13 + (1 + r) A_23)/(3 y3),   r = x3/x2.
#pragma once

#include "kardan/elements/shell/belytschko_tsay.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Sides of a triangle and how its transverse shears follow from the shears A along them: zx by `x`, yz by `y`, in the order 12, 13, 23.
template <class R>
struct TriangleEdges {
  R dx[3], dy[3], x[3], y[3];

  KARDAN_INLINE explicit TriangleEdges(const ShellAxes<R>& s) {
    const R twice = s.area + s.area;  // the diagonals of the repeated node are sides 1-3 and 2-3
    dx[1] = -(s.b2[1] * twice);
    dy[1] = s.b1[1] * twice;
    dx[2] = s.b2[0] * twice;
    dy[2] = -(s.b1[0] * twice);
    dx[0] = dx[1] - dx[2];
    dy[0] = R{};
    const R inverse_x = R(1.0 / 3.0) / dx[0], inverse_y = R(1.0 / 3.0) / dy[1], r = dx[1] / dx[0];
    x[0] = inverse_x + inverse_x;
    x[1] = inverse_x;
    x[2] = -inverse_x;
    y[0] = (R(1.0) - r - r) * inverse_y;
    y[1] = (R(2.0) - r) * inverse_y;
    y[2] = (R(1.0) + r) * inverse_y;
  }
};

inline constexpr int triangle_edge[3][2] = {{0, 1}, {0, 2}, {1, 2}};

/// Forces and moments on the nodes.
template <class R>
KARDAN_INLINE void triangle_nodal_forces(const ShellAxes<R>& s, const ShellResultants<R>& t, NodalForces<4, 6>& force, std::size_t first) {
  const TriangleEdges<R> edges(s);
  Vec3T<R> f[3], m[3];  // in the element's axes
  for (int i = 0; i < 2; ++i) {
    const R b1 = s.area * s.b1[i], b2 = s.area * s.b2[i];
    f[i] = {b1 * t.fxx + b2 * t.fxy, b2 * t.fyy + b1 * t.fxy, R{}};
    m[i] = {-(b2 * t.myy + b1 * t.mxy), b1 * t.mxx + b2 * t.mxy, R{}};
  }
  f[2] = -f[0] - f[1];
  m[2] = -m[0] - m[1];
  for (int k = 0; k < 3; ++k) {
    const R shear = s.area * (edges.x[k] * t.qx + edges.y[k] * t.qy), half = R(0.5) * shear;
    const auto [i, j] = triangle_edge[k];
    f[i].z -= shear;
    f[j].z += shear;
    for (const int node : {i, j}) {
      m[node].x -= half * edges.dy[k];
      m[node].y += half * edges.dx[k];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    force.set(i, first, s.e1 * f[i].x + s.e2 * f[i].y + s.e3 * f[i].z, s.e1 * m[i].x + s.e2 * m[i].y);
  }
  force.set(3, first, Vec3T<R>{}, Vec3T<R>{});  // the same node as the third
}

/// Lanes [first, first + R::lanes) of a block.
template <class R, class Law>
KARDAN_INLINE void triangle_pack(const ShellProperties& p, const Law& law, const TileWork& work, const std::uint16_t* connectivity,
                                 ShellBlock& block, double* history, std::size_t first) {
  const R dt(work.step.dt), half_dt(0.5 * work.step.dt), zero(0.0);
  const R n[2] = {R(1.0 / 3.0), R(1.0 / 6.0)};
  history += first;
  ShellThickness<R> thickness(p, history + static_cast<std::size_t>(p.points) * shell_point_values(law.history()) * block_lanes);
  Vec3T<R> x[4];
  ShellResultants<R> t;
  {
    Vec3T<R> v[4], w[4], middle[4];
    for (std::size_t a = 0; a < 4; ++a) {
      const std::uint16_t* index = connectivity + a * block_lanes + first;
      x[a] = gather_vectors<node_stride(6)>(work.node, index);
      v[a] = gather_vectors<node_stride(6)>(work.node + 4, index);
      w[a] = gather_vectors<node_stride(6)>(work.node + 8, index);
      middle[a] = x[a] - v[a] * half_dt;
    }
    const ShellAxes<R> s = shell_axes(middle);
    ShellStrains<R> d = shell_strains(s, v, w, n, dt);
    const TriangleEdges<R> edges(s);
    d.yz = d.zx = zero;
    for (int k = 0; k < 3; ++k) {
      const auto [i, j] = triangle_edge[k];
      const Vec3T<R> turn = (w[i] + w[j]) * R(0.5);
      const R shear = (dot(v[j] - v[i], s.e3) + dot(turn, s.e2) * edges.dx[k] - dot(turn, s.e1) * edges.dy[k]) * dt;
      d.zx += edges.x[k] * shear;
      d.yz += edges.y[k] * shear;
    }
    t = through_thickness(p, law, d, work.step, thickness, history);
    select(R::load(block.alive + first) > zero, t.work * s.area, zero).store(block.internal + first);
    zero.store(block.hourglass + first);
  }
  (R::load(block.alive + first) * t.intact).store(block.alive + first);
  const R ratio = thickness.update(p, t.thinning);
  if (p.thins) t.scale(ratio);
  const ShellAxes<R> s = shell_axes(x);
  stable_step(p, s, x, R(1.0), t.stiffening).store(block.time_step + first);
  triangle_nodal_forces(s, t, block.force, first);
}

template <class Law>
void triangle_tile(TileWork& work) {
  for_each_shell_pack<Law>(work, [&work](const ShellProperties& p, const Law& law, const std::uint16_t* connectivity, ShellBlock& block,
                                         double* history, std::size_t first) {
    triangle_pack<Pack>(p, law, work, connectivity, block, history, first);
  });
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
