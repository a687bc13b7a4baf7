// One law of material compiled for one instruction set, as plain function pointers.
#pragma once

#include "kardan/materials/point.hpp"

namespace kardan {

/// Updates the points of a pack: `law` the constants, `point` a MaterialPoint, ShellPoint or BeamPoint on the pack of the instruction set.
using PointUpdate = void (*)(const void* law, void* point, const StepTime&, double* history);

struct LawKernels {
  PointUpdate solid = nullptr;
  PointUpdate shell = nullptr;
  PointUpdate beam = nullptr;
};

}  // namespace kardan
