// Constrained and prescribed velocities of deformable nodes: TC/RC of *NODE, *BOUNDARY_SPC, *BOUNDARY_PRESCRIBED_MOTION.
//
// Each constraint is a row n . v(t_{n+1/2}) = s on the velocity, or the angular velocity, of one node. Rows of one node are
// imposed one after the other, each along the part d of n that is orthogonal to the rows before it,
//   v <- v + d (s - n . v) / (n . d),
// so that all of them hold whatever the angles between them; the impulse m d (s - n . v)/(n . d) is the row's reaction. A row
// that depends on those before it (|d|^2 <= 1e-12) is left out: what was given first holds.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"
#include "kardan/state/work_meter.hpp"

namespace kardan {

class NodeConstraints {
 public:
  /// Collects the constraints of nodes that belong to no body, appends their entries to state.reactions, registers the
  /// state of prescribed motions and takes velocities against constraints that hold at t = 0 out of state.nodes.
  NodeConstraints(const Model& model, State& state, Diagnostics& diagnostics);

  /// Remembers the velocities before the kick.
  void before_kick(const State& state);
  /// Imposes the rows on state.nodes.v and .omega; reactions at t_n into state.reactions.
  void impose(const Model& model, State& state);
  /// Work of the reactions up to t_n into state.reactions[].work; returns their sum.
  double account(State& state);
  /// Motions and work begin anew.
  void restart();

 private:
  /// What the direction n of a row is.
  enum class Axis : std::uint8_t {
    frame_axis,   ///< a column of the frame at t_n
    along_vector, ///< a *DEFINE_VECTOR
    across_vector,///< one of two normals of it
    tangent,      ///< of the circle about an axis parallel to a global one, at the angle of t_{n+1}
    radius        ///< of that circle, likewise; stands right behind its tangent
  };
  struct Row {
    std::size_t node = 0;      ///< into nodes_
    std::size_t report = 0;    ///< into reports_
    Index motion = none;       ///< into Model::prescribed_motions; none: held at zero
    Index frame = none;
    Axis axis = Axis::frame_axis;
    std::uint8_t component = 0;
    bool angular = false;
    bool still = false;        ///< held at zero although it belongs to a motion (DOF -4, -8)
    double birth = 0, death = 0;
  };
  /// What the prescribed motion of a row has done so far.
  struct MotionState {
    double rate = 0;           ///< velocity reached by the acceleration kind
    double travelled = 0;      ///< angle since birth
    double increment = 0;      ///< angle of the step to t_{n+1}
    double curve_offset = 0;   ///< ordinate at birth, 0 where birth = 0
    Vec3 reference;            ///< position at birth
    std::uint64_t born = 0;
  };
  struct Held {
    NodeIndex node = none;
    Vec3 v_before, omega_before;
  };
  struct Report {
    std::size_t node = 0;      ///< into nodes_
    std::size_t reaction = 0;  ///< into state.reactions
  };
  class Builder;

  Vec3 direction(const Model& model, const State& state, std::size_t row);
  double value(const Model& model, const State& state, std::size_t row, const Vec3& direction);
  double angle_increment(const Model& model, const State& state, std::size_t row);
  double curve_increment(const Model& model, const State& state, MotionState& s, const PrescribedMotion& motion,
                         double travelled) const;
  /// impose() of a node whose rows all hold it along global axes.
  void hold_still(State& state, std::size_t held);
  void give_birth(const Model& model, const State& state, std::size_t row);

  std::vector<Held> nodes_;
  std::vector<std::size_t> first_row_;     ///< of each held node, and the end
  std::vector<Row> rows_;                  ///< by held node, in the order of the deck
  std::vector<std::uint8_t> still_;        ///< by held node: all its rows hold it along global axes
  std::vector<MotionState> motion_state_;  ///< by row
  std::vector<Report> reports_;
  std::vector<WorkMeter> meters_;          ///< by report
};

}  // namespace kardan
