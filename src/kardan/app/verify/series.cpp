#include "kardan/app/verify/series.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

namespace kardan::verify {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> fields;
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1))
    fields.push_back(line.substr(0, comma));
  fields.push_back(line);
  return fields;
}

double number(std::string_view text, const std::filesystem::path& file, std::size_t line) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw CaseError(file.string() + ":" + std::to_string(line) + ": not a number: \"" + std::string(text) + "\"");
  return value;
}

}  // namespace

Series read_table(const std::filesystem::path& file, const std::vector<std::string>& columns) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) throw CaseError(file.string() + ": cannot be read");
  const auto header = split(line);
  std::vector<std::size_t> pick;
  for (const std::string& column : columns) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end()) throw CaseError(file.string() + ": no column \"" + column + "\"");
    pick.push_back(static_cast<std::size_t>(found - header.begin()));
  }

  Series series;
  series.width = columns.size();
  const std::size_t count = header.size();
  for (std::size_t n = 2; std::getline(in, line); ++n) {
    const auto fields = split(line);
    if (fields.size() != count)
      throw CaseError(file.string() + ":" + std::to_string(n) + ": " + std::to_string(fields.size()) +
                      " fields, expected " + std::to_string(count));
    series.time.push_back(number(fields[0], file, n));
    for (const std::size_t i : pick) series.values.push_back(number(fields[i], file, n));
  }
  return series;
}

double length(std::span<const double> components) {
  double sum = 0;
  for (const double c : components) sum += c * c;
  return std::sqrt(sum);
}

}  // namespace kardan::verify
