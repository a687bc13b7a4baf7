// *DAMPING.
#include <algorithm>

#include "kardan/io/deck/build/builder.hpp"

namespace kardan::deck {

namespace {

/// STX … SRZ; all zero means all one.
void read_factors(const Card& card, DampingLaw& law) {
  constexpr std::array<const char*, 6> fields{"stx", "sty", "stz", "srx", "sry", "srz"};
  std::array<double, 6> factor{};
  for (std::size_t i = 0; i < 6; ++i) {
    factor[i] = card.real(fields[i]);
    if (factor[i] < 0) card.error(fields[i], "is negative: the model would gain energy", "give a factor of 0 or more");
  }
  if (std::all_of(factor.begin(), factor.end(), [](double f) { return f == 0; })) return;
  law.translation = {factor[0], factor[1], factor[2]};
  law.rotation = {factor[3], factor[4], factor[5]};
}

/// Another *DAMPING_GLOBAL, or one beside *DAMPING_PART_MASS.
void refuse_second_global(Builder& b, const Block& block, bool global) {
  const bool clash = std::any_of(b.model.dampings.begin(), b.model.dampings.end(), [&](const DampingLaw& law) {
    return law.relative_to == none && (global || law.parts.empty());
  });
  if (clash) block.error("*DAMPING_GLOBAL cannot be combined with *DAMPING_PART_MASS or be given twice", "keep one of them");
}

}  // namespace

void build_damping_global(Builder& b, Block& block) {
  refuse_second_global(b, block, true);
  const Card card = block.next("card0");
  DampingLaw law;
  law.curve = b.optional_curve(card, "lcid");
  if (law.curve == none) law.value = card.real("valdmp", dimension::angular_velocity);
  if (law.value < 0) card.error("valdmp", "is negative: the model would gain energy", "give a constant of 0 or more");
  read_factors(card, law);
  b.model.dampings.push_back(std::move(law));
}

void build_damping_part(Builder& b, Block& block) {
  const bool set = block.keyword.ends_with("_SET");
  refuse_second_global(b, block, false);
  while (!block.at_end()) {
    const Card card = block.next("card0");
    DampingLaw law;
    if (set) {
      law.parts = b.part_set(card, "psid");
    } else {
      b.refuse_nonzero(card, "struc", "structural damping", "leave STRUC at 0");
      if (const PartIndex p = b.reference(card, "pid", b.parts); p != none) law.parts = {p};
    }
    law.curve = b.reference(card, "lcid", b.curves);
    law.value = Builder::real_or(card, "sf", 1.0);
    if (b.integer_in(card, "flag", 0, 1) == 1) read_factors(block.next("card1"), law);
    if (!law.parts.empty() && law.curve != none) b.model.dampings.push_back(std::move(law));
  }
}

void build_damping_stiffness(Builder& b, Block& block) {
  const bool set = block.keyword.ends_with("_SET");
  block.for_each("card0", [&](const Card& card) {
    StiffnessDamping damping;
    if (set) {
      damping.parts = b.part_set(card, "psid");
    } else if (const PartIndex p = b.reference(card, "pid", b.parts); p != none) {
      damping.parts = {p};
    }
    const double coefficient = card.real("coef");
    if (coefficient < 0) damping.beta = -card.real("coef", dimension::time);
    damping.fraction = std::max(coefficient, 0.0);
    if (coefficient > 1) card.error("coef", "found " + card.text("coef") + ", expected a share of critical damping", "give a value up to 1, mostly 0.01 to 0.25");
    if (coefficient > 0) card.warning("coef", "LS-DYNA's damping for COEF > 0 is not published; here it is that share of critical damping at each element's highest frequency");
    if (!damping.parts.empty() && coefficient != 0 && coefficient <= 1) b.model.stiffness_dampings.push_back(std::move(damping));
  });
}

void build_damping_relative(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    DampingLaw law;
    b.refuse_nonzero(card, "dv2", "damping by the square of the velocity", "leave DV2 at 0");
    law.curve = b.optional_curve(card, "lcid");
    if (law.curve == none) law.value = card.real("cdamp");
    law.frequency = card.real("freq", dimension::angular_velocity);
    if (law.frequency <= 0) card.error("freq", "is not positive", "give the frequency at which CDAMP is wanted");
    law.relative_to = b.body(card, "pidrb");
    law.parts = b.part_set(card, "psid");
    if (law.relative_to != none && !law.parts.empty()) b.model.dampings.push_back(std::move(law));
  });
}

}  // namespace kardan::deck
