#include "kardan/contact/penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace kardan {

namespace {

/// The list of candidates is renewed about so often; the margin follows.
constexpr double cycles_between_searches = 100;
constexpr double smallest_margin = 0.02, largest_margin = 0.5;  ///< parts of the segments' mean size

std::vector<NodeIndex> union_of(const std::array<Surface, 2>& surfaces) {
  std::vector<NodeIndex> all, nodes[2];
  for (std::size_t i = 0; i < 2; ++i)
    for (const SurfaceNode& n : surfaces[i].nodes()) nodes[i].push_back(n.node);
  std::set_union(nodes[0].begin(), nodes[0].end(), nodes[1].begin(), nodes[1].end(), std::back_inserter(all));
  return all;
}

std::array<Surface, 2> surfaces_of(const Model& model, const State& state, const Contact& contact, Diagnostics& diagnostics) {
  const SurfaceRules rules = surface_rules(model, contact);
  std::array<Surface, 2> surfaces{Surface(model, state, contact, contact.tracked, rules, diagnostics), Surface()};
  if (!contact.single) surfaces[1] = Surface(model, state, contact, contact.reference, rules, diagnostics);
  return surfaces;
}

}  // namespace

PenaltyContact::PenaltyContact(const Model& model, State& state, Index index, const TieHold& hold, Diagnostics& diagnostics)
    : model_(model),
      contact_(index),
      surfaces_(surfaces_of(model, state, contact(), diagnostics)),
      law_(model, contact()),
      meter_(union_of(surfaces_)),
      hold_(hold) {
  const Contact& c = contact();
  const auto add = [&](const Surface& nodes, const Surface& segments, bool reversed) {
    directions_.push_back(std::make_unique<Direction>(Direction{PenaltyPass(model, nodes, segments), reversed}));
  };
  add(surfaces_[0], c.single ? surfaces_[0] : surfaces_[1], false);
  if (c.two_way && !c.single) add(surfaces_[1], surfaces_[0], true);
  if (c.edges && c.single) edges_ = std::make_unique<EdgeContact>(model, surfaces_[0]);
  double count = 0;
  for (const Surface& surface : surfaces_)
    for (const Segment& s : surface.segments()) size_ += std::sqrt(s.area), ++count;
  if (count > 0) size_ /= count;
  margin_ = largest_margin * size_;
  for (const NodeIndex n : nodes()) state.nodes.needed[n] = 1;
  size_report(state);
  if (c.birth <= 0) {
    search(state);
    const TouchFrame at_birth = frame(state, true);
    const std::vector<double> masses(model.nodes.size(), 0.0);
    for (const auto& d : directions_) d->pass.evaluate(state, at_birth, law_, masses);
    if (edges_) edges_->evaluate(state, true, law_, masses);
    born_ = 1;
    warn_of_penetrations(state, diagnostics);
  }
  register_state(state.registry);
}

void PenaltyContact::register_state(Registry& registry) {
  const std::string name = fmt::format("contacts.{}", contact_), writer = "contacts.apply";
  if (contact().eroding) {
    for (std::size_t side = 0; side < surfaces_.size(); ++side) surfaces_[side].register_state(registry, fmt::format("{}.surface.{}", name, side));
  }
  for (std::size_t d = 0; d < directions_.size(); ++d) directions_[d]->pass.register_state(registry, fmt::format("{}.{}", name, d));
  if (edges_) edges_->register_state(registry, name);
  registry.add_value({name + ".step", "time", writer}, law_.step());
  registry.add_value({name + ".born", "1", writer}, born_);
  meter_.register_state(registry, name + ".meter");
  registry.keep_value({name + ".margin", "length", writer}, margin_);
  registry.keep_value({name + ".cycles_since_search", "1", writer}, cycles_);
  registry.keep_value({name + ".releases", "1", writer}, releases_);
  registry.keep_value({name + ".search_due", "1", writer}, renew_);
}

std::vector<NodeIndex> PenaltyContact::nodes() const { return union_of(surfaces_); }

