// *CONTACT_FORCE_TRANSDUCER_PENALTY: what the other contacts do to a surface.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/penalty.hpp"

namespace kardan {

/// With one side: all forces of penalty contacts on its nodes, those that it exerts on itself cancelling. With two: only those between a node of
/// one side and a segment of the other.
class Transducer {
 public:
  Transducer(const Model& model, const State& state, Index contact, Diagnostics& diagnostics);
  void report(const std::vector<std::unique_ptr<PenaltyContact>>& contacts, State& state) const;

 private:
  bool holds(std::size_t side, const Segment& segment) const;

  Index contact_;
  bool two_sided_ = false;
  std::array<std::vector<std::uint8_t>, 2> member_;  ///< by node of the model
};

}  // namespace kardan
