// Signals of verification on states made by hand.
#include "kardan/app/verify/signal.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "kardan/app/verify/series.hpp"

namespace kardan::verify {
namespace {

using nlohmann::json;

class Signals : public ::testing::Test {
 protected:
  Signals() {
    BodyInfo info;
    info.id = 7;
    info.mass = 2;
    info.initial_center = {1, 0, 0};
    info.initial_orientation = from_rotation_vector({0.3, -0.2, 0.9});
    state_.bodies.info = {info};
    state_.bodies.motion.resize(1);
    state_.bodies.report.resize(1);
    turn({});
    state_.bodies.motion[0].center = {1, 0, 0};
  }
  /// The body has turned by `rotation` since t = 0.
  void turn(const Vec3& rotation) {
    state_.bodies.motion[0].orientation = from_rotation_vector(rotation) * state_.bodies.info[0].initial_orientation;
  }
  std::vector<double> evaluate(const char* text) { return make_signal(json::parse(text), model_, state_)(state_); }

  Model model_;
  State state_;
};

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-14);
}

TEST_F(Signals, ComponentsProductsAndFactors) {
  state_.bodies.report[0].velocity = {3, 4, 12};
  expect_near(evaluate(R"({"body": 7, "quantity": "velocity"})"), {3, 4, 12});
  expect_near(evaluate(R"({"body": 7, "quantity": "velocity", "components": [2, 0]})"), {12, 3});
  expect_near(evaluate(R"({"body": 7, "quantity": "velocity", "along": [0, 1, 1], "factor": 2, "offset": 1})"), {33});
  expect_near(evaluate(R"({"body": 7, "quantity": "velocity", "norm": true})"), {13});
  expect_near(
      evaluate(R"({"sum": [{"body": 7, "quantity": "velocity"}, {"body": 7, "quantity": "center", "factor": -1}]})"),
      {2, 4, 12});
  expect_near(evaluate(R"({"quotient": [{"body": 7, "quantity": "velocity", "components": [2]},
                                        {"body": 7, "quantity": "velocity", "components": [0]}]})"),
              {4});
}

TEST_F(Signals, TurnsAreCountedBeyondHalfATurn) {
  for (const double sense : {1.0, -1.0}) {
    const auto fresh =
        make_signal(json::parse(R"({"body": 7, "quantity": "turn", "axis": [0, 0, 2]})"), model_, state_);
    for (int i = 0; i <= 100; ++i) {
      const double angle = sense * 0.2 * i;
      turn({0, 0, std::remainder(angle, 2 * std::numbers::pi)});
      EXPECT_NEAR(fresh(state_)[0], angle, 1e-12);
    }
  }
}

TEST_F(Signals, PointsAndAxesAreCarriedByTheBody) {
  state_.bodies.motion[0].center = {5, 0, 0};
  turn({0, 0, std::numbers::pi / 2});
  expect_near(evaluate(R"({"body": 7, "quantity": "carried_point", "point": [2, 0, 0]})"), {5, 1, 0});
  state_.bodies.report[0].angular_velocity = {1, 2, 3};
  expect_near(evaluate(R"({"body": 7, "quantity": "body_angular_velocity"})"), {2, -1, 3});
  const double h = std::sqrt(0.5);
  expect_near(evaluate(R"({"body": 7, "quantity": "quaternion"})"), {h, 0, 0, h});
  expect_near(evaluate(R"({"body": 7, "quantity": "quaternion", "initial": [0, 0, 0, 1]})"), {-h, 0, 0, h});
}

