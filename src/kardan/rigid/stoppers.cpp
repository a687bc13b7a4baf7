#include "kardan/rigid/stoppers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kardan/rigid/joint_parts.hpp"

namespace kardan {

void Stoppers::initialise(const Model& model, const State& state, Diagnostics& diagnostics) {
  for (const RigidBodyStopper& deck : model.stoppers) {
    const auto stopped = [&](PartIndex part, double closure) {
      const BodyIndex body = part == none ? none : state.bodies.of_part[part];
      if (body == none)
        diagnostics.error(fmt::format("part {} is not a rigid body and cannot have a stopper",
                                      part == none ? 0 : model.parts[part].id),
                          "name a part with *MAT_RIGID", "*CONSTRAINED_RIGID_BODY_STOPPERS");
      return Stopped{body, closure, 0};
    };
    Stopper stopper{&deck, stopped(deck.part, 0.0), {}, {}};
    for (const auto& f : deck.followers_maximum) stopper.followers_maximum.push_back(stopped(f.part, f.closure));
    for (const auto& f : deck.followers_minimum) stopper.followers_minimum.push_back(stopped(f.part, f.closure));
    stoppers_.push_back(std::move(stopper));
  }
  turned_.assign(stoppers_.size(), 0.0);
}

std::vector<BodyIndex> Stoppers::bodies() const {
  std::vector<BodyIndex> result;
  for (const Stopper& s : stoppers_) {
    if (s.lead.body != none) result.push_back(s.lead.body);
    for (const auto* list : {&s.followers_maximum, &s.followers_minimum})
      for (const Stopped& f : *list)
        if (f.body != none) result.push_back(f.body);
  }
  return result;
}

void Stoppers::bind(const std::map<BodyIndex, std::size_t>& constraint_of) {
  const auto bind_one = [&](Stopped& s) {
    if (s.body != none) s.constraint = constraint_of.at(s.body);
  };
  for (Stopper& s : stoppers_) {
    bind_one(s.lead);
    for (auto* list : {&s.followers_maximum, &s.followers_minimum})
      for (Stopped& f : *list) bind_one(f);
  }
}

Vec3 Stoppers::direction(const Model& model, const Stopper& stopper) const {
  const int dof = stopper.deck->direction;
  if (dof == 4 || dof == 8) {
    const DirectionVector& v = model.vectors[stopper.deck->vector];
    return normalized(v.head - v.tail);
  }
  Vec3 d;
  d[static_cast<std::size_t>(dof >= 5 ? dof - 5 : dof - 1)] = 1.0;
  return d;
}

void Stoppers::stop(const Stopper& stopper, const Stopped& stopped, const Vec3& along, double value, BodySet& bodies) {
  BodyConstraint& c = bodies.constraints[stopped.constraint];
  const bool rotation = stopper.deck->direction >= 5;
  if ((rotation ? c.angular : c.linear).add(along, value)) acting_.push_back({stopped, along, rotation, 0.0});
}

void Stoppers::account(const State& state, const BodySet& bodies) {
  energy_before_ += energy_of_kick_;
  energy_of_kick_ = energy_until_now_ = 0;
  const double share = state.clock.share_before();
  for (Acting& a : acting_) {
    const auto b = static_cast<std::size_t>(a.stopped.body);
    const BodyTrial& after = bodies.trial[b];
    const BodyMotion& before = state.bodies.motion[b];
    const Vec3 impulse = a.rotation ? bodies.angular_momentum_after(b, state.clock.dt) - after.angular_momentum
                                    : (after.constrained_velocity - after.velocity) * state.bodies.info[b].mass;
    const double along = dot(a.along, impulse);
    const double from = dot(a.along, a.rotation ? before.angular_velocity : before.velocity);
    const double to = dot(a.along, a.rotation ? after.angular_velocity : after.constrained_velocity);
    const double now = from + share * (to - from);
    a.work = 0.5 * along * (from + to);
    energy_of_kick_ -= a.work;
    energy_until_now_ -= 0.5 * share * along * (from + now);
  }
}

double Stoppers::work_on(std::size_t constraint) const {
  double sum = 0;
  for (const Acting& a : acting_)
    if (a.stopped.constraint == constraint) sum += a.work;
  return sum;
}

void Stoppers::prescribe(const Model& model, const State& state, BodySet& bodies) {
  const double t = state.clock.time, h = state.clock.dt;
  acting_.clear();
  for (std::size_t k = 0; k < stoppers_.size(); ++k) {
    const Stopper& stopper = stoppers_[k];
    const RigidBodyStopper& deck = *stopper.deck;
    const auto b = static_cast<std::size_t>(stopper.lead.body);
    const Vec3 along = direction(model, stopper);
    const bool rotation = deck.direction >= 5;
    const double speed = dot(along, rotation ? bodies.inverse_inertia_times(b, bodies.trial[b].angular_momentum)
                                             : bodies.trial[b].velocity);
    if (rotation) turned_[k] += rotation_about(state.bodies.motion[b].angular_velocity, along, state.clock.dt_previous);
    if (t < deck.birth || t >= deck.death) continue;
    const double displacement = rotation ? turned_[k] : dot(along, state.bodies.motion[b].center - state.bodies.info[b].initial_center);
    const double coordinate = rotation ? turned_[k] : dot(along, state.bodies.motion[b].center);

    const auto meet = [&](const RigidBodyStopper::Limit& limit, double sign, const std::vector<Stopped>& followers) {
      if (limit.curve == none) return false;
      const double bound_now = model.curves[limit.curve].value(t), bound = model.curves[limit.curve].value(t + h);
      const double here = limit.displacement ? displacement : coordinate;
      // A body that is past its limit already (the stopper was born late) goes no further; it is not thrown back.
      const double value = (bound - (sign * (here - bound_now) > 0 ? bound_now : here)) / h;
      if (sign * (speed - value) <= 0) return false;
      stop(stopper, stopper.lead, along, value, bodies);
      for (const Stopped& f : followers) {
        const auto fb = static_cast<std::size_t>(f.body);
        const double gap = std::abs(dot(along, state.bodies.motion[fb].center - state.bodies.motion[b].center));
        if (f.closure == 0 || gap <= f.closure) stop(stopper, f, along, value, bodies);
      }
      return true;
    };
    if (meet(deck.maximum, 1.0, stopper.followers_maximum) || meet(deck.minimum, -1.0, stopper.followers_minimum)) continue;
    if (deck.velocity != none) {
      const double bound = std::abs(model.curves[deck.velocity].value(t + 0.5 * h));
      if (std::abs(speed) > bound) stop(stopper, stopper.lead, along, std::copysign(bound, speed), bodies);
    }
  }
}

void Stoppers::register_state(State& state) {
  state.registry.add({"rigid.stopper_turned", "angle", "rigid.kick"}, turned_);
  state.registry.add_value({"rigid.stopper_energy", "energy", "rigid.kick"}, energy_before_);
  state.registry.add_value({"rigid.stopper_energy_of_kick", "energy", "rigid.kick"}, energy_of_kick_);
}

}  // namespace kardan
