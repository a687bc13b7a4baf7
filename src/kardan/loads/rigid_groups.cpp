// A group of nodes with masses m_i, rotary inertias I_i and arms r_i = x_i - c at t_n keeps the momenta that the kick gave the nodes,
//   M V = sum m_i v_i,     L = sum m_i r_i x v_i + sum I_i w_i,
// and turns by Hughes and Winget's rotation (1980): the displacement over the step is  dt w x r'_i  with the arm of its middle
//   r' = (1 - dt/2 [w])^-1 r = (r + a x r + a (a . r)) / (1 + a . a),     a = dt w/2,
// so that distances stay exactly. Because r' - r is parallel to the velocity about c, the angular momentum is J(r') w + sum I_i w, and w is
// its root, found by iteration. Source: the paper's eqs. (9)-(13), for a body that is made afresh of its nodes every cycle.
//
// The weld's force on node 1 is  f = m_1 (change of v_1) / k, k the length of the kick; its part along the line from node 1 to node 2 is
// the normal force f_n (tension positive), the rest the shear force f_s. Failure: Hallquist, LS-DYNA Keyword User's Manual,
// *CONSTRAINED_SPOTWELD:  (f_n/S_n)^N + (|f_s|/S_s)^M >= 1.
#include "kardan/loads/rigid_groups.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kardan/base/rotation.hpp"

namespace kardan {

namespace {

constexpr int most_iterations = 50;

/// J^-1 l. Nodes on one line without rotary inertia have no inertia about it, and l has no part along it: that part is left out.
Vec3 solve_inertia(const Mat3& j, const Vec3& l) {
  const double size = trace(j) / 3;
  if (determinant(j) > 1e-9 * size * size * size) return inverse(j) * l;
  const PrincipalAxes principal = principal_axes(j);
  const double largest = std::max({principal.values.x, principal.values.y, principal.values.z});
  Vec3 w;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 axis = principal.axes.column(i);
    if (principal.values[i] > 1e-9 * largest) w += axis * (dot(axis, l) / principal.values[i]);
  }
  return w;
}

/// A group as a body at t_n.
struct GroupMotion {
  Vec3 center, velocity, angular_momentum;
  double rotary_inertia = 0;

  GroupMotion(const NodeState& nodes, const std::vector<NodeIndex>& members) {
    double mass = 0;
    for (const NodeIndex n : members) {
      center += nodes.x[n] * nodes.mass[n];
      velocity += nodes.v[n] * nodes.mass[n];
      mass += nodes.mass[n];
    }
    center = center / mass;
    velocity = velocity / mass;
    for (const NodeIndex n : members) {
      angular_momentum += cross(nodes.x[n] - center, nodes.v[n]) * nodes.mass[n] + nodes.omega[n] * nodes.inertia[n];
      rotary_inertia += nodes.inertia[n];
    }
  }
};

Vec3 middle_arm(const Vec3& r, const Vec3& half_turn) {
  return (r + cross(half_turn, r) + half_turn * dot(half_turn, r)) / (1 + dot(half_turn, half_turn));
}

Vec3 angular_velocity(const NodeState& nodes, const std::vector<NodeIndex>& members, const GroupMotion& group, double dt) {
  Vec3 w;
  for (int i = 0; i < most_iterations; ++i) {
    Mat3 j = Mat3::identity() * group.rotary_inertia;
    for (const NodeIndex n : members) {
      const Vec3 r = middle_arm(nodes.x[n] - group.center, w * (0.5 * dt));
      j += (Mat3::identity() * dot(r, r) - outer(r, r)) * nodes.mass[n];
    }
    const Vec3 next = solve_inertia(j, group.angular_momentum);
    const double change = norm(next - w);
    w = next;
    if (change <= 1e-15 * norm(w)) break;
  }
  return w;
}

/// Force of a weld on its first node: along the line to the second, tension positive, and across it.
struct WeldForce {
  double normal, shear;

