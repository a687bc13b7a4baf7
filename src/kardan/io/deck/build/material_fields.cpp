#include "kardan/io/deck/build/material_fields.hpp"

namespace kardan::deck {

namespace {

/// Cards of the rubbers 77: hysteresis with PR < 0; constants, or with N > 0 the test they are fitted to.
bool has_rubber_card(const FieldMaterial& m, std::string_view card) {
  if (card == "hysteresis") return m.value("pr") < 0;
  if (card == "test") return m.value("n") > 0;
  return !(m.value("n") > 0);
}

}  // namespace

const MaterialFields* material_fields(std::string_view keyword) {
  static const std::map<std::string, MaterialFields, std::less<>> rows{
      {"MAT_PLASTIC_KINEMATIC", {3, {{"sigy", dimension::stress}, {"etan", dimension::stress}, {"src", dimension::rate}}}},
      {"MAT_BLATZ-KO_RUBBER", {7, {{"g", dimension::stress}}}},
      {"MAT_MOONEY-RIVLIN_RUBBER",
       {27, {{"a", dimension::stress}, {"b", dimension::stress}, {"sgl", dimension::length}, {"sw", dimension::length}, {"st", dimension::length}}}},
      {"MAT_HYPERELASTIC_RUBBER",
       {77,
        {{"g", dimension::stress},    {"sigf", dimension::stress}, {"sgl", dimension::length}, {"sw", dimension::length},
         {"st", dimension::length},   {"c10", dimension::stress},  {"c01", dimension::stress}, {"c11", dimension::stress},
         {"c20", dimension::stress},  {"c02", dimension::stress},  {"c30", dimension::stress}, {"beta", dimension::rate}},
        'H', &has_rubber_card, "prony"}},
      {"MAT_OGDEN_RUBBER",
       {77,
        {{"g", dimension::stress},   {"sigf", dimension::stress}, {"sgl", dimension::length}, {"sw", dimension::length},
         {"st", dimension::length},  {"mu1", dimension::stress},  {"mu2", dimension::stress}, {"mu3", dimension::stress},
         {"mu4", dimension::stress}, {"mu5", dimension::stress},  {"mu6", dimension::stress}, {"mu7", dimension::stress},
         {"mu8", dimension::stress}, {"beta", dimension::rate}},
        'O', &has_rubber_card, "prony"}},
  };
  const auto found = rows.find(keyword);
  return found == rows.end() ? nullptr : &found->second;
}

}  // namespace kardan::deck
