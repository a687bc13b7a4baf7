// *BOUNDARY, *INITIAL_VELOCITY, *LOAD.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Nodes of a field: one node, or those of a set.
std::vector<NodeIndex> nodes_of(Builder& b, const Card& card, std::string_view field, bool set) {
  if (set) return b.node_set(card, field);
  const NodeIndex n = b.node(card, field);
  return n == none ? std::vector<NodeIndex>{} : std::vector<NodeIndex>{n};
}

Vec3 velocity_of(const Card& card, const char* first_field) {
  return card.direction(first_field, dimension::velocity);
}
Vec3 angular_velocity_of(const Card& card, const char* first_field) {
  return card.direction(first_field, dimension::angular_velocity);
}

}  // namespace

void build_spc(Builder& b, Block& block) {
  static constexpr std::array<const char*, 6> dofs{"dofx", "dofy", "dofz", "dofrx", "dofry", "dofrz"};
  const bool set = block.keyword.ends_with("_SET"), limited = block.has("BIRTH_DEATH");
  while (!block.at_end()) {
    SinglePointConstraint spc;
    const Card head = block.next_if(block.has("ID"), "id");
    const Card card = block.next("card0");
    if (head.present()) spc.id = head.id("id", IdKind::other);
    spc.nodes = nodes_of(b, card, set ? "nsid" : "nid", set);
    spc.frame = b.optional_reference(card, "cid", b.frames);
    for (std::size_t i = 0; i < 6; ++i) {
      if (b.integer_in(card, dofs[i], 0, 1) == 1) spc.dofs = static_cast<std::uint8_t>(spc.dofs | 1u << i);
    }
    if (limited) {
      const Card times = block.next("birth_death");
      spc.birth = times.real("birth", dimension::time);
      spc.death = Builder::time_or(times, "death", 1e20);
    }
    if (!spc.nodes.empty() && spc.dofs != 0) b.model.constraints.push_back(std::move(spc));
  }
}

namespace {

/// DOF of *BOUNDARY_PRESCRIBED_MOTION; 0 where it is none that exists.
int motion_dof(const Card& card, bool rigid) {
  const std::int64_t dof = card.integer("dof"), size = std::abs(dof);
  const bool negative_allowed = size == 4 || size == 8 || size >= 9;
  if (size < 1 || size > 11 || (dof < 0 && !negative_allowed)) {
    card.error("dof",
               "found " + std::to_string(dof) +
                   ", expected 1-3 or 5-7 (axes), 4 or 8 with VID, or 9-11 (nodes only), "
                   "4 and 8 to 11 also negative",
               "correct the degree of freedom");
    return 0;
  }
  if (rigid && size >= 9) {
    card.error("dof", "found " + std::to_string(dof) + ", which is for nodes, not for rigid bodies", "use 5 to 8");
    return 0;
  }
  return static_cast<int>(dof);
}

void read_motion_extra(Builder& b, Block& block, PrescribedMotion& motion) {
  const Card extra = block.next_optional("card1");
  if (motion.kind == MotionKind::relative_displacement) {
    motion.lead_part = b.body(extra, "lrb");
    motion.lead_nodes = {b.optional_node(extra, "node1"), b.optional_node(extra, "node2")};
  }
  motion.offset_1 = extra.real("offset1", dimension::length);
  motion.offset_2 = extra.real("offset2", dimension::length);
}

}  // namespace

