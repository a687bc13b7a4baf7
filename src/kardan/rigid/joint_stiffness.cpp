#include "kardan/rigid/joint_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kardan {

namespace {

bool rotational(JointStiffnessKind kind) {
  return kind == JointStiffnessKind::generalized || kind == JointStiffnessKind::flexion_torsion;
}

double stop_moment(const JointStiffness::Coordinate& c, double q) {
  const double low = -std::abs(c.stop_negative), high = std::abs(c.stop_positive);
  if (c.stop_positive != 0 && q > high) return c.elastic * (q - high);
  if (c.stop_negative != 0 && q < low) return c.elastic * (q - low);
  return 0;
}

/// alpha, gamma, beta of B's frame in A's (columns of the rotation `r` are B's axes in A's components).
std::array<double, 3> bend_and_twist(const Mat3& r) {
  const Vec3 z = r.column(2);
  const double alpha = std::atan2(std::hypot(z.x, z.y), z.z);
  const double gamma = std::atan2(z.y, z.x);
  // Undo the shortest rotation that brings z to z_B; what is left is the twist about z.
  const Quat shortest = normalized(Quat{1.0 + std::max(z.z, -1.0 + 1e-12), -z.y, z.x, 0.0});
  const Quat twist = conjugate(shortest) * from_matrix(r);
  return {alpha, gamma, 2.0 * std::atan2(twist.z, twist.w)};
}

/// Direction from point 1 to point 3: the axis a translational or cylindrical joint slides along. Zero if it has none.
Vec3 joint_axis(const Model& model, const Joint& joint) {
  Vec3 d;
  if (joint.points) {
    d = (*joint.points)[2] - (*joint.points)[0];
  } else if (joint.nodes[2] != none) {
    d = model.nodes.x[joint.nodes[2]] - model.nodes.x[joint.nodes[0]];
  }
  const double length = norm(d);
  return length > 0 ? d / length : d;
}

/// The rotation vector of `q` next to `previous`: the same rotation, whole turns added.
Vec3 rotation_vector_next_to(const Quat& q, const Vec3& previous) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const Vec3 v = to_rotation_vector(q);
  const double angle = norm(v);
  if (angle < 1e-8) {
    // Whole turns about the axis of the angles before.
    const double before = norm(previous);
    return before > 1.0 ? v + previous * (std::round(before / turn) * turn / before) : v;
  }
  const Vec3 axis = v / angle;
  return axis * (angle + turn * std::round((dot(previous, axis) - angle) / turn));
}

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

}  // namespace

void JointStiffnesses::initialise(const Model& model, State& state, const JointSet& joints, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < model.joint_stiffnesses.size(); ++k) {
    const JointStiffness& deck = model.joint_stiffnesses[k];
    Element e{};
    e.model_index = static_cast<Index>(k);
    bool sound = true;
    for (auto [part, body] : {std::pair{deck.part_a, &e.a}, {deck.part_b, &e.b}}) {
      *body = part == none ? none : state.bodies.of_part[part];
      if (*body != none) continue;
      diagnostics.error(fmt::format("joint stiffness {}: part {} is not a rigid body", deck.id,
                                    part == none ? 0 : model.parts[part].id),
                        "name two parts with *MAT_RIGID", "*CONSTRAINED_JOINT_STIFFNESS");
      sound = false;
    }
    if (!sound) continue;
    const auto attach = [&](BodyIndex body, Index frame, Mat3& axes, Vec3& origin) {
      const BodyMotion& m = state.bodies.motion[body];
      const Mat3 to_body = transpose(to_matrix(m.orientation));
      axes = to_body * (frame == none ? Mat3::identity() : model.frames[frame].axes);
      origin = to_body * ((frame == none ? m.center : model.frames[frame].origin) - m.center);
    };
    const Index frame_b = deck.frame_b == none ? deck.frame_a : deck.frame_b;
    attach(e.a, deck.frame_a, e.axes_a, e.origin_a);
    attach(e.b, frame_b, e.axes_b, e.origin_b);
    for (std::size_t j = 0; j < joints.joints.size(); ++j)
      if (deck.joint != 0 && model.joints[joints.joints[j].model_joint].id == deck.joint) e.joint = static_cast<int>(j);
    if (e.joint >= 0) {
      const Mat3 axes = frame_b == none ? Mat3::identity() : model.frames[frame_b].axes;
      const Vec3 axis = joint_axis(model, model.joints[joints.joints[e.joint].model_joint]);
      for (std::size_t i = 0; i < 3; ++i)
        e.slides[i] = deck.kind == JointStiffnessKind::cylindrical ? i == 2 : std::abs(dot(axes.column(i), axis)) > 0.9;
    }
    Memory m{};
    const Mat3 r = transpose(to_matrix(state.bodies.motion[e.a].orientation) * e.axes_a) *
                   (to_matrix(state.bodies.motion[e.b].orientation) * e.axes_b);
    m.relative = from_matrix(r);
    if (deck.kind == JointStiffnessKind::generalized) {
      const Vec3 angles = to_rotation_vector(m.relative);
      m.coordinate = {angles.x, angles.y, angles.z};
    } else if (deck.kind == JointStiffnessKind::flexion_torsion) {
      m.coordinate = bend_and_twist(r);
    }
    elements_.push_back(e);
    memory_.push_back(m);
  }
  state.joint_stiffnesses.assign(model.joint_stiffnesses.size(), {});
}

