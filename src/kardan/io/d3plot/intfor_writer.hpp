// The interface force family (*DATABASE_BINARY_INTFOR): a d3plot whose shells are the segments of contact surfaces.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "kardan/io/d3plot/d3plot_writer.hpp"

namespace kardan {

/// Sides of contacts are parts, numbered from 1 in the order of the contacts, tracked side first. A segment carries 16 words: pressure, largest
/// shear stress, shear stress along its first side and across it, then the forces on its four nodes. Forces of nodes are shared among their
/// segments by area.
class IntforWriter {
 public:
  /// Writes the geometry of all sides that SPR or MPR ask for.
  /// @throws RunError if the file cannot be written
  IntforWriter(std::filesystem::path path, const RunLabel& label, const Model& model, const State& state, const D3plotOptions& options);
  /// Goes on where mark() was taken.
  IntforWriter(std::filesystem::path path, const Model& model, const State& state, const D3plotOptions& options, const nlohmann::json& mark);

  /// Appends the state at t_n. The nodal forces of the contacts must be up to date.
  void write_state(const State& state);

  nlohmann::json mark() const;
  void sync() { file_->sync(); }

  static bool has_surfaces(const State& state);

 private:
  /// A segment and where the forces on its nodes stand.
  struct Face {
    std::size_t contact = 0, side = 0;
    std::array<NodeIndex, 4> nodes{};        ///< of the model
    std::array<std::size_t, 4> place{};      ///< of its nodes in ContactReport::nodes
    std::array<double, 4> share{};           ///< its part of the force there
  };

  void gather(const Model& model, const State& state);

  Model surfaces_;                           ///< nodes and shells of the file
  std::vector<NodeIndex> model_node_;        ///< by node of the file
  std::vector<Face> faces_;                  ///< by shell of the file
  std::optional<D3plotWriter> file_;
};

}  // namespace kardan
