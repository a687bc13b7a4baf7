// NODOUT, RBDOUT, GLSTAT and MATSUM. The layouts are those of the ASCII files that LSTC's binout translator prints.
#include <fmt/format.h>

#include <array>
#include <iterator>

#include "kardan/io/ascii/ascii_writer.hpp"

namespace kardan {

namespace {

template <class... Args>
void put(std::string& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

/// "label" and the columns' values of entry i, 12.4E each.
void put_row(std::string& text, const char* label, const Folder& f, std::initializer_list<const char*> names,
             std::size_t i) {
  text += label;
  for (const char* name : names) put(text, "{:12.4E}", f[name][i]);
  text += '\n';
}

void put_node_lines(std::string& text, const Folder& f, std::initializer_list<const char*> names) {
  const auto& ids = f.meta("ids");
  std::vector<const std::vector<double>*> columns;
  for (const char* name : names) columns.push_back(&f[name]);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, "{:9d} ", ids[i]);
    for (const auto* c : columns) put(text, "{:12.4E}", (*c)[i]);
    text += '\n';
  }
}

}  // namespace

std::string glstat_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  std::string text;
  const auto integer = [&](std::size_t i) { return f.integers[i].values[0]; };
  std::vector<std::string> types;
  for (const char c : f.text_metadata.at(0).second + ",") {
    if (types.empty()) types.emplace_back();
    if (c == ',')
      types.emplace_back();
    else
      types.back() += c;
  }
  const std::int64_t type = integer(1);
  put(text, "\n\n dt of cycle{:8d} is controlled by {}", integer(0), types.at(static_cast<std::size_t>(type - 1)));
  if (type != 14) put(text, "{:10d}", integer(2));
  if (type != 14 && integer(3) != 0) put(text, " of part{:10d}", integer(3));
  put(text, "\n time...........................{:14.5E}\n", s.time);
  static constexpr std::array<std::array<const char*, 2>, 22> lines = {
      {{"time_step", " time step......................"},
       {"kinetic_energy", " kinetic energy................."},
       {"internal_energy", " internal energy................"},
       {"stonewall_energy", " stonewall energy..............."},
       {"rb_stopper_energy", " rigid body stopper energy......"},
       {"spring_and_damper_energy", " spring and damper energy......."},
       {"joint_internal_energy", " joint internal energy.........."},
       {"hourglass_energy", " hourglass energy .............."},
       {"system_damping_energy", " system damping energy.........."},
       {"sliding_interface_energy", " sliding interface energy......."},
       {"external_work", " external work.................."},
       {"eroded_kinetic_energy", " eroded kinetic energy.........."},
       {"eroded_internal_energy", " eroded internal energy........."},
       {"eroded_hourglass_energy", " eroded hourglass energy........"},
       {"total_energy", " total energy..................."},
       {"energy_ratio", " total energy / initial energy.."},
       {"energy_ratio_wo_eroded", " energy ratio w/o eroded energy."},
       {"global_x_velocity", " global x velocity.............."},
       {"global_y_velocity", " global y velocity.............."},
       {"global_z_velocity", " global z velocity.............."},
       {"added_mass", " added mass....................."},
       {"percent_increase", " percentage increase............"}}};
  for (const RealColumn& c : f.columns)
    for (const auto& [name, label] : lines)
      if (c.name == name)
        put(text, "{}{:14.5E}{}\n", label, c.values[0], c.name == "stonewall_energy" ? " wall# 1" : "");
  put(text, " number of nodes................{:14d}\n", integer(4));
  put(text, " number of elements.............{:14d}\n", integer(5));
  put(text, " time per zone cycle.(nanosec)..{:14d}\n", integer(6));
  return text;
}

