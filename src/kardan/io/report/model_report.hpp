// A model in words: what `kardan check` prints.
#pragma once

#include <string>

#include "kardan/model/model.hpp"

namespace kardan {

/// Title, counts, extent, parts with material and mass, rigid bodies, joints, loads, requested results, and what Kardan
/// cannot compute of it. Plain text, one line a fact, ends with a newline.
std::string model_report(const Model& model);

}  // namespace kardan
