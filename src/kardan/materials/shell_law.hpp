// Which law of shells belongs to a law of three dimensions: an own one where there is a faster way than iterating the normal strain.
#pragma once

#include "kardan/materials/j2_flow.hpp"
#include "kardan/materials/laws/elastic_plane_stress.hpp"
#include "kardan/materials/laws/johnson_cook.hpp"
#include "kardan/materials/plane_stress_of.hpp"
#include "kardan/materials/laws/null_material.hpp"
#include "kardan/materials/laws/plastic_plane_stress.hpp"

namespace kardan {

template <class Law>
struct ShellLawTrait {
  using Type = PlaneStressOf<Law>;
};
template <>
struct ShellLawTrait<Elastic> {
  using Type = ElasticPlaneStress;
};
template <>
struct ShellLawTrait<PiecewisePlastic> {
  using Type = PlasticPlaneStress;
};
template <>
struct ShellLawTrait<NullMaterial> {
  using Type = NullShell;
};
template <class Yield>
struct ShellLawTrait<J2Flow<Yield>> {
  using Type = J2PlaneStress<Yield>;
};
template <>
struct ShellLawTrait<JohnsonCook> {
  using Type = JohnsonCookShell;
};
template <class Law>
using ShellLawOf = typename ShellLawTrait<Law>::Type;

}  // namespace kardan
