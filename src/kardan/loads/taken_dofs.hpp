// Which degrees of freedom of nodes are held or tied already.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class TakenDofs {
 public:
  /// Supports and prescribed motions of nodes; in axes other than the global ones they take all three translations (rotations).
  explicit TakenDofs(const Model& model);

  /// An error where the node is of a body, has no mass, or some of `dofs` are taken. `what` names the tie: "weld 7".
  bool check(const Model& model, const State& state, NodeIndex n, std::uint8_t dofs, const std::string& what,
             const char* keyword, Diagnostics& diagnostics) const;
  /// The same; if all is well they are taken.
  void take(const Model& model, const State& state, NodeIndex n, std::uint8_t dofs, const std::string& what,
            const char* keyword, Diagnostics& diagnostics);

 private:
  std::vector<std::uint8_t> bits_;
};

}  // namespace kardan
