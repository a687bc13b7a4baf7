// *DEFINE_TRANSFORMATION: a list of movements, applied in the order in which they stand.
#pragma once

#include <cstdint>
#include <map>

#include "kardan/io/deck/deck.hpp"

namespace kardan::deck {

class Transformation {
 public:
  /// One line: OPTION, A1 … A7. Faults are reported on the card.
  void add(const Card& step);
  const Affine& result() const { return map_; }

 private:
  void apply(const Mat3& linear, const Vec3& shift);
  void about(const Mat3& linear, const Vec3& fixed_point) { apply(linear, fixed_point - linear * fixed_point); }
  void rotate(const Card& step);
  void mirror(const Card& step);
  void position(const Card& step);
  Vec3 named_point(const Card& step, std::string_view field) const;

  Affine map_;
  std::map<std::int64_t, Vec3> points_;
};

}  // namespace kardan::deck
