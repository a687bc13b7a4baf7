// Laws of material as the elements see them: constants made from the model, and plain function pointers for the instruction set of
// the run. The mathematics is in one header a law; the row that gives it to a keyword is in law_table.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/materials/law_entry.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

enum class LawUse { solid, shell, beam };

/// Laws that element kernels are compiled for; all others are called through Law::update.
enum class InlinedLaw { no, elastic, piecewise_plastic };

/// A material made ready for the elements of a part.
struct Law {
  std::shared_ptr<const void> constants;  ///< of the type that `update` knows
  PointUpdate update = nullptr;
  InlinedLaw inlined = InlinedLaw::no;
  std::vector<double> start;              ///< history of a point at the start; its size is the law's history
  std::size_t tensors = 0;                ///< symmetric tensors that the history begins with
  double density = 0;
  double longitudinal = 0, shear = 0;     ///< lambda + 2 mu and mu at the start
  double youngs_modulus = 0, poissons_ratio = 0;  ///< of the same two
  bool can_fail = false;
  ElementDeletion deletion;               ///< where it can
  /// Place of the effective plastic strain in the history, for output; npos if the law has none.
  std::size_t plastic_strain = npos;
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

  /// Gives the values of a point what an effective plastic strain before t = 0 means for them, whatever stress comes with it; empty where
  /// the stress follows from the values alone.
  std::function<void(double strain, double* values)> preload;
  bool remembers = false;                 ///< more than stress and plastic strain tell: back stress, temperature, damage

  /// Place of the factor beta of stiffness damping in the history (stiffness_damping.hpp), one value of each point; npos: none.
  std::size_t damping = npos;

  std::size_t history() const { return start.size(); }
};

/// What a law is made from.
struct LawSource {
  const Model& model;
  const Material& material;
  Diagnostics& diagnostics;
  std::string name;                                      ///< "material 3"
  std::vector<std::shared_ptr<std::vector<double>>> kept; ///< tables that constants point into
  LawUse use = LawUse::solid;
  double density = 0;
  const EquationOfState* eos = nullptr;                  ///< of the part; by equation_of_state()
  bool eos_taken = false;

  /// What EOSID of *PART names, null where it names nothing.
  const EquationOfState* equation_of_state() {
    eos_taken = true;
    return eos;
  }

  /// Keeps a table as long as the law.
  const std::vector<double>& keep(std::vector<double> table) {
    return *kept.emplace_back(std::make_shared<std::vector<double>>(std::move(table)));
  }
};

/// A law whose points also fail by criteria of stress, strain and time (erosion.hpp).
Law with_erosion(Law law, const ErosionCriteria& criteria, LawUse use);

/// A law with the stress of stiffness damping on top (stiffness_damping.hpp). @param shear_factor of shells
Law with_stiffness_damping(Law law, LawUse use, double shear_factor);

/// Density and Young's modulus positive, -1 < nu < 0.5; complains otherwise.
bool check_elastic_constants(LawSource& source, double density, double youngs_modulus, double poissons_ratio);

/// The law of a part's material for solids, shells (`shear_factor`: their SHRF) or beams. Without a value the diagnostics say why:
/// a law that this version does not have for these elements, or parameters it cannot be computed with.
std::optional<Law> make_law(const Model& model, const Part& part, LawUse use, double shear_factor, Diagnostics& diagnostics);

}  // namespace kardan
