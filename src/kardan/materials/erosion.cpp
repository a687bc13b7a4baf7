#include "kardan/materials/erosion.hpp"

#include <algorithm>

#include "kardan/base/isa.hpp"
#include "kardan/materials/law.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(LawKernels, erosion_kernels);

Law with_erosion(Law law, const ErosionCriteria& criteria, LawUse use) {
  struct Kept {
    Erosion erosion;
    std::shared_ptr<const void> law;
  };
  auto kept = std::make_shared<Kept>(Kept{{criteria, law.constants.get(), law.update, law.history(), 0}, law.constants});
  Erosion& erosion = kept->erosion;
  if (law.plastic_strain != Law::npos) {
    erosion.law_plastic_strain = law.plastic_strain;
    law.plastic_strain += Erosion::law_begin;
  }
  if (law.preload) {
    law.preload = [below = std::move(law.preload)](double strain, double* values) { below(strain, values + Erosion::law_begin); };
  }
  law.start.insert(law.start.begin(), Erosion::law_begin, 0.0);
  law.start.resize(erosion.history(), 0.0);
  law.tensors += Erosion::own_tensors;
  law.constants = std::shared_ptr<const void>(kept, &erosion);
  const LawKernels& kernels = erosion_kernels_of_isa.running();
  law.update = use == LawUse::solid ? kernels.solid : kernels.shell;
  law.inlined = InlinedLaw::no;
  law.can_fail = true;
  law.deletion.points = criteria.failing_points;
  law.deletion.step = std::max(law.deletion.step, criteria.smallest_step);
  return law;
}

}  // namespace kardan
