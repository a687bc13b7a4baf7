// The immutable description of what is simulated: plain typed structs, references resolved to indices, no keyword text.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/contact.hpp"
#include "kardan/model/control.hpp"
#include "kardan/model/curve.hpp"
#include "kardan/model/entities.hpp"
#include "kardan/model/initial_stress.hpp"
#include "kardan/model/loads.hpp"
#include "kardan/model/materials.hpp"
#include "kardan/model/rigid.hpp"
#include "kardan/model/rigid_wall.hpp"
#include "kardan/model/ties.hpp"

namespace kardan {

struct Model {
  std::string title;

  Nodes nodes;
  ShellElements shells;
  SolidElements solids;
  BeamElements beams;
  DiscreteElements discretes;
  std::vector<PointMass> masses;
  std::vector<PointInertia> inertias;

  std::vector<Part> parts;
  std::vector<Section> sections;
  std::vector<Material> materials;
  std::vector<Hourglass> hourglasses;
  std::vector<EquationOfState> equations_of_state;
  std::vector<ShellRule> shell_rules;

  std::vector<Curve> curves;
  std::vector<Table> tables;
  std::vector<Frame> frames;
  std::vector<DirectionVector> vectors;
  std::vector<SdOrientation> sd_orientations;
  std::vector<NodeSet> node_sets;
  std::vector<PartSet> part_sets;
  std::vector<SegmentSet> segment_sets;
  std::vector<ElementSet> element_sets;
  std::vector<CrossSection> cross_sections;

  std::vector<NodalRigidBody> nodal_rigid_bodies;
  std::vector<RigidBodyMerge> merges;
  std::vector<ExtraNodes> extra_nodes;
  std::vector<Joint> joints;
  std::vector<JointStiffness> joint_stiffnesses;
  std::vector<RigidBodyStopper> stoppers;

  std::vector<CommonMotion> common_motions;
  std::vector<RigidGroup> rigid_groups;
  std::vector<LinearEquation> linear_equations;
  std::vector<Interpolation> interpolations;

  std::vector<BodyLoad> body_loads;
  std::vector<PointLoad> point_loads;
  std::vector<PressureLoad> pressure_loads;
  std::vector<DampingLaw> dampings;
  std::vector<StiffnessDamping> stiffness_dampings;
  std::vector<NonReflectingBoundary> non_reflecting;
  std::vector<PrescribedMotion> prescribed_motions;
  std::vector<SinglePointConstraint> constraints;
  std::vector<InitialVelocity> initial_velocities;
  std::vector<InitialStress> initial_stresses;

  std::vector<RigidWall> rigid_walls;
  std::vector<Contact> contacts;
  std::vector<FrictionTable> friction_tables;

  Control control;
  OutputControl output;

  /// What the deck asks for and Kardan cannot compute (severity error): the model stands, `kardan check` reports it, and
  /// a run must refuse before its first cycle while this is not empty.
  std::vector<Diagnostic> unsupported;

  /// Part `p` is rigid (*MAT_RIGID).
  bool rigid_part(PartIndex p) const {
    const Index m = parts[static_cast<std::size_t>(p)].material;
    return m != none && materials[static_cast<std::size_t>(m)].rigid();
  }

  /// Part `p` moves as a rigid body: *MAT_RIGID, or the part that stands for a nodal rigid body.
  bool body_part(PartIndex p) const {
    return rigid_part(p) || parts[static_cast<std::size_t>(p)].nodal_rigid_body != none;
  }
};

}  // namespace kardan
