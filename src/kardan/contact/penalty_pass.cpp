#include "kardan/contact/penalty_pass.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kardan {

namespace {

constexpr Index chunk_nodes = 256;

/// Asks for the cache lines at both ends of a thing.
template <class T>
void ask(const T& thing) {
  const char* bytes = reinterpret_cast<const char*>(&thing);
  __builtin_prefetch(bytes);
  if (sizeof(T) > 16) __builtin_prefetch(bytes + sizeof(T) - 1);
}

/// Touches with segments that would be lost from the list because the node is deeper in them than the list reaches.
std::vector<std::pair<Index, Index>> deep_pairs(const std::vector<Touch>& touches, const Surface& nodes, const Surface& segments,
                                                double margin) {
  std::vector<std::pair<Index, Index>> pairs;
  for (const Touch& t : touches) {
    const Segment& s = segments.segments()[t.segment];
    if (t.penetration - s.half_thickness - nodes.nodes()[t.place].half_thickness < 0.5 * margin) continue;
    for (const NodeIndex n : s.nodes)
      for (const Index near : segments.segments_at(segments.place_of(n))) pairs.emplace_back(t.place, near);
  }
  return pairs;
}

}  // namespace

std::vector<std::uint8_t> dead_nodes(const Model& model, const Surface& surface, const Alive& alive) {
  std::vector<std::uint8_t> dead(surface.nodes().size(), 0);
  if (surface.segments().empty()) return dead;  // a side of nodes
  for (std::size_t p = 0; p < dead.size(); ++p) {
    const auto own = surface.segments_at(static_cast<Index>(p));
    dead[p] = std::all_of(own.begin(), own.end(), [&](Index s) {
      const Segment& segment = surface.segments()[s];
      return segment.element != none && !alive(segment.kind, segment.element);
    });
  }
  for (const Index beam : surface.beams())
    for (const NodeIndex n : {model.beams.nodes[beam][0], model.beams.nodes[beam][1]})
      if (const Index place = surface.place_of(n); place != none && alive(ElementKind::beam, beam)) dead[place] = 0;
  return dead;
}

PenaltyPass::PenaltyPass(const Model& model, const Surface& nodes, const Surface& segments) : nodes_(&nodes), segments_(&segments) {
  const auto count = static_cast<Index>(nodes.nodes().size());
  for (Index begin = 0; begin < count; begin += chunk_nodes) {
    Chunk chunk;
    chunk.begin = begin;
    chunk.end = std::min(begin + chunk_nodes, count);
    chunks_.push_back(std::move(chunk));
  }
  drop_dead(model, [](ElementKind, Index) { return true; });
}

void PenaltyPass::take_stiffnesses() {
  corner_stiffness_.resize(segments_->segments().size());
  for (std::size_t s = 0; s < corner_stiffness_.size(); ++s)
    for (std::size_t k = 0; k < 4; ++k)
      corner_stiffness_[s][k] = segments_->nodes()[segments_->place_of(segments_->segments()[s].nodes[k])].stiffness;
}

void PenaltyPass::drop_dead(const Model& model, const Alive& alive) {
  take_stiffnesses();
  dead_segment_.clear();
  for (const Segment& s : segments_->segments()) dead_segment_.push_back(s.element != none && !alive(s.kind, s.element));
  dead_node_ = dead_nodes(model, *nodes_, alive);
}

void PenaltyPass::search(const State& state, const TouchFrame& frame, const std::vector<std::uint8_t>& held) {
  std::vector<std::uint8_t> left_out_node, left_out_segment;
  if (!held.empty()) {
    left_out_node = dead_node_;
    left_out_segment = dead_segment_;
    for (std::size_t p = 0; p < left_out_node.size(); ++p) left_out_node[p] |= held[nodes_->nodes()[p].node];
    for (std::size_t s = 0; s < left_out_segment.size(); ++s)
      for (const NodeIndex n : segments_->segments()[s].nodes) left_out_segment[s] |= held[n];
  }
  const std::vector<std::uint8_t>&no_node = held.empty() ? dead_node_ : left_out_node, &no_segment = held.empty() ? dead_segment_ : left_out_segment;
  std::vector<std::pair<Index, Index>> always;
  for (const Chunk& chunk : chunks_)
    for (const auto& pair : deep_pairs(chunk.touches, *nodes_, *segments_, frame.margin)) always.push_back(pair);
  SearchInput input;
  input.nodes = nodes_;
  input.segments = segments_;
  input.x = &state.nodes.x;
  input.body = &state.nodes.body;
  input.dead_node = &no_node;
  input.dead_segment = &no_segment;
  input.margin = frame.margin;
  input.awake = frame.birth ? std::numeric_limits<double>::infinity() : 2 * frame.last_travel;
  std::erase_if(always, [&](const auto& pair) {
    const auto& corner = segments_->segments()[pair.second].nodes;
    return std::find(corner.begin(), corner.end(), nodes_->nodes()[pair.first].node) != corner.end() ||
           no_segment[pair.second] || no_node[pair.first];
  });
  search_.find(input, always, candidates_);
  const auto count = static_cast<std::ptrdiff_t>(chunks_.size());
#pragma omp parallel for schedule(static) if (count > 2)
  for (std::ptrdiff_t c = 0; c < count; ++c) wake_touched(chunks_[static_cast<std::size_t>(c)]);
  weigh();
}

