#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "kardan/base/vec3.hpp"
#include "kardan/materials/laws/blatz_ko.hpp"
#include "kardan/materials/laws/frazer_nash.hpp"
#include "kardan/materials/laws/hyperelastic_rubber.hpp"
#include "kardan/materials/laws/mooney_rivlin.hpp"
#include "kardan/materials/laws/ogden.hpp"
#include "kardan/materials/plane_stress_of.hpp"
#include "kardan/materials/rubber_data.hpp"
#include "materials/law_probe.hpp"

namespace kardan {
namespace {

using test::expect_lanes_independent;
using test::lane;
using test::LawProbe;
using test::Pack;
using test::Tensor;

// The constants of tests/oracles/rubbers.py.
BlatzKo blatz_ko() { return {1.3}; }
MooneyRivlin mooney_rivlin() { return MooneyRivlin::from(0.8, 0.25, 0.49); }
HyperelasticRubber hyperelastic() {
  HyperelasticRubber law;
  law.c10 = 0.5, law.c01 = 0.2, law.c11 = 0.03, law.c20 = -0.02, law.c02 = 0.01, law.c30 = 0.004;
  law.bulk = bulk_modulus(1.4, 0.48);
  return law;
}
FrazerNash frazer_nash() {
  FrazerNash law{1.1, 0.05, -0.03, 0.01, 0.04, -0.02, -0.3, 0.06, 0};
  law.bulk = bulk_modulus(law.shear(), 0.48);
  return law;
}
Ogden ogden() {
  Ogden law;
  law.terms = 3;
  const double mu[] = {0.63, 0.0012, -0.01}, alpha[] = {1.3, 5.0, -2.0};
  for (std::size_t i = 0; i < 3; ++i) law.mu[i] = mu[i], law.alpha[i] = alpha[i];
  law.bulk = bulk_modulus(law.elastic_shear(), 0.48);
  return law;
}

Mat3 full(const Tensor& s) { return {{{{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}}}}; }
Tensor symmetric(const Mat3& m) { return {m[0].x, m[1].y, m[2].z, m[0].y, m[1].z, m[2].x}; }
double size(const Tensor& s) { return std::sqrt(contraction(s, s)); }
Tensor difference(const Tensor& a, const Tensor& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.zx - b.zx};
}

/// The strain increment of a straight step from U0 to U1 along one set of axes: 2 (U1 - U0)(U1 + U0)^-1.
Tensor increment(const Mat3& from, const Mat3& to) { return symmetric((to - from) * inverse(to + from) * 2.0); }

struct Row {
  Tensor stretch, stress;
  double stiffness;
};
std::map<std::string, std::vector<Row>> oracle() {
  std::ifstream file(std::string(KARDAN_SOURCE_DIR) + "/tests/oracles/rubbers.csv");
  std::map<std::string, std::vector<Row>> rows;
  std::string line, name, cell;
  while (std::getline(file, line)) {
    std::istringstream in(line);
    std::getline(in, name, ',');
    double x[13];
    for (double& v : x) {
      std::getline(in, cell, ',');
      v = std::stod(cell);
    }
    rows[name].push_back({{x[0], x[1], x[2], x[3], x[4], x[5]}, {x[6], x[7], x[8], x[9], x[10], x[11]}, x[12]});
  }
  return rows;
}

/// One straight step to a large stretch is exact, so the stress is that of the energy; and the stiffness is never below the energy's.
template <class Law>
void expect_oracle(const Law& law, const char* name) {
  const std::vector<Row> rows = oracle()[name];
  ASSERT_GE(rows.size(), 17u);
  double worst = 0, largest = 0;
  for (const Row& row : rows) {
    LawProbe<Law> point(law);
    const Mat3 u = full(row.stretch);
    const Tensor s = point.step(increment(Mat3::identity(), u), determinant(row.stretch));
    worst = std::max(worst, size(difference(s, row.stress)) / (law.shear() + size(row.stress)));
    EXPECT_GE(point.modulus(), row.stiffness * (1 - 1e-7));
    largest = std::max(largest, point.modulus() / row.stiffness);
    // The same by the determinant alone, as shells do it.
    LawProbe<Law> shell(law);
    const Tensor t = shell.step(increment(Mat3::identity(), u), 0);
    worst = std::max(worst, size(difference(t, s)) / (law.shear() + size(s)));
  }
  EXPECT_LT(worst, 1e-9) << name;
  EXPECT_LT(largest, 2.0) << name;
  LawProbe<Law> rest(law);
  rest.step({}, 1);
  EXPECT_LT(size(rest.stress()), 1e-13 * law.longitudinal());
  EXPECT_NEAR(rows[0].stiffness, law.longitudinal(), 1e-6 * law.longitudinal());  // not stretched
  EXPECT_GE(rest.modulus(), law.longitudinal() * (1 - 1e-12));
}

TEST(Rubber, StressAndStiffnessAreThoseOfTheEnergy) {
  expect_oracle(blatz_ko(), "blatz_ko");
  expect_oracle(mooney_rivlin(), "mooney_rivlin");
  expect_oracle(hyperelastic(), "hyperelastic");
  expect_oracle(ogden(), "ogden");
  expect_oracle(frazer_nash(), "frazer_nash");
}

/// Uniaxial stretch to 2, equibiaxial to 1.6, and back, in any number of steps: the same stress, and the work of a closed loop vanishes
/// with the square of the step.
template <class Law>
double work_of_loop(const Law& law, int steps) {
  LawProbe<Law> point(law);
  double work = 0, peak = 0;
  Mat3 before = Mat3::identity();
  for (int i = 1; i <= steps; ++i) {
    const double s = 0.5 - 0.5 * std::cos(2 * 3.14159265358979323846 * i / steps);
    const double turn = std::sin(2 * 3.14159265358979323846 * i / steps);  // a loop, not a line there and back
    Mat3 u = Mat3::identity();
    u[0].x = 1 + s;
    u[1].y = 1 / std::sqrt(1 + s) * (1 + 0.3 * turn);
    u[2].z = 1 / std::sqrt(1 + s) / (1 + 0.3 * turn);
    const Tensor d = increment(before, u), old = point.stress();
    const double volume = determinant(symmetric(u)), mean_volume = determinant(symmetric((u + before) * 0.5));
    const Tensor now = point.step(d, volume);
    work += 0.5 * mean_volume * (contraction(old, d) + contraction(now, d));
    peak = std::max(peak, work);
    before = u;
  }
  EXPECT_LT(size(point.stress()), 1e-10 * law.longitudinal());
  return std::abs(work) / peak;
}

TEST(Rubber, EnergyOfAClosedLoopVanishesWithTheSquareOfTheStep) {
  const auto check = [](const auto& law) {
    const double coarse = work_of_loop(law, 200), fine = work_of_loop(law, 400);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_LT(fine, coarse / 3.8 + 1e-13);
  };
  check(blatz_ko());
  check(mooney_rivlin());
  check(hyperelastic());
  check(ogden());
  check(frazer_nash());
}

/// Incompressible uniaxial tension in plane stress with a free side (Treloar 1944): sigma = 2 (l^2 - 1/l) (A + B/l).
TEST(Rubber, StripOfShellFollowsMooneysLaw) {
  const double nu = 0.49999, a = 0.8, b = 0.25;
  const PlaneStressOf<MooneyRivlin> law{MooneyRivlin::from(a, b, nu), 1.0};
  alignas(64) double values[MooneyRivlin::history * block_lanes] = {};
  for (std::size_t k = 0; k < 3; ++k) std::fill_n(values + k * block_lanes, block_lanes, 1.0);
  PlaneStress<Pack> stress;
  double l = 1, w = 1, thickness = 1;
  for (int i = 0; i < 100; ++i) {
    const double next = l + 0.01;
    double width = w / std::sqrt(next / l);
    ShellPoint<Pack> p;
    alignas(64) double trial[MooneyRivlin::history * block_lanes];
    for (int k = 0; k < 40; ++k) {  // the width that leaves its side free
      std::copy(std::begin(values), std::end(values), trial);
      p = {};
      p.stress = stress;
      p.strain.xx = Pack(2 * (next - l) / (next + l));
      p.strain.yy = Pack(2 * (width - w) / (width + w));
      law.update(p, StepTime{1e-3, 0}, trial);
      const double rest = lane(p.stress.yy);
      if (std::abs(rest) < 1e-13) break;
      width -= rest / (8 * (a + b)) * w;
    }
    std::copy(std::begin(trial), std::end(trial), values);
    stress = p.stress;
    thickness *= (1 + 0.5 * lane(p.thickness_strain)) / (1 - 0.5 * lane(p.thickness_strain));
    l = next, w = width;
    const double expected = 2 * (l * l - 1 / l) * (a + b / l);
    ASSERT_NEAR(lane(stress.xx), expected, 1e-4 * expected) << l;
    ASSERT_NEAR(thickness, 1 / std::sqrt(l), 1e-4);
  }
}

/// A sudden small shear, held: 2 e [C10 + C01 …] + 2 e sum G_i exp(-beta_i t), in steps of any size.
TEST(Rubber, PronySeriesRelaxesExactly) {
  for (const int steps : {1, 7, 100}) {
    Ogden law = ogden();
    law.prony.terms = 2;
    law.prony.shear[0] = 0.9, law.prony.beta[0] = 3;
    law.prony.shear[1] = 0.4, law.prony.beta[1] = 0;
    LawProbe<Ogden> point(law);
    const double e = 1e-6, ramp = 1e-9;
    point.step({0, 0, 0, e, 0, 0}, 1, ramp);
    EXPECT_NEAR(point.stress().xy, 2 * e * law.shear(), 1e-7 * e);
    for (int i = 0; i < steps; ++i) point.step({}, 1, 0.8 / steps);
    const double expected = 2 * e * (law.elastic_shear() + 0.9 * std::exp(-3 * 0.8) + 0.4);
    EXPECT_NEAR(point.stress().xy, expected, 1e-7 * e) << steps;
  }
}

/// A constant rate: s = 2 rate G (1 - exp(-beta t))/beta, exact for every step size.
TEST(Rubber, MaxwellElementIsExactForAConstantRate) {
  for (const double beta : {1e-9, 0.4, 0.5, 40.0, 4e4}) {
    SymmetricTensor<Pack> h{};
    SymmetricTensor<Pack> d{};
    d.xy = Pack(0.01);
    for (int i = 0; i < 10; ++i) h = relaxed(h, d, 1.7, beta, 1.0);
    const double expected = 2 * 0.01 * 1.7 * -std::expm1(-10 * beta) / beta;
    EXPECT_NEAR(lane(h.xy), expected, 2e-14 * expected) << beta;
  }
}

TEST(Rubber, LanesAreIndependent) {
  expect_lanes_independent(blatz_ko(), 0.01);
  expect_lanes_independent(mooney_rivlin(), 0.002);
  HyperelasticRubber h = hyperelastic();
  h.prony.terms = 2;
  h.prony.shear[0] = h.prony.shear[1] = 0.5;
  h.prony.beta[0] = 10, h.prony.beta[1] = 700;
  expect_lanes_independent(h, 0.002);
  expect_lanes_independent(ogden(), 0.002);
  expect_lanes_independent(frazer_nash(), 0.002);
}

Model fields_model(FieldMaterial m, std::vector<Curve> curves = {}) {
  Model model;
  m.density = 1e-6;
  Material material;
  material.id = 5;
  material.law = std::move(m);
  model.materials.push_back(material);
  model.curves = std::move(curves);
  return model;
}
template <class Law>
std::optional<Law> made(const Model& model, Diagnostics& diagnostics) {
  LawSource source{model, model.materials[0], diagnostics, "material 5", {}};
  return Law::make(source);
}

/// Constants that made the curve come back from it.
TEST(Rubber, ConstantsAreFoundFromTests) {
  Curve curve;
  const double a = 0.3, b = 0.11, length = 25, area = 6 * 2;
  for (int i = -4; i <= 20; ++i) {
    const double l = 1 + 0.1 * i;
    curve.x.push_back((l - 1) * length);
    curve.y.push_back(2 * (a + b / l) * (l - 1 / (l * l)) * area);
  }
  FieldMaterial m;
  m.values = {{"pr", 0.495}, {"sgl", length}, {"sw", 6}, {"st", 2}};
  m.curves = {{"lcid", 0}};
  Diagnostics d;
  const auto mooney = made<MooneyRivlin>(fields_model(m, {curve}), d);
  ASSERT_TRUE(mooney);
  EXPECT_NEAR(mooney->a, a, 1e-12);
  EXPECT_NEAR(mooney->b, b, 1e-12);

  m.curves = {{"lcid1", 0}};
  m.values["n"] = 2;
  const auto h = made<HyperelasticRubber>(fields_model(m, {curve}), d);
  ASSERT_TRUE(h);
  EXPECT_NEAR(h->c10, a, 1e-8);
  EXPECT_NEAR(h->c01, b, 1e-8);
  EXPECT_NEAR(h->c02, 0, 1e-8);

  // The same in invariants of the Green strain: I2 = n/4 - m/2 and I1 = m/2, so a m + b n = (2 a + 4 b) I1 + 4 b I2.
  m.curves = {{"lcid", 0}};
  m.values["c100"] = m.values["c010"] = m.values["c020"] = 1;
  const auto f = made<FrazerNash>(fields_model(m, {curve}), d);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->c100, 2 * a + 4 * b, 1e-8);
  EXPECT_NEAR(f->c010, 4 * b, 1e-8);
  EXPECT_NEAR(f->c020, 0, 1e-8);
  EXPECT_NEAR(f->shear(), 2 * (a + b), 1e-8);
  m.curves = {{"lcid1", 0}};

