#include "kardan/io/deck/build/material_fields.hpp"

namespace kardan::deck {

const MaterialFields* material_fields(std::string_view keyword) {
  static const std::map<std::string, MaterialFields, std::less<>> rows{
      {"MAT_PLASTIC_KINEMATIC", {3, {{"sigy", dimension::stress}, {"etan", dimension::stress}, {"src", dimension::rate}}}},
  };
  const auto found = rows.find(keyword);
  return found == rows.end() ? nullptr : &found->second;
}

}  // namespace kardan::deck
