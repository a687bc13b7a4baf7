#include "kardan/io/tables/body_frames.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace kardan {

namespace {

/// Axes of A1..A3 and V1..V3 of *MAT_RIGID: local x along a, local z along a x v; false where they are not given.
bool axes_of_vectors(const Vec3& a, const Vec3& v, Mat3& axes) {
  const Vec3 c = cross(a, v);
  if (norm(a) == 0 || norm(c) == 0) return false;
  const Vec3 x = normalized(a), z = normalized(c);
  axes = Mat3::columns(x, cross(z, x), z);
  return true;
}

Mat3 initial_axes(const Model& model, const BodyInfo& info) {
  const auto frame = [&](Index f) { return model.frames[static_cast<std::size_t>(f)].axes; };
  if (info.nodal) {
    for (const NodalRigidBody& n : model.nodal_rigid_bodies)
      if (n.id == info.id && n.frame != none) return frame(n.frame);
  } else if (info.part != none) {
    const Index m = model.parts[static_cast<std::size_t>(info.part)].material;
    const auto* rigid =
        m == none ? nullptr : std::get_if<RigidMaterial>(&model.materials[static_cast<std::size_t>(m)].law);
    Mat3 axes;
    if (rigid && rigid->output_frame != none) return frame(rigid->output_frame);
    if (rigid && axes_of_vectors(rigid->a, rigid->v, axes)) return axes;
  }
  return to_matrix(info.initial_orientation);
}

/// The rotation vector of `q` nearest to `expected`.
Vec3 unwound(const Quat& q, const Vec3& expected) {
  constexpr double turn = 2 * std::numbers::pi;
  const Vec3 theta = to_rotation_vector(q);
  const double angle = norm(theta), expected_angle = norm(expected);
  // Near whole turns the axis of theta is lost; the expected one is as good.
  if (angle < 1e-6)
    return expected_angle == 0 ? theta : theta + expected * (turn * std::round(expected_angle / turn) / expected_angle);
  const Vec3 axis = theta * (1.0 / angle);
  return axis * (angle + turn * std::round((dot(expected, axis) - angle) / turn));
}

nlohmann::json numbers_of(const std::vector<Vec3>& vectors) {
  nlohmann::json list = nlohmann::json::array();
  for (const Vec3& v : vectors)
    for (const double x : {v.x, v.y, v.z}) list.push_back(x);
  return list;
}

void take_numbers(const nlohmann::json& list, std::vector<Vec3>& vectors) {
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) vectors[i][k] = list.at(3 * i + k).get<double>();
}

}  // namespace

nlohmann::json BodyFrames::mark() const {
  return {{"time", time_}, {"rotation", numbers_of(rotation_)}, {"angular_velocity", numbers_of(angular_velocity_)}};
}

void BodyFrames::resume(const nlohmann::json& mark) {
  mark.at("time").get_to(time_);
  take_numbers(mark.at("rotation"), rotation_);
  take_numbers(mark.at("angular_velocity"), angular_velocity_);
}

BodyFrames::BodyFrames(const Model& model, const State& state) {
  for (const BodyInfo& info : state.bodies.info) initial_axes_.push_back(initial_axes(model, info));
  rotation_.assign(initial_axes_.size(), Vec3{});
  angular_velocity_.assign(initial_axes_.size(), Vec3{});
  time_ = state.clock.time;
  for (std::size_t b = 0; b < initial_axes_.size() && b < state.bodies.report.size(); ++b)
    angular_velocity_[b] = state.bodies.report[b].angular_velocity;
}

Mat3 BodyFrames::axes(const State& state, BodyIndex b) const {
  const auto i = static_cast<std::size_t>(b);
  return to_matrix(state.bodies.motion[i].orientation * conjugate(state.bodies.info[i].initial_orientation)) *
         initial_axes_[i];
}

void BodyFrames::follow(const State& state) {
  const double elapsed = state.clock.time - time_;
  time_ = state.clock.time;
  for (std::size_t b = 0; b < rotation_.size(); ++b) {
    const Vec3& omega = state.bodies.report[b].angular_velocity;
    const Quat turned = state.bodies.motion[b].orientation * conjugate(state.bodies.info[b].initial_orientation);
    rotation_[b] = unwound(turned, rotation_[b] + (angular_velocity_[b] + omega) * (0.5 * elapsed));
    angular_velocity_[b] = omega;
  }
}

}  // namespace kardan
