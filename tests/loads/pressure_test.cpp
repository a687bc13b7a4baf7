// Pressure on segments: resultants, rotation, the work p dV, the energy of an accelerated plate.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kardan/base/rotation.hpp"
#include "kardan/loads/pressure_loads.hpp"
#include "loads/bench.hpp"

namespace kardan {
namespace {

using Segment = std::array<NodeIndex, 4>;

/// A brick whose corners stand off their places, so that its faces are warped; faces with normals outward.
const std::array<Vec3, 8> corners{{{0, 0, 0}, {1.1, -0.1, 0.2}, {1.3, 1.2, -0.1}, {-0.2, 0.9, 0.1},
                                   {0.1, 0.2, 1.0}, {0.9, 0.1, 1.4}, {1.0, 1.0, 0.8}, {0.2, 1.3, 1.2}}};
const std::vector<Segment> faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

PressureLoad pressure(std::vector<Segment> segments, CurveIndex curve, double scale) {
  PressureLoad load;
  load.segments = std::move(segments);
  load.curve = curve;
  load.scale = scale;
  return load;
}

/// Volume of the trilinear brick by 3 x 3 x 3 Gauss points of its Jacobian: exact, and not by way of its surface.
double volume(const std::array<Vec3, 8>& x) {
  constexpr std::array<double, 3> point{-0.7745966692414834, 0, 0.7745966692414834}, weight{5.0 / 9, 8.0 / 9, 5.0 / 9};
  constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  double v = 0;
  for (std::size_t i = 0; i < 27; ++i) {
    const Vec3 q{point[i % 3], point[i / 3 % 3], point[i / 9]};
    Vec3 d[3];
    for (std::size_t k = 0; k < 8; ++k) {
      const double a = 1 + sign[k][0] * q.x, b = 1 + sign[k][1] * q.y, c = 1 + sign[k][2] * q.z;
      d[0] += x[k] * (sign[k][0] * b * c / 8);
      d[1] += x[k] * (a * sign[k][1] * c / 8);
      d[2] += x[k] * (a * b * sign[k][2] / 8);
    }
    v += weight[i % 3] * weight[i / 3 % 3] * weight[i / 9] * dot(d[0], cross(d[1], d[2]));
  }
  return v;
}

TEST(Pressure, ParallelogramAndTriangleShareTheForceEquallyAgainstTheNormal) {
  Bench b;
  for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2.5, 3, 0}, Vec3{0.5, 3, 0}, Vec3{0, 0, 1}, Vec3{0, 4, 1}, Vec3{0, 0, 6}}) b.node(x);
  const CurveIndex one = b.curve({0, 1}, {1, 1});
  b.model.pressure_loads = {pressure({{0, 1, 2, 3}}, one, 8), pressure({{4, 5, 6, 6}}, one, 3)};
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  loads.apply(b.model, b.state);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(norm(b.state.nodes.force[n] - Vec3{0, 0, -12}), 0, 1e-14);  // 8 x 6 / 4
  for (std::size_t n = 4; n < 7; ++n) EXPECT_NEAR(norm(b.state.nodes.force[n] - Vec3{-10, 0, 0}), 0, 1e-14);  // 3 x 10 / 3
  EXPECT_EQ(b.state.nodes.needed[6], 1);
}

TEST(Pressure, ClosedSurfaceOfWarpedFacesHasNoResultantAndDoesTheWorkOfTheVolume) {
  Bench b;
  for (const Vec3& x : corners) b.node(x);
  b.model.pressure_loads = {pressure(faces, b.curve({0, 1}, {1, 1}), 7)};
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  loads.apply(b.model, b.state);
  Vec3 force, moment;
  double power = 0, largest = 0;
  const double step = 1e-4;
  std::array<Vec3, 8> ahead = corners, behind = corners;
  for (std::size_t n = 0; n < 8; ++n) {
    const Vec3& f = b.state.nodes.force[n];
    const double s = static_cast<double>(n);
    const Vec3 v{std::sin(1 + s), std::cos(2 * s), std::sin(3 * s * s)};
    force += f;
    moment += cross(corners[n], f);
    largest = std::max(largest, norm(f));
    power += dot(f, v);
    ahead[n] += v * step;
    behind[n] -= v * step;
  }
  EXPECT_GT(largest, 2.0);
  EXPECT_LT(norm(force), 1e-14 * largest);
  EXPECT_LT(norm(moment), 1e-14 * largest);
  // The volume is cubic in the step: the central difference errs by step^2. Outside pressure works against the growth.
  EXPECT_NEAR(power, -7 * (volume(ahead) - volume(behind)) / (2 * step), 1e-6);
}

TEST(Pressure, TurnsWithItsSurface) {
  Bench b;
  for (const Vec3& x : corners) b.node(x);
  b.model.pressure_loads = {pressure({faces[1]}, b.curve({0, 1}, {1, 1}), 7)};
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  loads.apply(b.model, b.state);
  const std::vector<Vec3> before = b.state.nodes.force;
  const Mat3 turn = to_matrix(from_rotation_vector({0.7, -1.1, 0.4}));
  for (Vec3& x : b.state.nodes.x) x = turn * x + Vec3{3, 4, 5};
  b.clear_forces();
  loads.apply(b.model, b.state);
  for (std::size_t n = 4; n < 8; ++n) EXPECT_LT(norm(b.state.nodes.force[n] - turn * before[n]), 1e-13);
}

TEST(Pressure, BeginsAtItsArrivalWithTheCurveFromItsStart) {
  Bench b;
  for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}) b.node(x);
  b.model.pressure_loads = {pressure({{0, 1, 2, 3}}, b.curve({0, 1}, {10, 20}), 4)};
  b.model.pressure_loads[0].arrival = 2;
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  for (const auto& [time, wanted] : {std::pair{1.99, 0.0}, std::pair{2.0, -10.0}, std::pair{2.5, -15.0}}) {
    b.state.clock.time = time;
    b.clear_forces();
    loads.apply(b.model, b.state);
    EXPECT_NEAR(b.state.nodes.force[0].z, wanted, 1e-13);
  }
}

TEST(Pressure, WorkIsTheKineticEnergyOfAFreePlateThatTumbles) {
  Bench b;
  for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1.2, 1, 0.3}, Vec3{0, 1.1, 0}}) b.node(x);
  b.model.pressure_loads = {pressure({{0, 1, 2, 3}}, b.curve({0, 1}, {0, 1}), 50)};
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  for (int i = 0; i < 50; ++i) b.step(loads, 0.01);
  const double energy = b.kinetic_energy_after_kick();
  b.model.curves[0].y = {0, 0};
  b.step(loads, 0.01);  // closes the last kick
  EXPECT_GT(energy, 1.0);
  EXPECT_NEAR(b.state.energy.external_work, energy, 1e-12 * energy);
}

TEST(Pressure, RefusesANodeThatNothingCarries) {
  Bench b;
  for (const Vec3& x : corners) b.node(x);
  b.model.pressure_loads = {pressure(faces, b.curve({0, 1}, {1, 1}), 7)};
  b.size_state(0.0);
  const LoadSystem loads(b.model, b.state, b.diagnostics);
  EXPECT_EQ(b.diagnostics.error_count(), 1u);
}

}  // namespace
}  // namespace kardan