/// Nodes with candidates. What touched in the last cycle is looked at with all of its candidates: its way past the mid-surface must not be missed.
void PenaltyPass::wake_touched(Chunk& chunk) {
  list_active(chunk);
  chunk.wake.assign(chunk.active.size(), 0.0F);
  for (const Touch& t : chunk.touches)
    std::fill(candidates_.wake.begin() + candidates_.first[t.place], candidates_.wake.begin() + candidates_.first[t.place + 1], 0.0F);
}

void PenaltyPass::list_active(Chunk& chunk) const {
  chunk.active.clear();
  for (Index p = chunk.begin; p < chunk.end; ++p)
    if (candidates_.first[p] != candidates_.first[p + 1]) chunk.active.push_back(p);
}

void PenaltyPass::weigh() {
  weights_.clear();
  for (const Chunk& chunk : chunks_)
    weights_.push_back(static_cast<double>(chunk.end - chunk.begin + candidates_.first[chunk.end] - candidates_.first[chunk.begin]));
}

void PenaltyPass::add_work(const State& state, const Touch& touch, PassEnergy& energy) const {
  const std::vector<Vec3>& v = state.nodes.v;
  const double half = 0.5 * state.clock.dt_previous;
  const Segment& s = segments_->segments()[touch.segment];
  Vec3 corner;
  for (std::size_t k = 0; k < 4; ++k) corner += v[s.nodes[k]] * touch.weights[k];
  energy.nodes -= half * dot(touch.force, v[nodes_->nodes()[touch.place].node]);
  energy.segments += half * dot(touch.force, corner);
}

/// Forces of the touches of one node, first <= i < end of chunk.touches.
void PenaltyPass::push(const TouchFrame& frame, const PenaltyLaw& law, const std::vector<double>& inverse_mass, std::size_t first,
                       std::size_t end, Chunk& chunk) const {
  const std::vector<Vec3>& v = *frame.v;
  for (std::size_t i = first; i < end; ++i) {
    Touch& t = chunk.touches[i];
    if (t.share == 0) continue;
    const SurfaceNode& node = nodes_->nodes()[t.place];
    const Segment& s = segments_->segments()[t.segment];
    const double own = inverse_mass[node.node];
    TouchMotion motion;
    motion.velocity = v[node.node];
    motion.dt = frame.dt;
    motion.inverse_mass = own;
    double largest = own, masses = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double corner = inverse_mass[s.nodes[k]], w = t.weights[k];
      motion.velocity -= v[s.nodes[k]] * w;
      motion.inverse_mass += w * corner;
      motion.stiffness += w * corner_stiffness_[t.segment][k];
      largest = std::max(largest, corner);
      masses += corner > 0 ? 0.25 / corner : 0.0;
    }
    motion.lightest = largest > 0 ? 1 / largest : 0.0;
    if (own > 0 || masses > 0) motion.reduced = 1 / (own + (masses > 0 ? 1 / masses : 0.0));
    chunk.energy.friction += law.apply(node, s, motion, t.share, t);
  }
  if (!law.has_friction()) return;
  for (std::size_t i = first; i < end; ++i) {  // what is only remembered sticks like its nearest neighbour
    Touch& t = chunk.touches[i];
    double nearest = 0;
    for (std::size_t j = first; t.share == 0 && j < end; ++j) {
      const Touch& other = chunk.touches[j];
      if (const double cosine = dot(other.direction, t.direction); other.share > 0 && cosine > nearest) {
        nearest = cosine;
        t.friction = other.friction;
      }
    }
  }
}

void PenaltyPass::find_touches(const State& state, const TouchFrame& frame, Desk& desk, Chunk& chunk) {
  desk.before.assign(chunk.touches.begin(), chunk.touches.end());
  chunk.touches.clear();
  chunk.energy = {};
  for (const Touch& t : desk.before)
    if (t.share > 0) add_work(state, t, chunk.energy);
  auto memory = desk.before.begin();
  for (std::size_t a = 0; a < chunk.active.size(); ++a) {
    const Index place = chunk.active[a];
    while (memory != desk.before.end() && memory->place < place) ++memory;
    auto end = memory;
    while (end != desk.before.end() && end->place == place) ++end;
    if (memory == end && chunk.wake[a] > frame.travel) continue;
    const auto begin = static_cast<std::size_t>(candidates_.first[place]);
    const std::size_t count = static_cast<std::size_t>(candidates_.first[place + 1]) - begin;
    const std::span<float> wake(candidates_.wake.data() + begin, count);
    desk.finder.find(frame, place, {candidates_.segment.data() + begin, count}, wake, {memory, end}, chunk.touches);
    chunk.wake[a] = *std::min_element(wake.begin(), wake.end());
  }
}

