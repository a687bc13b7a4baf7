#include "kardan/contact/contact_system.hpp"

#include <omp.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace kardan {

namespace {

/// Fewer touches than this are added up by one thread.
constexpr std::size_t parallel_touches = 500;

/// Which motions of a body forces cannot change: all translations are held, or one is prescribed (a tool); likewise rotations.
struct Held {
  bool translation = false, rotation = false;
};

Held held_motions(const Model& model, const State& state, std::size_t body) {
  Held held;
  const PartIndex lead = state.bodies.info[body].part;
  if (lead != none && model.rigid_part(lead)) {
    const auto& law = std::get<RigidMaterial>(model.materials[model.parts[lead].material].law);
    held = {law.cmo > 0 && law.con1 == 7, law.cmo > 0 && law.con2 == 7};
  }
  for (const PrescribedMotion& m : model.prescribed_motions)
    if (m.body_part != none && state.bodies.of_part[m.body_part] == static_cast<BodyIndex>(body))
      (std::abs(m.dof) <= 4 ? held.translation : held.rotation) = true;
  return held;
}

/// Upper bound of 1/m of a point of a body at arm r (principal axes) over all directions: 1/M + sum over the axes j of (|r|^2 - r_j^2)/I_j, the trace
/// of the tensor that turns a force at the point into the acceleration of the point; without the motions that are held.
double inverse_mass_of_point(const BodyInfo& body, const Held& held, const Vec3& r) {
  double sum = body.mass > 0 && !held.translation ? 1 / body.mass : 0.0;
  for (std::size_t j = 0; j < 3 && !held.rotation; ++j)
    if (body.principal_inertia[j] > 0) sum += (dot(r, r) - r[j] * r[j]) / body.principal_inertia[j];
  return sum;
}

}  // namespace

ContactSystem::ContactSystem(const Model& model, State& state, const TiedContacts& ties, Diagnostics& diagnostics) : model_(model) {
  state.contacts.assign(model.contacts.size(), ContactReport{});
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const auto index = static_cast<Index>(c);
    const ContactLaw law = model.contacts[c].law;
    if (law == ContactLaw::penalty || law == ContactLaw::tiebreak)
      penalties_.push_back(std::make_unique<PenaltyContact>(model, state, index, ties.hold(c), diagnostics));
    if (law == ContactLaw::transducer) transducers_.emplace_back(model, state, index, diagnostics);
  }
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    ContactReport& report = state.contacts[c];
    const std::string name = "contacts." + std::to_string(c);
    state.registry.add_value({name + ".tracked_energy", "energy", "contacts.apply"}, report.tracked_energy);
    state.registry.add_value({name + ".reference_energy", "energy", "contacts.apply"}, report.reference_energy);
    state.registry.add_value({name + ".friction_energy", "energy", "contacts.apply"}, report.friction_energy);
    state.registry.keep_value({name + ".rebuilds", "1", "contacts.apply"}, report.rebuilds);
  }
  if (penalties_.empty()) return;
  find_masses(state);
  state.registry.keep({"contacts.inverse_mass", "1/mass", "contacts.apply"}, inverse_mass_);
  state.registry.add({"contacts.crowd", "1", "contacts.apply"}, crowd_);
}

ContactSystem::~ContactSystem() = default;

void ContactSystem::find_masses(const State& state) {
  const NodeState& nodes = state.nodes;
  inverse_mass_.assign(nodes.x.size(), 0.0);
  for (std::size_t n = 0; n < nodes.x.size(); ++n)
    if (nodes.body[n] == none && nodes.mass[n] > 0) inverse_mass_[n] = 1 / nodes.mass[n];
  of_body_.resize(state.bodies.info.size());
  crowd_.assign(of_body_.size(), 1);
  touches_.assign(of_body_.size(), 0);
  std::vector<Held> held;
  for (std::size_t b = 0; b < of_body_.size(); ++b) held.push_back(held_motions(model_, state, b));
  std::vector<std::uint8_t> seen(nodes.x.size(), 0);
  for (const auto& contact : penalties_)
    for (const NodeIndex n : contact->nodes()) {
      const BodyIndex b = nodes.body[n];
      if (b == none || seen[n]) continue;
      seen[n] = 1;
      const BodyInfo& body = state.bodies.info[b];
      of_body_[b].push_back(n);
      const Vec3 arm = transpose(to_matrix(body.initial_orientation)) * (model_.nodes.x[n] - body.initial_center);
      inverse_mass_[n] = inverse_mass_of_point(body, held[b], arm);
    }
  single_ = inverse_mass_;
}

