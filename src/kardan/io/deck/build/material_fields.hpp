// Materials that are read by the names of their fields (FieldMaterial): one row a keyword.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "kardan/io/deck/deck.hpp"

namespace kardan::deck {

struct MaterialFields {
  int number = 0;  ///< LS-DYNA's
  /// Units of the fields that have some, for *INCLUDE_TRANSFORM; RO, E and PR are known. Integer fields that begin with "lc" name a curve or
  /// a table.
  std::map<std::string, Dimension, std::less<>> dimensions;
};

/// The row of a keyword ("MAT_JOHNSON_COOK"), null if it is not read in this way.
const MaterialFields* material_fields(std::string_view keyword);

}  // namespace kardan::deck
