// What a section's ELFORM, points and offsets mean for the kernels.
#pragma once

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/shell/shell_kernel.hpp"
#include "kardan/materials/law.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

/// ELFORM as Kardan computes it.
struct ShellFormulation {
  bool fully_integrated = false;  ///< 9, 16: 2 x 2 points in the plane
  bool triangles = false;         ///< 4: all elements are C0 triangles
  bool membrane = false;          ///< 5, 9: no bending
};
/// Complains about what is not computed. @param name "part 7"
bool find_formulation(const Section& section, const std::string& name, Diagnostics& diagnostics, ShellFormulation& formulation);

/// Triangles of the part are C0 triangles: by ELFORM 4, because ESORT = 1, or because the formulation needs four corners.
bool sorts_triangles(const Model& model, const ShellFormulation& formulation);

/// Points and weights (sum 2) over -1 to 1 from the inside out: the section's *INTEGRATION_SHELL, else NIP points of Gauss, of Lobatto where INTGRD =
/// 1 and there are 3 to 10, of the trapezoidal rule beyond 10.
struct ThicknessRule {
  std::vector<double> points, weights;
};
ThicknessRule thickness_rule(const Model& model, const ShellSection& section);

/// All a kernel wants to know of a part. `triangles`: its C0 triangles.
ShellProperties shell_properties(const Model& model, const Part& part, const Law& law, const ShellFormulation& formulation, bool triangles);

/// Gauss-Legendre rule on [-1, 1], ascending; exact to degree 2 n - 1.
void gauss_rule(int n, double* points, double* weights);
/// Gauss-Lobatto rule with both ends, n >= 2; exact to degree 2 n - 3.
void lobatto_rule(int n, double* points, double* weights);

}  // namespace kardan
