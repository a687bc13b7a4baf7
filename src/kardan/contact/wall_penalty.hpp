// Penalty springs between a rigid wall and nodes (RWPNAL of *CONTROL_CONTACT): those of rigid bodies, which the constraint method cannot hold
// one by one, and with RWPNAL < 0 all nodes.
//
// A node that is delta deep feels the force k delta N at t_n, N the outward normal at the nearest point of the surface: the gradient of
// k delta^2/2, which gives back what it took. Friction is a spring of the same stiffness k from where the node touched the wall; where
// its force exceeds mu k delta, that point is drawn along (Coulomb, as in plasticity).
//
// Stiffness. At one node of a body of mass M and principal inertias A, B, C, with the place (x, y, z) against the centre, unit forces along
// three axes move the node by the mobilities whose sum is
//   tau = 3/M + (y^2 + z^2)/A + (z^2 + x^2)/B + (x^2 + y^2)/C.
// Springs k_i in all directions at any set of the body's nodes have together a highest frequency omega with
//   omega^2 <= sum k_i tau_i                  (largest eigenvalue <= trace),
// and the leapfrog scheme is stable for omega dt < 2. So with the nodes' masses m_i as weights
//   k_i = 0.6 RWPNAL RWKSF m_i / (dt^2 sum m_j tau_j):   omega^2 dt^2 <= 0.6 RWPNAL RWKSF, however many nodes touch.
// Where the nodes' masses make up the body, the sum is 6 and k_i = 0.1 m_i/dt^2; of free nodes likewise (tau = 3/m, half of the bound). dt is that
// of the touch: a spring must not change while it is pressed, or it would not give back what it took. Only where the step has grown meanwhile by
// more than sqrt(3) the spring is made as soft as that allows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kardan/contact/wall_shape.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class WallPenalty {
 public:
  /// What a node feels at t_n.
  struct Push {
    NodeIndex node;
    BodyIndex body;   ///< none: a free node
    Vec3 arm;         ///< from the body's centre
    Vec3 place;       ///< against the wall's place at the start
    Vec3 force;       ///< on the node
    double pressing;  ///< the part along the normal
  };

  /// Of RWPNAL RWKSF: omega dt = sqrt(3) at the most, and beside the elements' own frequencies with TSSFAC = 0.9 (omega dt = 1.8) just stable.
  static constexpr double largest_scale = 5;

  /// `nodes`: ascending, of rigid bodies or free ones with mass; `scale`: RWPNAL RWKSF, positive.
  void initialise(const State& state, const std::vector<NodeIndex>& nodes, double scale);
  void register_state(Registry& registry, const std::string& name) {
    registry.add({name + ".springs", "force/length, length, 1", "contact.apply"}, springs_);
  }
  bool empty() const { return points_.empty(); }

  /// Nodes that are inside now may stay as deep as they are.
  void bear(const State& state, const WallShape& shape, const Vec3& displacement);
  /// Adds the forces at t_n to those of bodies and nodes. `friction`: Coulomb's coefficient, 1 = no sliding.
  void apply(State& state, const WallShape& shape, const Vec3& displacement, double friction);
  void let_go();

  const std::vector<Push>& pushes() const { return pushes_; }
  Vec3 force() const { return force_; }
  /// Power of the forces with the velocities now, those of nodes against `wall_velocity`.
  double power(const State& state, const Vec3& wall_velocity) const;

 private:
  struct Point {
    NodeIndex node;
    Vec3 place;     ///< of bodies: against the centre, in principal axes
    double weight;  ///< k dt^2
  };
  /// Points of one body, or of one free node.
  struct Group {
    BodyIndex body;
    std::size_t begin, end;
    double radius;  ///< of a sphere about the centre that holds all
  };
  enum Touch : std::uint64_t { apart, pressed, behind };
  struct Spring {
    double stiffness = 0;
    double free_depth = 0;       ///< depth without force: 0, or what the node began with
    Vec3 anchor;                 ///< where friction holds it, against the wall
    std::uint64_t touch = apart; ///< see Touch
  };

  template <class Skip, class F>
  void for_each_point(const State& state, Skip&& skip, F&& f) const;
  static void press(const Point& point, Spring& spring, const WallShape& shape, double friction, double dt, Push& push);

  std::vector<Point> points_;
  std::vector<Group> groups_;
  std::vector<Spring> springs_;  ///< by point
  std::vector<Push> pushes_;
  Vec3 force_;
};

}  // namespace kardan
