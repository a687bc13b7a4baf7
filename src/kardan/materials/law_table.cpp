// Which law computes which material: one row a law.
#include <algorithm>
#include <iterator>
#include <type_traits>

#include "kardan/base/isa.hpp"
#include "kardan/materials/beam_stress_of.hpp"
#include "kardan/materials/law.hpp"
#include "kardan/materials/laws/blatz_ko.hpp"
#include "kardan/materials/laws/crushable_foam.hpp"
#include "kardan/materials/laws/frazer_nash.hpp"
#include "kardan/materials/laws/hyperelastic_rubber.hpp"
#include "kardan/materials/laws/low_density_foam.hpp"
#include "kardan/materials/laws/mooney_rivlin.hpp"
#include "kardan/materials/laws/null_material.hpp"
#include "kardan/materials/laws/ogden.hpp"
#include "kardan/materials/laws/johnson_cook.hpp"
#include "kardan/materials/laws/plastic_kinematic.hpp"
#include "kardan/materials/laws/power_plastic.hpp"
#include "kardan/materials/laws/rate_plastic.hpp"
#include "kardan/materials/laws/spotweld.hpp"
#include "kardan/materials/laws/viscoelastic.hpp"
#include "kardan/materials/shell_law.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(LawKernels, elastic_kernels);
KARDAN_ISA_OBJECT(LawKernels, piecewise_plastic_kernels);
KARDAN_ISA_OBJECT(LawKernels, plastic_kinematic_kernels);
KARDAN_ISA_OBJECT(LawKernels, blatz_ko_kernels);
KARDAN_ISA_OBJECT(LawKernels, mooney_rivlin_kernels);
KARDAN_ISA_OBJECT(LawKernels, frazer_nash_kernels);
KARDAN_ISA_OBJECT(LawKernels, hyperelastic_rubber_kernels);
KARDAN_ISA_OBJECT(LawKernels, ogden_kernels);
KARDAN_ISA_OBJECT(LawKernels, spotweld_kernels);
KARDAN_ISA_OBJECT(LawKernels, viscoelastic_kernels);
KARDAN_ISA_OBJECT(LawKernels, null_material_kernels);
KARDAN_ISA_OBJECT(LawKernels, rate_plastic_kernels);
KARDAN_ISA_OBJECT(LawKernels, power_plastic_kernels);
KARDAN_ISA_OBJECT(LawKernels, johnson_cook_kernels);
KARDAN_ISA_OBJECT(LawKernels, low_density_foam_kernels);
KARDAN_ISA_OBJECT(LawKernels, crushable_foam_kernels);

