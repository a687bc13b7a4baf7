#include "kardan/elements/shell/shell_laws.hpp"

#include <type_traits>

namespace kardan {

namespace {

/// One overload for every material that shells can be made of.
struct MakeLaw {
  const Model& model;
  double shear_factor;
  std::vector<double>& table;

  std::optional<ShellLaw> operator()(const ElasticMaterial& m) const {
    return ElasticPlaneStress::from(m.youngs_modulus, m.poissons_ratio, shear_factor);
  }
  std::optional<ShellLaw> operator()(const PiecewisePlasticMaterial& m) const {
    table = hardening_table(m, model.curves);
    return PlasticPlaneStress::from(m, shear_factor, table);
  }
  std::optional<ShellLaw> operator()(const RigidMaterial&) const { return std::nullopt; }
  std::optional<ShellLaw> operator()(const SpringMaterial&) const { return std::nullopt; }
  std::optional<ShellLaw> operator()(const UnsupportedMaterial&) const { return std::nullopt; }
};

}  // namespace

bool check_shell_law(const Model& model, const Part& part, Diagnostics& diagnostics) {
  const Material& material = model.materials[part.material];
  const std::string name = "material " + std::to_string(material.id);
  const std::size_t errors = diagnostics.error_count();
  return std::visit(
      [&](const auto& m) {
        using M = std::decay_t<decltype(m)>;
        if constexpr (std::is_same_v<M, ElasticMaterial> || std::is_same_v<M, PiecewisePlasticMaterial>) {
          if (!(m.density > 0 && m.youngs_modulus > 0)) {
            diagnostics.error(name + " of deformable shells has no density or stiffness", "give RO and E", "*MAT");
          } else if constexpr (std::is_same_v<M, PiecewisePlasticMaterial>) {
            check_hardening(m, model.curves, name, diagnostics);
          }
        } else {
          std::string what = name;
          if constexpr (std::is_same_v<M, UnsupportedMaterial>) what += " (" + m.keyword + ")";
          diagnostics.error("part " + std::to_string(part.id) + " has deformable shells of " + what + ", which this version does not compute",
                            "use *MAT_ELASTIC or *MAT_PIECEWISE_LINEAR_PLASTICITY, or make the part rigid (*MAT_RIGID)", "*PART");
        }
        return diagnostics.error_count() == errors;
      },
      material.law);
}

ShellLaw shell_law(const Model& model, const Material& material, double shear_factor, std::vector<double>& table) {
  const auto law = std::visit(MakeLaw{model, shear_factor, table}, material.law);
  KARDAN_ASSERT(law.has_value());
  return *law;
}

std::vector<double> point_start(const ShellLaw& law) {
  return std::visit(
      [](const auto& l) {
        std::vector<double> values(shell_point_values<std::decay_t<decltype(l)>>, 0.0);
        l.start(values.data() + 5);
        return values;
      },
      law);
}

}  // namespace kardan
