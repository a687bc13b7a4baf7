// From keyword blocks to the model: every reference resolved to an index, every number in the main deck's units.
#pragma once

#include <cstddef>

#include "kardan/base/diagnostics.hpp"
#include "kardan/io/deck/deck.hpp"
#include "kardan/model/model.hpp"

namespace kardan::deck {

struct BuildOptions {
  /// End time of the run where it is not the deck's ENDTIM (0 = ENDTIM): functions of time are sampled up to it.
  double end_time = 0;
  /// A function of time that needs more points than this is refused.
  std::size_t max_curve_points = std::size_t{1} << 18;
};

/// Consumes the blocks of `deck`. Faults of the deck go into `diagnostics` (the model is then incomplete and must not
/// be run); what is right but cannot be computed by Kardan goes into Model::unsupported. Never throws on bad input.
Model build_model(Deck& deck, const BuildOptions& options, Diagnostics& diagnostics);

/// Keywords that the builder takes; the schema's honoured keywords must all be among them.
bool builds(const std::string& keyword);

}  // namespace kardan::deck
