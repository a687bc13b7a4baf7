#include "kardan/io/deck/transformation.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

namespace kardan::deck {

namespace {

Vec3 triple(const Card& card, int first) {
  return {card.real(first), card.real(first + 1), card.real(first + 2)};
}

Mat3 outer(const Vec3& a, const Vec3& b) {
  return {{{b * a.x, b * a.y, b * a.z}}};
}

/// Right-handed rotation by `angle` (radians) about the unit vector n (Rodrigues 1840).
Mat3 rotation(const Vec3& n, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Mat3 skew{{{{0, -n.z, n.y}, {n.z, 0, -n.x}, {-n.y, n.x, 0}}}};
  return Mat3::identity() * c + skew * s + outer(n, n) * (1 - c);
}

/// Columns: unit vectors of the frame with origin a, first axis towards b, third axis normal to the plane of a, b, c.
bool frame(const Vec3& a, const Vec3& b, const Vec3& c, Mat3& columns) {
  const Vec3 x = b - a, z = cross(x, c - a);
  if (!(norm(x) > 0) || !(norm(z) > 1e-12 * norm(x) * norm(c - a))) return false;
  const Vec3 ex = normalized(x), ez = normalized(z), ey = cross(ez, ex);
  columns = {{{{ex.x, ey.x, ez.x}, {ex.y, ey.y, ez.y}, {ex.z, ey.z, ez.z}}}};
  return true;
}

}  // namespace

void Transformation::apply(const Mat3& linear, const Vec3& shift) {
  map_.shift = linear * map_.shift + shift;
  map_.linear = linear * map_.linear;
  map_.is_identity = false;
}

Vec3 Transformation::named_point(const Card& step, std::string_view field) const {
  const auto found = points_.find(step.integer(field));
  if (found != points_.end()) return found->second;
  step.error(field, fmt::format("POINT {} is not defined", step.integer(field)), "a POINT line stands before its use");
  return {};
}

void Transformation::add(const Card& step) {
  std::string option = step.text("option");
  for (char& c : option) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (option == "TRANSL") {
    apply(Mat3::identity(), triple(step, 1));
  } else if (option == "SCALE") {
    Vec3 factors;
    for (std::size_t i = 0; i < 3; ++i) {
      const int field = static_cast<int>(i) + 1;
      factors[i] = step.blank(field) ? 1.0 : step.real(field);
      if (factors[i] == 0)
        step.error(step.where(field).column > 0 ? fmt::format("a{}", field) : "a1", "a scale factor is zero");
    }
    apply(Mat3::diagonal(factors), {});
  } else if (option == "ROTATE") {
    rotate(step);
  } else if (option == "MIRROR") {
    mirror(step);
  } else if (option == "POINT") {
    points_[step.integer("a1")] = triple(step, 2);
  } else if (option == "POS6P") {
    position(step);
  } else {
    step.error("option", fmt::format("'{}' is not built", option), "use SCALE, ROTATE, TRANSL, MIRROR, POINT or POS6P");
  }
}

// A1-A3 direction, A4-A6 a point of the axis, A7 degrees; or, with A4-A7 zero, POINT A1 to POINT A2 and A3 degrees.
void Transformation::rotate(const Card& step) {
  Vec3 direction = triple(step, 1), origin = triple(step, 4);
  double degrees = step.real("a7");
  if (degrees == 0 && norm(origin) == 0) {
    origin = named_point(step, "a1");
    direction = named_point(step, "a2") - origin;
    degrees = step.real("a3");
  }
  if (!(norm(direction) > 0)) return step.error("a1", "the axis of rotation has no direction");
  about(rotation(normalized(direction), degrees * std::numbers::pi / 180), origin);
}

// The plane through (A1, A2, A3), normal to the line from there to (A4, A5, A6).
void Transformation::mirror(const Card& step) {
  const Vec3 point = triple(step, 1), normal = triple(step, 4) - point;
  if (!(norm(normal) > 0)) return step.error("a4", "the mirror plane has no normal");
  const Vec3 n = normalized(normal);
  about(Mat3::identity() + outer(n, n) * -2.0, point);
}

// Three start POINTs go to three target POINTs: the first exactly, the second in direction, the third in plane.
void Transformation::position(const Card& step) {
  constexpr std::array<std::string_view, 6> fields = {"a1", "a2", "a3", "a4", "a5", "a6"};
  std::array<Vec3, 6> p;
  for (std::size_t i = 0; i < 6; ++i) p[i] = named_point(step, fields[i]);
  Mat3 from, to;
  if (!frame(p[0], p[1], p[2], from) || !frame(p[3], p[4], p[5], to))
    return step.error("a1", "three of the points lie on one line");
  const Mat3 turn = to * transpose(from);
  apply(turn, p[3] - turn * p[0]);
}

}  // namespace kardan::deck
