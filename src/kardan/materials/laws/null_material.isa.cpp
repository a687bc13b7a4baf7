#include "kardan/materials/laws/null_material.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(NullMaterial, null_material)