TouchFrame PenaltyContact::frame(const State& state, bool birth) const {
  TouchFrame f;
  f.x = &state.nodes.x;
  f.v = &state.nodes.v;
  f.dt = birth ? 0.0 : state.clock.dt_previous;
  f.travel = meter_.travel();
  f.last_travel = meter_.last_travel();
  f.margin = margin_;
  f.birth = birth;
  return f;
}

void PenaltyContact::search(const State& state) {
  if (born_ != 0 && cycles_ > 0) {
    margin_ *= std::clamp(cycles_between_searches / static_cast<double>(cycles_), 0.5, 2.0);
    margin_ = std::clamp(margin_, smallest_margin * size_, largest_margin * size_);
  }
  meter_.renew(state.nodes.x, state.nodes.v);
  for (const auto& d : directions_) d->pass.search(state, frame(state, born_ == 0), hold_.held);
  renew_ = false;
  releases_ = hold_.releases;
  cycles_ = 0;
}

void PenaltyContact::add_energy(const Direction& direction, const PassEnergy& energy, ContactReport& report) {
  report.tracked_energy += direction.reversed ? energy.segments : energy.nodes;
  report.reference_energy += direction.reversed ? energy.nodes : energy.segments;
  report.friction_energy += energy.friction;
}

void PenaltyContact::evaluate(State& state, const std::vector<double>& inverse_mass) {
  const Contact& c = contact();
  ContactReport& report = state.contacts[contact_];
  const double time = state.clock.time;
  meter_.advance(state.nodes.v, state.clock.dt_previous);
  if (time < c.birth || time >= c.death) {
    for (const auto& d : directions_) add_energy(*d, d->pass.end(state), report);
    if (edges_) report.tracked_energy += edges_->end(state).nodes;
    renew_ = true;
    return;
  }
  law_.follow_step(state.clock.dt);
  ++cycles_;
  if (born_ == 0) margin_ = largest_margin * size_;
  if (renew_ || releases_ != hold_.releases || meter_.exceeds(0.5 * margin_, state.nodes.x)) {
    search(state);
    ++report.rebuilds;
  }
  const TouchFrame now = frame(state, born_ == 0);
  for (const auto& d : directions_) add_energy(*d, d->pass.evaluate(state, now, law_, inverse_mass), report);
  if (edges_) {
    const PassEnergy energy = edges_->evaluate(state, born_ == 0, law_, inverse_mass);
    report.tracked_energy += energy.nodes;
    report.friction_energy += energy.friction;
  }
  born_ = 1;
}

void PenaltyContact::size_report(State& state) const {
  ContactReport& report = state.contacts[contact_];
  if (contact().tracked.report_nodes) size_nodal_report(surfaces_[0], 0, report);
  if (contact().reference.report_nodes) size_nodal_report(surfaces_[1], 1, report);
}

/// Shares of one touch in the forces of single nodes.
void PenaltyContact::report_nodes(ContactReport& report, const Direction& direction, const Touch& touch, const Segment& segment) const {
  const std::size_t tracked = direction.reversed ? 1 : 0, reference = contact().single ? tracked : 1 - tracked;
  if (!report.nodes[tracked].empty()) report.nodal_force[tracked][touch.place] += touch.force;
  if (report.nodes[reference].empty()) return;
  for (std::size_t k = 0; k < 4; ++k)
    if (touch.weights[k] != 0)
      report.nodal_force[reference][direction.pass.segments().place_of(segment.nodes[k])] -= touch.force * touch.weights[k];
}

void PenaltyContact::drop_deleted(const Alive& alive) {
  const Contact& c = contact();
  if (c.eroding) {
    const SurfaceRules rules = surface_rules(model_, c);
    surfaces_[0].expose(model_, c, c.tracked, rules, alive);
    if (!c.single) surfaces_[1].expose(model_, c, c.reference, rules, alive);
  }
  for (const auto& d : directions_) d->pass.drop_dead(model_, alive);
  if (edges_) edges_->drop_dead(alive);
  std::vector<NodeIndex> left;  // loose nodes fly far, and nobody looks for them
  for (const Surface& surface : surfaces_) {
    const std::vector<std::uint8_t> dead = dead_nodes(model_, surface, alive);
    for (std::size_t p = 0; p < dead.size(); ++p)
      if (!dead[p]) left.push_back(surface.nodes()[p].node);
  }
  std::sort(left.begin(), left.end());
  left.erase(std::unique(left.begin(), left.end()), left.end());
  meter_.watch(std::move(left));
  renew_ = true;
}

