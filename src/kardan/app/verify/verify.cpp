#include "kardan/app/verify/verify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <set>

#include <fmt/format.h>

#include "kardan/app/verify/runner.hpp"

namespace kardan::verify {
namespace {

using nlohmann::json;

/// The signals that figures want of each run, and the recorded histories.
class Recordings {
 public:
  void want(const std::string& run, const json& signal) {
    auto& list = wanted_[run];
    if (std::find(list.begin(), list.end(), signal) == list.end()) list.push_back(signal);
  }

  void make(const Case& of) {
    for (const auto& [name, signals] : wanted_) {
      try {
        recorded_[name] = record(of.runs.at(name), signals);
      } catch (const std::exception& e) {
        failed_[name] = e.what();
      }
    }
  }

  const Series& get(const std::string& run, const json& signal) const {
    if (const auto failure = failed_.find(run); failure != failed_.end()) throw CaseError(failure->second);
    const auto& list = wanted_.at(run);
    return recorded_.at(run)[static_cast<std::size_t>(std::find(list.begin(), list.end(), signal) - list.begin())];
  }

 private:
  std::map<std::string, std::vector<json>> wanted_;
  std::map<std::string, std::vector<Series>> recorded_;
  std::map<std::string, std::string> failed_;
};

std::optional<Series> oracle_series(const Oracle& oracle, const Recordings& recordings, const Series& signal) {
  Series series;
  if (!oracle.file.empty()) {
    series = read_table(oracle.file, oracle.columns);
  } else if (!oracle.run.empty()) {
    series = recordings.get(oracle.run, oracle.signal);
  } else {
    series.width = oracle.value.size();
    for (const double t : signal.time) series.append(t, oracle.value);
  }
  for (double& t : series.time) t *= oracle.time_factor;
  for (double& v : series.values) v *= oracle.factor;
  return series;
}

double value_of(const Case& of, const Figure& figure, const Recordings& recordings) {
  const auto measured = [&](const std::string& run, Measure how) {
    const Series& signal = recordings.get(run, figure.signal);
    Comparison comparison = figure.comparison;
    comparison.measure = how;
    return measure(comparison, signal,
                   figure.oracle ? oracle_series(*figure.oracle, recordings, signal) : std::optional<Series>{});
  };
  if (figure.comparison.measure != Measure::order) return measured(figure.runs[0], figure.comparison.measure);
  const double coarse = measured(figure.runs[0], Measure::max_error),
               fine = measured(figure.runs[1], Measure::max_error);
  return std::log(coarse / fine) / std::log(of.runs.at(figure.runs[0]).dt() / of.runs.at(figure.runs[1]).dt());
}

json to_json(const Result& r) {
  json line{{"case", r.of->name},     {"figure", r.figure->name}, {"value", r.value},
            {"unit", r.figure->unit}, {"limit", r.figure->limit}, {"pass", r.pass}};
  if (!std::isfinite(r.value)) line["value"] = nullptr;
  if (r.figure->at_least) line["limit_is"] = "at least";
  if (!r.failure.empty()) line["failure"] = r.failure;
  return line;
}

std::string as_text(const Result& r) {
  return fmt::format("{:<24} {:<58} {:>11.3e} {:<6} {:>2} {:<9.3g} {}", r.of->name, r.figure->name, r.value,
                     r.figure->unit, r.figure->at_least ? ">=" : "<=", r.figure->limit, r.pass ? "pass" : "FAIL");
}

std::string as_markdown(const Result& r) {
  return fmt::format("| {} | {:.2e} | {} {:.2g} | {} | {} |", r.figure->name, r.value, r.figure->at_least ? "≥" : "≤",
                     r.figure->limit, r.figure->unit, r.pass ? "yes" : "**no**");
}

void list(const std::vector<Case>& cases, std::ostream& out) {
  for (const Case& c : cases) {
    const auto slow = std::count_if(c.figures.begin(), c.figures.end(), [&](const Figure& f) { return c.is_long(f); });
    out << fmt::format("{:<12} {:<26} {:>3} figures{}  {}\n", c.group, c.name, c.figures.size(),
                       slow ? fmt::format(" ({} long)", slow) : "", c.title);
  }
}

/// The cases a name stands for, with the part of their figures that is meant. Empty if there is none.
std::vector<std::pair<const Case*, Selection>> select(const std::vector<Case>& cases, const std::string& name) {
  std::vector<std::pair<const Case*, Selection>> chosen;
  for (const Case& c : cases) {
    if (name == c.name || name == c.group) chosen.emplace_back(&c, Selection::quick);
    if (name == c.name + "-long" || name == c.group + "-long") chosen.emplace_back(&c, Selection::slow);
  }
  return chosen;
}

void print(const Options& options, const std::vector<Result>& results, double seconds, std::ostream& out) {
  if (results.empty()) return;
  const Case& c = *results.front().of;
  if (options.markdown)
    out << "\n### " << c.name << ": " << c.title << "\n\n"
        << c.proves << "\n\nOracle: " << c.source
        << fmt::format("\n\n| figure | value | limit | unit | holds |\n|---|---|---|---|---|\n");
  std::string told;  // a run that cannot be made fails many figures: said once
  for (const Result& r : results) {
    if (options.json)
      out << to_json(r).dump() << '\n';
    else if (options.markdown)
      out << as_markdown(r) << '\n';
    else
      out << as_text(r) << '\n';
    if (!r.failure.empty() && !options.json && told != r.failure) out << "    " << r.failure << '\n';
    told = r.failure;
  }
  if (options.markdown) {
    std::set<std::string> notes;
    for (const Result& r : results)
      if (!r.figure->note.empty() && notes.insert(r.figure->note).second) out << "\n* " << r.figure->note;
    if (!notes.empty()) out << '\n';
  } else if (!options.json) {
    out << fmt::format("{:<24} {:.1f} s\n", "", seconds);
  }
  out.flush();
}

}  // namespace

std::vector<Result> evaluate(const Case& of, Selection selection) {
  std::vector<const Figure*> chosen;
  Recordings recordings;
  for (const Figure& figure : of.figures) {
    if (of.is_long(figure) != (selection == Selection::slow)) continue;
    chosen.push_back(&figure);
    for (const auto& run : figure.runs) recordings.want(run, figure.signal);
    if (figure.oracle && !figure.oracle->run.empty()) recordings.want(figure.oracle->run, figure.oracle->signal);
  }
  recordings.make(of);

  std::vector<Result> results;
  for (const Figure* figure : chosen) {
    Result result{&of, figure, std::numeric_limits<double>::infinity(), false, {}};
    try {
      result.value = value_of(of, *figure, recordings);
      result.pass = std::isfinite(result.value) &&
                    (figure->at_least ? result.value >= figure->limit : result.value <= figure->limit);
    } catch (const std::exception& e) {
      result.failure = e.what();
    }
    results.push_back(std::move(result));
  }
  return results;
}

int run(const Options& options, std::ostream& out, std::ostream& log) try {
  const auto cases = read_cases(options.root.empty() ? std::filesystem::path(KARDAN_VERIFICATION_DIR) : options.root);
  if (options.list) {
    list(cases, out);
    return 0;
  }
  auto names = options.names;
  if (names.empty()) {
    std::set<std::string> groups;
    for (const Case& c : cases) groups.insert(c.group);
    names.assign(groups.begin(), groups.end());
  }
  std::vector<std::pair<const Case*, Selection>> chosen;
  for (const auto& name : names) {
    const auto some = select(cases, name);
    if (some.empty()) {
      log << "kardan verify: no case or group \"" << name << "\"; --list names them all\n";
      return 2;
    }
    chosen.insert(chosen.end(), some.begin(), some.end());
  }

  std::size_t total = 0, failed = 0;
  for (const auto& [of, selection] : chosen) {
    const auto start = std::chrono::steady_clock::now();
    const auto results = evaluate(*of, selection);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    print(options, results, wall.count(), out);
    total += results.size();
    failed += static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(), [](const Result& r) { return !r.pass; }));
  }
  log << fmt::format("{} figures, {} fall short\n", total, failed);
  return failed == 0 ? 0 : 1;
} catch (const CaseError& e) {
  log << "kardan verify: " << e.what() << '\n';
  return 2;
}

}  // namespace kardan::verify