/// A body carries all its touches together: each sees the body's mass divided by their number, rounded up to a power of two so that it changes seldom.
void ContactSystem::crowd_bodies(const State& state) {
  if (of_body_.empty()) return;
  std::fill(touches_.begin(), touches_.end(), 0);
  for (const auto& contact : penalties_)
    for (const auto& d : contact->directions())
      d->pass.for_each([&](const Touch& t) {
        const NodeIndex ends[] = {d->pass.nodes().nodes()[t.place].node,
                                  d->pass.segments().segments()[t.segment].nodes[0]};
        for (const NodeIndex n : ends)
          if (const BodyIndex b = state.nodes.body[n]; b != none) ++touches_[b];
      });
  for (std::size_t b = 0; b < crowd_.size(); ++b) {
    const std::uint64_t now = std::bit_ceil(std::max<std::uint64_t>(touches_[b], 1));
    if (now <= crowd_[b] && 4 * now > crowd_[b]) continue;
    crowd_[b] = now;
    for (const NodeIndex n : of_body_[b])
      inverse_mass_[n] = single_[n] * static_cast<double>(now);
  }
}

void ContactSystem::apply(State& state) {
  if (penalties_.empty()) return;
  for (const auto& contact : penalties_) contact->evaluate(state, inverse_mass_);
  crowd_bodies(state);
  add_forces(state);
}

/// In the order of contacts and touches for every node, whoever adds: with several threads each walks all touches and serves its own nodes.
void ContactSystem::add_forces(State& state) const {
  std::vector<Vec3>& force = state.nodes.force;
  const auto add = [&](NodeIndex begin, NodeIndex end) {
    const auto to = [&](NodeIndex n, const Vec3& f) {
      if (n >= begin && n < end) force[n] += f;
    };
    for (const auto& contact : penalties_)
      for (const auto& d : contact->directions()) d->pass.add_forces(force, begin, end);
    for (const auto& contact : penalties_) {
      if (!contact->edges()) continue;
      contact->edges()->for_each([&](const auto& a, const auto& wa, const auto& b, const auto& wb, const Vec3& f) {
        for (std::size_t k = 0; k < 2; ++k) {
          to(a[k], f * wa[k]);
          to(b[k], f * -wb[k]);
        }
      });
    }
  };
  std::size_t touches = 0;
  for (const auto& contact : penalties_)
    for (const auto& d : contact->directions()) touches += d->pass.touches();
  const auto nodes = static_cast<std::int64_t>(force.size());
  if (touches < parallel_touches || omp_get_max_threads() == 1) return add(0, static_cast<NodeIndex>(nodes));
#pragma omp parallel
  {
    const std::int64_t thread = omp_get_thread_num(), threads = omp_get_num_threads();
    add(static_cast<NodeIndex>(nodes * thread / threads), static_cast<NodeIndex>(nodes * (thread + 1) / threads));
  }
}

void ContactSystem::account(State& state) const {
  for (const auto& contact : penalties_) contact->report(state);
  for (const Transducer& transducer : transducers_) transducer.report(penalties_, state);
}

void ContactSystem::restart(State& state) const {
  for (ContactReport& report : state.contacts) report.tracked_energy = report.reference_energy = report.friction_energy = 0;
}

void ContactSystem::drop_deleted(const Alive& alive) {
  for (const auto& contact : penalties_) contact->drop_deleted(alive);
}

}  // namespace kardan