JointStiffnesses::Kinematics JointStiffnesses::kinematics(const Model& model, const State& state, const BodySet& bodies,
                                                          const Element& e, Memory& m) const {
  const JointStiffness& deck = model.joint_stiffnesses[e.model_index];
  const Mat3 axes_a = bodies.rotation[e.a] * e.axes_a, axes_b = bodies.rotation[e.b] * e.axes_b;
  const BodyMotion &a = state.bodies.motion[e.a], &b = state.bodies.motion[e.b];
  const Mat3 r = transpose(axes_a) * axes_b;
  const Quat relative = from_matrix(r);
  const Vec3 spin = b.angular_velocity - a.angular_velocity;
  Kinematics k{};
  switch (deck.kind) {
    case JointStiffnessKind::generalized: {
      const bool total = model.control.rigid.jntf != 0;
      const Vec3 turn = total ? rotation_vector_next_to(relative, {m.coordinate[0], m.coordinate[1], m.coordinate[2]})
                              : to_rotation_vector(relative * conjugate(m.relative));
      for (std::size_t i = 0; i < 3; ++i) {
        k.coordinate[i] = total ? turn[i] : m.coordinate[i] + turn[i];
        k.direction[i] = axes_a.column(i);
        k.rate[i] = dot(spin, k.direction[i]);
      }
      break;
    }
    case JointStiffnessKind::flexion_torsion: {
      k.coordinate = bend_and_twist(r);
      const Vec3 z_a = axes_a.column(2), z_b = axes_b.column(2);
      const Vec3 normal = cross(z_a, z_b);
      const double sine = norm(normal);
      k.direction[0] = sine > 1e-12 ? normal / sine : Vec3{};
      k.direction[2] = z_b;
      k.rate[0] = dot(spin, k.direction[0]);
      k.rate[2] = dot(spin, z_b);
      // Angles that live on a circle follow their predecessor.
      for (std::size_t i : {1, 2}) k.coordinate[i] = m.coordinate[i] + wrapped(k.coordinate[i] - m.coordinate[i]);
      k.rate[1] = state.clock.dt_previous > 0 ? (k.coordinate[1] - m.coordinate[1]) / state.clock.dt_previous : 0.0;
      if (deck.moment_scale != none) k.bend = model.curves[deck.moment_scale].value(wrapped(k.coordinate[1]));
      if (deck.damping_scale != none) k.bend_rate = model.curves[deck.damping_scale].value(k.rate[1]);
      break;
    }
    case JointStiffnessKind::translational:
    case JointStiffnessKind::cylindrical: {
      const Vec3 origin_a = a.center + bodies.rotation[e.a] * e.origin_a;
      const Vec3 origin_b = b.center + bodies.rotation[e.b] * e.origin_b;
      const Vec3 d = origin_b - origin_a;
      // The axes turn with one body: the coordinates are those of the other's origin in it, and the forces act there.
      k.point = deck.kind == JointStiffnessKind::translational ? origin_a : origin_b;
      const Vec3 v = b.velocity + cross(b.angular_velocity, k.point - b.center) - a.velocity -
                     cross(a.angular_velocity, k.point - a.center);
      if (deck.kind == JointStiffnessKind::translational) {
        for (std::size_t i = 0; i < 3; ++i) k.direction[i] = axes_b.column(i);
      } else {
        const Vec3 z = axes_a.column(2);
        const Vec3 across = d - z * dot(z, d);
        const double radius = norm(across);
        k.direction[0] = radius > 0 ? across / radius : Vec3{};
        k.direction[2] = z;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        k.coordinate[i] = dot(d, k.direction[i]);
        k.rate[i] = dot(v, k.direction[i]);
      }
      break;
    }
  }
  m.relative = relative;
  return k;
}

double JointStiffnesses::friction(const Model& model, const JointStiffness::Coordinate& c, const Sliding& now,
                                  double before, double& slips) const {
  const double given = c.friction_curve != none ? std::abs(model.curves[c.friction_curve].value(now.coordinate)) : std::abs(c.friction);
  // One coefficient alone serves at rest and in motion.
  const double mu_rest = c.static_coefficient > 0 ? c.static_coefficient : c.dynamic_coefficient;
  const double mu_motion = c.dynamic_coefficient > 0 ? c.dynamic_coefficient : c.static_coefficient;
  const double at_rest = given + mu_rest * now.normal_force, in_motion = given + mu_motion * now.normal_force;
  if (at_rest == 0) return 0;
  double trial = now.stopping_force;
  if (c.elastic > 0) {
    // A joint that moves already at t = 0 starts with its spring drawn.
    trial = (now.first ? c.elastic * now.rate * now.dt : before) + c.elastic * now.increment;
  }
  // Once it slips it slips at the lower limit, until that is enough to hold it.
  if (std::abs(trial) <= (slips != 0 ? in_motion : at_rest)) {
    slips = 0.0;
    return trial;
  }
  slips = 1.0;
  return std::copysign(in_motion, trial);
}