TEST_F(Signals, RelativeMotionIsSeenFromTheFirstBody) {
  state_.bodies.info.push_back(state_.bodies.info[0]);
  state_.bodies.info[1].id = 8;
  state_.bodies.motion.push_back(state_.bodies.motion[0]);
  state_.bodies.report.resize(2);
  // both turn by a quarter about z, the second goes on by 0.1 about its own x; it is 2 ahead in the turned frame's x
  turn({0, 0, std::numbers::pi / 2});
  const Quat quarter = from_rotation_vector({0, 0, std::numbers::pi / 2}), more = from_rotation_vector({0.1, 0, 0});
  state_.bodies.motion[1].orientation = quarter * more * state_.bodies.info[1].initial_orientation;
  state_.bodies.motion[1].center = state_.bodies.motion[0].center + Vec3{0, 2, 0};
  expect_near(evaluate(R"({"relative": [7, 8], "quantity": "displacement", "point": [1, 0, 0]})"), {2, 0, 0});
  expect_near(evaluate(R"({"relative": [7, 8], "quantity": "rotation"})"), {0.1, 0, 0});
  expect_near(evaluate(R"({"relative": [7, 8], "quantity": "direction", "direction": [0, 1, 0]})"),
              {0, std::cos(0.1), std::sin(0.1)});
}

TEST_F(Signals, MomentumCountsSpinAndPath) {
  state_.bodies.motion[0].velocity = {0, 3, 0};
  state_.bodies.motion[0].angular_momentum = {0, 0, 1};
  expect_near(evaluate(R"({"momentum": "linear"})"), {0, 6, 0});
  expect_near(evaluate(R"({"momentum": "angular"})"), {0, 0, 7});
}

TEST_F(Signals, PartsContactsAndWalls) {
  model_.parts.resize(2);
  model_.parts[0].id = 3;
  model_.parts[1].id = 4;
  model_.shells.id = {1, 2, 3};
  model_.shells.part = {0, 0, 1};
  model_.shells.nodes = {{0, 1, 2, 2}, {1, 2, 3, 3}, {4, 4, 4, 4}};  // two of the first share two nodes
  state_.nodes.mass = {1, 2, 3, 4, 100};
  state_.nodes.inertia = {0, 0, 0, 0.5, 100};
  state_.nodes.v_now.assign(5, {0, 1, 0});
  state_.nodes.omega_now.assign(5, {0, 0, 2});
  state_.nodes.x.assign(5, {});
  state_.nodes.x[1] = {10, 0, 0};
  expect_near(evaluate(R"({"part": 3, "quantity": "momentum"})"), {0, 10, 0});
  expect_near(evaluate(R"({"part": 3, "quantity": "angular_momentum"})"), {0, 0, 21});
  model_.contacts.resize(2);
  model_.contacts[1].id = 5;
  state_.contacts.resize(2);
  state_.contacts[1].force = {1, 2, 3};
  state_.contacts[1].friction_energy = 7;
  expect_near(evaluate(R"({"contact": 5, "quantity": "force"})"), {1, 2, 3});
  expect_near(evaluate(R"({"contact": 5, "quantity": "friction_energy"})"), {7});
  model_.rigid_walls.resize(2);
  model_.rigid_walls[1].id = 6;
  state_.walls.resize(2);
  state_.walls[1].force = {4, 5, 6};
  expect_near(evaluate(R"({"wall": 6, "quantity": "force"})"), {4, 5, 6});
}

TEST_F(Signals, UnknownThingsAreRefused) {
  for (const char* bad : {R"({"body": 8, "quantity": "center"})", R"({"body": 7, "quantity": "centre"})",
                          R"({"node": 1, "quantity": "position"})", R"({"joint": 1, "quantity": "force"})",
                          R"({"stiffness": 1, "quantity": "total"})", R"({"energy": "dark"})", R"({"part": 1, "quantity": "momentum"})", R"({"contact": 1, "quantity": "force"})", R"({"wall": 1, "quantity": "force"})", R"({"sum": []})",
                          R"({})", R"({"body": 7})", R"({"joint": "all", "quantity": "force"})"})
    EXPECT_THROW(evaluate(bad), CaseError) << bad;
}

}  // namespace
}  // namespace kardan::verify