void replace_relative_motions(Builder& b) {
  std::vector<PrescribedMotion> others;
  for (PrescribedMotion& motion : b.model.prescribed_motions) {
    if (motion.kind != MotionKind::relative_displacement || motion.lead_part == none || motion.body_part == none) {
      others.push_back(std::move(motion));
      continue;
    }
    const Part& part = b.model.parts[static_cast<std::size_t>(motion.body_part)];
    const bool rotation = std::abs(motion.dof) >= 5;
    Joint motor;
    motor.id = motion.id;
    motor.title = "motion of body " + std::to_string(part.id) + " relative to body " +
                  std::to_string(b.model.parts[static_cast<std::size_t>(motion.lead_part)].id);
    motor.kind = rotation ? JointKind::rotational_motor : JointKind::translational_motor;
    motor.part_a = motion.lead_part;
    motor.part_b = motion.body_part;
    motor.motor_type = 2;
    Curve scaled = b.model.curves[static_cast<std::size_t>(motion.curve)];
    for (double& y : scaled.y) y *= motion.scale;
    motor.curve = static_cast<CurveIndex>(b.model.curves.size());
    b.model.curves.push_back(std::move(scaled));
    Vec3 direction;
    if (motion.lead_nodes[0] != none && motion.lead_nodes[1] != none) {
      direction = b.model.nodes.x[static_cast<std::size_t>(motion.lead_nodes[1])] -
                  b.model.nodes.x[static_cast<std::size_t>(motion.lead_nodes[0])];
    } else if (motion.vector != none) {
      const DirectionVector& v = b.model.vectors[static_cast<std::size_t>(motion.vector)];
      direction = v.head - v.tail;
    } else {
      direction[static_cast<std::size_t>(rotation ? motion.dof - 5 : motion.dof - 1)] = 1.0;
    }
    const Vec3 at = part.inertia ? part.inertia->center : Vec3{};
    motor.points = {at, at, at + direction, at + direction, at, at};
    b.diagnostics.notice(motor.title + " (VAD = 4) is held by a " + to_string(motor.kind) +
                             " between them; its force is in JNTFORC",
                         "*BOUNDARY_PRESCRIBED_MOTION_RIGID");
    b.model.joints.push_back(std::move(motor));
  }
  b.model.prescribed_motions = std::move(others);
}

void build_prescribed_motion(Builder& b, Block& block) {
  const bool rigid = block.keyword.find("_RIGID") != std::string::npos, set = block.keyword.ends_with("_SET");
  while (!block.at_end()) {
    PrescribedMotion motion;
    const Card head = block.next_if(block.has("ID"), "id");
    const Card card = block.next("card0");
    if (!card.present()) return;
    if (head.present()) motion.id = head.id("id", IdKind::other);
    if (rigid)
      motion.body_part = b.body(card, "typeid");
    else
      motion.nodes = nodes_of(b, card, "typeid", set);
    motion.local = block.has("LOCAL");
    motion.dof = motion_dof(card, rigid);
    motion.kind = static_cast<MotionKind>(b.integer_in(card, "vad", 0, 4));
    motion.curve = b.curve_or_constant(card, "lcid");
    motion.scale = Builder::real_or(card, "sf", 1.0);
    motion.birth = card.real("birth", dimension::time);
    motion.death = Builder::time_or(card, "death", 1e28);
    if (motion.death <= motion.birth) {
      card.warning("death", "is not later than the birth time: the motion never acts", "correct BIRTH or DEATH");
    }
    const int size = std::abs(motion.dof);
    if (!rigid &&
        (motion.kind == MotionKind::velocity_versus_displacement || motion.kind == MotionKind::relative_displacement)) {
      card.error("vad", "found " + card.text("vad") + ", which is for rigid bodies only", "use 0, 1 or 2");
    }
    if (motion.kind == MotionKind::relative_displacement && (motion.birth > 0 || motion.death < 1e20)) {
      b.unsupported(card, "vad", "a motion relative to another body that starts or ends during the run is not available",
                    "leave BIRTH and DEATH blank");
    }
    if (size == 4 || size == 8) {
      motion.vector = b.reference(card, "vid", b.vectors);
    } else if (card.id("vid", IdKind::define) < 0) {
      b.unsupported(card, "vid", "a motion along the axes of a coordinate system is not available",
                    "use DOF = 4 or 8 with a vector, or _RIGID_LOCAL");
    }
    if (size >= 9 || motion.kind == MotionKind::relative_displacement) read_motion_extra(b, block, motion);
    if (motion.dof != 0 && (rigid ? motion.body_part != none : !motion.nodes.empty())) {
      b.model.prescribed_motions.push_back(std::move(motion));
    }
  }
}

