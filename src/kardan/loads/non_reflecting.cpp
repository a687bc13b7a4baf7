// Tractions  sigma = -rho c_p v_n,  tau = -rho c_s v_t  on the face of a half space (Lysmer and Kuhlemeyer 1969), rho c_p and rho c_s its
// impedances: a plane wave that meets the face at a right angle leaves; the more it slants, the more of it comes back. Each node has
// its share of the faces' areas, and with it a dashpot
//   C = sum A_a [rho c_p n n + rho c_s (1 - n n)].
// C k/m is about 2, so the half step matters: f = -C v_n with v_n the mean of v_{n-1/2} and v_{n+1/2} gives, as in damping.cpp,
//   f = -(1 + k C/(2 m))^-1 C (v_{n-1/2} + v*)/2,   v* the velocity after the kick without it.
#include "kardan/loads/non_reflecting.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>

#include "kardan/loads/pressure_loads.hpp"

namespace kardan {

namespace {

constexpr const char* keyword = "*BOUNDARY_NON_REFLECTING";

struct Impedances {
  double normal = 0, shear = 0;
};

/// rho c_p and rho c_s of an isotropic elastic solid: c_p^2 = E (1 - nu)/((1 + nu)(1 - 2 nu) rho), c_s^2 = G/rho.
std::optional<Impedances> impedances(const Material& material) {
  return std::visit(
      [](const auto& law) -> std::optional<Impedances> {
        if constexpr (requires { law.youngs_modulus, law.poissons_ratio, law.density; }) {
          const double e = law.youngs_modulus, nu = law.poissons_ratio;
          if (!(e > 0 && law.density > 0)) return std::nullopt;
          const double wave_modulus = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
          return Impedances{std::sqrt(law.density * wave_modulus), std::sqrt(law.density * 0.5 * e / (1 + nu))};
        } else {
          return std::nullopt;
        }
      },
      material.law);
}

/// The solids around each node.
std::vector<std::vector<Index>> solids_around(const Model& model) {
  std::vector<std::vector<Index>> around(model.nodes.size());
  for (std::size_t e = 0; e < model.solids.size(); ++e)
    for (const NodeIndex n : model.solids.nodes[e])
      if (n != none && (around[n].empty() || around[n].back() != static_cast<Index>(e))) around[n].push_back(static_cast<Index>(e));
  return around;
}

Index solid_behind(const Model& model, const std::vector<std::vector<Index>>& around, const std::array<NodeIndex, 4>& face) {
  for (const Index e : around[face[0]]) {
    const auto& nodes = model.solids.nodes[e];
    const auto has = [&](NodeIndex n) { return std::find(nodes.begin(), nodes.end(), n) != nodes.end(); };
    if (std::all_of(face.begin(), face.end(), has)) return e;
  }
  return none;
}

}  // namespace

NonReflecting::NonReflecting(const Model& model, const State& state, Diagnostics& diagnostics) {
  if (model.non_reflecting.empty()) return;
  const auto around = solids_around(model);
  std::vector<Index> place(model.nodes.size(), none);
  for (const NonReflectingBoundary& boundary : model.non_reflecting) {
    for (const auto& segment : boundary.segments) {
      const Index e = solid_behind(model, around, segment);
      const bool rigid = std::any_of(segment.begin(), segment.end(), [&](NodeIndex n) { return state.nodes.body[n] != none; });
      if (e == none || rigid) {
        diagnostics.error("the segment with node " + std::to_string(model.nodes.id[segment[0]]) + " is not the face of a deformable solid",
                          "use faces of solids of a deformable part", keyword);
        return;
      }
      const Material& material = model.materials[model.parts[model.solids.part[e]].material];
      const auto waves = impedances(material);
      if (!waves) {
        diagnostics.error("material " + std::to_string(material.id) + " of a non-reflecting face has no elastic wave speeds",
                          "use a material with E and PR", keyword);
        return;
      }
      Face face;
      face.normal_impedance = boundary.dilatational ? waves->normal : 0;
      face.shear_impedance = boundary.shear ? waves->shear : 0;
      for (std::size_t k = 0; k < 4; ++k) {
        Index& at = place[segment[k]];
        if (at == none) {
          at = static_cast<Index>(nodes_.size());
          nodes_.push_back(segment[k]);
        }
        face.nodes[k] = static_cast<std::size_t>(at);
      }
      faces_.push_back(face);
    }
  }
  v_before_.resize(nodes_.size());
  damping_.resize(nodes_.size());
  force_.resize(nodes_.size());
}

void NonReflecting::before_kick(const State& state) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) v_before_[i] = state.nodes.v[nodes_[i]];
}

double NonReflecting::apply(State& state) {
  std::fill(damping_.begin(), damping_.end(), Mat3{});
  for (const Face& face : faces_) {
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = state.nodes.x[nodes_[face.nodes[k]]];
    const std::array<Vec3, 4> areas = nodal_areas(x);
    const Vec3 n = normalized(areas[0] + areas[1] + areas[2] + areas[3]);
    const Mat3 normal = outer(n, n), across = Mat3::identity() - normal;
    const Mat3 impedance = normal * face.normal_impedance + across * face.shear_impedance;
    for (std::size_t k = 0; k < 4; ++k) damping_[face.nodes[k]] += impedance * dot(areas[k], n);
  }
  const double kick = state.clock.kick();
  double power = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const NodeIndex n = nodes_[i];
    if (state.nodes.mass[n] <= 0) continue;  // tied to a segment, which has its mass
    const double half = 0.5 * kick / state.nodes.mass[n];
    const Vec3 middle = (v_before_[i] + state.nodes.v[n]) * 0.5;
    force_[i] = -(inverse(Mat3::identity() + damping_[i] * half) * (damping_[i] * middle));
    state.nodes.v[n] += force_[i] * (2 * half);
    power += dot(force_[i], v_before_[i]);
  }
  return power;
}

double NonReflecting::power(const State& state) const {
  double power = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) power += dot(force_[i], state.nodes.v[nodes_[i]]);
  return power;
}

}  // namespace kardan
