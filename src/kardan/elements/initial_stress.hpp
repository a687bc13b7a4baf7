// *INITIAL_STRESS at the points of elements.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/materials/law.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/results.hpp"

namespace kardan {

/// Stress and plastic strain that a point begins with.
struct PointPreload {
  StressVector stress{};
  double plastic_strain = 0;
};

/// Element and entry, elements ascending: the last entry of the deck that names an element of this kind.
std::vector<std::pair<Index, const InitialStress*>> initial_stresses_of(const Model& model, ElementKind kind);

/// Says once a part what its law cannot take of an initial stress. @return whether it takes the stress.
class PreloadCheck {
 public:
  explicit PreloadCheck(const Model& model) : told_(model.parts.size(), 0) {}
  bool takes(const Model& model, PartIndex part, const Law& law, const InitialStress& given, Diagnostics& diagnostics);

 private:
  std::vector<char> told_;
};

/// At the place t through the thickness and the point `plane` of `planes` in the plane of a shell: on straight lines between the places that
/// are given, beyond the outermost ones the stress on the line of the last two and the plastic strain of the last one. One point in the
/// plane serves all four, of four the one point takes the mean; four and four are in one order,
/// (-,-), (+,-), (+,+), (-,+).
PointPreload shell_preload(const InitialStress& given, double t, int plane, int planes);

/// At point `point` of `points` of a solid, in Kardan's order (bits of the natural coordinates r, s, t); eight given points stand in the order of
/// the nodes.
PointPreload solid_preload(const InitialStress& given, std::size_t point, std::size_t points);

/// The stress in axes with the unit vectors `axes` (columns).
StressVector in_axes(const StressVector& global, const Mat3& axes);

/// The law's values of a point, block_lanes apart, after this plastic strain.
void preload_history(const Law& law, double plastic_strain, double* values);

/// Elastic energy per volume of a stress, ((1 + nu) s:s - nu (tr s)^2)/(2 E), transverse shears yz and zx of shells with `shear_factor` mu in
/// place of mu.
double elastic_energy(const Law& law, const StressVector& s, double shear_factor = 1);

}  // namespace kardan