  // Biaxial tension: nominal stress 2 (l - l^-5)(A + B l^2); pure shear: 2 (l - l^-3)(A + B), which cannot tell A from B.
  m.values["n"] = 1;
  m.values["data"] = 2;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double l = 1 + curve.x[i] / length;
    curve.y[i] = 2 * (l - std::pow(l, -5)) * (a + b * l * l) * area;
  }
  const auto biaxial = made<HyperelasticRubber>(fields_model(m, {curve}), d);
  ASSERT_TRUE(biaxial);
  EXPECT_NEAR(biaxial->c10, a, 1e-12);
  EXPECT_NEAR(biaxial->c01, b, 1e-12);
  m.values["data"] = 3;
  EXPECT_FALSE(made<HyperelasticRubber>(fields_model(m, {curve}), d));
}

/// Nominal stresses of Ogden's energy with two terms (Ogden 1972), mu (l^(a - 1) - l^(-s a - 1)), give the two terms back, whatever the test; with noise
/// the error of the fit is not above that of the terms that made the curve.
TEST(Rubber, OgdensTermsAreFoundFromTests) {
  const double mu[] = {0.62, -0.03}, alpha[] = {1.6, -3.5}, share[] = {0.5, 2.0, 1.0}, length = 25, area = 6 * 2;
  for (const int data : {1, 2, 3}) {
    for (const double noise : {0.0, 0.02}) {
      Curve curve;
      double made_with = 0;
      for (int i = -2; i <= 16; ++i) {
        const double l = 1 + 0.125 * i, s = share[data - 1], wrong = noise * std::sin(7.3 * i * i);
        double p = wrong;
        for (int k = 0; k < 2; ++k) p += mu[k] * (std::pow(l, alpha[k] - 1) - std::pow(l, -s * alpha[k] - 1));
        curve.x.push_back((l - 1) * length);
        curve.y.push_back(p * area);
        made_with += wrong * wrong;
      }
      FieldMaterial m;
      m.values = {{"pr", 0.495}, {"n", 2}, {"data", data}, {"sgl", length}, {"sw", 6}, {"st", 2}};
      m.curves = {{"lcid1", 0}};
      Diagnostics d;
      const auto law = made<Ogden>(fields_model(m, {curve}), d);
      ASSERT_TRUE(law) << data;
      ASSERT_EQ(law->terms, 2u);
      double error = 0;
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const double l = 1 + curve.x[i] / length, s = share[data - 1];
        double rest = curve.y[i] / area;
        for (std::size_t k = 0; k < 2; ++k) rest -= law->mu[k] * (std::pow(l, law->alpha[k] - 1) - std::pow(l, -s * law->alpha[k] - 1));
        error += rest * rest;
      }
      EXPECT_LE(error, made_with + 1e-14) << data << ' ' << noise;
      if (noise > 0 || data == 3) continue;  // in pure shear -mu, -alpha make the same curve
      const std::size_t first = law->alpha[0] > law->alpha[1] ? 0 : 1;
      EXPECT_NEAR(law->mu[first], mu[0], 1e-4) << data;
      EXPECT_NEAR(law->alpha[first], alpha[0], 1e-4) << data;
      EXPECT_NEAR(law->alpha[1 - first], alpha[1], 1e-3) << data;
    }
  }
}

