// Rigid walls: what nodes meet that is not meshed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// Friction of *RIGIDWALL_PLANAR_ORTHO, by the directions a and b = n x a of the plane:
/// mu = dynamic + (statical - dynamic) exp(-decay |v|).
struct OrthotropicFriction {
  std::array<double, 2> statical{}, dynamic{}, decay{};  ///< SFRICA, SFRICB, DFRICA, DFRICB; DECAYA, DECAYB [time/length]
  Vec3 direction{};                                      ///< D1, D2, D3: a is its projection on the plane
  NodeIndex node1 = none, node2 = none;                  ///< or from NODE1 to NODE2, as they move
};

/// *RIGIDWALL_PLANAR_…, *RIGIDWALL_GEOMETRIC_…. All walls can only be moved without turning.
struct RigidWall {
  enum class Shape : std::uint8_t { plane, prism, cylinder, sphere };

  UserId id = 0;
  std::string title;
  Shape shape = Shape::plane;
  /// Tail of the given vector: on the plane (the corner, where it is finite); the corner of the prism; on the cylinder's axis, in the middle
  /// of its top; the sphere's centre.
  Vec3 point{};
  Vec3 normal{};                     ///< unit: out of the plane to the nodes; out of the prism's top; the cylinder's axis, out of its top
  Vec3 edge_l{}, edge_m{};           ///< unit, of finite planes and prisms: l lies in the plane, m = n x l
  double length_l = 0, length_m = 0; ///< LENL, LENM: from the corner along l and m; 0 = infinite
  double length_p = 0;               ///< LENP of the prism, LENCYL of the cylinder: along -n; 0 = infinite
  double radius = 0;                 ///< RADCYL, RADSPH
  bool interior = false;             ///< the nodes are inside the cylinder

  double friction = 0;               ///< FRIC: 0 frictionless, below 1 Coulomb's coefficient, 1 no sliding
  bool welds = false;                ///< FRIC 2 (`friction` 0) and 3 (`friction` 1): nodes faster than …
  double weld_velocity = 0;          ///< … WVEL at impact stay on the wall
  std::optional<OrthotropicFriction> orthotropic;  ///< in place of `friction`
  double penalty_scale = 1;          ///< RWKSF
  double birth = 0, death = 1e20;

  double mass = 0;                   ///< MASS of _MOVING: the wall moves freely along its normal; 0 = it does not
  double velocity = 0;               ///< V0 of it
  CurveIndex motion = none;          ///< LCID of _MOTION, against the time since birth
  bool motion_is_displacement = false;  ///< OPT = 1
  Vec3 motion_direction{};           ///< unit

  int soft_cycles = 0;               ///< SOFT of _FORCES: cycles in which a node loses its relative velocity
  std::vector<std::array<NodeIndex, 4>> segments;  ///< SSID: areas the force is reported by; they move with the wall

  std::vector<NodeIndex> nodes;      ///< tracked: NSID without NSIDEX, in the box BOXID, within OFFSET

  bool finite_plane() const { return shape == Shape::plane && (length_l > 0 || length_m > 0); }
};

}  // namespace kardan
