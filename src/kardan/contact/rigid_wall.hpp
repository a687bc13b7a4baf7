// Rigid walls (*RIGIDWALL_…): a perfectly plastic impact by the constraint method. Formulas: docs/theory/rigid-walls.md.
//
// Source: Hallquist, LS-DYNA Theory Manual 2006, "Rigid walls": a node that would pass the wall loses the velocity that takes it there.
// With r the position of a node at t_n, v its velocity after the kick, w the wall's for the step to t_{n+1}, u = v - w, the wall gives the
// node along one normal N (wall_shape.hpp) the least change c >= 0 of velocity with which it is not inside at t_{n+1}. The impulse is
// J = m c; friction takes from the tangential velocity u_t
//   min(|u_t|, mu c)  (Coulomb, 0 < mu < 1),  or all of it (mu = 1);
// orthotropic friction does so along each of its two directions. The force of the impulse over the kick is the wall's reaction at t_n.
//
// A wall of mass M that moves freely along its normal n (_MOVING) meets all of its nodes at once: with the impulses its velocity w' solves
//   M (w' - w) + sum m_i phi_i max(0, w' - b_i) = 0,   b_i = v_i.n + max(g_i, 0)/dt  the slowest wall that the node i stays ahead of,
// which is increasing and piecewise linear in w', so that Newton's method ends at the root after a few steps.
//
// RWFORC: the impulse that stops a node of mass m arriving at the speed v is the lumped mass's, and m v/dt, a peak of one cycle, says more
// about mesh and step than about the crash. What files show is the force without these arrivals, and their impulses handed out by a tenth of
// what is left each cycle: the integral over time remains the momentum that the wall took.
//
// Work: of the force F on a node, F.w goes to what drives the wall (external work; of a free wall its kinetic energy), the rest,
// -F.u, is what impact and friction take: stonewall energy.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/wall_penalty.hpp"
#include "kardan/contact/wall_segments.hpp"
#include "kardan/contact/wall_shape.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"
#include "kardan/state/work_meter.hpp"

namespace kardan {

class RigidWalls {
 public:
  /// Sizes state.walls; warns of nodes that begin inside their wall and, where RWPNAL is 0, of nodes of rigid bodies, which are not held. The
  /// bodies must stand in state.nodes.body and state.bodies, the lumped masses in state.nodes.mass.
  RigidWalls(const Model& model, State& state, Diagnostics& diagnostics);

  bool empty() const { return walls_.empty(); }
  /// At t_n: moves the walls there and adds the forces of penalty springs to those of bodies and nodes. `fastest`: largest speed of a free
  /// node in the drift before.
  void apply(const Model& model, State& state, double fastest);
  /// Remembers the velocities of the nodes near the walls. `fastest` as above.
  void before_kick(State& state, double fastest);
  /// Right after the free nodes were kicked: holds them back, with reactions at t_n in state.walls. `fastest`: an upper bound of
  /// the free nodes' speeds now.
  void hold(const Model& model, State& state, double fastest);
  /// After all constraints of the velocities: work up to t_n, that of driven walls into state.energy.external_work.
  void close_kick(State& state);
  /// Stonewall energy, kinetic energy of free walls and forces by segment at t_n.
  void account(State& state) const;
  /// Work begins anew (after a dynamic relaxation).
  void restart();

 private:
  enum Mark : std::uint8_t { behind = 1, welded = 2, listed = 4 };  ///< behind: gone round the edges, free while it is there

  /// A node held in this kick.
  struct Held {
    NodeIndex node;
    Vec3 force;           ///< on it
    double pressing;      ///< the part along the normal
    double arriving;      ///< the share of the force that stops the node's approach of before the kick
    double power_before;  ///< against the wall, with the velocities of before the kick
  };
  struct Wall {
    Wall(const Model& model, const RigidWall& wall) : description(wall), shape(wall), segments(model, wall) {}

    RigidWall description;            ///< its nodes: those held by the constraint method
    WallShape shape;
    WallSegments segments;
    Vec3 displacement;                ///< at t_n
    Vec3 velocity, velocity_before;   ///< to t_{n+1}, and of the drift before
    bool born = false, alive = false;
    Vec3 friction_axis;               ///< a of orthotropic friction
    std::vector<std::uint8_t> marks;  ///< by node
    std::vector<std::uint16_t> braked;  ///< by node, where SOFT is given: cycles of the impact so far

    /// Nodes that can be inside at t_{n+1}: positions in description.nodes, ascending. A node that is not listed was farther than `skin`
    /// from the wall when the list was made, and since then neither it nor the wall has moved by more than `travelled` in all.
    std::vector<std::uint32_t> near;
    std::vector<Vec3> v_before;       ///< of the near ones, before the kick
    double skin = -1, travelled = 0;

    std::vector<Held> held;
    WallPenalty penalty;
    double penalty_power = 0;         ///< with the velocities before the kick
    Vec3 force;                       ///< on all nodes
    Vec3 arrived;                     ///< impulse on arriving nodes that has not been handed out
    double arrived_normal = 0;        ///< the same along their normals
    WorkMeter loss, drive;
    double loss_now = 0, drive_counted = 0;
  };
  /// A node as the free wall meets it.
  struct Obstacle {
    double mass, threshold;
    bool welded;
  };

  void register_state(State& state, std::size_t wall);
  void share_nodes(const Model& model, const State& state, Wall& wall, Diagnostics& diagnostics) const;
  void bear(const Model& model, const State& state, Wall& wall) const;
  void list_near(const State& state, Wall& wall, double fastest);
  double margin(const Wall& wall) const { return wall.skin - wall.travelled; }
  Vec3 driven_velocity(const Model& model, const State& state, const Wall& wall) const;
  Vec3 free_velocity(const State& state, const Wall& wall);
  void hold_chunk(Wall& wall, std::size_t begin, std::size_t end, State& state, std::vector<Held>& held) const;
  static double arriving_share(const Wall& wall, double stopping, double pressing);
  static double braking_share(const Wall& wall, std::size_t k);
  static void sum_forces(Wall& wall, double kick, WallReport& report);
  static Vec3 rub(const Wall& wall, const Vec3& u, const Vec3& normal, double change);

  std::vector<Wall> walls_;
  double smallest_reach_ = 0;                        ///< see list_near
  std::vector<std::vector<Held>> chunk_held_;        ///< work space, by chunk
  std::vector<std::vector<std::uint32_t>> chunk_near_;
  std::vector<double> chunk_speed_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace kardan
