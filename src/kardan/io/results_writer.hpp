// The result files of a run: which, when, where.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "kardan/io/d3plot/d3plot_writer.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

struct WriterOptions {
  std::string version = "kardan";  ///< of the program, for the files' heads
  std::string date;                ///< "MM/DD/YYYY"; empty = today
  D3plotOptions d3plot;
};

/// Writes what model.output.requests asks for (d3plot; glstat, matsum, nodout, rbdout, jntforc, bndout, spcforc, deforc,
/// elout as ASCII, binout or both), each at its own times: k * dt or by its interval curve, first at t = 0 and last at the
/// end time. Every write is flushed, so that a killed run leaves readable files. The model must outlive the writer.
class ResultsWriter {
 public:
  /// Makes `directory` and removes the result files of an earlier run from it. Writes d3plot's geometry.
  /// @throws RunError with path and reason, here and at every write.
  ResultsWriter(const Model& model, const State& state, std::filesystem::path directory, WriterOptions options);
  /// Goes on where mark() was taken: what the files hold beyond it is cut off, and files that came later are removed.
  ResultsWriter(const Model& model, const State& state, std::filesystem::path directory, WriterOptions options, const nlohmann::json& mark);
  ~ResultsWriter();
  ResultsWriter(ResultsWriter&&) noexcept;
  ResultsWriter& operator=(ResultsWriter&&) noexcept;

  /// Some file is due at `time`, so that nodes and reports must be brought up to date. `dt`: step to come.
  bool due(double time, double dt) const;
  /// One of the files that are due shows elements (d3plot, elout): state.results must be up to date.
  bool elements_due(double time, double dt) const;
  /// Writes the files that are due. To be called between kick and drift, with reports and nodes up to date at t_n.
  void write_due(const Model& model, const State& state);
  /// Writes every file that has no output at t_n yet, due or not: the last state of a run that stops early.
  void write_now(const Model& model, const State& state);
  /// Writes a state into d3plot if there is none at t_n yet; its schedule knows nothing of it.
  void write_d3plot(const Model& model, const State& state);
  /// Flushes everything.
  void finish();
  /// Everything written so far is on the disk.
  void sync();

  /// Between two cycles, after sync(): what a later run needs to go on, with the sizes of all files.
  nlohmann::json mark() const;
  /// Why a run cannot go on from this mark (a file is missing or shorter than it was); empty if it can.
  static std::string fault(const std::filesystem::path& directory, const nlohmann::json& mark);

  /// The deck asked for nothing; d3plot (20 states) and glstat (a thousandth of the end time) are written all the same.
  bool defaulted() const;
  /// Files the deck asks for that Kardan does not write.
  const std::vector<OutputFile>& unwritten() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kardan
