#include "kardan/io/tables/summaries.hpp"

namespace kardan {

namespace {

template <class T>
T at_or_zero(const std::vector<T>& v, std::size_t i) {
  return i < v.size() ? v[i] : T{};
}

}  // namespace

std::vector<PartSummary> part_summaries(const Model& model, const State& state) {
  std::vector<PartSummary> all(model.parts.size());
  for (std::size_t p = 0; p < all.size(); ++p) {
    PartSummary& s = all[p];
    s.internal = at_or_zero(state.energy.part_internal, p);
    s.kinetic = at_or_zero(state.energy.part_kinetic, p);
    s.hourglass = at_or_zero(state.energy.part_hourglass, p);
    const BodyIndex b = p < state.bodies.of_part.size() ? state.bodies.of_part[p] : none;
    if (b == none) {
      s.mass = at_or_zero(state.energy.part_mass, p);
      s.momentum = at_or_zero(state.energy.part_momentum, p);
      if (s.mass > 0) s.velocity = s.momentum / s.mass;
      continue;
    }
    const auto i = static_cast<std::size_t>(b);
    s.velocity = state.bodies.report[i].velocity;
    if (state.bodies.info[i].part != static_cast<PartIndex>(p)) continue;
    s.mass = state.bodies.info[i].mass;
    s.momentum = s.velocity * s.mass;
  }
  return all;
}

Vec3 global_velocity(const State& state) {
  double mass = 0;
  Vec3 momentum{};
  for (std::size_t b = 0; b < state.bodies.info.size(); ++b) {
    mass += state.bodies.info[b].mass;
    momentum += state.bodies.report[b].velocity * state.bodies.info[b].mass;
  }
  for (std::size_t n = 0; n < state.nodes.mass.size(); ++n) {
    if (state.nodes.body[n] != none) continue;
    mass += state.nodes.mass[n];
    momentum += state.nodes.v_now[n] * state.nodes.mass[n];
  }
  return mass > 0 ? momentum / mass : Vec3{};
}

}  // namespace kardan
