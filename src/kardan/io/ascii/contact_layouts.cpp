// RCFORC, SLEOUT, NCFORC in the layouts of LSTC's binout translator.
#include <fmt/format.h>

#include <iterator>

#include "kardan/io/ascii/ascii_writer.hpp"

namespace kardan {

namespace {

template <class... Args>
void put(std::string& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

}  // namespace

std::string rcforc_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  const auto& ids = f.meta("ids");
  const auto& sides = f.meta("side");
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, "{:>7}{:12d} time{:14.5E}  x{:14.5E}  y{:14.5E}  z{:14.5E}", sides[i] == 0 ? "slave" : "master", ids[i], s.time, f["x_force"][i],
        f["y_force"][i], f["z_force"][i]);
    put(text, "  mx{:14.5E}  my{:14.5E}  mz{:14.5E}\n", f["x_moment"][i], f["y_moment"][i], f["z_moment"][i]);
  }
  return text;
}

std::string sleout_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  const auto& ids = f.meta("ids");
  std::string text;
  put(text, "\n\n\n contact interface energy file, time={:14.7E}\n", s.time);
  text += "         #          slave         master     frictional\n\n";
  for (std::size_t i = 0; i < ids.size(); ++i)
    put(text, "{:10d}{:15.4E}{:15.4E}{:15.4E}\n", ids[i], f["slave"][i], f["master"][i], f["friction"][i]);
  put(text, "\n total slave side           ={:15.7E}\n total master side          ={:15.7E}\n", f["total_slave"][0], f["total_master"][0]);
  put(text, " total energy               ={:15.7E}\n total frictional energy    ={:15.7E}\n", f["total_energy"][0], f["total_friction"][0]);
  return text;
}

std::string ncforc_text(const Snapshot& s) {
  std::string text;
  for (const Folder& f : s.folders) {
    const auto& ids = f.meta("ids");
    put(text, "\n forces (t={:12.5E}) for interface{:10d} {} side\n\n", s.time, f.meta("interface")[0], f.meta("side")[0] == 0 ? "slave" : "master");
    text += "      node           x-force/        y-force/        z-force/       pressure/\n";
    for (std::size_t i = 0; i < ids.size(); ++i)
      put(text, "{:10d}{:16.5E}{:16.5E}{:16.5E}{:16.5E}\n", ids[i], f["x_force"][i], f["y_force"][i], f["z_force"][i], f["pressure"][i]);
  }
  return text;
}

}  // namespace kardan
