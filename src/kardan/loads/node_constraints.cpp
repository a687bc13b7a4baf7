#include "kardan/loads/node_constraints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>

#include "kardan/base/rotation.hpp"
#include "kardan/state/frames.hpp"
#include "kardan/state/load_curve.hpp"

namespace kardan {

namespace {

constexpr int along_vector_dof = 4, about_vector_dof = 8, first_axis_dof = 9, last_axis_dof = 11;

/// Two unit vectors normal to the unit vector e and to each other.
std::pair<Vec3, Vec3> normals(const Vec3& e) {
  const Vec3 helper = std::abs(e.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 a = normalized(cross(e, helper));
  return {a, cross(e, a)};
}

/// Unit vector of the axis of DOF 9-11, and the arm of x from it.
std::pair<Vec3, Vec3> axis_and_arm(const PrescribedMotion& m, const Vec3& x) {
  const auto k = static_cast<std::size_t>(std::abs(m.dof) - first_axis_dof);
  Vec3 e, point;
  e[k] = 1;
  point[(k + 1) % 3] = m.offset_1;
  point[(k + 2) % 3] = m.offset_2;
  Vec3 arm = x - point;
  arm[k] = 0;
  return {e, arm};
}

/// Directions of one node that are held already, orthonormal: linear and angular ones apart.
class HeldDirections {
 public:
  /// The part of n orthogonal to what is held; zero if n depends on it. It is held from now on.
  Vec3 add(bool angular, const Vec3& n) {
    Vec3 d = n;
    auto& basis = basis_[angular];
    int& count = count_[angular];
    for (int i = 0; i < count; ++i) d -= basis[i] * dot(basis[i], d);
    const double length2 = dot(d, d);
    if (length2 <= 1e-12) return {};
    basis[count++] = d * (1.0 / std::sqrt(length2));
    return d;
  }

 private:
  std::array<std::array<Vec3, 3>, 2> basis_;
  std::array<int, 2> count_{};
};

}  // namespace

/// Collects rows node by node.
class NodeConstraints::Builder {
 public:
  Builder(NodeConstraints& target, const Model& model, State& state, Diagnostics& diagnostics)
      : t_(target), model_(model), state_(state), diagnostics_(diagnostics), held_of_(model.nodes.size(), absent) {}

  void fixed(NodeIndex n, std::uint8_t dofs, const SinglePointConstraint* spc) {
    if (dofs == 0 || state_.nodes.body[n] != none) return;
    Row row = start(n, spc ? spc->id : 0, ReactionReport::Kind::single_point_constraint);
    row.frame = spc ? spc->frame : none;
    row.birth = spc ? spc->birth : 0;
    row.death = spc ? spc->death : 1e28;
    for (std::uint8_t d = 0; d < 6; ++d) {
      if ((dofs >> d & 1) == 0) continue;
      row.component = d % 3;
      row.angular = d >= 3;
      t_.rows_.push_back(row);
    }
    need_frame(model_, state_, row.frame);
  }

  void motion(Index index) {
    const PrescribedMotion& m = model_.prescribed_motions[index];
    if (m.body_part != none || !valid(m)) return;
    need_vector(model_, state_, m.vector);
    for (const NodeIndex n : m.nodes) {
      if (state_.nodes.body[n] == none) motion_of_node(index, m, n);
    }
  }

  /// Brings the rows of a node together, in the order they were given.
  void finish() {
    std::vector<std::size_t> count(t_.nodes_.size() + 1, 0);
    for (const Row& row : t_.rows_) ++count[row.node + 1];
    std::partial_sum(count.begin(), count.end(), count.begin());
    t_.first_row_ = count;
    std::vector<Row> sorted(t_.rows_.size());
    for (const Row& row : t_.rows_) sorted[count[row.node]++] = row;
    t_.rows_ = std::move(sorted);
    t_.still_.assign(t_.nodes_.size(), 1);
    for (const Row& row : t_.rows_) {
      if (row.motion != none || row.frame != none) t_.still_[row.node] = 0;
    }
    t_.motion_state_.assign(t_.rows_.size(), MotionState{});
    t_.meters_.assign(t_.reports_.size(), WorkMeter{});
  }