void PenaltyPass::push_all(const State& state, const TouchFrame& frame, const PenaltyLaw& law, const std::vector<double>& inverse_mass,
                           Chunk& chunk) const {
  for (std::size_t first = 0, end = 0; first < chunk.touches.size(); first = end) {
    while (end < chunk.touches.size() && chunk.touches[end].place == chunk.touches[first].place) ++end;
    push(frame, law, inverse_mass, first, end, chunk);
  }
  for (const Touch& t : chunk.touches)
    if (t.share > 0) add_work(state, t, chunk.energy);
}

/// Segments of the next chunk but one are asked for, and forces of the nodes of the next: in large models they lie in memory, here and there.
void PenaltyPass::add_forces(std::vector<Vec3>& force, NodeIndex begin, NodeIndex end) const {
  const std::vector<Segment>& segments = segments_->segments();
  const auto to = [&](NodeIndex n, const Vec3& f) {
    if (n >= begin && n < end) force[n] += f;
  };
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    if (c + 2 < chunks_.size())
      for (const Touch& t : chunks_[c + 2].touches) {
        ask(segments[t.segment].nodes);
        ask(nodes_->nodes()[t.place].node);
      }
    if (c + 1 < chunks_.size())
      for (const Touch& t : chunks_[c + 1].touches) {
        ask(force[nodes_->nodes()[t.place].node]);
        for (const NodeIndex n : segments[t.segment].nodes)
          if (n >= begin && n < end) ask(force[n]);
      }
    for (const Touch& t : chunks_[c].touches) {
      if (!(t.share > 0)) continue;
      to(nodes_->nodes()[t.place].node, t.force);
      for (std::size_t k = 0; k < 4; ++k)
        if (t.weights[k] != 0) to(segments[t.segment].nodes[k], t.force * -t.weights[k]);
    }
  }
}

double PenaltyPass::force_of_penetration(const PenaltyLaw& law) const {
  double largest = 0, sum = 0;
  for_each([&](const Touch& t) {
    const double p = std::max(0.0, t.penetration - t.offset);
    largest = std::max(largest, p);
    sum += t.share * p;
  });
  return law.force_of_penetration(largest, sum);
}

PassEnergy PenaltyPass::sum_energies() const {
  PassEnergy sum;
  for (const Chunk& chunk : chunks_) {
    sum.nodes += chunk.energy.nodes;
    sum.segments += chunk.energy.segments;
    sum.friction += chunk.energy.friction;
  }
  return sum;
}

PassEnergy PenaltyPass::evaluate(const State& state, const TouchFrame& frame, PenaltyLaw& law, const std::vector<double>& inverse_mass) {
  const auto threads = static_cast<std::size_t>(omp_get_max_threads());
  while (desks_.size() < threads) desks_.push_back({TouchFinder(*nodes_, *segments_), {}});
  const bool at_once = !law.shares_total();
  shares_.start(cut_by_weight(weights_, threads));
#pragma omp parallel if (chunks_.size() > 2)
  {
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    shares_.run(thread, [&](std::size_t c) {
      find_touches(state, frame, desks_[thread], chunks_[c]);
      if (at_once) push_all(state, frame, law, inverse_mass, chunks_[c]);
    });
  }
  if (!at_once) {
    law.scale_of_total = force_of_penetration(law);
    for (Chunk& chunk : chunks_) push_all(state, frame, law, inverse_mass, chunk);
  }
  return sum_energies();
}

PassEnergy PenaltyPass::end(const State& state) {
  for (Chunk& chunk : chunks_) {
    chunk.energy = {};
    for (const Touch& t : chunk.touches)
      if (t.share > 0) add_work(state, t, chunk.energy);
    chunk.touches.clear();
  }
  return sum_energies();
}

std::size_t PenaltyPass::touches() const {
  std::size_t count = 0;
  for (const Chunk& chunk : chunks_) count += chunk.touches.size();
  return count;
}

void PenaltyPass::register_state(Registry& registry, const std::string& name) {
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    registry.add_list({name + ".touches." + std::to_string(c), "mixed", "contacts.apply"}, chunks_[c].touches);
  const std::string writer = "contacts.search";
  registry.keep_list({name + ".candidates.first", "1", writer}, candidates_.first);
  registry.keep_list({name + ".candidates.segment", "1", writer}, candidates_.segment);
  registry.keep_list({name + ".candidates.wake", "length", "contacts.apply"}, candidates_.wake);
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    registry.keep_list({name + ".wake." + std::to_string(c), "length", "contacts.apply"}, chunks_[c].wake);
  registry.keep_list({name + ".dead_segments", "1", "contacts.drop_deleted"}, dead_segment_);
  registry.keep_list({name + ".dead_nodes", "1", "contacts.drop_deleted"}, dead_node_);
  registry.after_restore([this] {
    take_stiffnesses();
    if (candidates_.first.empty()) return;
    for (Chunk& chunk : chunks_) list_active(chunk);
    weigh();
  });
}

}  // namespace kardan
