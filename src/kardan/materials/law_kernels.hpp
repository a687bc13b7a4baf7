// Compiles a law for one instruction set; included by the *.isa.cpp files of materials/laws only.
#pragma once

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/beam_stress_of.hpp"
#include "kardan/materials/law_entry.hpp"
#include "kardan/materials/shell_law.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

template <class Law>
void update_solid(const void* law, void* point, const StepTime& t, double* history) {
  auto& p = *static_cast<MaterialPoint<Pack>*>(point);
  static_cast<const Law*>(law)->update(p, t, history);
  unload_failed(p);
}
template <class Law>
void update_shell(const void* law, void* point, const StepTime& t, double* history) {
  auto& p = *static_cast<ShellPoint<Pack>*>(point);
  static_cast<const ShellLawOf<Law>*>(law)->update(p, t, history);
  unload_failed(p);
}
template <class Law>
void update_beam(const void* law, void* point, const StepTime& t, double* history) {
  static_cast<const BeamStressOf<Law>*>(law)->update(*static_cast<BeamPoint<Pack>*>(point), t, history);
}
/// Null for laws whose tensors a beam would have to turn.
template <class Law>
constexpr PointUpdate beam_update() {
  if constexpr (requires { Law::finite_strain; })
    return nullptr;
  else
    return &update_beam<Law>;
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

/// The kernels of the law `Type` as `name`_kernels; law_table.cpp declares it by KARDAN_ISA_OBJECT.
#define KARDAN_LAW_KERNELS(Type, name)                                                              \
  namespace kardan::KARDAN_ISA_NAMESPACE {                                                          \
  extern const LawKernels name##_kernels;                                                           \
  const LawKernels name##_kernels = {&update_solid<Type>, &update_shell<Type>, beam_update<Type>()}; \
  }
