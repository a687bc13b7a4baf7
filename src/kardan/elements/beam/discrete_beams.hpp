// Discrete beams (*SECTION_BEAM, ELFORM 6): springs and dampers in six directions of local axes that follow the nodes, and cables.
//
// SCOOR says which axes turn how and where the forces act (Hallquist, LS-DYNA Keyword User's Manual Vol. I, *SECTION_BEAM):
//   sign        the axes turn with node 1 (negative), node 2 (positive) or the mean of both (0);
//   |SCOOR|<=1  the nodes are one point: displacements are of node 2 relative to node 1, without couple;
//   3, 13       the distance d = x2 - x1 turns with the node of the sign, w: u' = v2 - v1 - w x d, and that node gets the couple of the
//               forces, d x F: a rigid rotation deforms nothing, and angular momentum is kept;
//   2, 12       as 3, with r along d.
// Kardan makes the correction that LS-DYNA makes for 12 and 13 always: there is no reason to do without it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/elements/node_limits.hpp"
#include "kardan/materials/discrete_beam_law.hpp"
#include "kardan/model/beam_sections.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class DiscreteBeams {
 public:
  /// Takes the beams of ELFORM 6 that are not rigid; complains about what is not computed.
  DiscreteBeams(const Model& model, State& state, Diagnostics& diagnostics);

  /// Forces at t_n onto the nodes. @throws RunError naming a beam whose force is not finite.
  void internal_forces(const Model& model, State& state);
  /// The beam with the smallest stable step at t_n.
  const Governing& governing() const { return governing_; }
  /// Adds the energies stored and dissipated up to t_n, by part.
  void add_energies(const Model& model, std::vector<double>& internal) const;
  /// Resultants at t_n.
  void report(BeamResults& results) const;

 private:
  struct Element {
    Index beam = none;
    std::array<NodeIndex, 2> nodes{none, none};
    Index law = none;        ///< into six_dof_ or cables_
    bool cable = false;
    int scoor = 0;
    double cable_area = 0, free_length = 0;

    bool extended() const { return scoor <= -2 || scoor >= 2; }
    bool along_nodes() const { return scoor == 2 || scoor == -2 || scoor == 12 || scoor == -12; }
    std::size_t carrier() const { return scoor > 0 ? 1 : 0; }  ///< the node that the axes turn with, where SCOOR is not 0
  };
  /// Mutable part of an element.
  struct History {
    std::array<Vec3, 3> axes;                          ///< r, s, t at t_n, global components
    std::array<double, 6> displacement{}, force{};     ///< at t_n
    double energy = 0;
    double alive = 1;
  };

  void add_element(const Model& model, State& state, Index beam, Diagnostics& diagnostics);
  bool find_law(const Model& model, const Part& part, Element& element, Diagnostics& diagnostics);
  bool start_axes(const Model& model, const BeamSection& section, const Element& element, History& history,
                  Diagnostics& diagnostics) const;
  void check_masses(const Model& model, const State& state, Diagnostics& diagnostics) const;
  std::array<double, 6> relative_velocity(const State& state, const Element& element, History& history) const;
  void six_forces(State& state, const Element& element, History& history);
  void cable_force(State& state, const Element& element, History& history);
  void bound_step(const Model& model, const State& state);

  std::vector<Element> elements_;
  std::vector<History> history_;
  std::vector<SixDofLaw> six_dof_;
  std::vector<CableLaw> cables_;
  std::vector<Index> law_of_material_;
  StepBound bound_;
  Governing governing_;
  bool can_fail_ = false;
};

}  // namespace kardan