namespace {

using Maker = std::optional<Law> (*)(LawSource&, LawUse, double shear_factor, const LawKernels&);

struct Row {
  int material;                 ///< LS-DYNA's number
  bool solids, shells;
  bool beams;                   ///< only laws whose two strains across the axis are equal (beam_stress_of.hpp)
  Maker make;
  const ForEachIsa<LawKernels>* kernels;
  char variant = 0;             ///< 'H' of 77_H
};

template <class Constants>
struct Kept {
  Constants constants;
  std::vector<std::shared_ptr<std::vector<double>>> tables;
};

template <class Constants>
void keep_constants(Law& law, const Constants& constants, const LawSource& source) {
  auto kept = std::make_shared<Kept<Constants>>(Kept<Constants>{constants, source.kept});
  law.constants = std::shared_ptr<const void>(kept, &kept->constants);
  law.start.resize(Constants::history);
  if constexpr (requires { constants.used_history(); }) law.start.resize(constants.used_history());
  constants.start(law.start.data());
}

/// Yield stress of a hardening table at the plastic strain p.
double yield_at(const HardeningCurve& hardening, double p) {
  std::size_t row = 0;
  while (row + 1 < hardening.row_count && p >= hardening.rows[(row + 1) * hardening_columns]) ++row;
  const double* piece = hardening.rows + row * hardening_columns;
  return piece[1] + piece[2] * (p - piece[0]);
}

/// Law::preload and ::remembers, for the set-up only.
template <class L>
void set_preload(Law& law, const L& own) {
  if constexpr (std::is_same_v<L, PiecewisePlastic>) {
    law.preload = [hardening = own.hardening](double strain, double* values) {
      values[PiecewisePlastic::plastic_strain] = strain;
      values[PiecewisePlastic::plastic_strain + 1] = yield_at(hardening, strain);
    };
  } else if constexpr (requires { L::plastic_strain; }) {
    law.preload = [](double strain, double* values) { values[L::plastic_strain] = strain; };
  } else if constexpr (!requires { L::finite_strain; } && !std::is_same_v<L, NullMaterial>) {
    law.preload = [](double, double*) {};
  }
  if constexpr (std::is_base_of_v<PlasticKinematic, L>) law.remembers = own.kinematic > 0;                       // the back stress
  if constexpr (std::is_same_v<L, JohnsonCook> || std::is_same_v<L, Viscoelastic>) law.remembers = true;  // temperature, damage; what relaxes
}

template <class L>
std::optional<Law> make(LawSource& source, LawUse use, double shear_factor, const LawKernels& kernels) {
  const std::optional<L> own = L::make(source);
  if (!own) return std::nullopt;
  Law law;
  law.longitudinal = own->longitudinal();
  law.shear = own->shear();
  const double lambda = law.longitudinal - 2 * law.shear;
  if (lambda + law.shear > 0) {  // else it carries nothing
    law.youngs_modulus = law.shear * (3 * lambda + 2 * law.shear) / (lambda + law.shear);
    law.poissons_ratio = lambda / (2 * (lambda + law.shear));
  }
  law.tensors = L::tensors;
  if constexpr (requires { own->used_tensors(); }) law.tensors = own->used_tensors();
  if constexpr (requires { L::plastic_strain; }) law.plastic_strain = L::plastic_strain;
  if constexpr (requires { own->can_fail(); }) law.can_fail = own->can_fail();
  if constexpr (requires { own->deletion(); }) law.deletion = own->deletion();
  set_preload(law, *own);
  if constexpr (std::is_same_v<L, Elastic>) law.inlined = InlinedLaw::elastic;
  if constexpr (std::is_same_v<L, PiecewisePlastic>) law.inlined = InlinedLaw::piecewise_plastic;
  if (use == LawUse::solid) {
    law.update = kernels.solid;
    keep_constants(law, *own, source);
  } else if (use == LawUse::beam) {
    law.update = kernels.beam;
    keep_constants(law, BeamStressOf<L>::from(*own), source);
  } else {
    law.update = kernels.shell;
    keep_constants(law, ShellLawOf<L>::from(*own, shear_factor), source);
  }
  return law;
}

constexpr Row rows[] = {
    // number, solids, shells, beams
    {1, true, true, true, &make<Elastic>, &elastic_kernels_of_isa},
    {3, true, true, true, &make<PlasticKinematic>, &plastic_kinematic_kernels_of_isa},
    {6, true, true, false, &make<Viscoelastic>, &viscoelastic_kernels_of_isa},
    {7, true, true, false, &make<BlatzKo>, &blatz_ko_kernels_of_isa},
    {9, true, true, false, &make<NullMaterial>, &null_material_kernels_of_isa},
    {12, true, true, true, &make<PowerPlastic>, &power_plastic_kernels_of_isa},
    {15, true, true, false, &make<JohnsonCook>, &johnson_cook_kernels_of_isa},
    {18, true, true, true, &make<PowerPlastic>, &power_plastic_kernels_of_isa},
    {24, true, true, true, &make<PiecewisePlastic>, &piecewise_plastic_kernels_of_isa},
    {27, true, true, false, &make<MooneyRivlin>, &mooney_rivlin_kernels_of_isa},
    {31, true, false, false, &make<FrazerNash>, &frazer_nash_kernels_of_isa},
    {57, true, false, false, &make<LowDensityFoam>, &low_density_foam_kernels_of_isa},
    {63, true, false, false, &make<CrushableFoam>, &crushable_foam_kernels_of_isa},
    {77, true, true, false, &make<HyperelasticRubber>, &hyperelastic_rubber_kernels_of_isa, 'H'},
    {77, true, true, false, &make<Ogden>, &ogden_kernels_of_isa, 'O'},
    {98, true, true, true, &make<PowerPlastic>, &power_plastic_kernels_of_isa},
    {100, true, false, true, &make<Spotweld>, &spotweld_kernels_of_isa},
    {123, true, true, true, &make<RatePlastic>, &rate_plastic_kernels_of_isa},  // and 24 where the law above does not do what the deck asks
};

bool serves(const Row& row, LawUse use) {
  return use == LawUse::solid ? row.solids : use == LawUse::shell ? row.shells : row.beams;
}

constexpr const char* element_names[] = {"solids", "shells", "beams"};  // by LawUse

/// LS-DYNA's number and the density of a material.
struct Identify {
  const Model& model;