double JointStiffnesses::stopping_force(const State& state, const BodySet& bodies, const Element& e, const Kinematics& k,
                                        std::size_t i) const {
  // m_eff (v + kick (f_B / m_B - f_A / m_A) . e) / kick, the joint's own forces being square to the way.
  const Vec3& along = k.direction[i];
  const double inverse_a = dot(along, bodies.linear_response(e.a, along)), inverse_b = dot(along, bodies.linear_response(e.b, along));
  if (!(inverse_a + inverse_b > 0)) return 0.0;
  const double kick = state.clock.kick();
  const double driven = k.rate[i] + kick * dot(along, bodies.linear_response(e.b, state.bodies.force[e.b]) -
                                                          bodies.linear_response(e.a, state.bodies.force[e.a]));
  return driven / ((inverse_a + inverse_b) * kick);
}

bool JointStiffnesses::asks_for_joint_forces() const {
  return std::any_of(elements_.begin(), elements_.end(), [](const Element& e) { return e.joint >= 0; });
}

void JointStiffnesses::apply(const Model& model, State& state, const BodySet& bodies, const JointSet& joints,
                             const std::vector<double>& joint_force) {
  for (std::size_t n = 0; n < elements_.size(); ++n) {
    const Element& e = elements_[n];
    Memory& m = memory_[n];
    const JointStiffness& deck = model.joint_stiffnesses[e.model_index];
    const Kinematics k = kinematics(model, state, bodies, e, m);
    JointStiffnessReport& report = state.joint_stiffnesses[e.model_index];
    const double normal_force =
        e.joint < 0 ? 0.0
                    : norm(joints.resultant(bodies, static_cast<std::size_t>(e.joint), joint_force.data() + joints.offset[e.joint]).first);
    Vec3 total;
    for (std::size_t i = 0; i < 3; ++i) {
      const JointStiffness::Coordinate& c = deck.coordinate[i];
      const bool only_scales = deck.kind == JointStiffnessKind::flexion_torsion && i == 1;
      const bool first = state.clock.cycle == 0;
      const double q = k.coordinate[i], dq = first ? 0.0 : q - m.coordinate[i];
      const double ratio = state.clock.dt_previous > 0 ? 0.5 : 0.0;
      const double rate = k.rate[i] + ratio * (k.rate[i] - m.rate_before[i]);
      const double bend = i == 0 ? k.bend : 1.0, bend_rate = i == 0 ? k.bend_rate : 1.0;
      double elastic = 0, damping = 0;
      if (!only_scales) {
        if (c.moment != none) elastic += bend * model.curves[c.moment].value(q);
        if (c.damping != none) damping += bend_rate * model.curves[c.damping].value(rate);
        const double rubbing = e.slides[i] ? normal_force : 0.0;
        const double stopping = rubbing > 0 ? stopping_force(state, bodies, e, k, i) : 0.0;
        const Sliding now{q, dq, rate, rubbing, stopping, state.clock.dt, first};
        m.friction[i] = friction(model, c, now, m.friction[i], m.slips[i]);
        elastic += stop_moment(c, q) + m.friction[i];
      }
      const double moment = elastic + damping;
      report.energy += 0.5 * (moment + m.moment[i]) * dq;
      report.coordinate[i] = q;
      report.rate[i] = rate;
      report.elastic[i] = only_scales ? k.bend : elastic;
      report.damping[i] = damping;
      report.total[i] = moment;
      m.coordinate[i] = q;
      m.rate_before[i] = k.rate[i];
      m.moment[i] = moment;
      total += k.direction[i] * moment;
    }
    if (rotational(deck.kind)) {
      state.bodies.moment[e.a] += total;
      state.bodies.moment[e.b] -= total;
    } else {
      state.bodies.force[e.a] += total;
      state.bodies.force[e.b] -= total;
      state.bodies.moment[e.a] += cross(k.point - state.bodies.motion[e.a].center, total);
      state.bodies.moment[e.b] -= cross(k.point - state.bodies.motion[e.b].center, total);
    }
  }
}

double JointStiffnesses::energy(const State& state) const {
  double sum = 0;
  for (const Element& e : elements_) sum += state.joint_stiffnesses[e.model_index].energy;
  return sum;
}

void JointStiffnesses::register_state(State& state) {
  state.registry.add({"joint_stiffness.memory", "mixed", "rigid.kick"}, memory_);
  state.registry.add({"joint_stiffness.reports", "mixed", "rigid.kick"}, state.joint_stiffnesses);
}

}  // namespace kardan
