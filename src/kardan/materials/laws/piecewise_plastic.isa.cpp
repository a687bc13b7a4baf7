#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(PiecewisePlastic, piecewise_plastic)
