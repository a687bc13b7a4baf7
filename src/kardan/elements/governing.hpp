// Which element governs the time step.
#pragma once

#include <limits>

#include "kardan/model/entities.hpp"

namespace kardan {

/// The element that governs the time step.
struct Governing {
  ElementKind kind = ElementKind::shell;
  UserId element = 0;  ///< the user's number; 0 = no element limits dt
  double time_step = std::numeric_limits<double>::infinity();  ///< its stable time step, without TSSFAC
};

}  // namespace kardan
