#include "kardan/model/properties.hpp"

#include <type_traits>

#include "kardan/model/element_shape.hpp"

namespace kardan {

BulkProperties bulk_properties(const Material& material) {
  return std::visit(
      [](const auto& law) -> BulkProperties {
        if constexpr (std::is_same_v<std::decay_t<decltype(law)>, SpringMaterial>) {
          return {};
        } else {
          return {law.density, law.youngs_modulus, law.poissons_ratio};
        }
      },
      material.law);
}

std::array<double, 4> shell_thickness(const Model& model, Index shell) {
  if (const auto own = model.shells.thickness.find(shell); own != model.shells.thickness.end()) return own->second;
  const Part& part = model.parts[static_cast<std::size_t>(model.shells.part[static_cast<std::size_t>(shell)])];
  std::array<double, 4> t = model.sections[static_cast<std::size_t>(part.section)].shell.thickness;
  for (double& node : t) node = node == 0 ? t[0] : node;
  return t;
}

double mean_thickness(const Model& model, Index shell) {
  const std::array<double, 4> t = shell_thickness(model, shell);
  if (is_triangle(model.shells.nodes[static_cast<std::size_t>(shell)])) return (t[0] + t[1] + t[2]) / 3.0;
  return 0.25 * (t[0] + t[1] + t[2] + t[3]);
}

}  // namespace kardan
