#include "kardan/model/beam_sections.hpp"

#include <numbers>

namespace kardan {

namespace {

bool given_by_sizes(const BeamSection& s) {
  return (s.elform == beam_elform::hughes_liu || s.elform == 4 || s.elform == 5 || s.elform == beam_elform::spot_weld) && s.cst != 2;
}

/// Size at an end; node 2 has that of node 1 where it is left at 0.
double at_end(const std::array<double, 2>& ends, std::size_t i) { return ends[i] == 0 ? ends[0] : ends[i]; }
double mean(const std::array<double, 2>& ends) { return 0.5 * (ends[0] + at_end(ends, 1)); }

void replace(double& value, double own) {
  if (own != 0) value = own;
}

}  // namespace

BeamSection beam_section(const Model& model, Index beam) {
  const auto e = static_cast<std::size_t>(beam);
  const Part& part = model.parts[static_cast<std::size_t>(model.beams.part[e])];
  BeamSection s = model.sections[static_cast<std::size_t>(part.section)].beam;
  const auto own = model.beams.sizes.find(beam);
  if (own == model.beams.sizes.end()) return s;
  const std::array<double, 5>& p = own->second;
  if (given_by_sizes(s)) {
    replace(s.ts[0], p[0]);
    replace(s.ts[1], p[1]);
    replace(s.tt[0], p[2]);
    replace(s.tt[1], p[3]);
  } else if (s.elform == beam_elform::discrete) {
    replace(s.volume, p[0]);
    replace(s.inertia, p[1]);
    replace(s.cable_area, p[3]);
    replace(s.cable_offset, p[4]);
  } else {
    replace(s.area, p[0]);
    replace(s.iss, p[1]);
    replace(s.itt, p[2]);
    replace(s.j, p[3]);
    if (p[4] != 0) s.shear_s = s.shear_t = p[4];
  }
  return s;
}

double beam_area(const BeamSection& s) {
  if (!given_by_sizes(s)) return s.area;
  const auto end = [&](std::size_t i) {
    const double width = at_end(s.ts, i), height = at_end(s.tt, i);
    return s.cst == 1 ? 0.25 * std::numbers::pi * (width * width - height * height) : width * height;
  };
  return 0.5 * (end(0) + end(1));
}

BeamMoments beam_moments(const BeamSection& s) {
  if (!given_by_sizes(s)) return {s.iss, s.itt};
  const double width = mean(s.ts), height = mean(s.tt), area = beam_area(s);
  if (s.cst == 1) {
    const double i = area * (width * width + height * height) / 16;
    return {i, i};
  }
  return {area * height * height / 12, area * width * width / 12};
}

double beam_volume(const BeamSection& s, double length) {
  if (s.elform != beam_elform::discrete) return beam_area(s) * length;
  return s.volume > 0 ? s.volume : s.cable_area * length;
}

}  // namespace kardan
