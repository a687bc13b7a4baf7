#include "kardan/io/tables/snapshot.hpp"

#include <algorithm>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

const std::vector<double>& Folder::operator[](std::string_view name) const {
  const auto hit = std::find_if(columns.begin(), columns.end(), [&](const RealColumn& c) { return c.name == name; });
  KARDAN_ASSERT(hit != columns.end());
  return hit->values;
}

const std::vector<std::int64_t>& Folder::meta(std::string_view name) const {
  const auto hit =
      std::find_if(metadata.begin(), metadata.end(), [&](const IntegerColumn& c) { return c.name == name; });
  KARDAN_ASSERT(hit != metadata.end());
  return hit->values;
}

}  // namespace kardan
