// Materials that are read by the names of their fields (FieldMaterial): one row a keyword.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "kardan/io/deck/deck.hpp"
#include "kardan/model/materials.hpp"

namespace kardan::deck {

struct MaterialFields {
  int number = 0;  ///< LS-DYNA's
  /// Units of the fields that have some, for *INCLUDE_TRANSFORM; RO, E and PR are known. Integer fields that begin with "lc" name a curve or
  /// a table.
  std::map<std::string, Dimension, std::less<>> dimensions;
  char variant = 0;  ///< 'H' of 77_H
  /// Whether a card is there, where that depends on the fields before it; null: every card may follow.
  bool (*has_card)(const FieldMaterial& so_far, std::string_view card) = nullptr;
  /// The card that may follow again and again to the end of the keyword; its fields get numbers: g1, g2, …
  std::string_view repeated{};
};

/// The row of a keyword ("MAT_JOHNSON_COOK"), null if it is not read in this way.
const MaterialFields* material_fields(std::string_view keyword);

}  // namespace kardan::deck
