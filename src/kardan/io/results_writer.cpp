#include "kardan/io/results_writer.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>
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

/// A longer earlier run would leave later members of the d3plot family, which readers would append to this run's.
void remove_old_results(const std::filesystem::path& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    bool ours = name == binout_name || name == separations_name;
    for (const OutputFile file : Reporter::files()) ours = ours || name == to_string(file);
    for (const std::string family : {"d3plot", "intfor"}) ours = ours || (name.starts_with(family) && all_digits(name.substr(family.size())));
    if (ours && entry.is_regular_file()) std::filesystem::remove(entry.path());
  }
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
  try {
    std::filesystem::create_directories(w.directory);
    remove_old_results(w.directory);
  } catch (const std::filesystem::filesystem_error& error) {
    throw RunError("cannot use the result directory " + w.directory.string() + ": " + error.code().message());
  }
  for (const auto& [file, request] : requests_of(model, w.defaulted)) {
    if (!known(file)) {
      w.unwritten.push_back(file);
      continue;
    }
    const Curve* curve = request.curve == none ? nullptr : &model.curves[static_cast<std::size_t>(request.curve)];
    w.outputs.emplace(file, Impl::Output{request, {request.dt, curve, model.control.termination.end_time}});
  }
  if (w.outputs.contains(OutputFile::d3plot))
    w.d3plot.emplace(w.directory / to_string(OutputFile::d3plot), w.label, model, state, options.d3plot);
  if (w.outputs.contains(OutputFile::intfor) && IntforWriter::has_surfaces(state))
    w.intfor.emplace(w.directory / to_string(OutputFile::intfor), w.label, model, state, options.d3plot);
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

void ResultsWriter::finish() {
  if (impl_->binout) impl_->binout->flush();
}

bool ResultsWriter::defaulted() const {
  return impl_->defaulted;
}

const std::vector<OutputFile>& ResultsWriter::unwritten() const {
  return impl_->unwritten;
}

}  // namespace kardan
