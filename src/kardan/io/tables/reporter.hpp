// Collects what each time-history file reports at t_n.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "kardan/io/tables/body_frames.hpp"
#include "kardan/io/tables/snapshot.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class Reporter {
 public:
  Reporter(const Model& model, const State& state) : frames_(model, state) {}

  /// Files this reporter knows.
  static const std::vector<OutputFile>& files();

  /// To be called once at every output time, before take().
  void follow(const State& state) { frames_.follow(state); }
  /// What a later run needs to go on.
  nlohmann::json mark() const;
  void resume(const nlohmann::json& mark) { frames_.resume(mark); }

  /// What `file` (one of files()) reports at t_n; without folders if the model has nothing of the kind.
  Snapshot take(OutputFile file, const Model& model, const State& state) const;

 private:
  BodyFrames frames_;
};

/// The pieces of Reporter::take, one for each file.
Folder glstat_folder(const Model& model, const State& state);
Folder matsum_folder(const Model& model, const State& state);
Folder nodout_folder(const Model& model, const State& state, const BodyFrames& frames);
Folder rbdout_folder(const Model& model, const State& state, const BodyFrames& frames);
/// /jntforc/joints, type0 (generalized), type1 (flexion-torsion), type2 (translational and cylindrical).
std::vector<Folder> jntforc_folders(const Model& model, const State& state, const BodyFrames& frames);
/// /bndout/velocity/nodes and /bndout/velocity/rigidbodies.
std::vector<Folder> bndout_folders(const Model& model, const State& state);
Folder spcforc_folder(const Model& model, const State& state);
/// /rwforc/forces, and /rwforc/wall001 … for walls whose force is reported by segments.
std::vector<Folder> rwforc_folders(const Model& model, const State& state);
Folder swforc_folder(const State& state);
Folder deforc_folder(const Model& model, const State& state);
Folder secforc_folder(const Model& model, const State& state);
Folder rcforc_folder(const Model& model, const State& state);
Folder sleout_folder(const Model& model, const State& state);
/// /ncforc/slave_<id> and master_<id>, for sides that SPR and MPR ask for.
std::vector<Folder> ncforc_folders(const Model& model, const State& state);
/// /elout/solid, /elout/beam and /elout/shell.
std::vector<Folder> elout_folders(const Model& model, const State& state);

}  // namespace kardan