 private:
  static constexpr std::size_t absent = static_cast<std::size_t>(-1);

  Row start(NodeIndex n, UserId id, ReactionReport::Kind kind) {
    std::size_t& held = held_of_[n];
    if (held == absent) {
      held = t_.nodes_.size();
      t_.nodes_.push_back({n, {}, {}});
      state_.nodes.needed[n] = 1;
    }
    Row row;
    row.node = held;
    row.report = t_.reports_.size();
    t_.reports_.push_back({held, state_.reactions.size()});
    ReactionReport report;
    report.kind = kind;
    report.id = id;
    report.node = n;
    state_.reactions.push_back(report);
    return row;
  }

  void motion_of_node(Index index, const PrescribedMotion& m, NodeIndex n) {
    const int dof = std::abs(m.dof);
    if (dof >= first_axis_dof && norm(axis_and_arm(m, model_.nodes.x[n]).second) == 0) {
      diagnostics_.error("node " + std::to_string(model_.nodes.id[n]) + " lies on the axis that DOF " +
                             std::to_string(m.dof) + " turns it about",
                         "leave the node out, or hold it by *BOUNDARY_SPC", keyword);
      return;
    }
    Row row = start(n, m.id, ReactionReport::Kind::motion_of_node);
    row.motion = index;
    row.birth = m.birth;
    row.death = m.death;
    row.angular = dof > along_vector_dof && dof <= about_vector_dof;
    row.component = static_cast<std::uint8_t>((dof - 1) % 4);
    if (dof == along_vector_dof || dof == about_vector_dof) {
      row.axis = Axis::along_vector;
      t_.rows_.push_back(row);
      row.axis = Axis::across_vector;
      row.still = true;
      for (row.component = 0; m.dof < 0 && row.component < 2; ++row.component) t_.rows_.push_back(row);
    } else if (dof >= first_axis_dof) {
      row.axis = Axis::tangent;
      t_.rows_.push_back(row);
      row.axis = Axis::radius;
      if (m.dof < 0) t_.rows_.push_back(row);
    } else {
      t_.rows_.push_back(row);
    }
  }

  bool valid(const PrescribedMotion& m) {
    const int dof = std::abs(m.dof);
    const std::string which = "the prescribed motion " + (m.id != 0 ? std::to_string(m.id) + " " : std::string());
    if (dof < 1 || dof > last_axis_dof || (m.dof < 0 && dof < first_axis_dof && dof != 4 && dof != 8)) {
      diagnostics_.error(which + "has DOF = " + std::to_string(m.dof), "give one of 1-11, -4, -8, -9, -10, -11", keyword);
    } else if ((dof == along_vector_dof || dof == about_vector_dof) && m.vector == none) {
      diagnostics_.error(which + "has DOF = " + std::to_string(m.dof) + " and no vector", "give VID", keyword);
    } else if (m.kind == MotionKind::relative_displacement) {
      diagnostics_.error(which + "of nodes has VAD = 4, which is for rigid bodies", "use *BOUNDARY_PRESCRIBED_MOTION_RIGID",
                         keyword);
    } else if (m.curve == none) {
      diagnostics_.error(which + "has no curve", "give LCID", keyword);
    } else {
      return true;
    }
    return false;
  }

  static constexpr const char* keyword = "*BOUNDARY_PRESCRIBED_MOTION";

