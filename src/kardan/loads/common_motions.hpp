// *CONSTRAINED_NODE_SET: nodes that move alike along some global axes.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/loads/taken_dofs.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class CommonMotions {
 public:
  CommonMotions(const Model& model, const State& state, TakenDofs& taken, Diagnostics& diagnostics);

  /// After the kick: gives the nodes of each set their common velocity.
  void impose(const Model& model, State& state) const;
};

}  // namespace kardan
