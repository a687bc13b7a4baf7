#include "kardan/io/results_writer.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "kardan/base/diagnostics.hpp"
#include "kardan/io/ascii/ascii_writer.hpp"
#include "kardan/io/binout/binout_writer.hpp"
#include "kardan/io/d3plot/intfor_writer.hpp"
#include "kardan/io/output_schedule.hpp"
#include "kardan/io/tables/reporter.hpp"

namespace kardan {

namespace {

constexpr const char* binout_name = "binout0000";
constexpr const char* separations_name = "jntsep";

using nlohmann::json;
using Requests = std::map<OutputFile, OutputRequest>;

bool asks(const OutputRequest& r) {
  return r.dt > 0 || r.curve != none;
}

bool known(OutputFile file) {
  const auto& files = Reporter::files();
  return file == OutputFile::d3plot || file == OutputFile::intfor || std::find(files.begin(), files.end(), file) != files.end();
}

Requests requests_of(const Model& model, bool& defaulted) {
  Requests wanted = model.output.requests;
  std::erase_if(wanted, [](const auto& entry) { return !asks(entry.second); });
  defaulted = wanted.empty();
  if (defaulted) {
    const double end = model.control.termination.end_time;
    wanted[OutputFile::d3plot].dt = end / 20;
    wanted[OutputFile::glstat].dt = end / 1000;
    std::erase_if(wanted, [](const auto& entry) { return !asks(entry.second); });
  }
  return wanted;
}

bool all_digits(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_result(const std::string& name) {
  if (name == binout_name || name == separations_name) return true;
  for (const OutputFile file : Reporter::files())
    if (name == to_string(file)) return true;
  for (const std::string family : {"d3plot", "intfor"})
    if (name.starts_with(family) && all_digits(name.substr(family.size()))) return true;
  return false;
}

/// f(name, entry) for the result files in a folder.
template <class F>
void for_each_result(const std::filesystem::path& directory, F&& f) {
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (const std::string name = entry.path().filename().string(); is_result(name) && entry.is_regular_file()) f(name, entry);
}

/// A longer earlier run would leave later members of the d3plot family, which readers would append to this run's. Those in `kept` stay.
void remove_old_results(const std::filesystem::path& directory, const json& kept) {
  std::filesystem::create_directories(directory);
  std::vector<std::filesystem::path> old;
  for_each_result(directory, [&](const std::string& name, const auto& entry) {
    if (!kept.contains(name)) old.push_back(entry.path());
  });
  for (const auto& path : old) std::filesystem::remove(path);
}

double step_of(const Clock& clock) {
  return clock.dt > 0 ? clock.dt : clock.dt_previous;
}

}  // namespace

struct ResultsWriter::Impl {
  struct Output {
    OutputRequest request;
    OutputSchedule schedule;
    double last = -1e300;
  };

  std::filesystem::path directory;
  RunLabel label;
  Reporter reporter;
  std::map<OutputFile, Output> outputs;
  std::vector<OutputFile> unwritten;
  bool defaulted = false;
  std::optional<D3plotWriter> d3plot;
  std::optional<IntforWriter> intfor;
  std::optional<BinoutWriter> binout;
  std::map<OutputFile, AsciiWriter> ascii;
  std::optional<AsciiWriter> separations;

  Impl(const Model& model, const State& state) : reporter(model, state) {}

  void write(OutputFile file, const OutputRequest& request, const Model& model, const State& state) {
    if (file == OutputFile::d3plot) return d3plot->write_state(model, state);
    if (file == OutputFile::intfor) return intfor ? intfor->write_state(state) : void();
    const Snapshot snapshot = reporter.take(file, model, state);
    if (snapshot.folders.empty()) return;
    if (request.binary != 1) {
      if (!binout) binout.emplace(directory / binout_name, label);
      binout->write(snapshot);
    }
    if (request.binary == 2) return;
    auto place = ascii.find(file);
    if (place == ascii.end()) place = ascii.try_emplace(file, directory / to_string(file), label).first;
    place->second.write(snapshot);
    if (file != OutputFile::jntforc || snapshot.folders[0].path != "/jntforc/joints") return;
    if (!separations) separations.emplace(directory / separations_name, label);
    separations->write_separations(snapshot);
  }

  void prepare(const Model& model, const json& kept_files) {
    try {
      remove_old_results(directory, kept_files);
    } catch (const std::filesystem::filesystem_error& error) {
      throw RunError("cannot use the result directory " + directory.string() + ": " + error.code().message());
    }
    for (const auto& [file, request] : requests_of(model, defaulted)) {
      if (!known(file)) {
        unwritten.push_back(file);
        continue;
      }
      const Curve* curve = request.curve == none ? nullptr : &model.curves[static_cast<std::size_t>(request.curve)];
      outputs.emplace(file, Output{request, {request.dt, curve, model.control.termination.end_time}});
    }
  }

  /// f(writer) for every file that is open.
  template <class F>
  void for_each_writer(F&& f) {
    if (d3plot) f(*d3plot);
    if (intfor) f(*intfor);
    if (binout) f(*binout);
    for (auto& [file, writer] : ascii) f(writer);
    if (separations) f(*separations);
  }

