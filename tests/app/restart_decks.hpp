// Decks that remember much from cycle to cycle.
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

namespace kardan::app {

/// A square tube of shells on a fixed foot, hit by a moving wall of given mass: buckling, self-contact, failure.
/// @param more  further keywords
inline std::string tube_deck(int sides, int rows, const std::string& more) {
  constexpr double size = 5, thickness = 1;
  std::string deck = fmt::format(R"(*KEYWORD
*TITLE
tube
*CONTROL_TERMINATION
1.0
*CONTROL_ENERGY
2,2,2,2
*PART
tube
1,1,1
*SECTION_SHELL
1,2,0.8333,3
{0},{0},{0},{0}
*MAT_PIECEWISE_LINEAR_PLASTICITY
1,7.83E-6,207.0,0.3,0.2,0.4,0.12
0
0
0
*CONTACT_AUTOMATIC_SINGLE_SURFACE
0
0.2,0.1
0
*RIGIDWALL_PLANAR_MOVING
0,0,0
0,0,{1},0,0,0
0.5,20.0
*DATABASE_GLSTAT
0.01
*DATABASE_MATSUM
0.05
*DATABASE_RWFORC
0.02
*DATABASE_SLEOUT
0.05
*DATABASE_BINARY_D3PLOT
0.05
*SET_NODE_LIST_GENERATE
1
1,{2}
*BOUNDARY_SPC_SET
1,0,1,1,1,1,1,1
)", thickness, size * rows + 0.01, 4 * sides);
  deck += "*NODE\n";
  const int around = 4 * sides;
  for (int row = 0; row <= rows; ++row)
    for (int i = 0; i < around; ++i) {
      const int side = i / sides;
      const double s = size * (i % sides), length = size * sides;
      const std::array<std::array<double, 2>, 4> place{{{s, 0}, {length, s}, {length - s, length}, {0, length - s}}};
      const double bulge = row == 2 ? (side % 2 == 0 ? 0.05 : -0.05) : 0;  // where it begins to buckle
      deck += fmt::format("{},{:.6g},{:.6g},{:.6g}\n", row * around + i + 1, place[side][0] + bulge, place[side][1] + bulge, size * row);
    }
  deck += "*ELEMENT_SHELL\n";
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < around; ++i) {
      const int a = row * around + i + 1, b = row * around + (i + 1) % around + 1;
      deck += fmt::format("{},1,{},{},{},{}\n", row * around + i + 1, a, b, b + around, a + around);
    }
  return deck + more + "*END\n";
}

/// A mass on a spring that comes to rest under its load before t = 0, then is struck.
inline const std::string relaxed_spring = R"(*KEYWORD
*CONTROL_TERMINATION
0.5
*CONTROL_TIMESTEP
5e-4
*CONTROL_DYNAMIC_RELAXATION
50,1e-5,0.98,0,0,0,0,1
*PART
spring
1,1,1
*SECTION_DISCRETE
1,0
0,0
*MAT_SPRING_ELASTIC
1,800.0
*NODE
1,0,0,0,7,7
2,1,0,0,5,7
*ELEMENT_MASS
1,2,2.0
*ELEMENT_DISCRETE
1,1,1,2
*DEFINE_CURVE
1,2
0,40
1,40
*LOAD_NODE_POINT
2,1,1
*INITIAL_VELOCITY_NODE
2,0.3,0,0
*DATABASE_NODOUT
0.01
*DATABASE_HISTORY_NODE
2
*DATABASE_DEFORC
0.02
*END
)";

}  // namespace kardan::app
