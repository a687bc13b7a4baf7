#include "kardan/app/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "kardan/app/version.hpp"
#include "kardan/base/timer.hpp"

namespace kardan::app {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::string_view prefix = "checkpoint-";
constexpr int kept_files = 2;

fs::path path_of(const fs::path& folder, int number) { return folder / fmt::format("{}{:06d}", prefix, number); }

/// Number of a restart file, 0 for other names.
int number_of(const std::string& name) {
  const std::string digits = name.starts_with(prefix) ? name.substr(prefix.size()) : "";
  const bool number = !digits.empty() && digits.size() < 9 && std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number ? std::atoi(digits.c_str()) : 0;
}

std::vector<int> numbers_in(const fs::path& folder) {
  std::vector<int> numbers;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (const int n = number_of(entry.path().filename().string()); n > 0) numbers.push_back(n);
  std::sort(numbers.rbegin(), numbers.rend());
  return numbers;
}

json optional(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json options_of(const RunRequest& request) {
  std::vector<std::string> without = request.without;
  std::sort(without.begin(), without.end());
  return {{"--end", optional(request.end_time)},
          {"--dt", optional(request.dt)},
          {"--joints", request.joints ? json(*request.joints == JointHolding::exact ? "exact" : "penalty") : json(nullptr)},
          {"--without", without}};
}

std::string shown(const json& value) {
  if (value.is_null() || (value.is_array() && value.empty())) return "not given";
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() ? fmt::format("{:g}", value.get<double>()) : value.dump();
}

}  // namespace

RestartPoint newest_restart_point(const fs::path& folder, Log& log) {
  const std::vector<int> numbers = numbers_in(folder);
  if (numbers.empty()) throw RunError(fmt::format("{} holds no restart file ({}…)", folder.string(), prefix));
  for (const int number : numbers) {
    const fs::path path = path_of(folder, number);
    try {
      CheckpointFile file(path);
      const std::string fault = ResultsWriter::fault(folder, file.head().at("results"));
      if (fault.empty()) return {path, number, std::move(file)};
      log.line(fmt::format("warning: {} cannot be used: {}", path.string(), fault));
    } catch (const RunError& error) {
      log.line(fmt::format("warning: {}", error.what()));
    } catch (const json::exception& error) {
      log.line(fmt::format("warning: {} cannot be used: {}", path.string(), error.what()));
    }
  }
  throw RunError(fmt::format("no restart file in {} can be used", folder.string()));
}

json identity_of(const RunRequest& request, const std::vector<deck::DeckFile>& files) {
  json list = json::array();
  for (const deck::DeckFile& file : files) list.push_back({{"name", file.name}, {"bytes", file.bytes}, {"hash", file.hash}});
  return {{"kardan", build_info().version}, {"commit", build_info().commit}, {"deck", fs::absolute(request.deck).string()},
          {"options", options_of(request)}, {"files", list}};
}

RunRequest continued(const RunRequest& request, const json& head, Diagnostics& diagnostics) {
  RunRequest result = request;
  if (const auto version = head.at("kardan").get<std::string>(); version != build_info().version)
    diagnostics.error(fmt::format("the restart file was written by Kardan {}, this is {}", version, build_info().version), "go on with the same version");
  if (const auto commit = head.at("commit").get<std::string>(); commit != build_info().commit)
    diagnostics.warning(fmt::format("the restart file was written by a build of commit {}, this one is of {}: the results may differ from those of an "
                                    "unbroken run", commit, build_info().commit));
  const json given = options_of(request), before = head.at("options");
  for (const auto& [name, value] : given.items()) {
    const bool asked = !value.is_null() && value != json::array();
    if (asked && value != before.at(name))
      diagnostics.error(fmt::format("{} is {} now and was {} when the run began", name, shown(value), shown(before.at(name))),
                        "a restart keeps the options of the run; only -j and -o may change");
  }
  const auto number = [&](const char* name) { return before.at(name).is_null() ? std::nullopt : std::optional(before.at(name).get<double>()); };
  result.end_time = number("--end");
  result.dt = number("--dt");
  if (!before.at("--joints").is_null()) result.joints = before.at("--joints") == "exact" ? JointHolding::exact : JointHolding::penalty;
  result.without = before.at("--without").get<std::vector<std::string>>();
  if (result.deck.empty()) result.deck = head.at("deck").get<std::string>();
  if (!result.checkpoint) result.checkpoint = CheckpointPlan{head.at("plan").at("seconds").get<double>(), head.at("plan").at("cycles").get<std::int64_t>()};
  return result;
}

void compare_files(const json& head, const std::vector<deck::DeckFile>& files, Diagnostics& diagnostics) {
  const char* const cure = "go on with the deck that the run began with, or begin anew without --restart";
  const json& before = head.at("files");
  for (std::size_t i = 0; i < std::min(files.size(), before.size()); ++i)
    if (files[i].hash != before[i].at("hash").get<std::uint64_t>() || files[i].bytes != before[i].at("bytes").get<std::size_t>())
      diagnostics.error(fmt::format("{} is not the file that the run began with ({}, {} bytes then, {} now)", files[i].name,
                                    before[i].at("name").get<std::string>(), before[i].at("bytes").get<std::size_t>(), files[i].bytes), cure);
  if (files.size() != before.size())
    diagnostics.error(fmt::format("the deck has {} file{}, and had {} when the run began", files.size(), files.size() == 1 ? "" : "s", before.size()), cure);
}

Checkpoints::Checkpoints(fs::path folder, json identity, CheckpointPlan plan, int last)
    : folder_(std::move(folder)), identity_(std::move(identity)), plan_(plan), last_(last) {
  identity_["plan"] = {{"seconds", plan_.seconds}, {"cycles", plan_.cycles}};
}

void remove_checkpoints(const fs::path& folder) {
  for (const int number : numbers_in(folder)) fs::remove(path_of(folder, number));
}

std::string Checkpoints::write(Solver& solver, ResultFiles& results) {
  const Stopwatch watch;
  results.writer().sync();
  const Clock& clock = solver.state().clock;
  json head = identity_;
  head["clock"] = {{"cycle", clock.cycle}, {"time", clock.time}, {"relaxing", clock.relaxing != 0}};
  head["results"] = results.writer().mark();
  const fs::path path = path_of(folder_, last_ + 1);
  const std::int64_t bytes = write_checkpoint(path, head, solver.registry());
  ++last_;
  for (const int number : numbers_in(folder_))
    if (number > last_ || number <= last_ - kept_files) fs::remove(path_of(folder_, number));
  return fmt::format("restart file {} at t = {:g}, cycle {} ({:.1f} MB, {:.2f} s)", path.filename().string(), clock.time, clock.cycle,
                     1e-6 * static_cast<double>(bytes), watch.seconds());
}

void copy_results(const fs::path& from, const fs::path& to, const json& mark) {
  fs::create_directories(to);
  for (const auto& [name, size] : mark.at("files").items()) {
    fs::copy_file(from / name, to / name, fs::copy_options::overwrite_existing);
    fs::resize_file(to / name, size.get<std::uintmax_t>());
  }
}

}  // namespace kardan::app
