#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/erosion_update.hpp"
#include "kardan/materials/laws/elastic_plane_stress.hpp"
#include "kardan/materials/laws/plastic_kinematic.hpp"

namespace kardan {
namespace {

using KARDAN_ISA_NAMESPACE::Pack;

constexpr double e_modulus = 200, nu = 0.25;
const Elastic elastic = Elastic::from(e_modulus, nu);
const ElasticPlaneStress elastic_shell = ElasticPlaneStress::from(elastic, 1);

void update_solid(const void* law, void* p, const StepTime& t, double* values) {
  static_cast<const Elastic*>(law)->update(*static_cast<MaterialPoint<Pack>*>(p), t, values);
}
void update_shell(const void* law, void* p, const StepTime& t, double* values) {
  static_cast<const ElasticPlaneStress*>(law)->update(*static_cast<ShellPoint<Pack>*>(p), t, values);
}

/// Steps of one strain increment (tensor shears) until the point fails or 1000 are done; how many it survived.
int steps_to_failure(const std::function<void(ErosionCriteria&)>& set, const SymmetricTensor<Pack>& d, double dt = 1e-3) {
  Erosion erosion;
  erosion.law = &elastic;
  erosion.update = &update_solid;
  set(erosion.criteria);
  std::vector<double> values(erosion.history() * block_lanes);
  MaterialPoint<Pack> p;
  for (int i = 0; i < 1000; ++i) {
    p.strain = d;
    erode(erosion, p, StepTime{dt, (i + 1) * dt}, values.data());
    if (p.failed.v[0] > 0) {
      EXPECT_EQ(p.stress.xx.v[0], 0.0);
      return i;
    }
  }
  return 1000;
}

int shell_steps_to_failure(const std::function<void(ErosionCriteria&)>& set, const PlaneStress<Pack>& d) {
  Erosion erosion;
  erosion.law = &elastic_shell;
  erosion.update = &update_shell;
  set(erosion.criteria);
  std::vector<double> values(erosion.history() * block_lanes);
  ShellPoint<Pack> p;
  for (int i = 0; i < 1000; ++i) {
    p.strain = d;
    erode(erosion, p, StepTime{1e-3, (i + 1) * 1e-3}, values.data());
    if (p.failed.v[0] > 0) return i;
  }
  return 1000;
}

using C = ErosionCriteria;
constexpr double step = 1e-4;

SymmetricTensor<Pack> along_x(double s) { return {Pack(s), {}, {}, {}, {}, {}}; }
SymmetricTensor<Pack> shear(double s) { return {{}, {}, {}, Pack(s), {}, {}}; }

/// Limits lie half a step behind step 100 of a path whose stress and strain are linear: 100 steps are survived.
TEST(Erosion, EveryCriterionFailsThePointAtItsLimit) {
  const double n = 100.5 * step, lambda = elastic.lambda, mu = elastic.shear(), bulk = lambda + 2 * mu / 3;
  const auto pull = along_x(step), push = along_x(-step), slide = shear(step);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.min_pressure = -bulk * n; }, pull), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.min_pressure = -bulk * n; }, push), 1000);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.max_pressure = bulk * n; }, push), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.principal_stress = (lambda + 2 * mu) * n; }, pull), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.principal_stress = 2 * mu * n; }, slide), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.mises = 2 * mu * n; }, pull), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.mises = std::sqrt(3.0) * 2 * mu * n; }, slide), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.max_strain = n; }, pull), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.max_strain = n; }, slide), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.max_strain = n; }, push), 1000);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.min_strain = -n; }, slide), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.min_strain = -n; }, push), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.shear_strain = n; }, slide), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.shear_strain = 0.5 * n; }, pull), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.expansion = n; }, pull), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.compaction = -n; }, push), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.compaction = -n; }, pull), 1000);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.effective_strain = 2.0 / 3 * n; }, pull), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.effective_strain = 2 / std::sqrt(3.0) * n; }, slide), 100);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.time = 0.1005; }, pull), 100);
  EXPECT_EQ(steps_to_failure([](C&) {}, pull), 1000);
}