void build_initial_velocity(Builder& b, Block& block) {
  while (!block.at_end()) {
    InitialVelocity v;
    const Card card = block.next("card0");
    const Card values = block.next("card1");
    const UserId set = card.id("nsid", IdKind::set), box = card.id("boxid", IdKind::define);
    v.all_nodes = set == 0 && box == 0;
    if (set != 0) v.nodes = b.node_set(card, "nsid");
    if (box != 0) {
      const Index i = b.reference(card, "boxid", b.boxes);
      if (i != none) {
        const Box& bounds = b.box_list[at(i)];
        const auto outside = [&](NodeIndex n) {
          const Vec3& x = b.model.nodes.x[at(n)];
          for (std::size_t k = 0; k < 3; ++k)
            if (x[k] < bounds.low[k] || x[k] > bounds.high[k]) return true;
          return false;
        };
        if (set == 0) {
          v.nodes.resize(b.model.nodes.size());
          for (std::size_t n = 0; n < v.nodes.size(); ++n) v.nodes[n] = static_cast<NodeIndex>(n);
        }
        std::erase_if(v.nodes, outside);
      }
    }
    v.frame = b.optional_reference(card, "icid", b.frames);
    v.velocity = velocity_of(values, "vx");
    v.angular_velocity = angular_velocity_of(values, "vxr");
    if (card.id("nsidex", IdKind::set) != 0) {
      v.exempt = b.node_set(card, "nsidex");
      const Card exempted = block.next("exempted");
      v.exempt_velocity = velocity_of(exempted, "vxe");
      v.exempt_angular_velocity = angular_velocity_of(exempted, "vxre");
    }
    // IRIGID: 0 the velocities of *PART_INERTIA hold, -1 all, -2 nodal rigid bodies, > 0 a part set are overridden.
    const std::int64_t irigid = card.integer("irigid");
    v.include_rigid = irigid != 0;
    if (irigid > 0) {
      v.override_parts = b.part_set(card, "irigid");
    } else if (irigid == -2) {
      for (const NodalRigidBody& body : b.model.nodal_rigid_bodies) v.override_parts.push_back(body.part);
    } else if (irigid < -2) {
      card.error("irigid", "found " + std::to_string(irigid) + ", expected -2, -1, 0 or a part set",
                 "correct the value");
    }
    b.model.initial_velocities.push_back(std::move(v));
  }
}

void build_initial_velocity_node(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    InitialVelocity v;
    v.nodes = nodes_of(b, card, "nid", false);
    v.velocity = velocity_of(card, "vx");
    v.angular_velocity = angular_velocity_of(card, "vxr");
    v.frame = b.optional_reference(card, "icid", b.frames);
    v.include_rigid = false;
    b.model.initial_velocities.push_back(std::move(v));
  });
}

void build_initial_velocity_rigid(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    InitialVelocity v;
    v.kind = InitialVelocity::Kind::rigid_body;
    v.body_part = b.body(card, "pid");
    v.velocity = velocity_of(card, "vx");
    v.angular_velocity = angular_velocity_of(card, "vxr");
    v.frame = b.optional_reference(card, "icid", b.frames);
    if (v.body_part != none) b.model.initial_velocities.push_back(std::move(v));
  });
}

