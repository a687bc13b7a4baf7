// Which nodes make up parts.
#pragma once

#include <vector>

#include "kardan/model/model.hpp"

namespace kardan {

/// Nodes of the elements of `parts`, of the nodal rigid bodies they stand for, and extra nodes of rigid parts; ascending,
/// without repeats.
std::vector<NodeIndex> nodes_of_parts(const Model& model, const std::vector<PartIndex>& parts);

}  // namespace kardan
