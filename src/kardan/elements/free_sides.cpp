#include "kardan/elements/free_sides.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "kardan/base/rotation.hpp"
#include "kardan/elements/geometry.hpp"

namespace kardan {

namespace {

/// An edge or a face of an element by its nodes in ascending order.
template <std::size_t N>
struct Side {
  std::array<NodeIndex, N> nodes;
  Index element;
  std::uint8_t bit;
};

/// Sets the bits of sides that occur once.
template <std::size_t N>
void mark_single(std::vector<Side<N>>& sides, std::vector<std::uint8_t>& free) {
  const auto before = [](const Side<N>& a, const Side<N>& b) { return a.nodes < b.nodes; };
  std::sort(sides.begin(), sides.end(), before);
  for (auto i = sides.begin(); i != sides.end();) {
    const auto next = std::find_if(i, sides.end(), [&](const Side<N>& s) { return s.nodes != i->nodes; });
    if (next - i == 1) free[i->element] |= i->bit;
    i = next;
  }
}

/// How much of a direction between two sides is free to breathe.
double share(std::uint8_t free, int a, int b) { return 0.5 * ((free >> a & 1) + (free >> b & 1)); }

/// Likewise of an element without opposite sides: all of it, a half, or nothing.
double share_of_all(std::uint8_t free, int sides) {
  const int count = std::popcount(free);
  return count == sides ? 1.0 : (2 * count >= sides ? 0.5 : 0.0);
}

/// Largest omega^2 of the strains: eigenvalue of C G, see above. `dimensions`: 3, or 2 where the first direction of S is normal to a plate
/// and `lambda` is that of plane stress.
double largest_square(const Mat3& s, double lambda, double mu, int dimensions) {
  const Vec3 p = principal_axes(s).values;  // ascending
  double largest = mu * (p[1] + p[2]);
  Mat3 normal;
  for (std::size_t i = dimensions == 3 ? 0 : 1; i < 3; ++i) {
    for (std::size_t j = dimensions == 3 ? 0 : 1; j < 3; ++j) {
      normal[i][j] = std::sqrt(std::max(p[i], 0.0) * std::max(p[j], 0.0)) * (lambda + (i == j ? 2 * mu : 0.0));
    }
  }
  return std::max(largest, principal_axes(normal).values[2]);
}

double factor(double square, double length, double wave_speed) {
  return square > 0 ? std::min(1.0, 2 / std::sqrt(square) * wave_speed / length) : 1.0;
}

}  // namespace

std::vector<std::uint8_t> free_edges(const ShellElements& shells) {
  std::vector<std::uint8_t> free(shells.size(), 0);
  std::vector<Side<2>> sides;
  sides.reserve(4 * shells.size());
  for (std::size_t e = 0; e < shells.size(); ++e) {
    for (std::size_t i = 0; i < 4; ++i) {
      const NodeIndex a = shells.nodes[e][i], b = shells.nodes[e][(i + 1) % 4];
      if (a != b) sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<Index>(e), static_cast<std::uint8_t>(1u << i)});
    }
  }
  mark_single(sides, free);
  return free;
}

std::vector<std::uint8_t> free_faces(const SolidElements& solids) {
  std::vector<std::uint8_t> free(solids.size(), 0);
  std::vector<Side<3>> sides;  // three nodes tell faces apart
  sides.reserve(6 * solids.size());
  for (std::size_t e = 0; e < solids.size(); ++e) {
    for (std::size_t i = 0; i < 6; ++i) {
      std::array<NodeIndex, 4> n;
      for (std::size_t k = 0; k < 4; ++k) n[k] = solids.nodes[e][hexahedron_faces[i][k]];
      std::sort(n.begin(), n.end());
      const auto end = std::unique(n.begin(), n.end());
      if (end - n.begin() < 3) continue;
      sides.push_back({{n[0], n[1], n[2]}, static_cast<Index>(e), static_cast<std::uint8_t>(1u << i)});
    }
  }
  mark_single(sides, free);
  return free;
}

