// Resultants of the forces on the nodes of bodies.
#pragma once

#include <cstddef>
#include <vector>

#include "kardan/state/state.hpp"

namespace kardan {

/// A body of no more listed nodes is summed term by term in the order of the list, at a fifth of the cost of reproducible sums or less.
/// Ranks that share such a body can still get the same bits: its terms, 48 bytes a node, are no more to send than six reproducible sums.
inline constexpr std::size_t nodes_summed_in_order = 64;

/// Adds to each body's force and moment f = Σ f_k, m = Σ [m_k + (x_k − c) × f_k] over its nodes among those listed. The sums of larger bodies
/// are exact and rounded once, hence the same for any order of the nodes and any number of threads.
/// @param body  that of each node; nodes of one body are neighbours in the list
void add_node_resultants(State& state, const std::vector<NodeIndex>& nodes, const std::vector<BodyIndex>& body);

}  // namespace kardan
