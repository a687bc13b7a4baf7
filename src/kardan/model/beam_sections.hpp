// Cross sections of beams: the section's sizes, or the element's own.
#pragma once

#include "kardan/model/model.hpp"

namespace kardan {

/// Formulations of *SECTION_BEAM (ELFORM).
namespace beam_elform {
inline constexpr int hughes_liu = 1, belytschko_schwer = 2, truss = 3, discrete = 6, spot_weld = 9;
}

/// LS-DYNA's number of *MAT_SPOTWELD, the material of ELFORM 9.
inline constexpr int spot_weld_material = 100;

/// Section of a beam with the sizes of *ELEMENT_BEAM_THICKNESS where it has some; the part has a section of beams.
BeamSection beam_section(const Model& model, Index beam);

/// Area of the cross section [length^2]: the mean of both ends for the sections given by sizes (ELFORM 1, 4, 5, 9 with CST 0
/// rectangular and 1 tubular), else A of the section.
double beam_area(const BeamSection& section);

/// Second moments of area [length^4] about s and t, of the mean sizes where the section is given by sizes.
struct BeamMoments {
  double ss = 0, tt = 0;
};
BeamMoments beam_moments(const BeamSection& section);

/// Volume [length^3]: VOL of discrete beams (of cables without VOL, their area times the length), else area times length.
double beam_volume(const BeamSection& section, double length);

}  // namespace kardan
