// One output of one time-history file, independent of its format: binout and the ASCII files are made of the same
// numbers. Folders and columns carry the names of LS-DYNA's binout.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/model/control.hpp"

namespace kardan {

struct RealColumn {
  std::string name;
  std::vector<double> values;
};

struct IntegerColumn {
  std::string name;
  std::vector<std::int64_t> values;
};

struct Folder {
  std::string path;  ///< e.g. "/jntforc/joints"
  std::vector<std::pair<std::string, std::string>> text_metadata;
  std::vector<IntegerColumn> metadata;  ///< what does not change with time: ids …
  std::vector<UserId> legend_ids;       ///< entries with a title
  std::vector<std::string> legend;
  std::vector<IntegerColumn> integers;  ///< at this time
  std::vector<RealColumn> columns;      ///< at this time; one value for each id, or one in all

  /// The column or metadata of that name, which must be there.
  const std::vector<double>& operator[](std::string_view name) const;
  const std::vector<std::int64_t>& meta(std::string_view name) const;

  /// Appends three columns, the components of value(0), value(1), … value(count - 1).
  template <class F>
  void add_vectors(std::string_view x, std::string_view y, std::string_view z, std::size_t count, F&& value) {
    RealColumn c[3] = {{std::string(x), {}}, {std::string(y), {}}, {std::string(z), {}}};
    for (RealColumn& column : c) column.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto v = value(i);
      for (std::size_t k = 0; k < 3; ++k) c[k].values.push_back(v[k]);
    }
    for (RealColumn& column : c) columns.push_back(std::move(column));
  }

  /// Appends one column of value(0) … value(count - 1).
  template <class F>
  void add_scalars(std::string_view name, std::size_t count, F&& value) {
    RealColumn c{std::string(name), {}};
    c.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) c.values.push_back(value(i));
    columns.push_back(std::move(c));
  }
};

struct Snapshot {
  OutputFile file = OutputFile::glstat;
  double time = 0;
  std::int64_t cycle = 0;
  std::vector<Folder> folders;  ///< only those that have something in them
};

}  // namespace kardan
