// JNTFORC, BNDOUT, SPCFORC, RWFORC, SWFORC (Kardan's columns), DEFORC and Kardan's own JNTSEP. The layouts are those of the ASCII files that LSTC's binout
// translator prints.
#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string_view>

#include "kardan/io/ascii/ascii_writer.hpp"

namespace kardan {

namespace {

template <class... Args>
void put(std::string& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

struct Line {
  const char* label;
  const char* column;
};

void put_lines(std::string& text, const Folder& f, const std::vector<Line>& lines, std::size_t i) {
  for (const Line& line : lines) put(text, " {:.<29}{:14.5E}\n", line.label, f[line.column][i]);
}

const std::vector<Line>& stiffness_lines(std::string_view path) {
  static const std::vector<Line> generalized = {{"phi (degrees)", "phi_degrees"},
                                                {"d(phi)/dt (degrees)", "d(phi)_dt"},
                                                {"theta (degrees)", "theta_degrees"},
                                                {"d(theta)/dt (degrees)", "d(theta)_dt"},
                                                {"psi (degrees)", "psi_degrees"},
                                                {"d(psi)/dt (degrees)", "d(psi)_dt"},
                                                {"phi moment-stiffness", "phi_moment_stiffness"},
                                                {"phi moment-damping", "phi_moment_damping"},
                                                {"phi moment-total", "phi_moment_total"},
                                                {"theta-moment-stiffness", "theta_moment_stiffness"},
                                                {"theta-moment-damping", "theta_moment_damping"},
                                                {"theta-moment-total", "theta_moment_total"},
                                                {"psi-moment-stiffness", "psi_moment_stiffness"},
                                                {"psi-moment-damping", "psi_moment_damping"},
                                                {"psi-moment-total", "psi_moment_total"},
                                                {"joint energy", "joint_energy"}};
  static const std::vector<Line> flexion_torsion = {{"alpha (degrees)", "alpha_degrees"},
                                                    {"d(alpha)/dt (degrees)", "d(alpha)_dt"},
                                                    {"gamma (degrees)", "gamma_degrees"},
                                                    {"d(gamma)/dt (degrees)", "d(gamma)_dt"},
                                                    {"beta (degrees)", "beta_degrees"},
                                                    {"d(beta)/dt (degrees)", "d(beta)_dt"},
                                                    {"alpha-moment-stiffness", "alpha_moment_stiffness"},
                                                    {"alpha-moment-damping", "alpha_moment_damping"},
                                                    {"alpha-moment-total", "alpha_moment_total"},
                                                    {"gamma scale factor", "gamma_scale_factor"},
                                                    {"beta-moment-stiffness", "beta_moment_stiffness"},
                                                    {"beta-moment-damping", "beta_moment_damping"},
                                                    {"beta-moment-total", "beta_moment_total"},
                                                    {"joint energy", "joint_energy"}};
  static const std::vector<Line> translational = {
      {"x-displacement", "x_displacement"},       {"d(dispx)/dt", "d(dispx)_dt"},
      {"y-displacement", "y_displacement"},       {"d(dispy)/dt", "d(dispy)_dt"},
      {"z-displacement", "z_displacement"},       {"d(dispz)/dt", "d(dispz)_dt"},
      {"force-x-stiffness", "x_force_stiffness"}, {"force-x-damping", "x_force_damping"},
      {"force-x-total", "x_force_total"},         {"force-y-stiffness", "y_force_stiffness"},
      {"force-y-damping", "y_force_damping"},     {"force-y-total", "y_force_total"},
      {"force-z-stiffness", "z_force_stiffness"}, {"force-z-damping", "z_force_damping"},
      {"force-z-total", "z_force_total"},         {"joint energy", "joint_energy"}};
  return path == "/jntforc/type0" ? generalized : path == "/jntforc/type1" ? flexion_torsion : translational;
}

void put_joints(std::string& text, const Folder& f) {
  static const std::vector<Line> global = {{"x-force", "x_force"},   {"y-force", "y_force"},
                                           {"z-force", "z_force"},   {"x-moment", "x_moment"},
                                           {"y-moment", "y_moment"}, {"z-moment", "z_moment"}};
  static const std::vector<Line> local = {{"x-force  (local) ", "x_force"},  {"y-force  (local) ", "y_force"},
                                          {"z-force  (local) ", "z_force"},  {"x-moment (local) ", "x_moment"},
                                          {"y-moment (local) ", "y_moment"}, {"z-moment (local) ", "z_moment"}};
  static const std::vector<Line> rest = {
      {"resultant force", "resultant_force"}, {"resultant moment", "resultant_moment"}, {"energy", "energy"}};
  const auto& ids = f.meta("ids");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, " joint ID.....................{:10d}\n", ids[i]);
    put_lines(text, f, f.meta("local")[i] != 0 ? local : global, i);
    put_lines(text, f, rest, i);
  }
}

}  // namespace