TEST(Erosion, ImpulseIsTulerAndButchersIntegral) {
  const double modulus = elastic.longitudinal(), threshold = modulus * 50 * step, dt = 1e-3;
  // sum over steps i > 50 of ((i - 50) step M)^2 dt: 100 - 50 = 50 more of them reach the limit.
  double limit = 0;
  for (int i = 1; i <= 50; ++i) limit += std::pow(i * step * modulus, 2) * dt;
  EXPECT_EQ(steps_to_failure([&](C& c) { c.impulse_stress = threshold, c.impulse = limit * (1 - 1e-9); }, along_x(step), dt), 99);
  EXPECT_EQ(steps_to_failure([&](C& c) { c.impulse_stress = threshold, c.impulse = limit * (1 + 1e-9); }, along_x(step), dt), 100);
}

TEST(Erosion, SeveralCriteriaMustHoldAtOnceWhereNcsSaysSo) {
  const auto two = [&](double needed) {
    return [=](C& c) {
      c.max_strain = 50.5 * step;
      c.expansion = 100.5 * step;
      c.needed = needed;
    };
  };
  EXPECT_EQ(steps_to_failure(two(1), along_x(step)), 50);
  EXPECT_EQ(steps_to_failure(two(2), along_x(step)), 100);
  EXPECT_EQ(steps_to_failure(two(3), along_x(step)), 1000);
}

/// Biaxial tension e: eps_zz = -2 nu/(1 - nu) e. The stress of a point that has failed is taken away for good.
TEST(Erosion, ShellsFailByThinningAndMajorStrain) {
  const PlaneStress<Pack> biaxial{Pack(step), Pack(step), {}, {}, {}};
  const double thinning = 2 * nu / (1 - nu);
  EXPECT_EQ(shell_steps_to_failure([&](C& c) { c.thinning = thinning * 100.5 * step; }, biaxial), 100);
  EXPECT_EQ(shell_steps_to_failure([&](C& c) { c.expansion = (2 - thinning) * 100.5 * step; }, biaxial), 100);
  EXPECT_EQ(shell_steps_to_failure([&](C& c) { c.min_strain = -thinning * 100.5 * step; }, biaxial), 100);
  const PlaneStress<Pack> sliding{Pack(step), Pack(-step), Pack(2 * step), {}, {}};  // principal: +- sqrt 2 step
  EXPECT_EQ(shell_steps_to_failure([&](C& c) { c.major_strain = std::sqrt(2.0) * 100.5 * step; }, sliding), 100);
}

TEST(Erosion, PlasticStrainOfTheLawBelow) {
  PlasticKinematic metal;
  metal.elastic = elastic;
  metal.yield_stress = 0.1;
  Erosion erosion;
  erosion.law = &metal;
  erosion.update = [](const void* law, void* p, const StepTime& t, double* values) {
    static_cast<const PlasticKinematic*>(law)->update(*static_cast<MaterialPoint<Pack>*>(p), t, values);
  };
  erosion.law_history = PlasticKinematic::history;
  erosion.law_plastic_strain = PlasticKinematic::plastic_strain;
  erosion.criteria.plastic_strain = 0.02;
  std::vector<double> values(erosion.history() * block_lanes);
  MaterialPoint<Pack> p;
  const double* strain = values.data() + (Erosion::law_begin + PlasticKinematic::plastic_strain) * block_lanes;
  for (int i = 0; i < 1000 && !(p.failed.v[0] > 0); ++i) {
    EXPECT_LT(*strain, 0.02);
    p.strain = shear(step);
    erode(erosion, p, StepTime{1e-3, 1e-3 * i}, values.data());
  }
  EXPECT_GE(*strain, 0.02);
  EXPECT_LT(*strain, 0.02 + 2 * step);
}

}  // namespace
}  // namespace kardan