  std::pair<int, double> operator()(const ElasticMaterial& m) const { return {1, m.density}; }
  std::pair<int, double> operator()(const PiecewisePlasticMaterial& m) const {
    return {PiecewisePlastic::computes(m, model.curves) ? 24 : 123, m.density};
  }
  std::pair<int, double> operator()(const FieldMaterial& m) const { return {m.number, m.density}; }
  std::pair<int, double> operator()(const RigidMaterial& m) const { return {20, m.density}; }
  std::pair<int, double> operator()(const SpringMaterial&) const { return {0, 0}; }
  std::pair<int, double> operator()(const UnsupportedMaterial& m) const { return {0, m.density}; }
};

char variant_of(const Material& material) {
  const auto* m = std::get_if<FieldMaterial>(&material.law);
  return m ? m->variant : 0;
}

std::string keyword_of(const Material& material) {
  if (const auto* m = std::get_if<UnsupportedMaterial>(&material.law)) return " (" + m->keyword + ")";
  if (const auto* m = std::get_if<FieldMaterial>(&material.law)) return " (" + m->keyword + ")";
  return {};
}

/// EPSTHIN and EPSMAJ of *MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY.
std::optional<ErosionCriteria> criteria_of_law(const Material& material) {
  const auto* m = std::get_if<PiecewisePlasticMaterial>(&material.law);
  if (m == nullptr || !(m->thinning > 0 || m->major_strain > 0)) return std::nullopt;
  ErosionCriteria criteria;
  if (m->thinning > 0) criteria.thinning = m->thinning;
  if (m->major_strain > 0) criteria.major_strain = m->major_strain;
  criteria.failing_points = m->failing_points;
  return criteria;
}

bool damped(const Model& model, const Part& part) {
  return std::any_of(model.stiffness_dampings.begin(), model.stiffness_dampings.end(), [&](const StiffnessDamping& damping) {
    return std::any_of(damping.parts.begin(), damping.parts.end(), [&](PartIndex p) { return &model.parts[static_cast<std::size_t>(p)] == &part; });
  });
}

bool check_erosion(LawSource& source, const Law& law, const ErosionCriteria& criteria, LawUse use) {
  const auto refuse = [&](const char* what, const char* cure) {
    source.diagnostics.error(source.name + what, cure, "*MAT_ADD_EROSION");
    return false;
  };
  if (use == LawUse::beam) return refuse(" of beams is to fail by *MAT_ADD_EROSION, which this version does not compute", "take the criteria away");
  if (criteria.plastic_strain < ErosionCriteria::never && law.plastic_strain == Law::npos)
    return refuse(" is to fail by its plastic strain (EFFEPS < 0) and has none", "give EFFEPS > 0, or a plastic material");
  if (use == LawUse::solid && (criteria.thinning < ErosionCriteria::never || criteria.major_strain < ErosionCriteria::never))
    return refuse(" of solids is to fail by its thinning or major strain (EPSTHIN, EPSMAJ), which are of shells",
                  "use MXEPS of *MAT_ADD_EROSION for solids");
  return true;
}

}  // namespace

bool check_elastic_constants(LawSource& source, double density, double youngs_modulus, double poissons_ratio) {
  if (density > 0 && youngs_modulus > 0 && poissons_ratio > -1 && poissons_ratio < 0.5) return true;
  source.diagnostics.error(source.name + " of deformable elements has density " + std::to_string(density) + ", Young's modulus " +
                               std::to_string(youngs_modulus) + " and Poisson's ratio " + std::to_string(poissons_ratio),
                           "give RO > 0, E > 0 and -1 < PR < 0.5", "*MAT");
  return false;
}

std::optional<Law> make_law(const Model& model, const Part& part, LawUse use, double shear_factor, Diagnostics& diagnostics) {
  const Material& material = model.materials[static_cast<std::size_t>(part.material)];
  const auto [number, density] = std::visit(Identify{model}, material.law);
  const auto row = std::find_if(std::begin(rows), std::end(rows), [&, n = number](const Row& r) {
    return r.material == n && r.variant == variant_of(material) && serves(r, use);
  });
  LawSource source{model, material, diagnostics, "material " + std::to_string(material.id), {}, use, density};
  if (part.equation_of_state != none) source.eos = &model.equations_of_state[part.equation_of_state];
  if (row == std::end(rows)) {
    diagnostics.error("part " + std::to_string(part.id) + " has deformable " + element_names[static_cast<int>(use)] + " of " +
                          source.name + keyword_of(material) + ", which this version does not compute",
                      "use a material that docs/keywords.md names for them, or make the part rigid (*MAT_RIGID)", "*PART");
    return std::nullopt;
  }
  std::optional<Law> law = row->make(source, use, shear_factor, row->kernels->running());
  if (!law) return std::nullopt;
  law->density = density;
  if (const std::optional<ErosionCriteria> own = criteria_of_law(material)) {
    if (!check_erosion(source, *law, *own, use)) return std::nullopt;
    law = with_erosion(std::move(*law), *own, use);
  }
  if (material.erosion) {
    if (!check_erosion(source, *law, *material.erosion, use)) return std::nullopt;
    law = with_erosion(std::move(*law), *material.erosion, use);
  }
  if (source.eos && !source.eos_taken && use == LawUse::solid) {
    diagnostics.warning("part " + std::to_string(part.id) + " names an equation of state; " + source.name + keyword_of(material) + " has none and takes no notice",
                        "set EOSID = 0", "*PART");
  }
  if (damped(model, part)) law = with_stiffness_damping(std::move(*law), use, shear_factor);
  return law;
}

}  // namespace kardan
