// A positive pressure p acts against the normal of the segment n1, n2, n3, n4. Source: Hallquist, LS-DYNA Keyword User's Manual,
// *LOAD_SEGMENT, *LOAD_SHELL. The forces are those that do the work of p on the bilinear surface,
//   f_a = -p int N_a n dA,     n dA = dx/dxi x dx/deta dxi deta,     x = sum N_a x_a,
// so that a constant pressure on a closed surface has no resultant and no moment, whatever the shape of the segments, and does the
// work p dV. With x = ... + A xi + B eta + H xi eta the normal is  A x B + (A x H) xi + (H x B) eta  and
//   int N_a n dA = A x B + (A x H) xi_a/3 + (H x B) eta_a/3.
// On parallelograms and triangles every node has its equal share.
#include "kardan/loads/pressure_loads.hpp"

#include <algorithm>
#include <string>

#include "kardan/loads/node_velocity.hpp"
#include "kardan/state/load_curve.hpp"

namespace kardan {

std::array<Vec3, 4> nodal_areas(const std::array<Vec3, 4>& x) {
  const Vec3 a = ((x[1] + x[2]) - (x[0] + x[3])) * 0.25, b = ((x[2] + x[3]) - (x[0] + x[1])) * 0.25;
  const Vec3 h = ((x[0] + x[2]) - (x[1] + x[3])) * 0.25;
  const Vec3 constant = cross(a, b), along_xi = cross(a, h) * (1.0 / 3.0), along_eta = cross(h, b) * (1.0 / 3.0);
  const Vec3 sum = along_xi + along_eta, difference = along_xi - along_eta;
  return {constant - sum, constant + difference, constant + sum, constant - difference};
}

PressureLoads::PressureLoads(const Model& model, State& state, Diagnostics& diagnostics) {
  if (model.pressure_loads.empty()) return;
  std::vector<Index> place(model.nodes.size(), none);
  std::size_t floating = 0;
  for (const PressureLoad& load : model.pressure_loads) {
    for (const auto& segment : load.segments) {
      auto& entry = segments_.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        const NodeIndex n = segment[k];
        if (place[n] == none) {
          place[n] = static_cast<Index>(nodes_.size());
          nodes_.push_back(n);
          state.nodes.needed[n] = 1;
          if (state.nodes.body[n] == none && state.nodes.mass[n] <= 0 && floating++ == 0) {
            diagnostics.error("node " + std::to_string(model.nodes.id[n]) + " carries a pressure but has no mass",
                              "load segments of elements", "*LOAD_SEGMENT");
          }
        }
        entry[k] = static_cast<std::uint32_t>(place[n]);
      }
    }
    end_.push_back(segments_.size());
  }
  force_.resize(nodes_.size());
}

double PressureLoads::apply(const Model& model, State& state) {
  if (nodes_.empty()) return 0;
  std::fill(force_.begin(), force_.end(), Vec3{});
  std::size_t i = 0;
  double factor = 0;  // of the curve; many a deck has one load for each segment, all with one curve
  for (std::size_t l = 0; l < end_.size(); ++l) {
    const PressureLoad& load = model.pressure_loads[l];
    const bool as_before = l > 0 && load.curve == model.pressure_loads[l - 1].curve && load.arrival == model.pressure_loads[l - 1].arrival;
    if (!as_before) factor = load_curve_value(model, state.clock, load.curve, state.clock.time - load.arrival);
    const double pressure = state.clock.time < load.arrival ? 0.0 : load.scale * factor;
    if (pressure == 0) {
      i = end_[l];
      continue;
    }
    for (; i < end_[l]; ++i) {
      const auto& segment = segments_[i];
      std::array<Vec3, 4> x;
      for (std::size_t k = 0; k < 4; ++k) x[k] = state.nodes.x[nodes_[segment[k]]];
      const std::array<Vec3, 4> area = nodal_areas(x);
      for (std::size_t k = 0; k < 4; ++k) force_[segment[k]] -= area[k] * pressure;
    }
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) state.nodes.force[nodes_[n]] += force_[n];
  return power(state);
}

double PressureLoads::power(const State& state) const {
  double power = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) power += dot(force_[i], velocity_of(state, nodes_[i]));
  return power;
}

}  // namespace kardan
