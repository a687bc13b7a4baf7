#include "kardan/elements/section_forces.hpp"

#include <algorithm>

#include "kardan/state/frames.hpp"

namespace kardan {

SectionForces::SectionForces(const Model& model, const std::array<std::vector<TileElements*>, 3>& tiled) {
  corners_.resize(model.cross_sections.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const CrossSection& section = model.cross_sections[i];
    for (std::size_t kind = 0; kind < tiled.size(); ++kind) {
      for (TileElements* group : tiled[kind]) {
        group->watch(section.elements[kind]);
        for (const Index element : section.elements[kind]) {
          const std::vector<NodeIndex> nodes = group->nodes_of(element);
          for (std::size_t a = 0; a < nodes.size(); ++a) {
            if (std::binary_search(section.nodes.begin(), section.nodes.end(), nodes[a])) corners_[i].push_back({group, element, a, nodes[a]});
          }
        }
      }
    }
  }
}

void SectionForces::report(const Model& model, State& state) const {
  state.sections.assign(corners_.size(), SectionReport{});
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const CrossSection& section = model.cross_sections[i];
    SectionReport& r = state.sections[i];
    for (const NodeIndex n : section.nodes) r.centroid += state.nodes.x[n];
    r.centroid *= 1.0 / static_cast<double>(std::max<std::size_t>(section.nodes.size(), 1));
    const auto add = [&](NodeIndex node, const Vec3& force, const Vec3& moment) {
      r.force += force;
      r.moment += cross(state.nodes.x[node] - r.centroid, force) + moment;
    };
    for (const Corner& c : corners_[i]) {
      const std::array<Vec3, 2> f = c.group->force_on(c.element, c.a);
      add(c.node, f[0], f[1]);
    }
    for (const Index e : section.elements[static_cast<std::size_t>(ElementKind::discrete)]) {
      const auto& nodes = model.discretes.nodes[e];
      for (std::size_t a = 0; a < 2; ++a) {
        if (nodes[a] == none || !std::binary_search(section.nodes.begin(), section.nodes.end(), nodes[a])) continue;
        add(nodes[a], state.discretes[e].global_force * (a == 1 ? -1.0 : 1.0), {});
      }
    }
    if (section.frame == none) continue;
    const Mat3 to_local = transpose(frame_axes(model, state, section.frame));
    r.force = to_local * r.force;
    r.moment = to_local * r.moment;
  }
}

}  // namespace kardan
