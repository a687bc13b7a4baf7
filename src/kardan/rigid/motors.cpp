#include "kardan/rigid/motors.hpp"

#include <fmt/format.h>

namespace kardan {

void Motors::initialise(const Model& model, const JointSet& joints, Diagnostics& diagnostics) {
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const Joint& deck = model.joints[joints.joints[j].model_joint];
    if (deck.kind != JointKind::rotational_motor && deck.kind != JointKind::translational_motor) continue;
    if (deck.curve == none)
      diagnostics.error(fmt::format("motor joint {} has no load curve", deck.id), "set LCID on card 2",
                        "*CONSTRAINED_JOINT");
    motors_.push_back({j, joints.joints[j].first_row});
  }
  reached_.assign(motors_.size(), 0.0);
  for (auto* by_motor : {&rate_, &rate_before_, &rate_now_}) by_motor->assign(motors_.size(), 0.0);
}

void Motors::initial_rates(const Model& model, const State& state, const JointSet& joints,
                           std::vector<double>& rates) const {
  for (const Motor& m : motors_) {
    const Joint& deck = model.joints[joints.joints[m.joint].model_joint];
    const Curve& curve = model.curves[deck.curve];
    double rate = 0;
    if (deck.motor_type == 0) rate = curve.value(state.clock.time);
    if (deck.motor_type == 2) rate = curve.slope(state.clock.time);
    if (deck.motor_type == 3) rate = curve.value(0.0);
    rates[joints.offset[m.joint]] = rate;
  }
}

void Motors::aim(const Model& model, const State& state, JointSet& joints, bool at_end_of_step) {
  const Clock& clock = state.clock;
  for (std::size_t k = 0; k < motors_.size(); ++k) {
    const Joint& deck = model.joints[joints.joints[motors_[k].joint].model_joint];
    const Curve& curve = model.curves[deck.curve];
    RowMemory& memory = joints.memory[motors_[k].row];
    const double before = reached_[k];
    double after = before;
    switch (deck.motor_type) {
      case 0: after = curve.integral(clock.time + clock.dt); break;
      case 1:
        rate_[k] += curve.value(clock.time) * clock.kick();
        after = before + rate_[k] * clock.dt;
        break;
      case 2: after = curve.value(clock.time + clock.dt) - curve.value(0.0); break;
      default: after = before + curve.value(before) * clock.dt; break;
    }
    memory.target_rate = (after - before) / clock.dt;
    rate_now_[k] = clock.cycle == 0 ? memory.target_rate : 0.5 * (rate_before_[k] + memory.target_rate);
    rate_before_[k] = memory.target_rate;
    memory.target = at_end_of_step ? after : before;
    reached_[k] = after;
  }
}

void Motors::account(const JointSet& joints, const std::vector<double>& force, const Clock& clock) {
  work_before_ += work_of_kick_;
  work_of_kick_ = 0;
  for (std::size_t k = 0; k < motors_.size(); ++k)
    if (const std::size_t j = motors_[k].joint; !joints.failed[j])
      work_of_kick_ += force[joints.offset[j]] * rate_now_[k] * clock.kick();
}

void Motors::register_state(State& state) {
  state.registry.add({"joints.motor_target", "length or angle", "rigid.kick"}, reached_);
  state.registry.add({"joints.motor_rate", "length/time or angle/time", "rigid.kick"}, rate_);
  state.registry.add_value({"joints.motor_work", "energy", "rigid.kick"}, work_before_);
  state.registry.add_value({"joints.motor_work_of_kick", "energy", "rigid.kick"}, work_of_kick_);
  state.registry.add({"joints.motor_rate_before", "length/time or angle/time", "rigid.kick"}, rate_before_);
}

}  // namespace kardan
