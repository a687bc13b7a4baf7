// Time histories of verification: what a run recorded and what an oracle's table says.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace kardan::verify {

/// A case that cannot be understood or evaluated: the message names the file and the entry.
class CaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Values of a fixed number of components at ascending times.
struct Series {
  std::size_t width = 1;
  std::vector<double> time;
  std::vector<double> values;  ///< width values a time

  std::size_t size() const { return time.size(); }
  std::span<const double> at(std::size_t i) const { return std::span(values).subspan(i * width, width); }
  void append(double t, std::span<const double> components) {
    time.push_back(t);
    values.insert(values.end(), components.begin(), components.end());
  }
};

/// Reads columns of a comma-separated table with one header line; the first column is the time.
/// @throws CaseError if the file, a column or a number is missing.
Series read_table(const std::filesystem::path& file, const std::vector<std::string>& columns);

/// Euclidean length.
double length(std::span<const double> components);

}  // namespace kardan::verify