TEST(Rubber, RefusesWhatItDoesNotCompute) {
  const auto count = [](auto make, std::map<std::string, double, std::less<>> values) {
    FieldMaterial m;
    m.values = std::move(values);
    Diagnostics d;
    const Model model = fields_model(m);
    const bool accepted = make(model, d);
    EXPECT_EQ(accepted, d.error_count() == 0);
    return d.error_count();
  };
  const auto og = [](const Model& m, Diagnostics& d) { return made<Ogden>(m, d).has_value(); };
  const auto hy = [](const Model& m, Diagnostics& d) { return made<HyperelasticRubber>(m, d).has_value(); };
  const auto mo = [](const Model& m, Diagnostics& d) { return made<MooneyRivlin>(m, d).has_value(); };
  const auto bl = [](const Model& m, Diagnostics& d) { return made<BlatzKo>(m, d).has_value(); };
  EXPECT_EQ(count(og, {{"pr", 0.495}, {"mu1", 1}, {"alpha1", 2}}), 0u);
  EXPECT_EQ(count(og, {{"pr", 0.495}, {"mu1", 1}, {"alpha1", -2}}), 1u);
  EXPECT_EQ(count(og, {{"pr", 0.495}, {"n", 2}}), 1u);  // no test
  EXPECT_EQ(count(og, {{"pr", 0.495}, {"n", 9}}), 1u);
  EXPECT_EQ(count(og, {{"pr", -0.495}, {"mu1", 1}, {"alpha1", 2}}), 1u);
  EXPECT_EQ(count(og, {{"pr", 0.495}, {"g", 0.1}, {"mu1", 1}, {"alpha1", 2}}), 1u);
  EXPECT_EQ(count(og, {{"pr", 0.495}, {"mu1", 1}, {"alpha1", 2}, {"g1", 1}, {"beta1", -1}}), 1u);
  EXPECT_EQ(count(hy, {{"pr", 0.495}, {"c10", 1}}), 0u);
  EXPECT_EQ(count(hy, {{"pr", 0.495}, {"c10", 1}, {"therml", 1}}), 1u);
  EXPECT_EQ(count(hy, {{"pr", 0.495}, {"c10", -1}}), 1u);
  EXPECT_EQ(count(mo, {{"pr", 0.5}, {"a", 1}, {"b", 0}}), 1u);
  EXPECT_EQ(count(mo, {{"pr", 0.49}}), 1u);
  EXPECT_EQ(count(bl, {{"g", 0}}), 1u);
  const auto fr = [](const Model& m, Diagnostics& d) { return made<FrazerNash>(m, d).has_value(); };
  EXPECT_EQ(count(fr, {{"pr", 0.495}, {"c100", 1}}), 0u);
  EXPECT_EQ(count(fr, {{"pr", 0.495}, {"c100", 1}, {"c010", 3}}), 1u);
  EXPECT_EQ(count(fr, {{"pr", 0.5}, {"c100", 1}}), 1u);
}

}  // namespace
}  // namespace kardan
