// Small things that the files of Sets share.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck::set_detail {

inline constexpr std::array<const char*, set_kinds> kind_names{"node",  "part", "segment", "shell",
                                                               "solid", "beam", "discrete"};

inline std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}
inline std::size_t at(SetKind k) {
  return static_cast<std::size_t>(k);
}

inline ElementKind element_kind(SetKind kind) {
  switch (kind) {
    case SetKind::shell:
      return ElementKind::shell;
    case SetKind::solid:
      return ElementKind::solid;
    case SetKind::beam:
      return ElementKind::beam;
    default:
      return ElementKind::discrete;
  }
}

/// Calls f with the element block of a kind.
template <class F>
auto with_elements(const Model& model, ElementKind kind, F&& f) {
  switch (kind) {
    case ElementKind::shell:
      return f(model.shells);
    case ElementKind::solid:
      return f(model.solids);
    case ElementKind::beam:
      return f(model.beams);
    default:
      return f(model.discretes);
  }
}

/// In the box or on its faces.
inline bool inside(const Box& box, const Vec3& x) {
  return x.x >= box.low.x && x.x <= box.high.x && x.y >= box.low.y && x.y <= box.high.y && x.z >= box.low.z &&
         x.z <= box.high.z;
}

inline std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// "id" and 3 give "id3".
inline std::string field_name(const char* stem, int number) {
  return stem + std::to_string(number);
}

}  // namespace kardan::deck::set_detail
