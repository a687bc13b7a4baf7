// *ELEMENT_DISCRETE: springs and dampers between two nodes, or a node and the ground; translational and torsional.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/node_limits.hpp"
#include "kardan/materials/spring_law.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class DiscreteForces {
 public:
  /// Checks sections, laws and orientations, marks the nodes as needed, registers the history.
  DiscreteForces(const Model& model, State& state, Diagnostics& diagnostics);

  /// Forces at t_n onto the nodes; fills state.discretes and the stable step.
  void internal_forces(const Model& model, State& state);
  /// The element with the smallest stable step at t_n.
  const Governing& governing() const { return governing_; }
  /// Energy stored and dissipated up to t_n.
  double energy() const { return energy_; }

 private:
  enum class Line : std::uint8_t {
    nodes,        ///< along the line of the two nodes
    fixed,        ///< along a vector fixed in space
    fixed_plane,  ///< along the projection of that line on the plane normal to the vector
    moving,       ///< along the line of two other nodes
    moving_plane  ///< along the projection on the plane normal to that
  };
  struct Element {
    std::array<NodeIndex, 2> nodes{none, none};
    Line line = Line::nodes;
    Index orientation = none, section = none, law = none;  ///< law: into laws_
    double scale = 1;
  };
  struct Law {
    const SpringMaterial* material = nullptr;
    SpringBounds bounds;
  };
  /// Mutable part of an element.
  struct History {
    SpringHistory law;
    Vec3 arm;                 ///< x2 - x1 at t_n
    Vec3 axis;                ///< direction at t_n
    double elongation = 0;    ///< at t_n, initial offset included
    double force = 0;         ///< at t_n, scale and magnification included
    double energy = 0;
    std::uint64_t failed = 0;
  };

  void add_element(const Model& model, State& state, std::size_t e, Diagnostics& diagnostics);
  bool set_line(const Model& model, State& state, std::size_t e, Element& element, Diagnostics& diagnostics);
  Index law_of(const Model& model, const Part& part, Diagnostics& diagnostics);
  void check_masses(const Model& model, const State& state, Diagnostics& diagnostics) const;
  Vec3 arm(const Model& model, const State& state, const Element& element) const;
  Vec3 axis(const Model& model, const State& state, const Element& element, const Vec3& arm, const Vec3& fallback) const;
  double rate(const Model& model, const State& state, const Element& element, History& h, double& elongation);
  double force_of(const Model& model, const State& state, std::size_t e, double elongation, double rate);
  double stop_force(const State& state, const DiscreteSection& section, std::size_t e, double elongation, double rate) const;
  double inverse_mass(const State& state, NodeIndex node, const Vec3& axis, bool torsional) const;
  void bound_step(const Model& model, const State& state);

  std::vector<Element> elements_;
  std::vector<Law> laws_;
  std::vector<Index> law_of_material_;
  std::vector<History> history_;
  std::vector<std::array<double, 2>> inverse_mass_;  ///< of the two ends at t_n, by element
  std::vector<std::array<double, 2>> tangent_;       ///< bounds of stiffness and damping at t_n, by element
  StepBound bound_;
  Governing governing_;
  double energy_ = 0;
};

}  // namespace kardan