void build_initial_velocity_generation(Builder& b, Block& block) {
  while (!block.at_end()) {
    InitialVelocity v;
    v.kind = InitialVelocity::Kind::generation;
    const Card card = block.next("card0");
    const Card axis = block.next_optional("card1");
    const int type = b.integer_in(card, "styp", 1, 3);
    if (card.integer("id") == 0) {
      v.all_nodes = true;
    } else if (type == 1) {
      v.parts = b.part_set(card, "id");
    } else if (type == 2) {
      if (const PartIndex p = b.reference(card, "id", b.parts); p != none) v.parts = {p};
    } else {
      v.nodes = b.node_set(card, "id");
    }
    v.omega = card.real("omega", dimension::angular_velocity);
    v.velocity = velocity_of(card, "vx");
    v.frame = b.optional_reference(card, "icid", b.frames);
    v.axis_point = axis.point("xc");
    v.axis_direction = axis.direction("nx");
    v.include_rigid = b.integer_in(axis, "irigid", 0, 1) == 1;
    if (std::int64_t(axis.real("nx")) == -999) {
      // NX = -999: NY and NZ are two nodes on the axis.
      const NodeIndex tail = b.node(axis, "ny"), head = b.node(axis, "nz");
      if (tail != none && head != none) {
        v.axis_point = b.model.nodes.x[at(tail)];
        v.axis_direction = b.model.nodes.x[at(head)] - v.axis_point;
      }
    }
    if (v.omega != 0 && norm(v.axis_direction) == 0) {
      axis.error("nx", "OMEGA is given but the axis has no direction", "give NX, NY, NZ");
    }
    if (type != 3 && !v.all_nodes) {
      v.nodes = b.sets->nodes_of_parts(v.parts);
    }
    b.model.initial_velocities.push_back(std::move(v));
  }
}

void build_body_load_parts(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    for (const PartIndex p : b.part_set(card, "psid")) b.body_load_parts.push_back(p);
  });
}

void build_body_load(Builder& b, Block& block) {
  static constexpr std::array<std::string_view, 7> axes{"X", "Y", "Z", "RX", "RY", "RZ", "VECTOR"};
  const auto axis = std::find(axes.begin(), axes.end(),
                              std::string_view(block.keyword).substr(std::string_view("LOAD_BODY_").size()));
  if (axis == axes.end()) {
    b.unsupported(block, "a body load of this kind is not available", "use *LOAD_BODY_X … RZ with *LOAD_BODY_PARTS");
    return;
  }
  while (!block.at_end()) {
    BodyLoad load;
    const Card card = block.next("card0");
    load.axis = static_cast<int>(axis - axes.begin());
    load.curve = b.curve_or_constant(card, "lcid");
    load.scale = Builder::real_or(card, "sf", 1.0);
    load.center = card.point("xc");
    load.frame = b.optional_reference(card, "cid", b.frames);
    load.relaxation_curve = b.optional_curve(card, "lciddr");
    if (load.axis == 6) {
      const Card vector = block.next("card1");
      load.vector = vector.direction("v1");
      if (norm(load.vector) == 0) vector.error("v1", "the vector has no direction", "give V1, V2, V3");
    }
    b.model.body_loads.push_back(std::move(load));
  }
}

void build_point_load(Builder& b, Block& block) {
  const bool rigid = block.keyword == "LOAD_RIGID_BODY", set = block.keyword.ends_with("_SET");
  block.for_each("card0", [&](const Card& card) {
    PointLoad load;
    if (rigid)
      load.body_part = b.body(card, "pid");
    else
      load.nodes = nodes_of(b, card, set ? "nsid" : "nid", set);
    load.dof = b.integer_in(card, "dof", 1, 8);
    if (card.id("lcid", IdKind::curve) < 0) {
      b.unsupported(card, "lcid", "a load against the displacement (LCID < 0) is not available", "use a spring");
    } else {
      load.curve = b.curve_or_constant(card, "lcid");
    }
    load.scale = Builder::real_or(card, "sf", 1.0);
    load.frame = b.optional_reference(card, "cid", b.frames);
    if (load.dof == 4 || load.dof == 8) load.m = {b.node(card, "m1"), b.node(card, "m2"), b.node(card, "m3")};
    if (rigid ? load.body_part != none : !load.nodes.empty()) b.model.point_loads.push_back(std::move(load));
  });
}

}  // namespace kardan::deck
