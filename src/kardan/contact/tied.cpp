#include "kardan/contact/tied.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>

#include "kardan/contact/tie_search.hpp"

namespace kardan {

namespace {

bool by_springs(const Contact& contact) {
  return contact.law == ContactLaw::tiebreak || contact.tie.holding == Tie::Holding::offset || contact.tie.holding == Tie::Holding::beam_offset;
}

bool tied(const Contact& contact) { return contact.law == ContactLaw::tied || contact.law == ContactLaw::tiebreak; }

std::vector<TiedPoint> points_of(const Model& model, const State& state, bool springs, Diagnostics& diagnostics) {
  std::vector<TiedPoint> points;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (!tied(model.contacts[c]) || by_springs(model.contacts[c]) != springs) continue;
    const std::vector<TiedPoint> found = find_tied_points(model, state, c, diagnostics);
    for (const TiedPoint& p : found) {
      const auto n = static_cast<std::size_t>(p.node);
      if (!springs || state.nodes.mass[n] > 0 || state.nodes.body[n] != none) points.push_back(p);
      else
        diagnostics.error("node " + std::to_string(model.nodes.id[n]) + " has no mass that the springs of contact " +
                              std::to_string(model.contacts[c].id) + " could hold", "name nodes of elements", model.contacts[c].keyword);
    }
  }
  return points;
}

/// By node: it has elements, and all of them are deleted.
std::vector<std::uint8_t> bare_nodes(const Model& model, const Alive& alive) {
  enum : std::uint8_t { without, deleted, left };
  std::vector<std::uint8_t> found(model.nodes.size(), without);
  const auto look = [&](const auto& elements, ElementKind kind) {
    for (std::size_t e = 0; e < elements.nodes.size(); ++e) {
      const std::uint8_t is = alive(kind, static_cast<Index>(e)) ? left : deleted;
      for (const NodeIndex n : elements.nodes[e])
        if (n != none) found[static_cast<std::size_t>(n)] = std::max(found[static_cast<std::size_t>(n)], is);
    }
  };
  look(model.shells, ElementKind::shell);
  look(model.solids, ElementKind::solid);
  look(model.beams, ElementKind::beam);
  for (std::uint8_t& f : found) f = f == deleted;
  return found;
}

/// What of a tie cannot be honoured.
void check(const Contact& contact, Diagnostics& diagnostics) {
  const std::string name = "contact " + std::to_string(contact.id);
  if (contact.birth > 0) diagnostics.error(name + ": a tie that is born later is not available", "leave BT at 0", contact.keyword);
  if (!by_springs(contact) && contact.death < 1e20)
    diagnostics.error(name + ": a tie without a spring cannot end", "leave DT empty, or take the keyword with _OFFSET", contact.keyword);
  if (contact.law != ContactLaw::tiebreak) return;
  if (contact.tie.normal_limit <= 0 && contact.tie.shear_limit <= 0)
    diagnostics.warning(name + " has no limits: it never breaks", "give NFLF and SFLF, or NFLS and SFLS", contact.keyword);
  if (contact.tie.option != 0 && contact.tracked.kind == ContactSide::Kind::nodes)
    diagnostics.error(name + ": its limits are stresses, but nodes of a set have no area", "name parts or segments as SURFA", contact.keyword);
  if (contact.tie.option == 6 && contact.tie.critical_distance <= 0)
    diagnostics.error(name + ": OPTION = 6 needs the critical distance", "give PARAM > 0, or OPTION = 2", contact.keyword);
}

}  // namespace

TiedContacts::TiedContacts(const Model& model, State& state, Diagnostics& diagnostics)
    : kinematic_(model, state, points_of(model, state, false, diagnostics), diagnostics),
      springs_(model, state, points_of(model, state, true, diagnostics)) {
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (!tied(model.contacts[c])) continue;
    if (model.contacts[c].law == ContactLaw::tied) for_good_.push_back(c);
    check(model.contacts[c], diagnostics);
  }
}

void TiedContacts::size_reports(const Model& model, State& state) const {
  for (const std::size_t c : for_good_) size_tie_report(model, state, c, state.contacts[c]);
}

bool TiedContacts::drop_deleted(const Model& model, State& state, const Alive& alive) {
  if (empty()) return false;
  const std::vector<std::uint8_t> bare = bare_nodes(model, alive);
  const auto ends = [&](const TiedPoint& p) {
    const bool off = p.element != none && !alive(p.kind, p.element);
    const auto n = static_cast<std::size_t>(p.node);
    if (off || bare[n])
      spdlog::info("contact {}: node {} is no longer tied from t = {:.6g}: {}", model.contacts[p.contact].id, model.nodes.id[n], state.clock.time,
                   off ? "the element of its segment is deleted" : "its elements are deleted");
    return off || bare[n] != 0;
  };
  springs_.release(ends);
  return kinematic_.release(state, ends);
}

void TiedContacts::report(State& state) const {
  for (const std::size_t c : for_good_) {  // PenaltyContact does so for those that break
    ContactReport& contact = state.contacts[c];
    contact.force = contact.moment = {};
    contact.touching = 0;
    for (auto& forces : contact.nodal_force) std::fill(forces.begin(), forces.end(), Vec3{});
    state.energy.sliding += contact.tracked_energy + contact.reference_energy;
  }
  kinematic_.account(state);
  kinematic_.report(state);
  springs_.report(state);
}

void TiedContacts::drift(State& state) {
  kinematic_.place(state);
  springs_.turn(state);
}

}  // namespace kardan