  WeldForce(const Vec3& force, const Vec3& line) {
    const double length = norm(line);
    const Vec3 along = length > 0 ? line / length : Vec3{};
    normal = dot(force, along);
    shear = norm(force - along * normal);
  }
  bool breaks(const RigidGroup::Failure& limit) const {
    double sum = 0;
    if (limit.normal > 0 && normal > 0) sum += std::pow(normal / limit.normal, limit.normal_exponent);
    if (limit.shear > 0) sum += std::pow(shear / limit.shear, limit.shear_exponent);
    return sum >= 1;
  }
};

void let_go(WeldReport& weld, double time) {
  if (!weld.failed) weld.failure_time = time;
  weld.failed = true;
}

}  // namespace

RigidGroups::RigidGroups(const Model& model, State& state, TakenDofs& taken, Diagnostics& diagnostics)
    : broken_(model.rigid_groups.size(), 0), report_(model.rigid_groups.size(), none) {
  constexpr const char* keyword = "*CONSTRAINED_…WELD, *DEFORMABLE_TO_RIGID";
  for (std::size_t i = 0; i < model.rigid_groups.size(); ++i) {
    const RigidGroup& group = model.rigid_groups[i];
    if (group.weld != RigidGroup::Weld::no && group.nodes.size() == 2) {
      report_[i] = static_cast<Index>(state.welds.size());
      WeldReport& weld = state.welds.emplace_back();
      weld.kind = group.weld == RigidGroup::Weld::spot ? WeldReport::Kind::constrained : WeldReport::Kind::generalized;
      weld.id = group.weld_id;
    }
    for (const NodeIndex n : group.nodes) taken.take(model, state, n, dof_all, group.name, keyword, diagnostics);
    if (group.failure && state.nodes.x[group.nodes[0]] == state.nodes.x[group.nodes[1]])
      diagnostics.error(group.name + " may fail but its nodes stand at one place: there is no normal",
                        "move the nodes apart, or leave SN and SS at 0", keyword);
  }
  if (!broken_.empty()) state.registry.add({"loads.broken_groups", "1", "loads.constrain_velocities"}, broken_);
}

void RigidGroups::impose(const Model& model, State& state) {
  NodeState& nodes = state.nodes;
  const double time = state.clock.time, dt = state.clock.dt, kick = state.clock.kick();
  for (std::size_t i = 0; i < broken_.size(); ++i) {
    const RigidGroup& group = model.rigid_groups[i];
    if (time < group.birth) continue;
    if (broken_[i] || time >= group.death) {
      if (report_[i] == none) continue;
      WeldReport& weld = state.welds[static_cast<std::size_t>(report_[i])];
      weld.axial = weld.shear = 0;  // the force that broke it was reported with the kick that did
      let_go(weld, group.death);
      continue;
    }
    const GroupMotion motion(nodes, group.nodes);
    const Vec3 w = angular_velocity(nodes, group.nodes, motion, dt);
    const NodeIndex first = group.nodes.front();
    const Vec3 v_first = nodes.v[first];
    for (const NodeIndex n : group.nodes) {
      nodes.v[n] = motion.velocity + cross(w, middle_arm(nodes.x[n] - motion.center, w * (0.5 * dt)));
      nodes.omega[n] = w;
    }
    if ((!group.failure && report_[i] == none) || kick <= 0) continue;
    const Vec3 line = nodes.x[group.nodes[1]] - nodes.x[first];
    const WeldForce force((nodes.v[first] - v_first) * (nodes.mass[first] / kick), line);
    if (report_[i] != none) {
      WeldReport& weld = state.welds[static_cast<std::size_t>(report_[i])];
      weld.axial = force.normal;
      weld.shear = force.shear;
      weld.length = norm(line);
    }
    if (!group.failure || !force.breaks(*group.failure)) continue;
    broken_[i] = 1;
    if (report_[i] != none) let_go(state.welds[static_cast<std::size_t>(report_[i])], time);
    spdlog::info("{} fails at t = {:.6g}", group.name, time);
  }
}

}  // namespace kardan
