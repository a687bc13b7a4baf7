// The d3plot family: geometry in `d3plot`, states in `d3plot01`, `d3plot02` …
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "kardan/io/d3plot/d3plot_layout.hpp"
#include "kardan/io/d3plot/word_buffer.hpp"
#include "kardan/io/file_sink.hpp"
#include "kardan/io/run_label.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

struct D3plotOptions {
  int word_bytes = 4;  ///< 4 or 8
  /// A state that would make its file longer starts the next one. LS-DYNA's default: 70 x 262144 words.
  std::int64_t file_words = 70 * 262144;
  /// NDIM = 5: the material type section tells readers which parts are rigid, and rigid shells have no state data. Off
  /// by default, because VTK's vtkLSDynaReader miscounts such states.
  bool material_types = false;
  int file_type = 1;             ///< word 11: 1 d3plot, 4 interface forces
  std::int64_t shell_words = 0;  ///< NV2D, of a file whose shells carry no stresses; 0 = stresses
};

/// Word positions follow the "LS-DYNA Database Binary Output" description (LSTC) as read by vtkLSDynaReader and
/// lasso-python.
class D3plotWriter {
 public:
  /// Writes the geometry. @throws RunError if the file cannot be written or a user id does not fit in a word.
  D3plotWriter(std::filesystem::path path, const RunLabel& label, const Model& model, const State& state,
               const D3plotOptions& options);
  /// Goes on where mark() was taken; later members of the family must be gone.
  D3plotWriter(std::filesystem::path path, const Model& model, const State& state, const D3plotOptions& options, const nlohmann::json& mark);

  /// Appends the state at t_n and flushes it. All nodes must be up to date.
  void write_state(const Model& model, const State& state);
  /// Appends a state that is complete but for its end marker, and flushes it.
  void append(WordBuffer& state);
  const D3plotLayout& layout() const { return layout_; }
  int word_bytes() const { return options_.word_bytes; }

  nlohmann::json mark() const;
  void sync();

 private:
  D3plotWriter(std::filesystem::path path, const Model& model, const State& state, const D3plotOptions& options);
  std::filesystem::path member(int number) const;
  void write_geometry(const RunLabel& label, const Model& model);
  void control_words(const RunLabel& label, WordBuffer& out) const;
  void geometry_words(const Model& model, WordBuffer& out) const;
  void numbering_words(const Model& model, WordBuffer& out) const;
  void title_words(const RunLabel& label, const Model& model, WordBuffer& out) const;
  void global_words(const Model& model, const State& state, WordBuffer& out) const;
  void element_words(const Model& model, const State& state, WordBuffer& out) const;
  void deletion_words(const Model& model, const State& state, WordBuffer& out) const;

  std::filesystem::path path_;
  D3plotOptions options_;
  D3plotLayout layout_;
  D3plotWords words_;
  std::optional<FileSink> file_;
  int file_number_ = 0;
  int first_unsynced_ = 0;  ///< members from here on may not be on the disk
  std::int64_t end_ = 0;  ///< where the next state begins: the end marker stands there
};

}  // namespace kardan
