#include "kardan/materials/laws/plastic_kinematic.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(PlasticKinematic, plastic_kinematic)
