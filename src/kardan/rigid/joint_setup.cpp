#include "kardan/rigid/joint_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kardan {

namespace {

constexpr const char* keyword = "*CONSTRAINED_JOINT";

/// Highest point number each kind of joint uses.
int points_used(JointKind kind) {
  switch (kind) {
    case JointKind::spherical: return 2;
    case JointKind::locking: return 2;
    case JointKind::revolute: case JointKind::cylindrical: case JointKind::planar: case JointKind::universal:
    case JointKind::translational: case JointKind::screw: case JointKind::rack_and_pinion: case JointKind::gears:
    case JointKind::pulley: case JointKind::constant_velocity: return 4;
    case JointKind::rotational_motor: case JointKind::translational_motor: return 3;
  }
  return 6;
}

/// Body of the joint's odd (A) or even (B) points; none with an error where they are on no body or on several.
BodyIndex side_body(const Model& model, const State& state, const Joint& joint, int side, Diagnostics& diagnostics) {
  if (joint.points) {
    const PartIndex part = side == 0 ? joint.part_a : joint.part_b;
    const BodyIndex body = part == none ? none : state.bodies.of_part[part];
    if (body == none)
      diagnostics.error(fmt::format("joint {}: part {} is not a rigid body", joint.id, part == none ? 0 : model.parts[part].id),
                        "name a part with *MAT_RIGID", keyword);
    return body;
  }
  BodyIndex found = none;
  for (int i = side; i < 6; i += 2) {
    const NodeIndex n = joint.nodes[i];
    if (n == none) {
      if (i < points_used(joint.kind) && !(joint.kind == JointKind::cylindrical && i == 2)) {
        diagnostics.error(fmt::format("joint {} ({}): node N{} is missing", joint.id, to_string(joint.kind), i + 1),
                          "give the node", keyword);
        return none;
      }
      continue;
    }
    const BodyIndex body = state.nodes.body[n];
    if (body == none) {
      diagnostics.error(fmt::format("joint {} ({}): node N{} = {} belongs to no rigid body", joint.id, to_string(joint.kind),
                                    i + 1, model.nodes.id[n]),
                        "attach it to a rigid part with *CONSTRAINED_EXTRA_NODES_NODE", keyword);
      return none;
    }
    if (found != none && body != found) {
      diagnostics.error(fmt::format("joint {} ({}): node N{} = {} belongs to body {}, the nodes before it on this side to body {}",
                                    joint.id, to_string(joint.kind), i + 1, model.nodes.id[n], state.bodies.info[body].id,
                                    state.bodies.info[found].id),
                        "N1, N3, N5 belong to body A and N2, N4, N6 to body B", keyword);
      return none;
    }
    found = body;
  }
  if (found == none)
    diagnostics.error(fmt::format("joint {} ({}): no node for body {}", joint.id, to_string(joint.kind), side == 0 ? 'A' : 'B'),
                      "give N1 and N2", keyword);
  return found;
}

/// Sizes of the mechanisms: the diagonal of the box around the joints' nodes and the centres of each set of connected bodies.
void set_lengths(const Model& model, const State& state, JointSet& set) {
  std::vector<int> root(state.bodies.info.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const JointRuntime& j : set.joints) root[find(j.a)] = find(j.b);
  std::vector<Vec3> low(root.size(), Vec3{1e300, 1e300, 1e300}), high(root.size(), Vec3{-1e300, -1e300, -1e300});
  const auto include = [&](int r, const Vec3& x) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[r][i] = std::min(low[r][i], x[i]);
      high[r][i] = std::max(high[r][i], x[i]);
    }
  };
  for (const JointRuntime& j : set.joints) {
    const int r = find(j.a);
    for (const auto& [body, arm] : {std::pair{j.a, j.arm_a}, {j.b, j.arm_b}}) {
      const BodyMotion& m = state.bodies.motion[body];
      include(r, m.center);
      include(r, m.center + to_matrix(m.orientation) * arm);
    }
    const Joint& deck = model.joints[j.model_joint];
    for (std::size_t i = 0; i < 6; ++i) {
      if (deck.points && (i == 0 || norm((*deck.points)[i]) > 0)) include(r, (*deck.points)[i]);
      if (!deck.points && deck.nodes[i] != none) include(r, model.nodes.x[deck.nodes[i]]);
    }
  }
  double largest = 0;
  for (JointRuntime& j : set.joints) {
    const int r = find(j.a);
    j.length = norm(high[r] - low[r]);
    largest = std::max(largest, j.length);
  }
  // A mechanism in one point (everything at the joint) has no size of its own.
  for (JointRuntime& j : set.joints)
    if (!(j.length > 1e-9 * largest)) j.length = largest > 0 ? largest : 1.0;
}

}  // namespace