void PenaltyContact::report(State& state) const {
  ContactReport& report = state.contacts[contact_];
  const std::vector<Vec3>& x = state.nodes.x;
  report.force = report.moment = {};
  report.touching = 0;
  for (auto& forces : report.nodal_force) std::fill(forces.begin(), forces.end(), Vec3{});
  for (const auto& d : directions_) {
    d->pass.for_each([&](const Touch& t) {
      ++report.touching;
      const Segment& s = d->pass.segments().segments()[t.segment];
      report_nodes(report, *d, t, s);
      if (contact().single) return;  // what a surface does to itself is nothing in sum
      if (!d->reversed) {
        report.force += t.force;
        report.moment += cross(x[d->pass.nodes().nodes()[t.place].node], t.force);
        return;
      }
      report.force -= t.force;
      for (std::size_t k = 0; k < 4; ++k) report.moment -= cross(x[s.nodes[k]], t.force * t.weights[k]);
    });
  }
  if (edges_) report_edges(report);
  state.energy.sliding += report.tracked_energy + report.reference_energy;
}

/// Edges are of one surface: no net force, but forces of nodes.
void PenaltyContact::report_edges(ContactReport& report) const {
  report.touching += static_cast<std::int64_t>(edges_->touches());
  if (report.nodes[0].empty()) return;
  edges_->for_each([&](const auto& a, const auto& wa, const auto& b, const auto& wb, const Vec3& force) {
    for (std::size_t k = 0; k < 2; ++k) {
      report.nodal_force[0][surfaces_[0].place_of(a[k])] += force * wa[k];
      report.nodal_force[0][surfaces_[0].place_of(b[k])] -= force * wb[k];
    }
  });
}

void PenaltyContact::warn_of_penetrations(const State& state, Diagnostics& diagnostics) const {
  struct Penetration {
    double depth;
    NodeIndex node;
    const Segment* segment;
  };
  std::vector<Penetration> all;
  std::size_t count = 0;
  NodeIndex last = none;
  for (const auto& d : directions_) {
    d->pass.for_each([&](const Touch& t) {
      const SurfaceNode& node = d->pass.nodes().nodes()[t.place];
      const Segment& s = d->pass.segments().segments()[t.segment];
      if (t.offset < 1e-3 * (s.half_thickness + node.half_thickness) || t.offset < 1e-6 * std::sqrt(s.area)) return;
      count += node.node != last;
      last = node.node;
      all.push_back({t.offset, node.node, &s});
    });
  }
  if (all.empty()) return;
  std::stable_sort(all.begin(), all.end(), [](const Penetration& a, const Penetration& b) { return a.depth > b.depth; });
  const auto line = [&](const Penetration& p) {
    const Vec3& x = state.nodes.x[p.node];
    const auto element = static_cast<std::size_t>(p.segment->element);
    const bool shell = p.segment->kind == ElementKind::shell;
    return fmt::format("\n  node {} at ({:.6g}, {:.6g}, {:.6g}): {:.4g} deep in {} {}", model_.nodes.id[p.node], x.x,
                       x.y, x.z, p.depth, shell ? "shell" : "solid", shell ? model_.shells.id[element] : model_.solids.id[element]);
  };
  const Contact& c = contact();
  std::string text = fmt::format("contact {}: {} node{} in initial penetration{}", c.id, count, count == 1 ? "" : "s",
                                 all.size() > 10 ? "; the deepest:" : ":");
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 10); ++i) text += line(all[i]);
  diagnostics.warning(text, "nothing is moved: what a node penetrates at first causes no force, only what is deeper does; part the meshes by "
                      "the thicknesses to be rid of it", c.keyword);
  if (c.initial_penetration != 2 || all.size() <= 10) return;
  std::string rest = fmt::format("contact {}: the other initial penetrations (IGNORE = 2)", c.id);
  for (std::size_t i = 10; i < all.size(); ++i) rest += line(all[i]);
  diagnostics.notice(rest, c.keyword);
}

}  // namespace kardan
