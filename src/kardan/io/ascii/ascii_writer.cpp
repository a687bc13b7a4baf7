#include "kardan/io/ascii/ascii_writer.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

namespace {

std::string legend_text(const Snapshot& s) {
  std::string lines;
  for (const Folder& f : s.folders)
    for (std::size_t i = 0; i < f.legend.size(); ++i)
      lines += fmt::format("{:9d}     {:.80s}\n", f.legend_ids[i], f.legend[i]);
  if (lines.empty()) return "\n\n";
  return "\n{BEGIN LEGEND}\n Entity #        Title\n" + lines + "{END LEGEND}\n\n";
}

constexpr const char* secforc_head =
    " line#1  section#     time        x-force     y-force     z-force    magnitude\n"
    " line#2  resultant  moments     x-moment    y-moment    z-moment   magnitude\n"
    " line#3  centroids                     x           y           z\n\n";

bool has_legend(OutputFile file) {
  return file != OutputFile::glstat && file != OutputFile::rbdout && file != OutputFile::spcforc &&
         file != OutputFile::deforc;
}

}  // namespace

AsciiWriter::AsciiWriter(std::filesystem::path path, RunLabel label)
    : file_(std::move(path)), label_(std::move(label)) {}

AsciiWriter::AsciiWriter(std::filesystem::path path, RunLabel label, const nlohmann::json& mark)
    : file_(std::move(path), mark.at("size").get<std::int64_t>()), label_(std::move(label)), headed_(mark.at("headed").get<bool>()) {}

nlohmann::json AsciiWriter::mark() const { return {{"size", file_.size()}, {"headed", headed_}}; }

std::string AsciiWriter::text_of(const Snapshot& s) {
  switch (s.file) {
    case OutputFile::glstat:
      return glstat_text(s);
    case OutputFile::matsum:
      return matsum_text(s);
    case OutputFile::nodout:
      return nodout_text(s);
    case OutputFile::rbdout:
      return rbdout_text(s);
    case OutputFile::jntforc:
      return jntforc_text(s);
    case OutputFile::bndout:
      return bndout_text(s);
    case OutputFile::spcforc:
      return spcforc_text(s);
    case OutputFile::rcforc:
      return rcforc_text(s);
    case OutputFile::sleout:
      return sleout_text(s);
    case OutputFile::ncforc:
      return ncforc_text(s);
    case OutputFile::rwforc:
      return rwforc_text(s);
    case OutputFile::swforc:
      return swforc_text(s);
    case OutputFile::deforc:
      return deforc_text(s);
    case OutputFile::secforc:
      return secforc_text(s);
    case OutputFile::elout:
      return elout_text(s);
    default:
      break;
  }
  KARDAN_ASSERT(!"an ASCII layout for this file");
  return {};
}

void AsciiWriter::append(const Snapshot& s, const std::string& text) {
  if (!headed_) {
    file_.write(fmt::format(" {:.72s}\n{:25}{:<30} date {}\n", label_.title, "", label_.version, label_.date));
    if (has_legend(s.file)) file_.write(legend_text(s));
    if (s.file == OutputFile::secforc) file_.write(secforc_head);
    if (s.file == OutputFile::spcforc) file_.write(" single point constraint forces\n\n");
    if (s.file == OutputFile::rwforc)
      file_.write("\n\n    time       wall#   normal-force    x-force        y-force        z-force\n");
    if (s.file == OutputFile::swforc)
      file_.write("\n spotweld and constraint forces\n\n constraint#     axial          shear          time           failure        length         moment         torsion\n");
    headed_ = true;
  }
  file_.write(text);
  file_.flush();
}

void AsciiWriter::write_separations(const Snapshot& jntforc) {
  append(jntforc, jntsep_text(jntforc));
}

}  // namespace kardan
