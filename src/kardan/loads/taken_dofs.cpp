#include "kardan/loads/taken_dofs.hpp"

#include <cstdlib>

namespace kardan {

namespace {

std::uint8_t in_any_axes(std::uint8_t dofs) {
  std::uint8_t all = 0;
  if (dofs & dof_translations) all |= dof_translations;
  if (dofs & dof_rotations) all |= dof_rotations;
  return all;
}

std::uint8_t dofs_of(const PrescribedMotion& motion) {
  const int dof = std::abs(motion.dof);
  if (dof >= 1 && dof <= 3) return static_cast<std::uint8_t>(1u << (dof - 1));
  if (dof >= 5 && dof <= 7) return static_cast<std::uint8_t>(1u << (dof - 2));
  return dof == 8 ? dof_rotations : dof_translations;
}

}  // namespace

TakenDofs::TakenDofs(const Model& model) : bits_(model.nodes.constrained) {
  for (const SinglePointConstraint& spc : model.constraints) {
    const std::uint8_t dofs = spc.frame == none ? spc.dofs : in_any_axes(spc.dofs);
    for (const NodeIndex n : spc.nodes) bits_[n] |= dofs;
  }
  for (const PrescribedMotion& motion : model.prescribed_motions) {
    for (const NodeIndex n : motion.nodes) bits_[n] |= dofs_of(motion);
  }
}

bool TakenDofs::check(const Model& model, const State& state, NodeIndex n, std::uint8_t dofs, const std::string& what,
                      const char* keyword, Diagnostics& diagnostics) const {
  const std::string node = "node " + std::to_string(model.nodes.id[n]) + " of " + what;
  if (state.nodes.body[n] != none) {
    diagnostics.error(node + " belongs to a rigid body", "leave the node out, or make it an extra node of the body", keyword);
    return false;
  }
  if (state.nodes.mass[n] <= 0) {
    diagnostics.error(node + " has no mass", "use nodes of elements", keyword);
    return false;
  }
  if (bits_[n] & dofs) {
    diagnostics.error(node + " is held by a support, a prescribed motion or another constraint in the same direction",
                      "keep one of them", keyword);
    return false;
  }
  return true;
}

void TakenDofs::take(const Model& model, const State& state, NodeIndex n, std::uint8_t dofs, const std::string& what,
                     const char* keyword, Diagnostics& diagnostics) {
  if (check(model, state, n, dofs, what, keyword, diagnostics)) bits_[n] |= dofs;
}

}  // namespace kardan
