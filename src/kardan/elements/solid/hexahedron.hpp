// The one-point hexahedron (ELFORM 1) with exact mean gradients and hourglass control.
//
// Sources: Flanagan and Belytschko 1981, Int. J. Numer. Meth. Eng. 17, 679-706; Hallquist, LS-DYNA Theory Manual 2006, "Solid
// elements". What it is made of: hexahedron_modes.hpp, hexahedron_hourglass.hpp, solid_point.hpp.
#pragma once

#include "kardan/elements/solid/hexahedron_hourglass.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// The lanes of `place`; `history` begins with their values.
template <class R, class Law>
KARDAN_INLINE void hexahedron_pack(const SolidProperties& p, const Law& law, const PackPlace& place, SolidBlock<8>& block, double* history) {
  const StepTime& step = place.work.step;
  const std::size_t first = place.first;
  constexpr std::size_t hourglass_values = 12;
  const R dt(step.dt);
  const std::size_t own = (solid_history::own + hourglass_values) * block_lanes, values_of_point = 6 + law.history();
  const double* const next = history + own + values_of_point * block_lanes;  // of the next block
  ask_for(next, solid_history::own + hourglass_values);
  const HexahedronMotion<R> m(place);
  const auto good = m.now.volume > R(0.0);

  MaterialPoint<R> point;
  point.volume = m.now.volume / R::load(history + solid_history::volume * block_lanes);
  point.modulus = R(p.longitudinal);
  const Mat3T<R> l = sum_outer<6>(m.v8.a, m.between.b, m.inverse_between);
  const R divergence = l[0].x + l[1].y + l[2].z;
  const PointMotion<R> motion = point_motion(l, dt);
  const BulkViscosity<R> bulk(p, m.now.volume, m.inverse_now, m.length, divergence, history);
  point.viscosity = bulk.mean();
  ask_for(next + own, values_of_point);
  // What divides and takes roots stands where the work behind it does not need it: the processor goes on meanwhile.
  const R scale = hourglass_scale(p, m, bulk.size * bulk.size, dt);
  R work = update_point(law, step, motion, point, history + own);
  work += bulk.work(divergence, dt);
  stable_step(p, m.length, divergence, point.modulus, good).store(block.time_step + first);
  Vec3T<R> hourglass[4];
  const R hourglass_work = hourglass_forces(p, m, l, motion.turn, scale, dt, history + solid_history::own * block_lanes, hourglass);

  point.stress.xx -= bulk.pressure;
  point.stress.yy -= bulk.pressure;
  point.stress.zz -= bulk.pressure;
  const Mat3T<R> s = full_tensor(point.stress) - sum_outer<4>(hourglass, m.x.a + 3, R(8.0) * m.inverse_now);
  Modes<R> f;
  for (int k = 0; k < 6; ++k) f.a[k] = s * m.now.b[k];
  for (int k = 0; k < 3; ++k) f.a[k + 3] += hourglass[k];
  f.a[6] = hourglass[3];
  Vec3T<R> force[8];
  to_nodes(f, force);
  report_pack(p, block, first, force, work * m.between.volume, hourglass_work, point.failed, good);
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
