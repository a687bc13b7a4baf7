#include "kardan/rigid/node_resultants.hpp"

#include "kardan/base/reproducible_sum.hpp"

namespace kardan {

namespace {

/// Larger bodies are summed by all threads: for less, waking the others costs more than it saves.
constexpr std::ptrdiff_t parallel_threshold = 2048;

struct Resultant {
  ReproducibleSum3 force, moment;

  /// Most nodes of a body in contact have no force.
  void add(const State& state, NodeIndex node, const Vec3& center) {
    const Vec3 &f = state.nodes.force[node], &m = state.nodes.moment[node];
    if (f == Vec3{} && m == Vec3{}) return;
    force.add(f);
    moment.add(m + cross(state.nodes.x[node] - center, f));
  }
  void add(const Resultant& other) {
    force.add(other.force);
    moment.add(other.moment);
  }
};

Resultant sum_nodes(const State& state, const NodeIndex* node, std::ptrdiff_t count, const Vec3& center) {
  Resultant sum;
  if (count < parallel_threshold) {
    for (std::ptrdiff_t k = 0; k < count; ++k) sum.add(state, node[k], center);
    return sum;
  }
#pragma omp parallel
  {
    Resultant mine;
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t k = 0; k < count; ++k) mine.add(state, node[k], center);
#pragma omp critical(node_resultants)
    sum.add(mine);
  }
  return sum;
}

}  // namespace

void add_node_resultants(State& state, const std::vector<NodeIndex>& nodes, const std::vector<BodyIndex>& body) {
  for (std::size_t begin = 0, end = 0; begin < nodes.size(); begin = end) {
    const BodyIndex b = body[begin];
    while (end < nodes.size() && body[end] == b) ++end;
    const Vec3 center = state.bodies.motion[b].center;
    Vec3 &force = state.bodies.force[b], &moment = state.bodies.moment[b];
    if (end - begin <= nodes_summed_in_order) {
      for (std::size_t k = begin; k < end; ++k) {
        const Vec3& f = state.nodes.force[nodes[k]];
        force += f;
        moment += state.nodes.moment[nodes[k]] + cross(state.nodes.x[nodes[k]] - center, f);
      }
    } else {
      const Resultant sum = sum_nodes(state, &nodes[begin], static_cast<std::ptrdiff_t>(end - begin), center);
      force += sum.force.value();
      moment += sum.moment.value();
    }
  }
}

}  // namespace kardan