  template <class Chosen>
  void write_chosen(const Model& model, const State& state, Chosen&& chosen) {
    bool followed = false;
    for (auto& [file, output] : outputs) {
      if (!chosen(output)) continue;
      if (!followed) reporter.follow(state);
      followed = true;
      write(file, output.request, model, state);
      output.schedule.written(state.clock.time, step_of(state.clock));
      output.last = state.clock.time;
    }
    if (binout) binout->flush();
  }
};

ResultsWriter::ResultsWriter(const Model& model, const State& state, std::filesystem::path directory,
                             WriterOptions options)
    : impl_(std::make_unique<Impl>(model, state)) {
  Impl& w = *impl_;
  w.directory = std::move(directory);
  if (options.date.empty()) options.date = fmt::format("{:%m/%d/%Y}", fmt::localtime(std::time(nullptr)));
  w.label = {model.title, options.version, options.date};
  w.prepare(model, json::object());
  if (w.outputs.contains(OutputFile::d3plot))
    w.d3plot.emplace(w.directory / to_string(OutputFile::d3plot), w.label, model, state, options.d3plot);
  if (w.outputs.contains(OutputFile::intfor) && IntforWriter::has_surfaces(state))
    w.intfor.emplace(w.directory / to_string(OutputFile::intfor), w.label, model, state, options.d3plot);
}

ResultsWriter::ResultsWriter(const Model& model, const State& state, std::filesystem::path directory, WriterOptions options,
                             const json& mark)
    : impl_(std::make_unique<Impl>(model, state)) {
  Impl& w = *impl_;
  w.directory = std::move(directory);
  w.label = {model.title, mark.at("version").get<std::string>(), mark.at("date").get<std::string>()};
  w.prepare(model, mark.at("files"));
  w.reporter.resume(mark.at("reporter"));
  for (auto& [file, output] : w.outputs) {
    const json& own = mark.at("outputs").at(to_string(file));
    output.schedule.resume(own.at("schedule"));
    own.at("last").get_to(output.last);
  }
  const auto path = [&](OutputFile file) { return w.directory / to_string(file); };
  if (mark.contains("d3plot")) w.d3plot.emplace(path(OutputFile::d3plot), model, state, options.d3plot, mark["d3plot"]);
  if (mark.contains("intfor")) w.intfor.emplace(path(OutputFile::intfor), model, state, options.d3plot, mark["intfor"]);
  if (mark.contains("binout")) w.binout.emplace(w.directory / binout_name, w.label, mark["binout"]);
  if (mark.contains("separations")) w.separations.emplace(w.directory / separations_name, w.label, mark["separations"]);
  for (const OutputFile file : Reporter::files())
    if (const json& ascii = mark.at("ascii"); ascii.contains(to_string(file)))
      w.ascii.try_emplace(file, path(file), w.label, ascii[to_string(file)]);
}

json ResultsWriter::mark() const {
  Impl& w = *impl_;
  json mark = {{"version", w.label.version}, {"date", w.label.date}, {"reporter", w.reporter.mark()}, {"outputs", json::object()},
               {"ascii", json::object()},    {"files", json::object()}};
  for (const auto& [file, output] : w.outputs) mark["outputs"][to_string(file)] = {{"schedule", output.schedule.mark()}, {"last", output.last}};
  for (const auto& [file, writer] : w.ascii) mark["ascii"][to_string(file)] = writer.mark();
  if (w.d3plot) mark["d3plot"] = w.d3plot->mark();
  if (w.intfor) mark["intfor"] = w.intfor->mark();
  if (w.binout) mark["binout"] = w.binout->mark();
  if (w.separations) mark["separations"] = w.separations->mark();
  for_each_result(w.directory, [&](const std::string& name, const auto& entry) { mark["files"][name] = entry.file_size(); });
  return mark;
}

std::string ResultsWriter::fault(const std::filesystem::path& directory, const json& mark) {
  for (const auto& [name, size] : mark.at("files").items()) {
    std::error_code error;
    const auto now = std::filesystem::file_size(directory / name, error);
    if (error) return "the result file " + name + " is gone";
    if (now < size.get<std::uintmax_t>()) return "the result file " + name + " is shorter than it was then";
  }
  return {};
}

ResultsWriter::~ResultsWriter() = default;
ResultsWriter::ResultsWriter(ResultsWriter&&) noexcept = default;
ResultsWriter& ResultsWriter::operator=(ResultsWriter&&) noexcept = default;

bool ResultsWriter::due(double time, double dt) const {
  return std::any_of(impl_->outputs.begin(), impl_->outputs.end(),
                     [&](const auto& entry) { return entry.second.schedule.due(time, dt); });
}

bool ResultsWriter::elements_due(double time, double dt) const {
  return std::any_of(impl_->outputs.begin(), impl_->outputs.end(), [&](const auto& entry) {
    return (entry.first == OutputFile::d3plot || entry.first == OutputFile::elout) && entry.second.schedule.due(time, dt);
  });
}

void ResultsWriter::write_due(const Model& model, const State& state) {
  impl_->write_chosen(model, state, [&](const Impl::Output& output) {
    return output.schedule.due(state.clock.time, step_of(state.clock));
  });
}

void ResultsWriter::write_now(const Model& model, const State& state) {
  impl_->write_chosen(model, state, [&](const Impl::Output& output) { return output.last < state.clock.time; });
}

void ResultsWriter::write_d3plot(const Model& model, const State& state) {
  const auto place = impl_->outputs.find(OutputFile::d3plot);
  if (!impl_->d3plot || !(place->second.last < state.clock.time)) return;
  impl_->d3plot->write_state(model, state);
  place->second.last = state.clock.time;
}

void ResultsWriter::finish() {
  if (impl_->binout) impl_->binout->flush();
}

void ResultsWriter::sync() {
  impl_->for_each_writer([](auto& writer) { writer.sync(); });
  sync_folder(impl_->directory);
}

bool ResultsWriter::defaulted() const {
  return impl_->defaulted;
}

const std::vector<OutputFile>& ResultsWriter::unwritten() const {
  return impl_->unwritten;
}

}  // namespace kardan
