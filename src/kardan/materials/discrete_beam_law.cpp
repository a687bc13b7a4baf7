#include "kardan/materials/discrete_beam_law.hpp"

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

constexpr std::array<const char*, 6> linear_stiffness{"tkr", "tks", "tkt", "rkr", "rks", "rkt"};
constexpr std::array<const char*, 6> linear_damping{"tdr", "tds", "tdt", "rdr", "rds", "rdt"};
constexpr std::array<const char*, 6> elastic_curves{"lcidtr", "lcidts", "lcidtt", "lcidrr", "lcidrs", "lcidrt"};
constexpr std::array<const char*, 6> viscous_curves{"lcidtdr", "lcidtds", "lcidtdt", "lcidrdr", "lcidrds", "lcidrdt"};
constexpr std::array<const char*, 6> preloads{"for_", "fos", "fot", "mor", "mos", "mot"};
constexpr std::array<const char*, 6> failure_forces{"ffailr", "ffails", "ffailt", "mfailr", "mfails", "mfailt"};
constexpr std::array<const char*, 6> failure_displacements{"ufailr", "ufails", "ufailt", "tfailr", "tfails", "tfailt"};

double value(const Curve* curve, double x) {
  if (curve == nullptr) return 0.0;
  const bool mirrored = curve->x.front() == 0 && curve->y.front() == 0;
  return mirrored && x < 0 ? -curve->value(-x) : curve->value(x);
}

double steepest(const Curve* curve) {
  double slope = 0;
  if (curve == nullptr) return slope;
  for (std::size_t i = 0; i + 1 < curve->x.size(); ++i) {
    slope = std::max(slope, std::abs((curve->y[i + 1] - curve->y[i]) / (curve->x[i + 1] - curve->x[i])));
  }
  return slope;
}

double square_sum(const std::array<double, 6>& values, const std::array<double, 6>& limits) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    if (limits[i] > 0) sum += values[i] / limits[i] * (values[i] / limits[i]);
  }
  return sum;
}

}  // namespace

std::optional<SixDofLaw> SixDofLaw::make(const Model& model, const FieldMaterial& m, const std::string& name, Diagnostics& diagnostics) {
  SixDofLaw law;
  const bool linear = m.number == 66;
  const auto curve = [&](const char* field) { return m.curve(field) == none ? nullptr : &model.curves[static_cast<std::size_t>(m.curve(field))]; };
  bool good = true;
  for (std::size_t i = 0; i < 6; ++i) {
    law.preload_[i] = m.value(preloads[i]);
    if (linear) {
      law.stiffness_[i] = m.value(linear_stiffness[i]);
      law.damping_[i] = m.value(linear_damping[i]);
      if (law.stiffness_[i] < 0 || law.damping_[i] < 0) {
        diagnostics.error(name + " has a negative stiffness or damping", "give positive numbers", m.keyword);
        good = false;
      }
    } else {
      law.elastic_[i] = curve(elastic_curves[i]);
      law.viscous_[i] = curve(viscous_curves[i]);
      law.failure_force_[i] = m.value(failure_forces[i]);
      law.failure_displacement_[i] = m.value(failure_displacements[i]);
      law.can_fail_ = law.can_fail_ || law.failure_force_[i] > 0 || law.failure_displacement_[i] > 0;
    }
    law.largest_stiffness_[i] = std::max(law.stiffness_[i], steepest(law.elastic_[i]));
    law.largest_damping_[i] = std::max(law.damping_[i], steepest(law.viscous_[i]));
  }
  if (!good) return std::nullopt;
  return law;
}

double SixDofLaw::force(std::size_t i, double u, double rate) const {
  return preload_[i] + stiffness_[i] * u + damping_[i] * rate + value(elastic_[i], u) + value(viscous_[i], rate);
}

bool SixDofLaw::fails(const std::array<double, 6>& force, const std::array<double, 6>& displacement) const {
  return can_fail_ && (square_sum(force, failure_force_) >= 1 || square_sum(displacement, failure_displacement_) >= 1);
}

std::optional<CableLaw> CableLaw::make(const Model& model, const FieldMaterial& m, const std::string& name, Diagnostics& diagnostics) {
  bool good = true;
  const auto refuse = [&](const char* field, const char* what) {
    diagnostics.error(name + ": " + what + " is not available in this version", std::string("leave ") + field + " out", m.keyword);
    good = false;
  };
  if (m.value("tmaxf0") != 0 || m.value("tramp") != 0) refuse("TMAXF0 and TRAMP", "a pretension that is ramped (TMAXF0, TRAMP)");
  if (m.value("iread") != 0) refuse("IREAD and its card", "a start time, a length reached in time or failure (IREAD)");
  CableLaw law;
  law.modulus_ = m.value("e");
  law.preload_ = m.value("f0");
  if (m.curve("lcid") != none) law.curve_ = &model.curves[static_cast<std::size_t>(m.curve("lcid"))];
  law.steepest_ = steepest(law.curve_);
  if (law.curve_ == nullptr && law.modulus_ == 0) {
    diagnostics.error(name + " has neither a modulus nor a curve", "give E or LCID", m.keyword);
    good = false;
  }
  if (!good) return std::nullopt;
  return law;
}

double CableLaw::force(double length, double free_length, double area) const {
  const double stretch = length - free_length;
  if (curve_ != nullptr) return std::max(0.0, preload_ + area * curve_->value(stretch / free_length));
  return std::max(0.0, preload_ + stiffness(free_length, area) * stretch);
}

double CableLaw::stiffness(double free_length, double area) const {
  if (curve_ != nullptr) return area * steepest_ / free_length;
  return modulus_ < 0 ? -modulus_ : modulus_ * area / free_length;
}

}  // namespace kardan
