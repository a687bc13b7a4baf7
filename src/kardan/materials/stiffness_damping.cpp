#include "kardan/materials/stiffness_damping.hpp"

#include "kardan/base/isa.hpp"
#include "kardan/materials/law.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(LawKernels, stiffness_damping_kernels);

Law with_stiffness_damping(Law law, LawUse use, double shear_factor) {
  struct Kept {
    DampedLaw damped;
    std::shared_ptr<const void> law;
  };
  auto kept = std::make_shared<Kept>();
  DampedLaw& damped = kept->damped;
  kept->law = law.constants;
  damped.law = law.constants.get();
  damped.update = law.update;
  damped.law_history = law.history();
  damped.shear = law.shear;
  damped.transverse = shear_factor * law.shear;
  damped.youngs_modulus = law.youngs_modulus;
  const double nu = law.poissons_ratio;
  damped.lambda = use == LawUse::shell ? nu * law.youngs_modulus / (1 - nu * nu) : law.longitudinal - 2 * law.shear;

  if (law.plastic_strain != Law::npos) law.plastic_strain += DampedLaw::law_begin;
  if (law.preload) {
    law.preload = [below = std::move(law.preload)](double strain, double* values) { below(strain, values + DampedLaw::law_begin); };
  }
  law.start.insert(law.start.begin(), DampedLaw::law_begin, 0.0);
  law.start.push_back(0.0);
  law.damping = damped.damping_place();
  law.tensors += 1;
  const LawKernels& kernels = stiffness_damping_kernels_of_isa.running();
  law.update = use == LawUse::solid ? kernels.solid : use == LawUse::shell ? kernels.shell : kernels.beam;
  law.constants = std::shared_ptr<const void>(kept, &damped);
  law.inlined = InlinedLaw::no;
  return law;
}

}  // namespace kardan
