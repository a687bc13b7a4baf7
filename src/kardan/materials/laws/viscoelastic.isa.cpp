#include "kardan/materials/laws/viscoelastic.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(Viscoelastic, viscoelastic)