void setup_joints(const Model& model, const State& state, JointSet& set, Diagnostics& diagnostics) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    const BodyIndex a = side_body(model, state, joint, 0, diagnostics), b = side_body(model, state, joint, 1, diagnostics);
    if (a == none || b == none) continue;
    if (a == b) {
      diagnostics.error(fmt::format("joint {} ({}) has both sides on body {}", joint.id, to_string(joint.kind),
                                    state.bodies.info[a].id),
                        "the two bodies may have been merged: remove the joint or the merge", keyword);
      continue;
    }
    std::array<Vec3, 6> points{};
    for (int i = 0; i < 6; ++i)
      points[i] = joint.points ? (*joint.points)[i] : joint.nodes[i] == none ? Vec3{} : model.nodes.x[joint.nodes[i]];
    if (!joint.points) {
      // A cylindrical joint may leave out N3 (the axis is then that of N2-N4); unused points follow the first ones.
      if (joint.nodes[2] == none) points[2] = joint.nodes[3] == none ? points[0] : points[0] + (points[3] - points[1]);
      if (joint.nodes[3] == none) points[3] = points[1] + (points[2] - points[0]);
      for (int i = 4; i < 6; ++i)
        if (joint.nodes[i] == none) points[i] = points[i - 4];
    }
    append_joint(joint, static_cast<Index>(j), a, b, points, state, set, diagnostics);
  }
  set_lengths(model, state, set);
}

void find_redundant_joints(const Model& model, const State& state, JointSet& set, const BodySet& bodies, ExactJoints& exact,
                             Diagnostics& diagnostics) {
  if (set.joints.empty()) return;
  set.linearise(state, bodies);
  const std::vector<int> redundant = exact.find_redundant_rows(set, bodies);
  if (redundant.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(redundant.size(), 12); ++i) {
    const Joint& joint = model.joints[set.joints[redundant[i]].model_joint];
    names += fmt::format("{}{} ({})", i ? ", " : "", joint.id, to_string(joint.kind));
  }
  if (redundant.size() > 12) names += fmt::format(" and {} more", redundant.size() - 12);
  diagnostics.notice(fmt::format("redundant constraints: in the initial position joint{} {} repeat{} in part what other joints "
                                 "hold; the motion is not affected, the reactions are shared by least squares",
                                 redundant.size() > 1 ? "s" : "", names, redundant.size() > 1 ? "" : "s"), keyword);
}

void JointFailure::initialise(const Model& model, const JointSet& joints) {
  for (std::size_t j = 0; j < joints.joints.size(); ++j)
    if (model.joints[joints.joints[j].model_joint].failure) watched_.push_back(j);
}

const std::vector<Index>& JointFailure::check(const Model& model, const State& state, JointSet& joints,
                                              const BodySet& bodies, const std::vector<double>& force) {
  just_failed_.clear();
  for (std::size_t j : watched_) {
    if (joints.failed[j]) continue;
    const Index index = joints.joints[j].model_joint;
    const Joint::Failure& f = *model.joints[index].failure;
    const auto [n, m] = joints.resultant(bodies, j, force.data() + joints.offset[j]);
    const BodyIndex a = joints.joints[j].a;
    const Mat3 turned = bodies.rotation[a] * transpose(to_matrix(state.bodies.info[a].initial_orientation));
    const Mat3 axes = turned * (f.frame == none ? Mat3::identity() : model.frames[f.frame].axes);
    double by_force = 0, by_moment = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double nf = dot(axes.column(i), n), mf = dot(axes.column(i), m);
      if (f.limits[i] > 0) by_force += nf * nf / (f.limits[i] * f.limits[i]);
      if (f.limits[i + 3] > 0) by_moment += mf * mf / (f.limits[i + 3] * f.limits[i + 3]);
    }
    const bool fails = f.coupling > 0 ? by_force + by_moment >= 1 : by_force >= 1 || by_moment >= 1;
    if (fails || state.clock.time >= f.time) {
      joints.failed[j] = 1;
      just_failed_.push_back(index);
    }
  }
  return just_failed_;
}

}  // namespace kardan
