#include "kardan/rigid/body_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kardan/rigid/joint_parts.hpp"
#include "kardan/state/frames.hpp"

namespace kardan {

namespace {

Vec3 unit(int axis) { return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0}; }

/// Axes of the frame of a rigid part (LCO, else global axes): they turn with the body. Carried on from t_n by `ahead` with the
/// body's angular velocity: to the middle of the step, where the velocity stands that they direct.
Mat3 body_axes(const Model& model, const State& state, PartIndex part, BodyIndex body, double ahead) {
  Mat3 at_start = Mat3::identity();
  const Index material = part == none ? none : model.parts[part].material;
  if (material != none && model.materials[material].rigid()) {
    const auto& rigid = std::get<RigidMaterial>(model.materials[material].law);
    if (rigid.output_frame != none) {
      at_start = model.frames[rigid.output_frame].axes;
    } else if (norm(cross(rigid.a, rigid.v)) > 0) {
      const Vec3 x = normalized(rigid.a), z = normalized(cross(rigid.a, rigid.v));
      at_start = Mat3::columns(x, cross(z, x), z);
    }
  }
  const BodyMotion& motion = state.bodies.motion[body];
  const Quat turned = from_rotation_vector(motion.angular_velocity * ahead) * motion.orientation *
                      conjugate(state.bodies.info[body].initial_orientation);
  return to_matrix(turned) * at_start;
}

bool alive(const PrescribedMotion& motion, const Clock& clock) { return clock.time >= motion.birth && clock.time < motion.death; }

}  // namespace

std::vector<BodyConstraint> BodyMotions::initialise(const Model& model, State& state, const BodyAssembly& assembly,
                                                    Diagnostics& diagnostics) {
  std::vector<BodyConstraint> constraints;
  std::map<BodyIndex, std::size_t> constraint_of;
  const auto constraint_for = [&](BodyIndex body) {
    const auto [it, is_new] = constraint_of.try_emplace(body, constraints.size());
    if (is_new) constraints.emplace_back().body = body;
    return it->second;
  };
  for (std::size_t b = 0; b < assembly.fixity.size(); ++b) {
    const BodyFixity& f = assembly.fixity[b];
    if (f.global == 0 && f.local == 0) continue;
    const std::size_t c = constraint_for(static_cast<BodyIndex>(b));
    fixed_.push_back({c, f, 0.0, 1e300});
    constraints[c].fixed = (f.global | f.local) == dof_all && (f.global == dof_all || f.local == dof_all);
  }
  for (const TimedFixity& timed : assembly.timed_fixity)
    fixed_.push_back({constraint_for(timed.body), timed.fixity, timed.birth, timed.death});
  for (std::size_t m = 0; m < model.prescribed_motions.size(); ++m) {
    const PrescribedMotion& motion = model.prescribed_motions[m];
    if (motion.vector != none) need_vector(model, state, motion.vector);
    std::vector<BodyIndex> targets;
    if (motion.body_part != none) {
      const BodyIndex body = state.bodies.of_part[motion.body_part];
      if (body == none) {
        diagnostics.error(fmt::format("part {} is not a rigid body", model.parts[motion.body_part].id),
                          "give it *MAT_RIGID, or move its nodes by *BOUNDARY_PRESCRIBED_MOTION_SET",
                          "*BOUNDARY_PRESCRIBED_MOTION_RIGID");
        continue;
      }
      targets.push_back(body);
    }
    for (NodeIndex n : motion.nodes)
      if (state.nodes.body[n] != none) targets.push_back(state.nodes.body[n]);
    std::sort(targets.begin(), targets.end());
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    for (BodyIndex body : targets) {
      if (motion.body_part == none)
        diagnostics.notice(fmt::format("nodes of rigid body {} have a prescribed motion: it becomes a motion of the body",
                                       state.bodies.info[body].id), "*BOUNDARY_PRESCRIBED_MOTION");
      ReactionReport reaction;
      reaction.kind = ReactionReport::Kind::motion_of_body;
      reaction.id = motion.id;
      reaction.body = body;
      const bool rotation = std::abs(motion.dof) >= 5;
      drivers_.push_back({static_cast<Index>(m), constraint_for(body), state.reactions.size(), rotation});
      state.reactions.push_back(reaction);
    }
  }
  travelled_.assign(drivers_.size(), 0.0);
  reported_work_.assign(drivers_.size(), 0.0);
  directions_.assign(drivers_.size(), Vec3{});
  stoppers_.initialise(model, state, diagnostics);
  for (BodyIndex body : stoppers_.bodies()) constraint_for(body);
  stoppers_.bind(constraint_of);
  counted_.assign(constraints.size(), 0);
  return constraints;
}

