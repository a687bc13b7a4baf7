// Deformable beams: which formulation and law computes a part, and what its elements start from. Discrete beams (ELFORM 6) are in
// discrete_beams.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/beam/beam_kernel.hpp"
#include "kardan/elements/tiles/tile_elements.hpp"
#include "kardan/model/beam_sections.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class BeamForces {
 public:
  /// Cuts the tiles of all beams that are not rigid or discrete; complains about formulations and materials that are not computed.
  BeamForces(const Model& model, State& state, Diagnostics& diagnostics);

  /// Resultants to t_n and forces onto the nodes. @throws RunError naming a beam without length or with a value that is not finite.
  void internal_forces(const Model& model, State& state);
  /// Adds the forces of the cycle to the nodes begin <= n < end.
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const { elements_.add_forces(state, begin, end); }
  TileElements& elements() { return elements_; }
  const Governing& governing() const { return elements_.governing(); }
  const TileElements& elements() const { return elements_; }
  /// Adds the energies at t_n, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
    elements_.add_energies(internal, hourglass);
  }
  /// Resultants at t_n.
  void report(const State& state, BeamResults& results) const;
  /// Entries of spot welds (ELFORM 9) in state.welds, and what they say at t_n, after report().
  void add_welds(const Model& model, State& state);
  void report_welds(State& state) const;

 private:
  void note_failures(State& state);
  bool set_up_part(const Model& model, PartIndex part, Diagnostics& diagnostics);
  void damp(const Model& model);
  void preload(const Model& model, Diagnostics& diagnostics);
  void preload_beam(const Model& model, const InitialStress& given, Index beam, Diagnostics& diagnostics);
  bool start_element(const Model& model, Index beam, PartIndex part, double* own, Diagnostics& diagnostics) const;

  TileElements elements_;
  std::vector<Law> laws_;                                         ///< by part of the model
  std::vector<std::shared_ptr<const BeamProperties>> properties_; ///< likewise
  const std::vector<std::array<NodeIndex, 3>>* nodes_;            ///< of the model's beams
  std::vector<Index> welds_;                                      ///< beams that are spot welds
  std::int64_t known_deleted_ = 0;                                ///< beams, when welds were last looked at
  std::size_t first_weld_ = 0;                                    ///< of them in state.welds
};

}  // namespace kardan