std::string matsum_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  const auto& ids = f.meta("ids");
  std::string text;
  put(text, "\n\n time ={:13.4E}\n", s.time);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    text += ids[i] < 100000 ? fmt::format(" mat.#={:5d}   ", ids[i]) : fmt::format(" mat.#={:8d}", ids[i]);
    put(text, "          inten={:13.4E}     kinen={:13.4E}\n", f["internal_energy"][i], f["kinetic_energy"][i]);
    put(text, " x-mom={:13.4E}     y-mom={:13.4E}     z-mom={:13.4E}\n", f["x_momentum"][i], f["y_momentum"][i],
        f["z_momentum"][i]);
    put(text, " x-rbv={:13.4E}     y-rbv={:13.4E}     z-rbv={:13.4E}\n", f["x_rbvelocity"][i], f["y_rbvelocity"][i],
        f["z_rbvelocity"][i]);
    put(text, "                         hgeng={:13.4E}     +mass={:13.4E}\n", f["hourglass_energy"][i], f["mass"][i]);
  }
  return text;
}

std::string nodout_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  std::string text;
  const auto head = [&] {
    put(text,
        "\n\n\n n o d a l   p r i n t   o u t   f o r   t i m e  s t e p{:8d}                              ( at time"
        "{:12.5E} )\n",
        s.cycle, s.time);
  };
  head();
  text +=
      "\n nodal point  x-disp     y-disp      z-disp      x-vel       y-vel       z-vel      x-accl      y-accl      "
      "z-accl      x-coor      y-coor      z-coor\n";
  put_node_lines(
      text, f,
      {"x_displacement", "y_displacement", "z_displacement", "x_velocity", "y_velocity", "z_velocity", "x_acceleration",
       "y_acceleration", "z_acceleration", "x_coordinate", "y_coordinate", "z_coordinate"});
  head();
  text +=
      "\n nodal point  x-rot      y-rot       z-rot       x-rot vel   y-rot vel   z-rot vel   x-rot acc   y-rot acc   "
      "z-rot acc\n";
  put_node_lines(text, f,
                 {"rx_displacement", "ry_displacement", "rz_displacement", "rx_velocity", "ry_velocity", "rz_velocity",
                  "rx_acceleration", "ry_acceleration", "rz_acceleration"});
  return text;
}

std::string rbdout_text(const Snapshot& s) {
  const Folder& f = s.folders.at(0);
  const auto& ids = f.meta("ids");
  const std::size_t rigid_parts = ids.size() - static_cast<std::size_t>(f.meta("num_nodal")[0]);
  std::string text;
  put(text, "1\n\n  r i g i d   b o d y   m o t i o n   a t  cycle={:8d}    time={:15.6E}\n", s.cycle, s.time);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i < rigid_parts)
      put(text, "\n rigid body{:8d}\n", ids[i]);
    else
      put(text, " nodal rigid body{:8d}\n", ids[i]);
    text += "   global             x           y           z          x-rot       y-rot       z-rot\n";
    put_row(text, "   coordinates:  ", f, {"global_x", "global_y", "global_z"}, i);
    put_row(text, " displacements:  ", f,
            {"global_dx", "global_dy", "global_dz", "global_rdx", "global_rdy", "global_rdz"}, i);
    put_row(text, "    velocities:  ", f,
            {"global_vx", "global_vy", "global_vz", "global_rvx", "global_rvy", "global_rvz"}, i);
    put_row(text, " accelerations:  ", f,
            {"global_ax", "global_ay", "global_az", "global_rax", "global_ray", "global_raz"}, i);
    text +=
        "\nprincipal or user defined local coordinate direction vectors\n                     a           b           "
        "c\n";
    for (int row = 1; row <= 3; ++row) {
      put(text, "     row {}", row);
      for (int column = 1; column <= 3; ++column) put(text, "{:15.4E}", f[fmt::format("dircos_{}{}", row, column)][i]);
      text += '\n';
    }
    text +=
        "\n output in principal or user defined local coordinate directions\n"
        "                      a           b           c          a-rot       b-rot       c-rot\n";
    put_row(text, " displacements:  ", f, {"local_dx", "local_dy", "local_dz", "local_rdx", "local_rdy", "local_rdz"},
            i);
    put_row(text, "    velocities:  ", f, {"local_vx", "local_vy", "local_vz", "local_rvx", "local_rvy", "local_rvz"},
            i);
    put_row(text, " accelerations:  ", f, {"local_ax", "local_ay", "local_az", "local_rax", "local_ray", "local_raz"},
            i);
  }
  return text;
}

}  // namespace kardan
