#include "kardan/elements/node_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kardan {

std::vector<std::uint8_t> carried_nodes(const Model& model) {
  std::vector<std::uint8_t> carried(model.nodes.size(), 0);
  const auto mark = [&](const auto& nodes) {
    for (const NodeIndex n : nodes) {
      if (n != none) carried[n] = 1;
    }
  };
  const auto rigid_elements = [&](const auto& block) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      if (model.rigid_part(block.part[e])) mark(block.nodes[e]);
    }
  };
  rigid_elements(model.shells);
  rigid_elements(model.solids);
  rigid_elements(model.beams);
  for (const NodalRigidBody& body : model.nodal_rigid_bodies) mark(body.nodes);
  for (const ExtraNodes& extra : model.extra_nodes) mark(extra.nodes);
  for (const SinglePointConstraint& spc : model.constraints) {
    if ((spc.dofs & dof_translations) == dof_translations) mark(spc.nodes);
  }
  for (const PrescribedMotion& motion : model.prescribed_motions) mark(motion.nodes);
  for (std::size_t n = 0; n < carried.size(); ++n) {
    if ((model.nodes.constrained[n] & dof_translations) == dof_translations) carried[n] = 1;
  }
  return carried;
}

void StepBound::use(NodeIndex node) {
  if (load_of_node_[node] != none) return;
  load_of_node_[node] = static_cast<std::int32_t>(node_load_.size());
  node_load_.emplace_back();
}

void StepBound::begin(const State& state) {
  std::fill(node_load_.begin(), node_load_.end(), Load{});
  body_load_.assign(state.bodies.info.size(), Load{});
}

void StepBound::add(const State& state, NodeIndex node, double stiffness, double damping, Index element) {
  const BodyIndex b = state.nodes.body[node];
  Load& load = b == none ? node_load_[load_of_node_[node]] : body_load_[b];
  load.stiffness += stiffness;
  load.damping += damping;
  if (stiffness + damping > load.largest) {
    load.largest = stiffness + damping;
    load.element = element;
  }
}

StepBound::Smallest StepBound::smallest() const {
  Smallest best{std::numeric_limits<double>::infinity(), none};
  const auto consider = [&](const Load& load) {
    if (load.element == none) return;
    const double c = load.damping, k = load.stiffness;
    const double step = 4.0 / (c + std::sqrt(c * c + 4.0 * k));  // root of k dt^2/4 + c dt/2 = 1
    if (step < best.time_step) best = {step, load.element};
  };
  for (const Load& load : node_load_) consider(load);
  for (const Load& load : body_load_) consider(load);
  return best;
}

InverseMass largest_inverse_mass(const State& state, NodeIndex node) {
  const auto inverse = [](double m) { return m > 0 ? 1.0 / m : 0.0; };
  const BodyIndex b = state.nodes.body[node];
  if (b == none) return {inverse(state.nodes.mass[node]), inverse(state.nodes.inertia[node])};
  const BodyInfo& info = state.bodies.info[b];
  const Vec3& j = info.principal_inertia;
  const Vec3 arm = state.nodes.x[node] - state.bodies.motion[b].center;
  const double turning = inverse(std::min({j.x, j.y, j.z}));
  return {inverse(info.mass) + dot(arm, arm) * turning, turning};
}

}  // namespace kardan