BodyMotions::Directed BodyMotions::direction_of(const Model& model, const State& state, const PrescribedMotion& motion,
                                                BodyIndex body, double ahead) const {
  Directed d;
  const int dof = std::abs(motion.dof);
  d.only = motion.dof < 0;
  if (dof == 4 || dof == 8) {
    d.direction = vector_direction(model, state, motion.vector);
    d.rotation = dof == 8;
  } else if (dof >= 9) {
    const int axis = dof - 9;
    d.direction = unit(axis);
    d.rotation = d.offset_axis = true;
    d.axis_point = unit((axis + 1) % 3) * motion.offset_1 + unit((axis + 2) % 3) * motion.offset_2;
  } else {
    d.rotation = dof >= 5;
    const int axis = d.rotation ? dof - 5 : dof - 1;
    d.direction = motion.local ? body_axes(model, state, motion.body_part, body, ahead).column(static_cast<std::size_t>(axis))
                               : unit(axis);
  }
  return d;
}

double BodyMotions::speed(const Model& model, const State& state, const PrescribedMotion& motion, const Directed& d,
                          BodyIndex body, std::size_t driver, bool initial) const {
  const Clock& clock = state.clock;
  const BodyMotion& b = state.bodies.motion[body];
  const double now = dot(d.direction, d.rotation ? b.angular_velocity : b.velocity);
  const auto curve = [&](double x) {
    return motion.scale * (motion.curve == none ? 1.0 : model.curves[motion.curve].value(x));
  };
  switch (motion.kind) {
    case MotionKind::velocity:
      return curve(initial ? clock.time : clock.time + 0.5 * clock.dt);
    case MotionKind::acceleration:
      return initial ? now : now + curve(clock.time) * clock.kick();
    case MotionKind::displacement: {
      if (initial) return motion.curve == none ? 0.0 : motion.scale * model.curves[motion.curve].slope(clock.time);
      const double way = curve(clock.time + clock.dt) - curve(clock.time);
      // A Hughes-Winget step of h w turns by 2 atan(h w / 2): the angle asked for is met exactly.
      return d.rotation ? 2.0 * std::tan(0.5 * way) / clock.dt : way / clock.dt;
    }
    case MotionKind::velocity_versus_displacement:
      return curve(travelled_[driver]);
    case MotionKind::relative_displacement:  // a motor joint by now
      break;
  }
  KARDAN_ASSERT(false);
  return now;
}

