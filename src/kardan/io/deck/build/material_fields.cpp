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
  constexpr Dimension force{1, 1, -2}, moment{1, 2, -2}, spring{1, 0, -2}, damper{1, 0, -1}, turning_damper{1, 2, -1};
  constexpr Dimension heat_capacity{0, 2, -2};  // per mass and degree; temperatures are not converted
  static const std::map<std::string, MaterialFields, std::less<>> rows{
      {"MAT_ISOTROPIC_ELASTIC_PLASTIC",
       {12, {{"g", dimension::stress}, {"sigy", dimension::stress}, {"etan", dimension::stress}, {"bulk", dimension::stress}}}},
      {"MAT_JOHNSON_COOK",
       {15,
        {{"g", dimension::stress},
         {"dtf", dimension::time},
         {"a", dimension::stress},
         {"b", dimension::stress},
         {"epso", dimension::rate},
         {"cp", heat_capacity},
         {"pc", dimension::stress}}}},
      {"MAT_POWER_LAW_PLASTICITY", {18, {{"k", dimension::stress}, {"src", dimension::rate}, {"sigy", dimension::stress}}}},
      {"MAT_SIMPLIFIED_JOHNSON_COOK",
       {98,
        {{"a", dimension::stress},
         {"b", dimension::stress},
         {"sigmax", dimension::stress},
         {"sigsat", dimension::stress},
         {"epso", dimension::rate}}}},
      {"MAT_PLASTIC_KINEMATIC", {3, {{"sigy", dimension::stress}, {"etan", dimension::stress}, {"src", dimension::rate}}}},
      {"MAT_VISCOELASTIC", {6, {{"bulk", dimension::stress}, {"g0", dimension::stress}, {"gi", dimension::stress}, {"beta", dimension::rate}}}},
      {"MAT_NULL", {9, {{"pc", dimension::stress}, {"mu", {1, -1, -1}}, {"ym", dimension::stress}}}},
      {"MAT_BLATZ-KO_RUBBER", {7, {{"g", dimension::stress}}}},
      {"MAT_MOONEY-RIVLIN_RUBBER",
       {27, {{"a", dimension::stress}, {"b", dimension::stress}, {"sgl", dimension::length}, {"sw", dimension::length}, {"st", dimension::length}}}},
      {"MAT_FRAZER-NASH_RUBBER",
       {31,
        {{"c100", dimension::stress}, {"c200", dimension::stress}, {"c300", dimension::stress}, {"c400", dimension::stress},
         {"c110", dimension::stress}, {"c210", dimension::stress}, {"c010", dimension::stress}, {"c020", dimension::stress},
         {"sgl", dimension::length},  {"sw", dimension::length},   {"st", dimension::length}}}},
      {"MAT_LOW_DENSITY_FOAM", {57, {{"tc", dimension::stress}, {"beta", dimension::rate}, {"ed", dimension::stress}, {"kcon", dimension::stress}}}},
      {"MAT_CRUSHABLE_FOAM", {63, {{"tsc", dimension::stress}}}},
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
      {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM",
       {66, {{"tkr", spring}, {"tks", spring}, {"tkt", spring}, {"rkr", moment}, {"rks", moment}, {"rkt", moment},
             {"tdr", damper}, {"tds", damper}, {"tdt", damper}, {"rdr", turning_damper}, {"rds", turning_damper}, {"rdt", turning_damper},
             {"for_", force}, {"fos", force}, {"fot", force}, {"mor", moment}, {"mos", moment}, {"mot", moment}}}},
      {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM",
       {67, {{"for_", force}, {"fos", force}, {"fot", force}, {"mor", moment}, {"mos", moment}, {"mot", moment},
             {"ffailr", force}, {"ffails", force}, {"ffailt", force}, {"mfailr", moment}, {"mfails", moment}, {"mfailt", moment},
             {"ufailr", dimension::length}, {"ufails", dimension::length}, {"ufailt", dimension::length}}}},
      {"MAT_CABLE_DISCRETE_BEAM", {71, {{"f0", force}}}},
      {"MAT_SPOTWELD",
       {100, {{"sigy", dimension::stress}, {"eh", dimension::stress}, {"dt", dimension::time}, {"tfail", dimension::time},
              {"nrr", force}, {"nrs", force}, {"nrt", force}, {"mrr", moment}, {"mss", moment}, {"mtt", moment}}}},
  };
  const auto found = rows.find(keyword);
  return found == rows.end() ? nullptr : &found->second;
}

}  // namespace kardan::deck
