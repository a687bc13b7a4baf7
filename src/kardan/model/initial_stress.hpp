// Stresses at t = 0.
#pragma once

#include <array>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/model/entities.hpp"

namespace kardan {

/// *INITIAL_STRESS_SHELL, _SOLID, _BEAM (and _SET): what the points of some elements begin with. A later entry replaces an earlier one.
struct InitialStress {
  struct Point {
    double t = 0;                     ///< shells: place through the thickness, -1 inside to 1 outside
    std::array<double, 6> stress{};   ///< xx, yy, zz, xy, yz, zx in global axes (`local`: in the element's)
    double plastic_strain = 0;
  };

  ElementKind kind = ElementKind::shell;
  std::vector<Index> elements;
  int planes = 1;                     ///< shells: points in the plane, 1 or 4
  std::vector<Point> points;          ///< as many as the element has, or one for all; shells: `planes` with each t
  std::vector<double> resultants;     ///< beams without points: axial force, torsion, moments at node 1 about s, t and at node 2
  bool local = false;
  bool histories = false;             ///< history variables that are not zero came with it
};

}  // namespace kardan
