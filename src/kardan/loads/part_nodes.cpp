#include "kardan/loads/part_nodes.hpp"

#include <cstdint>

namespace kardan {

std::vector<NodeIndex> nodes_of_parts(const Model& model, const std::vector<PartIndex>& parts) {
  std::vector<std::uint8_t> wanted(model.parts.size(), 0), touched(model.nodes.size(), 0);
  for (const PartIndex p : parts) wanted[p] = 1;
  const auto mark = [&](const auto& nodes) {
    for (const NodeIndex n : nodes) {
      if (n != none) touched[n] = 1;
    }
  };
  const auto elements = [&](const auto& block) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      if (wanted[block.part[e]]) mark(block.nodes[e]);
    }
  };
  elements(model.shells);
  elements(model.solids);
  elements(model.beams);
  for (const NodalRigidBody& body : model.nodal_rigid_bodies) {
    if (body.part != none && wanted[body.part]) mark(body.nodes);
  }
  for (const ExtraNodes& extra : model.extra_nodes) {
    if (wanted[extra.part]) mark(extra.nodes);
  }
  std::vector<NodeIndex> nodes;
  for (std::size_t n = 0; n < touched.size(); ++n) {
    if (touched[n]) nodes.push_back(static_cast<NodeIndex>(n));
  }
  return nodes;
}

}  // namespace kardan