std::string jntforc_text(const Snapshot& s) {
  std::string text;
  put(text, "\n\n time.........................{:14.5E}\n", s.time);
  for (const Folder& f : s.folders) {
    if (f.path == "/jntforc/joints") {
      put_joints(text, f);
      continue;
    }
    const auto& ids = f.meta("ids");
    for (std::size_t i = 0; i < ids.size(); ++i) {
      put(text, " joint stiffness id number....{:10d}\n", ids[i]);
      put_lines(text, f, stiffness_lines(f.path), i);
    }
  }
  return text;
}

std::string jntsep_text(const Snapshot& s) {
  std::string text;
  put(text, "\n\n time.........................{:14.5E}\n  joint ID      separation   angular separation (degrees)\n",
      s.time);
  for (const Folder& f : s.folders) {
    if (f.path != "/jntforc/joints") continue;
    const auto& ids = f.meta("ids");
    for (std::size_t i = 0; i < ids.size(); ++i)
      put(text, "{:10d}  {:14.5E}  {:14.5E}\n", ids[i], f["separation"][i], f["angular_separation"][i]);
  }
  return text;
}

std::string bndout_text(const Snapshot& s) {
  std::string text;
  put(text, "\n\n\n\n\n n o d a l   f o r c e/e n e r g y    o u t p u t   t={:9.3E}\n", s.time);
  text += "\n\n\n\n\n velocity boundary condition forces/rigid body moments \n\n";
  double total[4] = {};
  for (const Folder& f : s.folders) {
    const bool bodies = f.path == "/bndout/velocity/rigidbodies";
    const auto& ids = f.meta("ids");
    for (std::size_t i = 0; i < ids.size(); ++i) {
      put(text, "{}{:8d}  xforce={:13.4E}   yforce={:13.4E}  zforce={:13.4E}   energy={:13.4E}   setid ={:8d}\n",
          bodies ? "mat#" : " nd#", ids[i], f["x_force"][i], f["y_force"][i], f["z_force"][i], f["energy"][i],
          f.meta("setid")[i]);
      if (bodies)
        put(text, "             xmoment={:13.4E}  ymoment={:13.4E} zmoment={:13.4E}\n", f["xmoment"][i],
            f["ymoment"][i], f["zmoment"][i]);
    }
    static constexpr std::array<const char*, 4> names = {"x_total", "y_total", "z_total", "etotal"};
    for (std::size_t k = 0; k < 4; ++k) total[k] += f[names[k]][0];
  }
  put(text, "              xtotal={:13.4E}   ytotal={:13.4E}  ztotal={:13.4E}   etotal={:13.4E}\n", total[0], total[1],
      total[2], total[3]);
  return text;
}

