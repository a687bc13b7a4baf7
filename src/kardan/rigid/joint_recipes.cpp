// LS-DYNA's joints as recipes over the parts of joint_parts.hpp. Points by LS-DYNA's numbers: 1, 3, 5 in body A; 2, 4, 6 in
// body B (array index = number - 1).
//
//   spherical            point(1,2)
//   revolute             point, axes 1-3 and 2-4 parallel
//   cylindrical          axes parallel, point 2 on the line through 1
//   planar               normals 1-3 and 2-4 parallel, point 2 in the plane through 1
//   universal            point, axis 1-3 of A perpendicular to axis 2-4 of B
//   translational        axes parallel, no turn about them, point 2 on the line through 1
//   locking              point, no turn
//   rotational_motor     twist of B in A about axis 1-3 = target(t)
//   translational_motor  way of point 2 from point 1 along axis 1-3 = target(t)
//   gears                angle_A + s (R2/R1) angle_B = 0 about 1-3 and 2-4; s = 1 if the axes point the same way, else -1:
//                        the rims move together where the wheels touch
//   pulley               angle_A - s (R2/R1) angle_B = 0: the belt moves together
//   rack_and_pinion      way of the rack (2) from the pinion (1) along 2-4 = h (angle_A - angle_B) about 1-3
//   screw                way of the nut (2) from 1 along the axis = parameter (angle_A - angle_B)
//   constant_velocity    point, and the homokinetic condition e1.f2 = e2.f1 on the triads (e1 from 1-5, axis 1-3) of A and
//                        (f1 from 2-6, axis 2-4) of B: the rotation from A to B has no twist about the bisecting plane's
//                        normal (it is symmetric), so both shafts turn at the same rate at any angle between them
#include <fmt/format.h>

#include <cmath>

#include "kardan/rigid/joint_set.hpp"

namespace kardan {

namespace {

/// Gap of a node pair, relative to the joint's own size, up to which it is taken for rounding in the deck.
constexpr double rounding_gap = 1e-4;

class Recipe {
 public:
  Recipe(const Joint& joint, Index model_joint, BodyIndex a, BodyIndex b, const std::array<Vec3, 6>& points,
         const State& state, JointSet& set, Diagnostics& diagnostics)
      : joint_(joint), set_(set), diagnostics_(diagnostics), points_(points),
        rotation_a_(to_matrix(state.bodies.motion[a].orientation)),
        rotation_b_(to_matrix(state.bodies.motion[b].orientation)),
        center_a_(state.bodies.motion[a].center), center_b_(state.bodies.motion[b].center),
        orientation_a_(state.bodies.motion[a].orientation), orientation_b_(state.bodies.motion[b].orientation) {
    runtime_.a = a;
    runtime_.b = b;
    runtime_.model_joint = model_joint;
    runtime_.first_row = static_cast<int>(set.rows.size());
  }

  void append() {
    const std::size_t errors = diagnostics_.error_count();
    build();
    if (diagnostics_.error_count() > errors) return;
    runtime_.row_count = static_cast<int>(set_.rows.size()) - runtime_.first_row;
    runtime_.size = runtime_.point_rows() + runtime_.row_count;
    set_.joints.push_back(runtime_);
  }

 private:
  void build() {
    switch (joint_.kind) {
      case JointKind::spherical: coincident_point(); break;
      case JointKind::revolute: coincident_point(); parallel(common_axis()); break;
      case JointKind::cylindrical: line_points(); parallel(common_axis()); on_line(common_axis()); break;
      case JointKind::planar: line_points(); parallel(common_axis()); on_plane(common_axis()); break;
      case JointKind::universal: coincident_point(); perpendicular(); break;
      case JointKind::translational:
        line_points(); parallel(common_axis()); no_turn(common_axis()); on_line(common_axis()); break;
      case JointKind::locking: coincident_point(); no_relative_rotation(); break;
      case JointKind::rotational_motor: line_points(); twist_motor(axis(0, 2)); break;
      case JointKind::translational_motor: line_points(); way_motor(axis(0, 2)); break;
      case JointKind::gears: angle_coupling(1.0); break;
      case JointKind::pulley: angle_coupling(-1.0); break;
      case JointKind::rack_and_pinion: line_points(); rack(); break;
      case JointKind::screw: line_points(); screw(); break;
      case JointKind::constant_velocity: coincident_point(); homokinetic(); break;
    }
  }