double free_shell_factor(const Model& model, Index shell, std::uint8_t edges, const FreeBody& body, double thickness) {
  if (edges == 0 || !(body.longitudinal > 0)) return 1.0;
  const auto& nodes = model.shells.nodes[shell];
  const bool triangle = is_triangle(nodes);
  const ElementCoordinates<4> x = gather_coordinates(model.nodes.x, nodes);
  const Vec3 normal = normalized(cross(x[2] - x[0], x[3] - x[1]));
  const Vec3 along_r = (x[1] + x[2] - x[0] - x[3]) * 0.25, along_s = (x[2] + x[3] - x[0] - x[1]) * 0.25;
  const double jacobian = dot(cross(along_r, along_s), normal);
  const Vec3 grad_r = cross(along_s, normal) / jacobian, grad_s = cross(normal, along_r) / jacobian;
  Mat3 s;
  if (triangle) {
    const double share = share_of_all(edges, 3);
    const Vec3 b[3] = {(grad_r + grad_s) * -0.25, (grad_r - grad_s) * 0.25, grad_s * 0.5};
    for (const Vec3& gradient : b) s += outer(gradient, gradient) * (3 * share / body.density);
  } else {
    s = (outer(grad_r, grad_r) * share(edges, 1, 3) + outer(grad_s, grad_s) * share(edges, 0, 2)) * (1 / body.density);
  }
  if (trace(s) == 0) return 1.0;
  const double plane_lambda = 2 * body.shear * (body.longitudinal - 2 * body.shear) / body.longitudinal;
  const double area = shell_area(x), radius = std::max(thickness * thickness / 12, area / 8);
  // Transverse shear: grad w beside a rotation that all nodes share, with their rotary inertia.
  const double in_plane = largest_square(s, plane_lambda, body.shear, 2);
  const double across = body.transverse * (principal_axes(s).values[2] + 1 / (body.density * radius));
  const double speed = std::sqrt((plane_lambda + 2 * body.shear) / body.density);
  return factor(std::max(in_plane, across), shell_length(x, triangle, model.control.time_step.isdo), speed);
}

double free_solid_factor(const Model& model, Index solid, std::uint8_t faces_free, const FreeBody& body) {
  if (faces_free == 0) return 1.0;
  const auto& nodes = model.solids.nodes[solid];
  const ElementCoordinates<8> x = gather_coordinates(model.nodes.x, nodes);
  const int corners = distinct_nodes(nodes);
  constexpr double r[8] = {-1, 1, 1, -1, -1, 1, 1, -1}, s[8] = {-1, -1, 1, 1, -1, -1, 1, 1}, t[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
  Mat3 jacobian;
  for (std::size_t a = 0; a < 8; ++a) {
    jacobian[0] += x[a] * (0.125 * r[a]);
    jacobian[1] += x[a] * (0.125 * s[a]);
    jacobian[2] += x[a] * (0.125 * t[a]);
  }
  const Mat3 gradients = inverse(jacobian);  // columns: grad r, s, t
  Mat3 sum;
  if (corners == 8) {
    sum += outer(gradients.column(0), gradients.column(0)) * share(faces_free, 3, 5);
    sum += outer(gradients.column(1), gradients.column(1)) * share(faces_free, 2, 4);
    sum += outer(gradients.column(2), gradients.column(2)) * share(faces_free, 0, 1);
  } else {
    const double all = share_of_all(faces_free, corners == 4 ? 4 : 5);
    for (std::size_t a = 0; a < 8; ++a) {
      if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(a), nodes[a]) != nodes.begin() + static_cast<std::ptrdiff_t>(a)) continue;
      Vec3 b;
      for (std::size_t k = a; k < 8; ++k) {
        if (nodes[k] == nodes[a]) b += gradients * Vec3{0.125 * r[k], 0.125 * s[k], 0.125 * t[k]};
      }
      sum += outer(b, b) * (corners * all);
    }
  }
  const double square = largest_square(sum * (1 / body.density), body.longitudinal - 2 * body.shear, body.shear, 3);
  return factor(square, solid_length(x, nodes), std::sqrt(body.longitudinal / body.density));
}

}  // namespace kardan
