// *CONSTRAINED_LINEAR and *CONSTRAINED_INTERPOLATION: linear equations between velocities of free nodes, held by Lagrange multipliers.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/loads/taken_dofs.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class VelocityTies {
 public:
  VelocityTies(const Model& model, State& state, TakenDofs& taken, Diagnostics& diagnostics);

  /// After the kick: the velocities nearest to those of the nodes, in the norm of the kinetic energy, that fulfil the equations.
  void impose(const Model& model, State& state) const;

 private:
  /// One coefficient of a row: on the velocity and on the angular velocity of a node.
  struct Term {
    std::size_t node = 0;  ///< into Cluster::nodes
    Vec3 linear, angular;
  };
  using Row = std::vector<Term>;
  /// Ties that share nodes, solved together.
  struct Cluster {
    std::vector<NodeIndex> nodes;
    std::vector<Index> equations, interpolations;  ///< into the model's lists
    std::vector<std::vector<std::size_t>> places;  ///< of the nodes of each interpolation, the dependent one first
    std::vector<std::vector<std::size_t>> equation_places;
  };
  class Grouping;

  void add_equations(const Model& model, const State& state, const Cluster& cluster, std::vector<Row>& rows) const;
  void add_interpolations(const Model& model, const State& state, const Cluster& cluster, const std::vector<Vec3>& x, std::vector<Row>& rows) const;
  void impose(const Model& model, State& state, const Cluster& cluster) const;

  std::vector<Cluster> clusters_;
};

}  // namespace kardan
