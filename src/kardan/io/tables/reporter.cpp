#include "kardan/io/tables/reporter.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

const std::vector<OutputFile>& Reporter::files() {
  static const std::vector<OutputFile> all = {OutputFile::glstat,  OutputFile::matsum,  OutputFile::nodout,
                                              OutputFile::rbdout,  OutputFile::jntforc, OutputFile::bndout,
                                              OutputFile::spcforc, OutputFile::deforc,  OutputFile::secforc,
                                              OutputFile::elout,   OutputFile::rwforc,
                                              OutputFile::rcforc,  OutputFile::sleout,  OutputFile::ncforc,
                                              OutputFile::swforc};
  return all;
}

nlohmann::json Reporter::mark() const { return frames_.mark(); }

Snapshot Reporter::take(OutputFile file, const Model& model, const State& state) const {
  Snapshot s{file, state.clock.time, state.clock.cycle, {}};
  switch (file) {
    case OutputFile::glstat:
      s.folders.push_back(glstat_folder(model, state));
      break;
    case OutputFile::matsum:
      s.folders.push_back(matsum_folder(model, state));
      break;
    case OutputFile::nodout:
      s.folders.push_back(nodout_folder(model, state, frames_));
      break;
    case OutputFile::rbdout:
      s.folders.push_back(rbdout_folder(model, state, frames_));
      break;
    case OutputFile::jntforc:
      s.folders = jntforc_folders(model, state, frames_);
      break;
    case OutputFile::bndout:
      s.folders = bndout_folders(model, state);
      break;
    case OutputFile::spcforc:
      s.folders.push_back(spcforc_folder(model, state));
      break;
    case OutputFile::deforc:
      s.folders.push_back(deforc_folder(model, state));
      break;
    case OutputFile::secforc:
      s.folders.push_back(secforc_folder(model, state));
      break;
    case OutputFile::elout:
      s.folders = elout_folders(model, state);
      break;
    case OutputFile::rcforc:
      s.folders.push_back(rcforc_folder(model, state));
      break;
    case OutputFile::sleout:
      s.folders.push_back(sleout_folder(model, state));
      break;
    case OutputFile::ncforc:
      s.folders = ncforc_folders(model, state);
      break;
    case OutputFile::rwforc:
      s.folders = rwforc_folders(model, state);
      break;
    case OutputFile::swforc:
      s.folders.push_back(swforc_folder(state));
      break;
    default:
      KARDAN_ASSERT(!"a file of Reporter::files()");
  }
  std::erase_if(s.folders, [](const Folder& f) {
    return std::all_of(f.columns.begin(), f.columns.end(), [](const RealColumn& c) { return c.values.empty(); });
  });
  return s;
}

}  // namespace kardan
