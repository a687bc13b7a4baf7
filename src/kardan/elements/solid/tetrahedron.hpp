// Four-node tetrahedra: one point (ELFORM 10) and nodal pressure (ELFORM 13).
//
// With edges e_i = x_i - x_0 and b_1 = e_2 x e_3, b_2 = e_3 x e_1, b_3 = e_1 x e_2, b_0 = -(b_1 + b_2 + b_3): 6 V = e_1.b_1, gradients
// of the shape functions b_a/(6 V), L = sum v_a b_a^T/(6 V), forces sigma b_a/6. The length of the stable step is the smallest
// altitude, 6 V/max |b_a|.
//
// Nodal pressure: Bonet and Burton 1998, Commun. Numer. Meth. Eng. 14, 437-449. A node's volume is a quarter of its elements', their
// ratio J_a to that of t = 0; the element's volume strain is that of the mean J of its nodes,
//   d(volume strain) = 2 (J_n - J_{n-1})/(J_n + J_{n-1}) in place of tr L dt,
// so that there are about as many volume conditions as nodes, and (nearly) incompressible flow does not lock. The nodes' ratios are
// summed before the tiles are computed: this element takes two passes. Where the law is linear in the volume strain, the element's
// pressure is the mean of its nodes' pressures, as in the paper. The work is that of the forces, on the element's own volume change.
#pragma once

#include "kardan/elements/solid/solid_point.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

template <class R>
struct TetrahedronGradient {
  Vec3T<R> b[4];
  R six_volumes;

  KARDAN_INLINE explicit TetrahedronGradient(const Vec3T<R> (&x)[4]) {
    const Vec3T<R> e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
    b[1] = cross(e2, e3);
    b[2] = cross(e3, e1);
    b[3] = cross(e1, e2);
    b[0] = -(b[1] + b[2] + b[3]);
    six_volumes = dot(e1, b[1]);
  }
};

/// The lanes of `place`; `history` begins with their values.
template <class R, class Law>
KARDAN_INLINE void tetrahedron_pack(const SolidProperties& p, const Law& law, const PackPlace& place, SolidBlock<4>& block, double* history) {
  const StepTime& step = place.work.step;
  const std::size_t first = place.first;
  constexpr std::size_t ratio_value = solid_history::own, stress_value = solid_history::own + 1;
  const R dt(step.dt), half_dt(0.5 * step.dt), zero(0.0), third(1.0 / 3.0), sixth(1.0 / 6.0);
  const PackNodes<4> nodes(place);
  const Vec3T<R>(&x)[4] = nodes.x, (&v)[4] = nodes.v;
  Vec3T<R> middle[4];
  for (int a = 0; a < 4; ++a) middle[a] = x[a] - v[a] * half_dt;
  const TetrahedronGradient<R> now(x), between(middle);
  const R volume = now.six_volumes * sixth, inverse = R(1.0) / between.six_volumes;
  Mat3T<R> l;
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3T<R> row;
    for (int a = 1; a < 4; ++a) row += between.b[a] * (v[a][k] - v[0][k]);
    l[k] = row * inverse;
  }
  const R divergence = l[0].x + l[1].y + l[2].z;

  MaterialPoint<R> point;
  point.volume = volume / R::load(history + solid_history::volume * block_lanes);
  const R widest = max(max(dot(now.b[0], now.b[0]), dot(now.b[1], now.b[1])), max(dot(now.b[2], now.b[2]), dot(now.b[3], now.b[3])));
  const R length = now.six_volumes / sqrt(widest);
  const BulkViscosity<R> bulk(p, volume, R(1.0) / volume, length, divergence, history);
  point.viscosity = bulk.mean();
  point.modulus = R(p.longitudinal);
  PointMotion<R> motion = point_motion(l, dt);
  double* const stress = history + stress_value * block_lanes;
  R excess{};  // a third of the volume strain that the element sees beyond its own
  R mean_before{};
  if (p.nodal_pressure) {
    double* const kept = history + ratio_value * block_lanes;
    const R before = R::load(kept);
    R sum{};
    for (std::size_t a = 0; a < 4; ++a) sum += gather_node_value(place, a);
    point.volume = R(0.25) * sum;
    point.volume.store(kept);
    excess = third * (R(2.0) * (point.volume - before) / (point.volume + before) - divergence * dt);
    motion.strain.xx += excess;
    motion.strain.yy += excess;
    motion.strain.zz += excess;
    mean_before = R::load(stress) + R::load(stress + block_lanes) + R::load(stress + 2 * block_lanes);
  }
  R work = update_point(law, step, motion, point, stress);
  work -= R(0.5) * excess * (mean_before + point.stress.xx + point.stress.yy + point.stress.zz);
  work += bulk.work(divergence, dt);
  point.stress.xx -= bulk.pressure;
  point.stress.yy -= bulk.pressure;
  point.stress.zz -= bulk.pressure;
  const Mat3T<R> s = full_tensor(point.stress);
  Vec3T<R> force[4];
  for (int a = 1; a < 4; ++a) force[a] = s * now.b[a] * sixth;
  force[0] = -(force[1] + force[2] + force[3]);
  const auto good = volume > zero;
  report_pack(p, block, first, force, work * between.six_volumes * sixth, zero, point.failed, good);
  stable_step(p, length, divergence, point.modulus, good).store(block.time_step + first);
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
