#include "kardan/app/verify/case.hpp"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <string_view>

namespace kardan::verify {
namespace {

using nlohmann::json;

/// A misspelt key would silently weaken a figure, so unknown ones are refused.
void only_keys(const json& object, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw CaseError("unknown entry \"" + key + "\" in " + object.dump());
}

Run read_run(const std::string& name, const json& entry, const std::filesystem::path& folder) {
  only_keys(entry, {"deck", "joints", "sample", "steps", "end", "long"});
  Run run;
  run.name = name;
  run.deck = folder / entry.at("deck").get<std::string>();
  const auto joints = entry.value("joints", "exact");
  if (joints != "exact" && joints != "penalty") throw CaseError("run " + name + ": joints are exact or penalty");
  run.joints = joints == "exact" ? JointHolding::exact : JointHolding::penalty;
  run.sample = entry.at("sample").get<double>();
  run.steps = entry.value("steps", std::int64_t{0});
  run.end = entry.at("end").get<double>();
  run.is_long = entry.value("long", false);
  if (!(run.sample > 0) || run.steps < 0 || (entry.contains("steps") && run.steps == 0) || !(run.end >= run.sample))
    throw CaseError("run " + name + ": sample > 0, steps >= 1 (or none: the deck's step) and end >= sample are needed");
  return run;
}

Oracle read_oracle(const json& entry, const std::filesystem::path& folder) {
  only_keys(entry, {"file", "columns", "run", "signal", "value", "time_factor", "factor"});
  Oracle oracle;
  if (entry.contains("file")) {
    oracle.file = folder / entry["file"].get<std::string>();
    oracle.columns = entry.at("columns").get<std::vector<std::string>>();
  } else if (entry.contains("run")) {
    oracle.run = entry["run"].get<std::string>();
    oracle.signal = entry.at("signal");
  } else {
    oracle.value = entry.at("value").get<std::vector<double>>();
  }
  oracle.time_factor = entry.value("time_factor", 1.0);
  oracle.factor = entry.value("factor", 1.0);
  return oracle;
}

Scale read_scale(const json& entry) {
  if (entry.is_number()) return {Scale::Kind::number, entry.get<double>()};
  if (entry == "peak") return {Scale::Kind::peak, 1};
  if (entry == "initial") return {Scale::Kind::initial, 1};
  throw CaseError("a scale is a number, \"peak\" or \"initial\"");
}

Figure read_figure(const json& entry, const Case& of) {
  only_keys(entry, {"figure", "unit", "run", "runs", "signal", "oracle", "measure", "scale", "from", "until", "level",
                    "crossings", "frequencies", "band", "limit", "at_least", "note"});
  Figure figure;
  figure.name = entry.at("figure").get<std::string>();
  figure.unit = entry.value("unit", "1");
  figure.runs = entry.contains("runs") ? entry["runs"].get<std::vector<std::string>>()
                                       : std::vector{entry.at("run").get<std::string>()};
  figure.signal = entry.at("signal");
  if (entry.contains("oracle")) figure.oracle = read_oracle(entry["oracle"], of.folder);
  Comparison& c = figure.comparison;
  c.measure = measure_from(entry.at("measure").get<std::string>());
  if (entry.contains("scale")) c.scale = read_scale(entry["scale"]);
  c.from = entry.value("from", c.from);
  c.until = entry.value("until", c.until);
  c.level = entry.value("level", 0.0);
  c.crossings = entry.value("crossings", std::vector<double>{});
  c.frequencies = entry.value("frequencies", std::vector<double>{});
  c.band = entry.value("band", c.band);
  figure.at_least = entry.contains("at_least");
  figure.limit = entry.at(figure.at_least ? "at_least" : "limit").get<double>();
  figure.note = entry.value("note", "");

  auto named = figure.runs;
  if (figure.oracle && !figure.oracle->run.empty()) named.push_back(figure.oracle->run);
  for (const auto& run : named)
    if (!of.runs.contains(run)) throw CaseError("figure \"" + figure.name + "\": no run \"" + run + "\"");
  for (const auto& run : named)
    if (c.measure == Measure::order && of.runs.at(run).free_step())
      throw CaseError("figure \"" + figure.name + "\": an order of convergence needs constant steps");
  if (figure.runs.size() != (c.measure == Measure::order ? 2u : 1u))
    throw CaseError("figure \"" + figure.name + "\": an order takes two runs, everything else one");
  return figure;
}

}  // namespace

bool Case::is_long(const Figure& figure) const {
  const auto slow = [this](const std::string& run) { return runs.at(run).is_long; };
  return std::any_of(figure.runs.begin(), figure.runs.end(), slow) ||
         (figure.oracle && !figure.oracle->run.empty() && slow(figure.oracle->run));
}

Case read_case(const std::filesystem::path& folder, const std::string& group) {
  const auto file = folder / "case.json";
  try {
    std::ifstream in(file);
    if (!in) throw CaseError("cannot be read");
    const json entry = json::parse(in);
    only_keys(entry, {"title", "proves", "source", "runs", "figures"});
    Case result;
    result.name = folder.filename().string();
    result.group = group;
    result.folder = folder;
    result.title = entry.at("title").get<std::string>();
    result.proves = entry.at("proves").get<std::string>();
    result.source = entry.at("source").get<std::string>();
    for (const auto& [name, run] : entry.at("runs").items()) result.runs[name] = read_run(name, run, folder);
    for (const json& figure : entry.at("figures")) result.figures.push_back(read_figure(figure, result));
    return result;
  } catch (const std::exception& e) {
    throw CaseError(file.string() + ": " + e.what());
  }
}

std::vector<Case> read_cases(const std::filesystem::path& root) {
  std::vector<Case> cases;
  std::error_code missing;
  for (const auto& group : std::filesystem::directory_iterator(root, missing)) {
    if (!group.is_directory()) continue;
    for (const auto& folder : std::filesystem::directory_iterator(group.path()))
      if (std::filesystem::exists(folder.path() / "case.json"))
        cases.push_back(read_case(folder.path(), group.path().filename().string()));
  }
  if (missing) throw CaseError(root.string() + ": " + missing.message());
  std::sort(cases.begin(), cases.end(),
            [](const Case& a, const Case& b) { return std::pair(a.group, a.name) < std::pair(b.group, b.name); });
  return cases;
}

}  // namespace kardan::verify
