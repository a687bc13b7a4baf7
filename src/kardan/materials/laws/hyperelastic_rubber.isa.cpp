#include "kardan/materials/laws/hyperelastic_rubber.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(HyperelasticRubber, hyperelastic_rubber)
