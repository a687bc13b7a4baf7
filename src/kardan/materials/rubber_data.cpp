#include "kardan/materials/rubber_data.hpp"

#include <cmath>

namespace kardan {

namespace {

struct Invariant {
  double value = 0, slope = 0;  ///< of the stretch
};
struct Invariants {
  Invariant first, second;
  double faces = 1;  ///< nominal stresses that do the work dW
};

/// J1 - 3 and J2 - 3 of an incompressible specimen stretched by l (Treloar 1944, Trans. Faraday Soc. 40, 59-70).
Invariants invariants_of(RubberTest test, double l) {
  const double i2 = 1 / (l * l);
  switch (test) {
    case RubberTest::biaxial:
      return {{2 * l * l + i2 * i2 - 3, 4 * l - 4 * i2 * i2 / l}, {l * l * l * l + 2 * i2 - 3, 4 * l * l * l - 4 * i2 / l}, 2};
    case RubberTest::pure_shear:
      return {{l * l + i2 - 2, 2 * l - 2 * i2 / l}, {l * l + i2 - 2, 2 * l - 2 * i2 / l}, 1};
    case RubberTest::uniaxial: break;
  }
  return {{l * l + 2 / l - 3, 2 * l - 2 * i2}, {2 * l + i2 - 3, 2 - 2 * i2 / l}, 1};
}

Invariants of_green_strain(const Invariants& of_stretch) {
  const Invariant &m = of_stretch.first, &n = of_stretch.second;
  return {{0.5 * m.value, 0.5 * m.slope}, {0.25 * n.value - 0.5 * m.value, 0.25 * n.slope - 0.5 * m.slope}, of_stretch.faces};
}

double derivative(const Monomial& m, const Invariants& i) {
  double d = 0;
  if (m.p > 0) d += m.p * std::pow(i.first.value, m.p - 1) * std::pow(i.second.value, m.q) * i.first.slope;
  if (m.q > 0) d += m.q * std::pow(i.first.value, m.p) * std::pow(i.second.value, m.q - 1) * i.second.slope;
  return d / i.faces;
}

}  // namespace

std::vector<double> least_squares(std::vector<std::vector<double>> columns, std::vector<double> right) {
  const std::size_t n = columns.size(), rows = right.size();
  std::vector<std::vector<double>> r(n, std::vector<double>(n, 0.0));
  std::vector<double> projected(n, 0.0);
  const auto dot = [rows](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < rows; ++i) sum += a[i] * b[i];
    return sum;
  };
  for (std::size_t k = 0; k < n; ++k) {
    const double before = std::sqrt(dot(columns[k], columns[k]));
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t j = 0; j < k; ++j) {
        const double c = dot(columns[j], columns[k]);
        r[j][k] += c;
        for (std::size_t i = 0; i < rows; ++i) columns[k][i] -= c * columns[j][i];
      }
    }
    r[k][k] = std::sqrt(dot(columns[k], columns[k]));
    if (!(r[k][k] > 1e-8 * before)) return {};
    for (double& c : columns[k]) c /= r[k][k];
    projected[k] = dot(columns[k], right);
    for (std::size_t i = 0; i < rows; ++i) right[i] -= projected[k] * columns[k][i];
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) projected[k] -= r[k][j] * projected[j];
    projected[k] /= r[k][k];
  }
  return projected;
}

PronySeries prony_series(LawFields& fields) {
  PronySeries series;
  for (std::size_t i = 1;; ++i) {
    const std::string number = std::to_string(i), g = "g" + number;
    if (!fields.fields().values.contains(g)) return series;
    if (fields[g] == 0) continue;
    const double beta = fields["beta" + number];
    fields.need(fields[g] > 0 && beta >= 0, "has a Prony term " + number + " with a negative G or BETA", "give G > 0 and BETA >= 0");
    if (!fields.need(series.terms < PronySeries::most, "has more than 12 Prony terms", "give at most 12")) return series;
    series.shear[series.terms] = fields[g];
    series.beta[series.terms++] = beta;
  }
}

void check_rubber(LawFields& fields) {
  const double nu = fields["pr"];
  fields.need(nu > 0 && nu < 0.5, "has a Poisson's ratio that is not between 0 and 0.5", "give 0 < PR < 0.5, 0.49 and more for rubber");
  fields.refuse("g", "frequency independent damping (G, SIGF)", "set G = 0, or use Prony terms");
}

TestPoints test_points(LawFields& fields, const char* lcid) {
  const double length = fields["sgl"], area = fields["sw"] * fields["st"];
  const Curve* curve = fields.curve(lcid);
  TestPoints points;
  if (!fields.need(curve && length > 0 && area > 0, "has neither constants nor a test to fit them to",
                   "give the constants, or SGL, SW, ST > 0 and the curve of the test")) {
    return {};
  }
  for (std::size_t i = 0; i < curve->x.size(); ++i) {
    points.stretch.push_back(1 + curve->x[i] / length);
    points.stress.push_back(curve->y[i] / area);
    if (!fields.need(points.stretch.back() > 0, "has a test curve that makes the specimen shorter than nothing", "correct SGL or the curve")) return {};
  }
  return points;
}

std::vector<double> fit_invariants(LawFields& fields, const char* lcid, const RubberFit& fit, const std::vector<Monomial>& terms) {
  const TestPoints points = test_points(fields, lcid);
  if (points.stretch.empty()) return {};
  std::vector<std::vector<double>> columns(terms.size());
  for (const double stretch : points.stretch) {
    Invariants now = invariants_of(fit.test, stretch);
    if (fit.invariants == RubberInvariants::green_strain) now = of_green_strain(now);
    for (std::size_t k = 0; k < terms.size(); ++k) columns[k].push_back(derivative(terms[k], now));
  }
  const std::vector<double>& right = points.stress;
  std::vector<double> constants = right.size() < terms.size() ? std::vector<double>{} : least_squares(columns, right);
  fields.need(!constants.empty(), "has a test curve that does not determine its constants", "give more points, or a smaller N");
  return constants;
}

}  // namespace kardan
