#include "kardan/materials/stiffness_damping.hpp"

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/law_kernels.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

namespace {

/// C d eps / dt without beta, into `rate`.
void stress_of(const DampedLaw& c, const SymmetricTensor<Pack>& d, SymmetricTensor<Pack>& rate) {
  const Pack mean = Pack(c.lambda) * (d.xx + d.yy + d.zz), two_mu(2 * c.shear);
  rate = {mean + two_mu * d.xx, mean + two_mu * d.yy, mean + two_mu * d.zz, two_mu * d.xy, two_mu * d.yz, two_mu * d.zx};
}
void stress_of(const DampedLaw& c, const PlaneStress<Pack>& d, PlaneStress<Pack>& rate) {
  const Pack mean = Pack(c.lambda) * (d.xx + d.yy), two_mu(2 * c.shear);
  rate = {mean + two_mu * d.xx, mean + two_mu * d.yy, Pack(c.shear) * d.xy, Pack(c.transverse) * d.yz, Pack(c.transverse) * d.zx};
}
void stress_of(const DampedLaw& c, const BeamStress<Pack>& d, BeamStress<Pack>& rate) {
  rate = {Pack(c.youngs_modulus) * d.rr, Pack(c.shear) * d.rs, Pack(c.shear) * d.tr};
}

/// f(component of a, the same of b).
template <class F>
void for_both(SymmetricTensor<Pack>& a, const SymmetricTensor<Pack>& b, F&& f) {
  f(a.xx, b.xx), f(a.yy, b.yy), f(a.zz, b.zz), f(a.xy, b.xy), f(a.yz, b.yz), f(a.zx, b.zx);
}
template <class F>
void for_both(PlaneStress<Pack>& a, const PlaneStress<Pack>& b, F&& f) {
  f(a.xx, b.xx), f(a.yy, b.yy), f(a.xy, b.xy), f(a.yz, b.yz), f(a.zx, b.zx);
}
template <class F>
void for_both(BeamStress<Pack>& a, const BeamStress<Pack>& b, F&& f) {
  f(a.rr, b.rr), f(a.rs, b.rs), f(a.tr, b.tr);
}

template <class Point>
void update_damped(const void* constants, void* at, const StepTime& t, double* values) {
  const DampedLaw& c = *static_cast<const DampedLaw*>(constants);
  Point& p = *static_cast<Point*>(at);
  auto viscous = p.stress;
  stress_of(c, p.strain, viscous);
  std::size_t row = 0;
  for_both(p.stress, viscous, [&](Pack& s, const Pack&) { s -= Pack::load(values + block_lanes * row++); });
  c.update(c.law, &p, t, values + DampedLaw::law_begin * block_lanes);
  const Pack beta = Pack::load(values + c.damping_place() * block_lanes), factor = beta * Pack(t.dt > 0 ? 1 / t.dt : 0.0);
  const Pack living = select(p.failed > Pack(0.5), Pack(0.0), factor);
  row = 0;
  for_both(p.stress, viscous, [&](Pack& s, const Pack& v) {
    const Pack own = living * v;
    own.store(values + block_lanes * row++);
    s += own;
  });
}

}  // namespace

extern const LawKernels stiffness_damping_kernels;
const LawKernels stiffness_damping_kernels = {&update_damped<MaterialPoint<Pack>>, &update_damped<ShellPoint<Pack>>, &update_damped<BeamPoint<Pack>>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE
