// What ties free nodes to one another: rigid groups, common degrees of freedom, linear equations, interpolation.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kardan/base/index.hpp"

namespace kardan {

/// *CONSTRAINED_NODE_SET: the nodes move alike along some of the global axes.
struct CommonMotion {
  UserId id = 0;
  std::vector<NodeIndex> nodes;
  std::uint8_t dofs = 0;   ///< Dof bits, translations only
  double death = 1e20;     ///< TF
};

/// Free nodes that move as one rigid body for a time: *CONSTRAINED_SPOTWELD and _GENERALIZED_WELD until the weld fails, parts while
/// *DEFORMABLE_TO_RIGID_AUTOMATIC makes them rigid.
struct RigidGroup {
  std::string name;        ///< for messages: "weld 7", "part 3"
  std::vector<NodeIndex> nodes;
  double birth = 0;
  double death = 1e20;     ///< TF, TFAIL; TIME1 of the switch back
  /// (f_n/S_n)^N + (|f_s|/S_s)^M >= 1 for the pair of nodes; f_n counts in tension only. 0 = that term is left out.
  struct Failure {
    double normal = 0, shear = 0;                      ///< SN, SS: forces
    double normal_exponent = 1, shear_exponent = 1;    ///< N, M
  };
  std::optional<Failure> failure;
  enum class Weld : std::uint8_t { no, spot, generalized } weld = Weld::no;
  UserId weld_id = 0;
};

/// *CONSTRAINED_LINEAR_GLOBAL, _LOCAL: sum of coefficient x displacement (rotation) = 0.
struct LinearEquation {
  UserId id = 0;
  struct Term {
    NodeIndex node = none;
    int dof = 1;           ///< 1-3 translations, 4-6 rotations along the axes of `frame`
    Index frame = none;
    double coefficient = 0;
  };
  std::vector<Term> terms;
};

/// *CONSTRAINED_INTERPOLATION: the dependent node follows the rigid motion that fits those of the independent nodes best.
struct Interpolation {
  UserId id = 0;
  NodeIndex dependent = none;
  std::uint8_t dofs = 0;   ///< DDOF: Dof bits of the dependent node, along the axes of `frame`
  Index frame = none;      ///< CIDD of _LOCAL
  std::vector<NodeIndex> nodes;
  std::vector<double> weight;  ///< by node
  bool asks_rotations = false; ///< IDOF names rotations of independent nodes too (the default); they take no part
};

}  // namespace kardan