  NodeConstraints& t_;
  const Model& model_;
  State& state_;
  Diagnostics& diagnostics_;
  std::vector<std::size_t> held_of_;  ///< by node of the model
};

NodeConstraints::NodeConstraints(const Model& model, State& state, Diagnostics& diagnostics) {
  Builder builder(*this, model, state, diagnostics);
  for (std::size_t n = 0; n < model.nodes.constrained.size(); ++n) {
    builder.fixed(static_cast<NodeIndex>(n), model.nodes.constrained[n], nullptr);
  }
  for (const SinglePointConstraint& spc : model.constraints) {
    for (const NodeIndex n : spc.nodes) builder.fixed(n, spc.dofs, &spc);
  }
  for (std::size_t m = 0; m < model.prescribed_motions.size(); ++m) builder.motion(static_cast<Index>(m));
  builder.finish();
  state.registry.add({"loads.motions", "mixed", "loads.constrain_velocities"}, motion_state_);
  state.registry.add({"loads.reaction_work", "energy", "loads.account"}, meters_);
  if (!diagnostics.ok()) return;
  // A velocity against a support is no motion that could ever be: it goes before the first energy is counted.
  for (std::size_t h = 0; h < nodes_.size(); ++h) {
    HeldDirections held;
    for (std::size_t r = first_row_[h]; r < first_row_[h + 1]; ++r) {
      const Row& row = rows_[r];
      if (row.motion != none || row.birth > 0) continue;
      const Vec3 d = held.add(row.angular, direction(model, state, r));
      const double length2 = dot(d, d);
      Vec3& v = (row.angular ? state.nodes.omega : state.nodes.v)[nodes_[h].node];
      if (length2 > 0) v -= d * (dot(d, v) / length2);
    }
  }
}

void NodeConstraints::before_kick(const State& state) {
  for (Held& h : nodes_) {
    h.v_before = state.nodes.v[h.node];
    h.omega_before = state.nodes.omega[h.node];
  }
}

Vec3 NodeConstraints::direction(const Model& model, const State& state, std::size_t r) {
  const Row& row = rows_[r];
  switch (row.axis) {
    case Axis::frame_axis:
      return frame_axes(model, state, row.frame).column(row.component);
    case Axis::along_vector:
      return vector_direction(model, state, model.prescribed_motions[row.motion].vector);
    case Axis::across_vector: {
      const auto [a, b] = normals(vector_direction(model, state, model.prescribed_motions[row.motion].vector));
      return row.component == 0 ? a : b;
    }
    case Axis::tangent:
    case Axis::radius:
      break;
  }
  const bool tangent = row.axis == Axis::tangent;
  const auto [e, arm] = axis_and_arm(model.prescribed_motions[row.motion], state.nodes.x[nodes_[row.node].node]);
  const double turn = tangent ? angle_increment(model, state, r) : motion_state_[r - 1].increment;
  const Vec3 radial = to_matrix(from_rotation_vector(e * turn)) * normalized(arm);
  return tangent ? cross(e, radial) : radial;
}

void NodeConstraints::give_birth(const Model& model, const State& state, std::size_t r) {
  const Row& row = rows_[r];
  MotionState& s = motion_state_[r];
  const PrescribedMotion& m = model.prescribed_motions[row.motion];
  const NodeIndex n = nodes_[row.node].node;
  s.born = 1;
  s.reference = state.nodes.x[n];
  // A displacement that begins later is counted from the position at birth, so that the node does not jump.
  s.curve_offset = m.birth > 0 ? m.scale * load_curve_value(model, state.clock, m.curve) : 0.0;
  if (row.axis == Axis::tangent) {
    const auto [e, arm] = axis_and_arm(m, s.reference);
    s.rate = dot(cross(e, arm), nodes_[row.node].v_before) / dot(arm, arm);
  } else if (row.axis == Axis::frame_axis || row.axis == Axis::along_vector) {
    s.rate = dot(direction(model, state, r), row.angular ? nodes_[row.node].omega_before : nodes_[row.node].v_before);
  }
}

double NodeConstraints::curve_increment(const Model& model, const State& state, MotionState& s, const PrescribedMotion& m,
                                        double travelled) const {
  const Clock& clock = state.clock;
  switch (m.kind) {
    case MotionKind::velocity:
      return m.scale * load_curve_value(model, clock, m.curve, clock.time + 0.5 * clock.dt) * clock.dt;
    case MotionKind::acceleration:
      s.rate += m.scale * load_curve_value(model, clock, m.curve) * clock.kick();
      return s.rate * clock.dt;
    case MotionKind::displacement:
      return m.scale * load_curve_value(model, clock, m.curve, clock.time + clock.dt) - s.curve_offset - travelled;
    case MotionKind::velocity_versus_displacement:
      return m.scale * load_curve_value(model, clock, m.curve, travelled) * clock.dt;
    case MotionKind::relative_displacement:
      break;
  }
  KARDAN_ASSERT(false);
}

double NodeConstraints::angle_increment(const Model& model, const State& state, std::size_t r) {
  MotionState& s = motion_state_[r];
  if (s.born == 0) give_birth(model, state, r);
  s.increment = curve_increment(model, state, s, model.prescribed_motions[rows_[r].motion], s.travelled);
  s.travelled += s.increment;
  return s.increment;
}

double NodeConstraints::value(const Model& model, const State& state, std::size_t r, const Vec3& n) {
  const Row& row = rows_[r];
  if (row.motion == none || row.still) return 0.0;
  const Vec3& x = state.nodes.x[nodes_[row.node].node];
  const double dt = state.clock.dt;
  if (row.axis == Axis::tangent || row.axis == Axis::radius) {
    // The node ends on the ray at the prescribed angle (n is its normal) and, on the radius row, at the same distance.
    const Vec3 arm = axis_and_arm(model.prescribed_motions[row.motion], x).second;
    return ((row.axis == Axis::radius ? norm(arm) : 0.0) - dot(n, arm)) / dt;
  }
  if (row.angular) return angle_increment(model, state, r) / dt;
  MotionState& s = motion_state_[r];
  if (s.born == 0) give_birth(model, state, r);
  return curve_increment(model, state, s, model.prescribed_motions[row.motion], dot(n, x - s.reference)) / dt;
}

void NodeConstraints::impose(const Model& model, State& state) {
  for (const Report& report : reports_) {
    state.reactions[report.reaction].force = {};
    state.reactions[report.reaction].moment = {};
  }
  const double time = state.clock.time, kick = state.clock.kick();
  for (std::size_t h = 0; h < nodes_.size(); ++h) {
    if (still_[h]) {
      hold_still(state, h);
      continue;
    }
    const NodeIndex node = nodes_[h].node;
    HeldDirections held;
    for (std::size_t r = first_row_[h]; r < first_row_[h + 1]; ++r) {
      const Row& row = rows_[r];
      if (time < row.birth || time > row.death) continue;
      const Vec3 n = direction(model, state, r);
      const double wanted = value(model, state, r, n);
      const Vec3 d = held.add(row.angular, n);
      if (d == Vec3{}) continue;
      Vec3& v = (row.angular ? state.nodes.omega : state.nodes.v)[node];
      const Vec3 change = d * ((wanted - dot(n, v)) / dot(n, d));
      v += change;
      ReactionReport& reaction = state.reactions[reports_[row.report].reaction];
      if (row.angular) {
        reaction.moment += change * (state.nodes.inertia[node] / kick);
      } else {
        reaction.force += change * (state.nodes.mass[node] / kick);
      }
    }
  }
}

void NodeConstraints::hold_still(State& state, std::size_t h) {
  const double time = state.clock.time, kick = state.clock.kick();
  const NodeIndex node = nodes_[h].node;
  const double mass = state.nodes.mass[node] / kick, inertia = state.nodes.inertia[node] / kick;
  for (std::size_t r = first_row_[h]; r < first_row_[h + 1]; ++r) {
    const Row& row = rows_[r];
    if (time < row.birth || time > row.death) continue;
    double& v = (row.angular ? state.nodes.omega : state.nodes.v)[node][row.component];
    ReactionReport& reaction = state.reactions[reports_[row.report].reaction];
    (row.angular ? reaction.moment : reaction.force)[row.component] -= v * (row.angular ? inertia : mass);
    v = 0;
  }
}

void NodeConstraints::restart() {
  std::fill(motion_state_.begin(), motion_state_.end(), MotionState{});
  std::fill(meters_.begin(), meters_.end(), WorkMeter{});
}

double NodeConstraints::account(State& state) {
  double work = 0;
  for (std::size_t i = 0; i < reports_.size(); ++i) {
    ReactionReport& reaction = state.reactions[reports_[i].reaction];
    const Held& h = nodes_[reports_[i].node];
    meters_[i].before(dot(reaction.force, h.v_before) + dot(reaction.moment, h.omega_before));
    reaction.work = meters_[i].after(
        dot(reaction.force, state.nodes.v[h.node]) + dot(reaction.moment, state.nodes.omega[h.node]), state.clock);
    work += reaction.work;
  }
  return work;
}

}  // namespace kardan
