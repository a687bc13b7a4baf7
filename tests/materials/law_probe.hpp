// For tests of laws: one material point on a pack, and what every law must keep.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/point.hpp"

namespace kardan::test {

using KARDAN_ISA_NAMESPACE::Pack;
using Tensor = SymmetricTensor<double>;

inline double lane(const Pack& p, std::size_t l = 0) { return p.v[l]; }
inline Tensor lane(const SymmetricTensor<Pack>& s, std::size_t l = 0) {
  return {s.xx.v[l], s.yy.v[l], s.zz.v[l], s.xy.v[l], s.yz.v[l], s.zx.v[l]};
}
inline SymmetricTensor<Pack> broadcast(const Tensor& s) { return {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx}; }

/// A point with the same values in every lane.
template <class Law>
class LawProbe {
 public:
  explicit LawProbe(const Law& law) : law_(law) {
    double start[Law::history > 0 ? Law::history : 1];
    law.start(start);
    std::size_t used = Law::history;
    if constexpr (requires { law.used_history(); }) used = law.used_history();
    for (std::size_t k = 0; k < used; ++k) std::fill_n(values_ + k * block_lanes, block_lanes, start[k]);
    point.modulus = Pack(law.longitudinal());
    point.volume = Pack(1.0);
  }
  /// One step of a strain increment; `volume` V/V0 after it.
  Tensor step(const Tensor& strain, double volume, double dt = 1e-3) {
    point.strain = broadcast(strain);
    point.volume = Pack(volume);
    point.modulus = Pack(law_.longitudinal());
    point.failed = Pack(0.0);
    law_.update(point, StepTime{dt, 0}, values_);
    return stress();
  }
  Tensor stress() const { return lane(point.stress); }
  double modulus() const { return lane(point.modulus); }
  double history(std::size_t k) const { return values_[k * block_lanes]; }

  MaterialPoint<Pack> point;

 private:
  const Law law_;
  alignas(64) double values_[(Law::history > 0 ? Law::history : 1) * block_lanes] = {};
};

/// Random paths in the lanes of a pack: every lane has the bits it has alone.
template <class Law>
void expect_lanes_independent(const Law& law, double size, int steps = 40) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double start[Law::history > 0 ? Law::history : 1];
  law.start(start);
  std::size_t used = Law::history;
  if constexpr (requires { law.used_history(); }) used = law.used_history();
  alignas(64) double together[(Law::history > 0 ? Law::history : 1) * block_lanes] = {};
  for (std::size_t k = 0; k < used; ++k) std::fill_n(together + k * block_lanes, block_lanes, start[k]);
  MaterialPoint<Pack> p;
  p.volume = Pack(1.0);
  std::array<LawProbe<Law>*, Pack::lanes> alone{};
  for (auto& a : alone) a = new LawProbe<Law>(law);
  for (int i = 0; i < steps; ++i) {
    for (std::size_t l = 0; l < Pack::lanes; ++l) {
      const double f = l == 0 ? 0.0 : size * static_cast<double>(l);  // lane 0 rests
      const Tensor d{f * uniform(random), f * uniform(random), f * uniform(random), f * uniform(random), f * uniform(random), f * uniform(random)};
      p.strain.xx.v[l] = d.xx, p.strain.yy.v[l] = d.yy, p.strain.zz.v[l] = d.zz;
      p.strain.xy.v[l] = d.xy, p.strain.yz.v[l] = d.yz, p.strain.zx.v[l] = d.zx;
      const double volume = p.volume.v[l] * (1 + d.xx + d.yy + d.zz);
      p.volume.v[l] = volume;
      alone[l]->step(d, volume);
    }
    p.modulus = Pack(law.longitudinal());
    p.failed = Pack(0.0);
    law.update(p, StepTime{1e-3, 0}, together);
    for (std::size_t l = 0; l < Pack::lanes; ++l) {
      const Tensor a = lane(p.stress, l), b = alone[l]->stress();
      ASSERT_EQ(a.xx, b.xx) << "step " << i << " lane " << l;
      ASSERT_EQ(a.yy, b.yy);
      ASSERT_EQ(a.zz, b.zz);
      ASSERT_EQ(a.xy, b.xy);
      ASSERT_EQ(a.yz, b.yz);
      ASSERT_EQ(a.zx, b.zx);
      ASSERT_EQ(p.modulus.v[l], alone[l]->modulus());
      ASSERT_EQ(p.failed.v[l], lane(alone[l]->point.failed));
    }
  }
  for (auto* a : alone) delete a;
}

}  // namespace kardan::test