std::string spcforc_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  const auto& nodes = f.meta("force_ids");
  const auto& constraints = f.meta("spc_ids");
  std::string text;
  put(text, " output at time ={:14.5E}\n", s.time);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    put(text, " node={:8d} local x,y,z forces ={:14.4E}{:14.4E}{:14.4E} setid={:8d}\n", nodes[i], f["x_force"][i],
        f["y_force"][i], f["z_force"][i], constraints[i]);
    put(text, " node={:8d} local x,y,z moments={:14.4E}{:14.4E}{:14.4E} setid={:8d}\n", nodes[i], f["x_moment"][i],
        f["y_moment"][i], f["z_moment"][i], constraints[i]);
  }
  put(text, "             force resultants   ={:14.4E}{:14.4E}{:14.4E}\n", f["x_resultant"][0], f["y_resultant"][0],
      f["z_resultant"][0]);
  return text;
}

std::string rwforc_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  const auto& walls = f.meta("setid");
  std::string text;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    put(text, "{:12.5E}{:8d}{:15.6E}{:15.6E}{:15.6E}{:15.6E}\n", s.time, walls[i], f["normal_force"][i], f["x_force"][i], f["y_force"][i],
        f["z_force"][i]);
    const std::string path = fmt::format("/rwforc/wall{:03d}", walls[i]);
    for (const Folder& segments : s.folders) {
      if (segments.path != path) continue;
      text += "                seg#    \n";
      const auto &x = segments["x_force"], &y = segments["y_force"], &z = segments["z_force"];
      for (std::size_t k = 0; k < x.size(); ++k) put(text, "            {:8d}               {:15.6E}{:15.6E}{:15.6E}\n", k + 1, x[k], y[k], z[k]);
      put(text, "  total force                      {:15.6E}{:15.6E}{:15.6E}\n", segments["total_x"][0], segments["total_y"][0], segments["total_z"][0]);
    }
  }
  return text;
}

std::string swforc_text(const Snapshot& s) {
  static constexpr std::array<const char*, 3> types{"constraint", "weld", "beam"};
  const Folder& f = s.folders.at(0);
  const auto& ids = f.meta("ids");
  const auto& failed = f.integers.at(0).values;
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, "{:12d}{:15.5E}{:15.5E}{:15.5E}{:15.5E}{:15.5E}{:15.5E}{:15.5E}  {}{}\n", ids[i], f["axial"][i], f["shear"][i], s.time,
        static_cast<double>(failed[i]), f["length"][i], f["resultant_moment"][i], f["torsion"][i],
        types[static_cast<std::size_t>(f.meta("types")[i]) - 1], failed[i] != 0 ? " failed" : "");
  }
  return text + "\n";
}

std::string deforc_text(const Snapshot& s) {
  static const std::vector<Line> translational = {{"x-force", "x_force"},
                                                  {"y-force", "y_force"},
                                                  {"z-force", "z_force"},
                                                  {"resultant force", "resultant_force"},
                                                  {"change in length", "displacement"}};
  static const std::vector<Line> rotational = {{"x-moment", "x_force"},
                                               {"y-moment", "y_force"},
                                               {"z-moment", "z_force"},
                                               {"resultant moment", "resultant_force"},
                                               {"relative rotation", "displacement"}};
  const Folder& f = s.folders.at(0);
  const auto& ids = f.meta("ids");
  std::string text;
  put(text, "\n time.........................{:14.5E}\n", s.time);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, " spring/damper number.........{:10d}\n", ids[i]);
    put_lines(text, f, f.meta("irot")[i] != 0 ? rotational : translational, i);
  }
  return text;
}

std::string secforc_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  const auto& ids = f.meta("ids");
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, "{:12d}{:15.5E}{:12.4E}{:12.4E}{:12.4E}{:12.4E}\n", ids[i], s.time, f["x_force"][i], f["y_force"][i], f["z_force"][i],
        f["total_force"][i]);
    put(text, "{:27}{:12.4E}{:12.4E}{:12.4E}{:12.4E}\n", "", f["x_moment"][i], f["y_moment"][i], f["z_moment"][i],
        f["total_moment"][i]);
    put(text, "{:27}{:12.4E}{:12.4E}{:12.4E}\n\n", "", f["x_centroid"][i], f["y_centroid"][i], f["z_centroid"][i]);
  }
  return text;
}

}  // namespace kardan
