// The fully integrated hexahedron with mean volume change (ELFORM 2), eight points.
//
// Sources: Nagtegaal, Parks and Rice 1974, Comput. Meth. Appl. Mech. Eng. 4, 153-177 (mean dilatation); Hughes 1980, Int. J. Numer.
// Meth. Eng. 15, 1413-1418 (B-bar); Hallquist, LS-DYNA Theory Manual 2006, "Solid elements" (selective reduced integration).
//
// With c_r, c_s, c_t and J of natural_gradient.hpp at the Gauss points r, s, t = +-1/sqrt 3 the velocity gradient is L = (v_r c_r^T + v_s c_s^T +
// v_t c_t^T)/J. Its divergence is replaced by the element's mean D = (8/V) sum v_a.B_a, which is dV/dt / V exactly:
//   L-bar = L + (D - tr L)/3 I.
// Virtual work then gives the forces: the deviators s' at the points on c_r, c_s, c_t, the mean p of the pressures on B,
//   8 F_1 = sum s' c_r,   8 F_4 = sum (s s' c_r + r s' c_s),  ...   + 8 p B_a.
// Uniform strains are exact on any shape; the eight points control every mode, so there is no hourglass control.
#pragma once

#include "kardan/elements/solid/hexahedron_modes.hpp"
#include "kardan/elements/solid/natural_gradient.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// The lanes of `place`; `history` begins with their values.
template <class R, class Law>
KARDAN_INLINE void full_hexahedron_pack(const SolidProperties& p, const Law& law, const PackPlace& place, SolidBlock<8>& block, double* history) {
  const StepTime& step = place.work.step;
  const std::size_t first = place.first;
  const R dt(step.dt), zero(0.0), third(1.0 / 3.0);
  const HexahedronMotion<R> m(place);
  R divergence{};
  for (int k = 0; k < 6; ++k) divergence += dot(m.v8.a[k], m.between.b[k]);
  divergence *= m.inverse_between;

  const R ratio = m.now.volume / R::load(history + solid_history::volume * block_lanes);
  const BulkViscosity<R> bulk(p, m.now.volume, m.inverse_now, m.length, divergence, history);
  const std::size_t point_values = (6 + law.history()) * block_lanes;
  double* values = history + solid_history::own * block_lanes;
  R work{}, pressure{}, smallest(1e300), modulus(p.longitudinal), failed{};
  Modes<R> f{};
  for (int i = 0; i < 8; ++i, values += point_values) {
    constexpr double g = 0.57735026918962576451;
    const R r(i & 1 ? g : -g), s(i & 2 ? g : -g), t(i & 4 ? g : -g);
    const Cofactors<R> c_mid(NaturalGradient<R>(m.middle, r, s, t));
    const NaturalGradient<R> v8(m.v8, r, s, t);
    const R inverse = R(0.125) / c_mid.jacobian;
    Mat3T<R> l;
    for (std::size_t k = 0; k < 3; ++k) l[k] = (c_mid.r * v8.r[k] + c_mid.s * v8.s[k] + c_mid.t * v8.t[k]) * inverse;
    const R correction = (divergence - (l[0].x + l[1].y + l[2].z)) * third;
    l[0].x += correction;
    l[1].y += correction;
    l[2].z += correction;
    MaterialPoint<R> point;
    point.volume = ratio;
    point.viscosity = bulk.mean();
    point.modulus = R(p.longitudinal);
    work += c_mid.jacobian * update_point(law, step, point_motion(l, dt), point, values);
    modulus = max(modulus, point.modulus);
    failed += point.failed;

    const Cofactors<R> c(NaturalGradient<R>(m.x, r, s, t));
    smallest = min(smallest, c.jacobian);
    SymmetricTensor<R>& stress = point.stress;
    const R mean = (stress.xx + stress.yy + stress.zz) * third;
    pressure += c.jacobian * mean;
    stress.xx -= mean;
    stress.yy -= mean;
    stress.zz -= mean;
    const Mat3T<R> deviator = full_tensor(stress);
    const Vec3T<R> fr = deviator * c.r, fs = deviator * c.s, ft = deviator * c.t;
    add_mode_forces(f, r, s, t, fr, fs, ft);
  }
  work += bulk.work(divergence, dt) * m.between.volume;
  const R mean = pressure / m.now.volume - bulk.pressure;
  for (int k = 0; k < 7; ++k) f.a[k] = f.a[k] * R(0.125);
  for (int k = 0; k < 6; ++k) f.a[k] += m.now.b[k] * mean;
  Vec3T<R> force[8];
  to_nodes(f, force);
  const auto good = smallest > zero;
  report_pack(p, block, first, force, work, zero, failed, good);
  stable_step(p, m.length, divergence, modulus, good).store(block.time_step + first);
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