void BodyMotions::prescribe(const Model& model, const State& state, BodySet& bodies, bool initial) {
  for (BodyConstraint& c : bodies.constraints) {
    c.linear.clear();
    c.angular.clear();
  }
  for (const Fixed& fixed : fixed_) {
    if (state.clock.time < fixed.birth || state.clock.time >= fixed.death) continue;
    BodyConstraint& c = bodies.constraints[fixed.constraint];
    for (int i = 0; i < 3; ++i) {
      if (fixed.fixity.global >> i & 1) c.linear.add(unit(i), 0.0);
      if (fixed.fixity.global >> (i + 3) & 1) c.angular.add(unit(i), 0.0);
    }
    if (fixed.fixity.local == 0) continue;
    const Mat3 axes = fixed.fixity.frame == none ? Mat3::identity() : model.frames[fixed.fixity.frame].axes;
    for (std::size_t i = 0; i < 3; ++i) {
      if (fixed.fixity.local >> i & 1) c.linear.add(axes.column(i), 0.0);
      if (fixed.fixity.local >> (i + 3) & 1) c.angular.add(axes.column(i), 0.0);
    }
  }
  for (std::size_t k = 0; k < drivers_.size(); ++k) {
    const PrescribedMotion& motion = model.prescribed_motions[drivers_[k].motion];
    if (!alive(motion, state.clock)) continue;
    BodyConstraint& c = bodies.constraints[drivers_[k].constraint];
    const double h = initial ? 0.0 : state.clock.dt;
    const Directed d = direction_of(model, state, motion, c.body, 0.5 * h);
    const double value = speed(model, state, motion, d, c.body, k, initial);
    (d.rotation ? c.angular : c.linear).add(d.direction, value);
    directions_[k] = d.direction;
    if (d.offset_axis) {
      // The centre circles about the axis through axis_point: v = w x (r + h v / 2), r the arm at t_n, turns it by the very
      // Hughes-Winget step h w of the body and keeps its length.
      const Vec3 w = d.direction * value;
      const Vec3 arm_rate = cross(w, state.bodies.motion[c.body].center - d.axis_point);
      const Vec3 v = (arm_rate + cross(w, arm_rate) * (0.5 * h)) / (1.0 + 0.25 * h * h * dot(w, w));
      for (int i = 0; i < 3; ++i)
        if (i != std::abs(motion.dof) - 9 || d.only) c.linear.add(unit(i), v[i]);
    } else if (d.only) {
      for (int i = 0; i < 3; ++i) {  // the axis most along the direction depends on it and is not added twice
        const Vec3 across = unit(i) - d.direction * dot(unit(i), d.direction);
        if (norm(across) > 1e-6) (d.rotation ? c.angular : c.linear).add(across, 0.0);
      }
    }
  }
  if (!initial) stoppers_.prescribe(model, state, bodies);
}

void BodyMotions::account(const Model& model, State& state, const BodySet& bodies) {
  const Clock& clock = state.clock;
  work_before_ += work_of_kick_;
  work_of_kick_ = 0;
  std::fill(counted_.begin(), counted_.end(), std::uint8_t{0});
  stoppers_.account(state, bodies);
  for (std::size_t k = 0; k < drivers_.size(); ++k) {
    const Driver& driver = drivers_[k];
    ReactionReport& report = state.reactions[driver.reaction];
    report.force = report.moment = {};
    report.work = reported_work_[k];
    if (!alive(model.prescribed_motions[driver.motion], clock)) continue;
    const auto b = static_cast<std::size_t>(bodies.constraints[driver.constraint].body);
    const BodyTrial& after = bodies.trial[b];
    const BodyMotion& before = state.bodies.motion[b];
    // What the constraints of the body added to the kick of all other forces.
    const Vec3 impulse = (after.constrained_velocity - after.velocity) * state.bodies.info[b].mass;
    const Vec3 angular_impulse = bodies.angular_momentum_after(b, clock.dt) - after.angular_momentum;
    report.force = impulse / clock.kick();
    report.moment = angular_impulse / clock.kick();
    const Vec3& direction = directions_[k];
    travelled_[k] += driver.rotation ? rotation_about(after.angular_velocity, direction, clock.dt)
                                     : dot(direction, after.constrained_velocity) * clock.dt;
    if (counted_[driver.constraint]) continue;  // several drivers of one body share its work
    counted_[driver.constraint] = 1;
    const double work = 0.5 * dot(impulse, before.velocity + after.constrained_velocity) +
                        0.5 * dot(angular_impulse, before.angular_velocity + after.angular_velocity) -
                        stoppers_.work_on(driver.constraint);
    report.work = reported_work_[k] += work;
    work_of_kick_ += work;
  }
}

void BodyMotions::register_state(State& state) {
  state.registry.add({"rigid.motion_travelled", "length or angle", "rigid.kick"}, travelled_);
  state.registry.add_value({"rigid.motion_work", "energy", "rigid.account"}, work_before_);
  state.registry.add_value({"rigid.motion_work_of_kick", "energy", "rigid.account"}, work_of_kick_);
  state.registry.keep({"rigid.motion_reported_work", "energy", "rigid.kick"}, reported_work_);
  stoppers_.register_state(state);
}

}  // namespace kardan
