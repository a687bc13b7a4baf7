// Stable step of elements that stand free: on edges and faces that no other element shares.
//
// L/c, LS-DYNA's step, is the limit of the inside of a regular mesh (a plane wave of one element's half wavelength). An element with free sides
// can also breathe: all its sides move outwards at once, against its own share of mass only, and a lone square shell of nu = 0.3 is then
// unstable beyond 0.877 L/c, a lone cube beyond 0.734 L/c.
//
// The one-point element with gradients b_a and nodal masses m_a has the rates L = sum v_a b_a, and its frequencies are those of C G,
// with G s = (S s + s S)/2 and S = V sum b_a b_a / m_a (both from M^-1 B^T C B, with the nonzero eigenvalues of B M^-1 B^T C). In the
// axes of S the shears stand alone, 2 mu (s_i + s_j)/2, and the normal strains give sqrt(s_i s_j) (lambda + 2 mu delta_ij). On a
// parallelepiped S = (V/(N m)) sum over its three directions of grad xi grad xi. A direction whose sides are both shared takes part in no
// breathing; one with a free side carries half the motion, exactly so in a row of two: its term is multiplied by
// f = (free sides)/2. The step is 2/omega. Rows and plates of squares and cubes then get the limit that their frequency gives, and elements without
// free sides keep L/c. For the frequency as the bound of the step: Belytschko, Liu and Moran, Nonlinear Finite Elements for Continua and Structures
// 2000, section 6.2.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/base/vec3.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

/// By element, a bit for every edge of a shell that no other shell shares: bit i for the edge of nodes i and i + 1.
std::vector<std::uint8_t> free_edges(const ShellElements& shells);
/// By element, a bit for every face of a solid that no other solid shares, in the order t-, t+, s-, r+, s+, r- of the natural
/// coordinates; faces without area (repeated nodes) count as shared.
std::vector<std::uint8_t> free_faces(const SolidElements& solids);

/// Elastic constants and density of an element. Plates are taken in plane stress.
struct FreeBody {
  double density = 0, shear = 0, longitudinal = 0;  ///< mass/volume with all that rides on it; mu; lambda + 2 mu
  double transverse = 0;                            ///< of shells: k G
};

/// Stable step of a shell over its L/c (`length` over the plate's wave speed), at most 1. @param edges its bits of free_edges()
double free_shell_factor(const Model& model, Index shell, std::uint8_t edges, const FreeBody& body, double thickness);
/// Likewise of a solid. @param faces its bits of free_faces()
double free_solid_factor(const Model& model, Index solid, std::uint8_t faces, const FreeBody& body);

}  // namespace kardan
