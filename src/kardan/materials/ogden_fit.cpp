// Constants of Ogden's energy from a test.
#include <algorithm>
#include <cmath>
#include <limits>

#include "kardan/materials/rubber_data.hpp"

namespace kardan {

namespace {

constexpr double largest_power = 20;

/// Nominal stress of a term with mu = 1 and its derivative by alpha (Ogden 1972): l^(alpha - 1) - l^(-s alpha - 1), s = 1/2 for a pull, 2 for two,
/// 1 for pure shear.
struct TermStress {
  double value = 0, slope = 0;
};
TermStress stress_of(RubberTest test, double l, double alpha) {
  const double s = test == RubberTest::uniaxial ? 0.5 : test == RubberTest::biaxial ? 2.0 : 1.0;
  const double along = std::pow(l, alpha - 1), across = std::pow(l, -s * alpha - 1), log = std::log(l);
  return {along - across, log * (along + s * across)};
}

double square_error(RubberTest test, const TestPoints& points, const std::vector<OgdenTerm>& terms) {
  double sum = 0;
  for (std::size_t i = 0; i < points.stretch.size(); ++i) {
    double rest = points.stress[i];
    for (const OgdenTerm& t : terms) rest -= t.mu * stress_of(test, points.stretch[i], t.alpha).value;
    sum += rest * rest;
  }
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

/// A start with these powers: equal terms of the size that fits best; empty where none does.
std::vector<OgdenTerm> start_of(RubberTest test, const TestPoints& points, const std::vector<double>& powers) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < points.stretch.size(); ++i) {
    double together = 0;
    for (const double alpha : powers) together += std::copysign(1.0, alpha) * stress_of(test, points.stretch[i], alpha).value;
    product += together * points.stress[i];
    square += together * together;
  }
  if (!(product > 0)) return {};
  std::vector<OgdenTerm> terms;
  for (const double alpha : powers) terms.push_back({std::copysign(product / square, alpha), alpha});
  return terms;
}

/// One step of Levenberg's and Marquardt's method with the damping `damping`; empty where it leaves the range of the constants.
std::vector<OgdenTerm> stepped(RubberTest test, const TestPoints& points, const std::vector<OgdenTerm>& terms, double damping) {
  const std::size_t n = 2 * terms.size();
  std::vector<std::vector<double>> columns(n);
  std::vector<double> right;
  for (std::size_t i = 0; i < points.stretch.size(); ++i) {
    double rest = points.stress[i];
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const TermStress s = stress_of(test, points.stretch[i], terms[k].alpha);
      columns[2 * k].push_back(s.value);
      columns[2 * k + 1].push_back(terms[k].mu * s.slope);
      rest -= terms[k].mu * s.value;
    }
    right.push_back(rest);
  }
  for (std::size_t k = 0; k < n; ++k) {  // rows of the damping, in the scale of each column
    double square = 0;
    for (const double c : columns[k]) square += c * c;
    for (std::size_t j = 0; j < n; ++j) columns[j].push_back(j == k ? std::sqrt(damping * square) : 0.0);
    right.push_back(0);
  }
  const std::vector<double> change = least_squares(std::move(columns), std::move(right));
  if (change.empty()) return {};
  std::vector<OgdenTerm> moved = terms;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    moved[k].mu += change[2 * k];
    moved[k].alpha += change[2 * k + 1];
    if (!(moved[k].mu * moved[k].alpha > 0) || std::abs(moved[k].alpha) > largest_power) return {};
  }
  return moved;
}

void refine(RubberTest test, const TestPoints& points, std::vector<OgdenTerm>& terms) {
  double error = square_error(test, points, terms), damping = 1e-3;
  for (int i = 0; i < 150 && damping < 1e9; ++i) {
    const std::vector<OgdenTerm> moved = stepped(test, points, terms, damping);
    const double now = moved.empty() ? std::numeric_limits<double>::infinity() : square_error(test, points, moved);
    if (now < error) {
      const bool done = now > error * (1 - 1e-14);
      terms = moved;
      error = now;
      damping = std::max(0.2 * damping, 1e-15);
      if (done) return;
    } else {
      damping *= 5;
    }
  }
}

}  // namespace

std::vector<OgdenTerm> fit_ogden(LawFields& fields, const char* lcid, RubberTest test, std::size_t count) {
  const TestPoints points = test_points(fields, lcid);
  if (points.stretch.empty()) return {};
  static constexpr double powers[] = {-8, -4, -2, -1, 1, 2, 4, 8};
  std::vector<OgdenTerm> terms;
  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned set = 1; set < 256 && points.stretch.size() >= 2 * count; ++set) {  // every choice of `count` powers is a start
    std::vector<double> chosen;
    for (unsigned k = 0; k < 8; ++k) {
      if (set >> k & 1U) chosen.push_back(powers[k]);
    }
    if (chosen.size() != count) continue;
    std::vector<OgdenTerm> found = start_of(test, points, chosen);
    if (found.empty()) continue;
    refine(test, points, found);
    if (const double error = square_error(test, points, found); error < smallest) smallest = error, terms = found;
  }
  if (!fields.need(terms.size() == count, "has a test curve that does not determine its constants", "give more points, or a smaller N")) return {};
  return terms;
}

}  // namespace kardan