  double extent() const {
    double size = 0;
    for (int i = 1; i < 6; ++i) size = std::max(size, norm(points_[i] - points_[0]));
    for (const Vec3& c : {center_a_, center_b_}) size = std::max(size, norm(c - points_[0]));
    return size;
  }

  std::string name() const { return fmt::format("joint {} ({})", joint_.id, to_string(joint_.kind)); }

  /// Unit vector from point i to point k; an error where they coincide.
  Vec3 axis(int i, int k) const {
    const Vec3 d = points_[k] - points_[i];
    const double length = norm(d);
    if (!(length > 1e-9 * extent())) {
      diagnostics_.error(fmt::format("{}: nodes N{} and N{} coincide, they must span an axis", name(), i + 1, k + 1),
                         "give two nodes apart from each other", "*CONSTRAINED_JOINT");
      return {1, 0, 0};
    }
    return d * (1.0 / length);
  }

  /// Axis 1-3 of A; the joint is held along the mean of it and axis 2-4 of B (they differ by rounding of the deck).
  Vec3 common_axis() const {
    const Vec3 a = axis(0, 2);
    Vec3 b = axis(1, 3);
    if (dot(a, b) < 0) b = -b;
    if (norm(cross(a, b)) > 1e-3)
      diagnostics_.warning(fmt::format("{}: axes N1-N3 and N2-N4 are {:.3g} degrees apart; held as they are at the mean axis",
                                       name(), std::asin(std::min(1.0, norm(cross(a, b)))) * 57.29577951308232),
                           "make the node pairs coincide", "*CONSTRAINED_JOINT");
    return normalized(a + b);
  }

  void set_points(const Vec3& p_a, const Vec3& p_b) {
    runtime_.arm_a = transpose(rotation_a_) * (p_a - center_a_);
    runtime_.arm_b = transpose(rotation_b_) * (p_b - center_b_);
  }

  void coincident_point() {
    const double gap = norm(points_[1] - points_[0]);
    if (gap > rounding_gap * extent())
      diagnostics_.warning(fmt::format("{}: nodes N1 and N2 should coincide but are {:.6g} apart; held at the point between "
                                       "them", name(), gap), "move the nodes together", "*CONSTRAINED_JOINT");
    const Vec3 middle = 0.5 * (points_[0] + points_[1]);
    runtime_.has_point = true;
    set_points(middle, middle);
  }

  void line_points() { set_points(points_[0], points_[1]); }

  ConstraintRow row(ConstraintRow::Kind kind, const Vec3& on_a, const Vec3& on_b) const {
    ConstraintRow r;
    r.kind = kind;
    r.axis_a = transpose(rotation_a_) * on_a;
    r.axis_b = transpose(rotation_b_) * on_b;
    return r;
  }
  void add(const ConstraintRow& r) { set_.rows.push_back(r); }
  void axis_axis(const Vec3& on_a, const Vec3& on_b) { add(row(ConstraintRow::Kind::axis_axis, on_a, on_b)); }
  void along(const Vec3& direction_on_a) {
    ConstraintRow r = row(ConstraintRow::Kind::axis_separation, direction_on_a, direction_on_a);
    r.constant = dot(direction_on_a, points_[1] - points_[0]);
    add(r);
  }

  static std::array<Vec3, 2> normals(const Vec3& axis) {
    const Vec3 helper = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 t = normalized(cross(axis, helper));
    return {t, cross(axis, t)};
  }

  void parallel(const Vec3& a) {
    for (const Vec3& t : normals(a)) axis_axis(t, a);
  }
  void on_line(const Vec3& a) {
    for (const Vec3& t : normals(a)) along(t);
  }
  void on_plane(const Vec3& normal) { along(normal); }
  void no_turn(const Vec3& a) {
    const auto t = normals(a);
    axis_axis(t[0], t[1]);
  }
  void no_relative_rotation() {
    axis_axis({1, 0, 0}, {0, 1, 0});
    axis_axis({0, 1, 0}, {0, 0, 1});
    axis_axis({0, 0, 1}, {1, 0, 0});
  }

