// Points of a law brought along the strain paths of an oracle's CSV, beside lanes that go another way.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/law.hpp"
#include "kardan/materials/shell_law.hpp"

namespace kardan::law_paths {

using KARDAN_ISA_NAMESPACE::Pack;
using Six = std::array<double, 6>;  ///< xx, yy, zz, xy, yz, zx; shear strains are engineering strains

/// What a point answers.
struct Answer {
  Six stress{};
  double thickness_strain = 0;
  bool failed = false;
};

/// One point in lane 0 of a pack; the other lanes are stretched by `others`.
class Point {
 public:
  virtual ~Point() = default;
  virtual Answer step(const Six& strain, double dt, double others) = 0;
  double value(std::size_t i) const { return values_[i * block_lanes]; }
  double plastic_strain() const { return value(plastic_place_); }
  const Answer& last() const { return last_; }

 protected:
  void start(std::size_t history, std::size_t plastic_place, const std::function<void(double*)>& fill) {
    std::vector<double> begin(history);
    fill(begin.data());
    values_.resize(history * block_lanes);
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = begin[i / block_lanes];
    plastic_place_ = plastic_place;
  }
  static Pack lanes(double first, double others) {
    Pack p(others);
    p.v[0] = first;
    return p;
  }
  std::vector<double> values_;
  std::size_t plastic_place_ = 0;
  Answer last_;
};

template <class Law>
class SolidPoint : public Point {
 public:
  explicit SolidPoint(const Law& law) : law_(law) {
    start(Law::history, Law::plastic_strain, [&](double* v) { law_.start(v); });
  }
  Answer step(const Six& d, double dt, double others) override {
    MaterialPoint<Pack> p;
    p.stress = stress_;
    p.strain = {lanes(d[0], others), lanes(d[1], -0.4 * others), lanes(d[2], 0.1 * others),
                lanes(0.5 * d[3], others), lanes(0.5 * d[4], 0), lanes(0.5 * d[5], 0)};
    p.modulus = Pack(law_.longitudinal());
    law_.update(p, StepTime{dt, time_ += dt}, values_.data());
    stress_ = p.stress;
    const auto& s = stress_;
    return last_ = {{s.xx.v[0], s.yy.v[0], s.zz.v[0], s.xy.v[0], s.yz.v[0], s.zx.v[0]}, d[2], p.failed.v[0] > 0.5};
  }

 private:
  Law law_;
  SymmetricTensor<Pack> stress_;
  double time_ = 0;
};

template <class Law>
class ShellPointOf : public Point {
 public:
  explicit ShellPointOf(const Law& law, double shear_factor = 1) : law_(ShellLawOf<Law>::from(law, shear_factor)) {
    start(Law::history, Law::plastic_strain, [&](double* v) { law_.start(v); });
  }
  Answer step(const Six& d, double dt, double others) override {
    ShellPoint<Pack> p;
    p.stress = stress_;
    p.strain = {lanes(d[0], others), lanes(d[1], -0.4 * others), lanes(d[3], others), lanes(d[4], 0), lanes(d[5], 0)};
    law_.update(p, StepTime{dt, time_ += dt}, values_.data());
    stress_ = p.stress;
    const auto& s = stress_;
    return last_ = {{s.xx.v[0], s.yy.v[0], 0, s.xy.v[0], s.yz.v[0], s.zx.v[0]}, p.thickness_strain.v[0], p.failed.v[0] > 0.5};
  }

 private:
  ShellLawOf<Law> law_;
  PlaneStress<Pack> stress_;
  double time_ = 0;
};

/// Makes the point of a row's law for "solid" or "shell".
using Make = std::function<std::unique_ptr<Point>(const std::string& use)>;

template <class Law>
Make points_of(const Law& law) {
  return [law](const std::string& use) -> std::unique_ptr<Point> {
    if (use == "solid") return std::make_unique<SolidPoint<Law>>(law);
    return std::make_unique<ShellPointOf<Law>>(law);
  };
}

/// A law from its parameters as the deck gives them; `kept` holds its tables.
template <class Law, class Parameters>
Law made(const Parameters& parameters, const Model& model, std::vector<std::shared_ptr<std::vector<double>>>& kept) {
  const Material material{7, {}, parameters};
  Diagnostics diagnostics;
  LawSource source{model, material, diagnostics, "material 7", {}};
  const std::optional<Law> law = Law::make(source);
  EXPECT_TRUE(law) << (diagnostics.all().empty() ? "" : diagnostics.all()[0].message);
  kept.insert(kept.end(), source.kept.begin(), source.kept.end());
  return law.value();
}

/// What a law complains about; "" if it does not.
template <class Law, class Parameters>
std::string complaint(const Parameters& parameters, const Model& model) {
  const Material material{7, {}, parameters};
  Diagnostics diagnostics;
  LawSource source{model, material, diagnostics, "material 7", {}};
  const bool made = Law::make(source).has_value();
  EXPECT_EQ(made, diagnostics.error_count() == 0);
  return diagnostics.all().empty() ? std::string() : diagnostics.all()[0].message;
}

/// Follows every path of the CSV (columns as tests/oracles/j2_metals.py writes them); stresses in units of `stress_unit`.
/// `extra`: places in the history of the columns temperature and damage, with their units.
inline void follow(const std::string& file_name, const std::map<std::string, Make>& laws, double dt, double stress_unit, double tolerance,
                   const std::vector<std::pair<std::size_t, double>>& extra = {}) {
  std::ifstream file(std::string(KARDAN_SOURCE_DIR) + "/tests/oracles/" + file_name);
  ASSERT_TRUE(file);
  std::string row, before;
  std::getline(file, row);
  std::map<std::string, double> worst;
  std::unique_ptr<Point> point;
  while (std::getline(file, row)) {
    std::istringstream in(row);
    std::string law, use, path, cell;
    std::getline(in, law, ',');
    std::getline(in, use, ',');
    std::getline(in, path, ',');
    const auto make = laws.find(law);
    if (make == laws.end()) continue;
    if (const std::string now = law + use + path; now != before) {
      point = make->second(use);
      before = now;
    }
    std::array<double, 15> x{};
    for (double& value : x) {
      ASSERT_TRUE(std::getline(in, cell, ','));
      value = std::stod(cell);
    }
    const Answer a = point->step({x[0], x[1], x[2], x[3], x[4], x[5]}, dt, 0.003);
    double& error = worst[law];
    for (std::size_t i = 0; i < 6; ++i) error = std::max(error, std::abs(a.stress[i] - x[6 + i]) / stress_unit);
    error = std::max({error, std::abs(point->plastic_strain() - x[12]), std::abs(a.thickness_strain - x[2])});
    for (std::size_t k = 0; k < extra.size(); ++k) {
      error = std::max(error, std::abs(point->value(extra[k].first) - x[13 + k]) / extra[k].second);
    }
    ASSERT_LT(error, tolerance) << row;
  }
  for (const auto& [law, make] : laws) EXPECT_TRUE(worst.contains(law)) << law << " has no rows";
  for (const auto& [law, error] : worst) ::testing::Test::RecordProperty("worst_" + law, fmt::format("{:.1e}", error));
}

}  // namespace kardan::law_paths
