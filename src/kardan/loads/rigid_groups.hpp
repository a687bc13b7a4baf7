// Groups of free nodes that move as rigid bodies for a time: welds until they fail, parts switched to rigid.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/loads/taken_dofs.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class RigidGroups {
 public:
  RigidGroups(const Model& model, State& state, TakenDofs& taken, Diagnostics& diagnostics);

  /// After the kick: rigid motion of the nodes of each group over the coming step, so that their distances stay what they are;
  /// a weld whose force in this kick is too great lets go from the next one on. A kick of length 0 (initial velocities) breaks none.
  void impose(const Model& model, State& state);

 private:
  std::vector<std::uint8_t> broken_;  ///< by group
  std::vector<Index> report_;         ///< by group: into state.welds; none = not reported
};

}  // namespace kardan