  void perpendicular() {
    const Vec3 a = axis(0, 2);
    Vec3 b = axis(1, 3);
    const double overlap = dot(a, b);
    if (std::abs(overlap) > 0.99) {
      diagnostics_.error(fmt::format("{}: axes N1-N3 and N2-N4 are parallel; a universal joint needs them perpendicular",
                                     name()), "choose N3 on the axis of A's yoke and N4 on that of B's", "*CONSTRAINED_JOINT");
      return;
    }
    if (std::abs(overlap) > 1e-3)
      diagnostics_.warning(fmt::format("{}: axes N1-N3 and N2-N4 are {:.3g} degrees off the right angle; N2-N4 is turned "
                                       "into it", name(), std::asin(std::abs(overlap)) * 57.29577951308232),
                           {}, "*CONSTRAINED_JOINT");
    b = normalized(b - a * overlap);
    axis_axis(a, b);
  }

  void twist_motor(const Vec3& a) {
    ConstraintRow r = row(ConstraintRow::Kind::twist, a, a);
    r.relative = conjugate(orientation_a_) * orientation_b_;
    add(r);
  }
  void way_motor(const Vec3& a) { along(a); }

  void angle_coupling(double sense) {
    const Vec3 a = axis(0, 2), b = axis(1, 3);
    double ratio = joint_.parameter;
    if (ratio == 0) {
      const double r1 = joint_.radius_1 > 0 ? joint_.radius_1 : norm(points_[4] - points_[0]);
      const double r2 = norm(points_[5] - points_[1]);
      if (!(r1 > 0 && r2 > 0)) {
        diagnostics_.error(fmt::format("{}: neither the ratio R2/R1 (PARM) nor radii by nodes N5, N6 are given", name()),
                           "set PARM on card 2", "*CONSTRAINED_JOINT");
        return;
      }
      ratio = r2 / r1;
    }
    ConstraintRow r = row(ConstraintRow::Kind::coupling, a, b);
    r.k_a = 1.0;
    r.k_b = sense * (dot(a, b) < -0.5 ? -1.0 : 1.0) * ratio;
    add(r);
  }
  void rack() {
    ConstraintRow r = row(ConstraintRow::Kind::coupling, axis(0, 2), axis(1, 3));
    r.k_d = 1.0;
    r.k_a = -joint_.parameter;
    r.k_b = joint_.parameter;
    r.constant = dot(axis(1, 3), points_[1] - points_[0]);
    add(r);
  }
  void screw() {
    ConstraintRow r = row(ConstraintRow::Kind::coupling, common_axis(), common_axis());
    r.k_d = 1.0;
    r.k_a = -joint_.parameter;
    r.k_b = joint_.parameter;
    r.constant = dot(common_axis(), points_[1] - points_[0]);
    add(r);
  }

  void homokinetic() {
    const Vec3 a = axis(0, 2);
    Vec3 b = axis(1, 3);
    if (dot(a, b) < 0) b = -b;
    // Triads that differ by the shortest rotation from a to b: then e1.f2 = e2.f1 at t = 0 whatever nodes 5 and 6 are.
    const auto e = normals(a);
    const Vec3 v = cross(a, b);
    const Quat turn = normalized(Quat{1.0 + dot(a, b), v.x, v.y, v.z});
    const Mat3 shortest = to_matrix(turn);
    const Vec3 f1 = shortest * e[0], f2 = shortest * e[1];
    ConstraintRow r = row(ConstraintRow::Kind::axis_axis_pair, e[0], f2);
    r.axis_a2 = transpose(rotation_a_) * e[1];
    r.axis_b2 = transpose(rotation_b_) * f1;
    add(r);
  }

  const Joint& joint_;
  JointSet& set_;
  Diagnostics& diagnostics_;
  std::array<Vec3, 6> points_;
  Mat3 rotation_a_, rotation_b_;
  Vec3 center_a_, center_b_;
  Quat orientation_a_, orientation_b_;
  JointRuntime runtime_;
};

}  // namespace

void append_joint(const Joint& joint, Index model_joint, BodyIndex a, BodyIndex b, const std::array<Vec3, 6>& points,
                  const State& state, JointSet& set, Diagnostics& diagnostics) {
  Recipe(joint, model_joint, a, b, points, state, set, diagnostics).append();
}

}  // namespace kardan
