#include "kardan/contact/transducer.hpp"

#include <algorithm>

namespace kardan {

Transducer::Transducer(const Model& model, const State& state, Index index, Diagnostics& diagnostics) : contact_(index) {
  const Contact& contact = model.contacts[index];
  two_sided_ = contact.reference.kind != ContactSide::Kind::nothing;
  for (std::size_t side = 0; side < (two_sided_ ? 2u : 1u); ++side) {
    member_[side].assign(model.nodes.size(), 0);
    const Surface surface(model, state, contact, side == 0 ? contact.tracked : contact.reference, {.automatic = true}, diagnostics);
    for (const SurfaceNode& n : surface.nodes()) member_[side][n.node] = 1;
  }
}

bool Transducer::holds(std::size_t side, const Segment& s) const {
  return std::all_of(s.nodes.begin(), s.nodes.end(), [&](NodeIndex n) { return member_[side][n] != 0; });
}

void Transducer::report(const std::vector<std::unique_ptr<PenaltyContact>>& contacts, State& state) const {
  ContactReport& report = state.contacts[contact_];
  report.force = report.moment = {};
  report.touching = 0;
  const auto add = [&](NodeIndex n, const Vec3& f) {
    report.force += f;
    report.moment += cross(state.nodes.x[n], f);
  };
  for (const auto& contact : contacts)
    for (const auto& d : contact->directions())
      d->pass.for_each([&](const Touch& t) {
        const NodeIndex node = d->pass.nodes().nodes()[t.place].node;
        const Segment& s = d->pass.segments().segments()[t.segment];
        const auto n = static_cast<std::size_t>(node);
        const bool on_node = member_[0][n] && (!two_sided_ || holds(1, s));
        const bool on_segment = holds(0, s) && (!two_sided_ || member_[1][n]);
        report.touching += on_node || on_segment;
        if (on_node) add(node, t.force);
        for (std::size_t k = 0; k < 4 && on_segment; ++k)
          if (t.weights[k] != 0) add(s.nodes[k], t.force * -t.weights[k]);
      });
  for (const auto& contact : contacts) {
    if (!contact->edges()) continue;
    contact->edges()->for_each([&](const auto& a, const auto& wa, const auto& b, const auto& wb, const Vec3& force) {
      const auto holds_edge = [&](std::size_t side, const auto& edge) { return member_[side][edge[0]] && member_[side][edge[1]]; };
      const bool first = holds_edge(0, a) && (!two_sided_ || holds_edge(1, b)), second = holds_edge(0, b) && (!two_sided_ || holds_edge(1, a));
      report.touching += first || second;
      for (std::size_t k = 0; k < 2; ++k) {
        if (first) add(a[k], force * wa[k]);
        if (second) add(b[k], force * -wb[k]);
      }
    });
  }
}

}  // namespace kardan
