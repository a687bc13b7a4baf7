// ELOUT. The layout is that of the ASCII file that LSTC's binout translator prints.
#include <fmt/format.h>

#include <iterator>

#include "kardan/io/ascii/ascii_writer.hpp"

namespace kardan {

namespace {

template <class... Args>
void put(std::string& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

const std::vector<std::int64_t>& integers(const Folder& f, std::string_view name) {
  for (const IntegerColumn& c : f.integers) {
    if (c.name == name) return c.values;
  }
  return f.meta(name);
}

const char* state_name(std::int64_t state) { return state == 2 ? "plastic" : "elastic"; }

void put_head(std::string& text, const Snapshot& s) {
  put(text, "\n\n\n e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  s t e p{:9d}   ( at time{:12.5E} )\n\n",
      s.cycle, s.time);
}

void put_stresses(std::string& text, const Folder& f, std::size_t i) {
  for (const char* name : {"sig_xx", "sig_yy", "sig_zz", "sig_xy", "sig_yz", "sig_zx"}) put(text, "{:12.4E}", f[name][i]);
}

void put_solids(std::string& text, const Folder& f) {
  text += " element  materl\n     ipt  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx           ";
  put(text, "            yield\n           state{:82}effsg      function\n", "");
  const auto& ids = integers(f, "ids");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, "{:8d}-{:7d}\n       1 {:<7} ", ids[i], integers(f, "mtype")[i], state_name(integers(f, "state")[i]));
    put_stresses(text, f, i);
    put(text, "{:14.4E}{:14.4E}\n", f["effsg"][i], f["yield"][i]);
  }
}

void put_shells(std::string& text, const Folder& f) {
  const bool global = f.text_metadata.at(1).second == "global";
  put(text, " element  materl{:<8}\n", global ? "(global)" : "(local)");
  text += " ipt-shl  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx       plastic\n";
  put(text, "           state{:81}strain \n", "");
  const auto& ids = integers(f, "ids");
  std::size_t k = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, "{:8d}-{:7d}\n", ids[i], integers(f, "mat")[i]);
    for (std::int64_t j = 1; j <= integers(f, "nip")[i]; ++j, ++k) {
      put(text, "{:4d}-{:3d} {:<7} ", j, integers(f, "iop")[i], state_name(integers(f, "state")[k]));
      put_stresses(text, f, k);
      put(text, "{:14.4E}\n", f["plastic_strain"][k]);
    }
  }
}

void put_beams(std::string& text, const Folder& f) {
  const auto& ids = integers(f, "ids");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(text, "\n beam/truss # ={:8d}      part ID  ={:8d}\n", ids[i], integers(f, "mat")[i]);
    text += " resultants      axial    shear-s    shear-t    moment-s   moment-t   torsion\n           ";
    for (const char* name : {"axial", "shear_s", "shear_t", "moment_s", "moment_t", "torsion"}) put(text, "{:11.3E}", f[name][i]);
    text += '\n';
  }
}

}  // namespace

std::string elout_text(const Snapshot& s) {
  std::string text;
  for (const Folder& f : s.folders) {
    put_head(text, s);
    (f.path == "/elout/solid" ? put_solids : f.path == "/elout/beam" ? put_beams : put_shells)(text, f);
  }
  return text;
}

}  // namespace kardan
