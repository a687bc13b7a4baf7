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
  constexpr std::array<double, 4> xi{-1, 1, 1, -1}, eta{-1, -1, 1, 1};
  Vec3 a, b, h;
  for (std::size_t k = 0; k < 4; ++k) {
    a += x[k] * (0.25 * xi[k]);
    b += x[k] * (0.25 * eta[k]);
    h += x[k] * (0.25 * xi[k] * eta[k]);
  }
  const Vec3 constant = cross(a, b), along_xi = cross(a, h) / 3.0, along_eta = cross(h, b) / 3.0;
  std::array<Vec3, 4> areas;
  for (std::size_t k = 0; k < 4; ++k) areas[k] = constant + along_xi * xi[k] + along_eta * eta[k];
  return areas;
}

PressureLoads::PressureLoads(const Model& model, State& state, Diagnostics& diagnostics) {
  if (model.pressure_loads.empty()) return;
  std::vector<Index> place(model.nodes.size(), none);
  std::size_t floating = 0;
  for (const PressureLoad& load : model.pressure_loads) {
    auto& places = segments_.emplace_back();
    for (const auto& segment : load.segments) {
      auto& entry = places.emplace_back();
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
        entry[k] = static_cast<std::size_t>(place[n]);
      }
    }
  }
  force_.resize(nodes_.size());
}

double PressureLoads::apply(const Model& model, State& state) {
  if (nodes_.empty()) return 0;
  std::fill(force_.begin(), force_.end(), Vec3{});
  for (std::size_t l = 0; l < segments_.size(); ++l) {
    const PressureLoad& load = model.pressure_loads[l];
    if (state.clock.time < load.arrival) continue;
    const double pressure = load.scale * load_curve_value(model, state.clock, load.curve, state.clock.time - load.arrival);
    if (pressure == 0) continue;
    for (const auto& segment : segments_[l]) {
      std::array<Vec3, 4> x;
      for (std::size_t k = 0; k < 4; ++k) x[k] = state.nodes.x[nodes_[segment[k]]];
      const std::array<Vec3, 4> area = nodal_areas(x);
      for (std::size_t k = 0; k < 4; ++k) force_[segment[k]] -= area[k] * pressure;
    }
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) state.nodes.force[nodes_[i]] += force_[i];
  return power(state);
}

double PressureLoads::power(const State& state) const {
  double power = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) power += dot(force_[i], velocity_of(state, nodes_[i]));
  return power;
}

}  // namespace kardan
