#include "kardan/rigid/body_set.hpp"

#include <utility>

namespace kardan {

namespace {

/// R diag(d) R^T.
Mat3 rotated_diagonal(const Mat3& r, const Vec3& d) {
  Mat3 a;
  for (int i = 0; i < 3; ++i) {
    const Vec3 row{r[i].x * d.x, r[i].y * d.y, r[i].z * d.z};
    for (int j = 0; j <= i; ++j) a[i][j] = a[j][i] = dot(row, r[j]);
  }
  return a;
}

Vec3 times_transposed(const Mat3& r, const Vec3& a) { return r[0] * a.x + r[1] * a.y + r[2] * a.z; }

/// J w + (h/2) w x J w = momentum on the complement of the prescribed directions, all in global components.
Vec3 constrained_angular_velocity(const BodyConstraint& constraint, const Mat3& mobility, const Mat3& inertia,
                                  const Vec3& momentum, double h) {
  const Vec3 prescribed = constraint.angular.particular();
  if (constraint.angular.count() == 3) return prescribed;
  Vec3 w = prescribed + mobility * (momentum - inertia * prescribed);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Vec3 next = prescribed + mobility * (momentum - inertia * prescribed - (0.5 * h) * cross(w, inertia * w));
    const Vec3 change = next - w;
    w = next;
    if (dot(change, change) <= 1e-33 * dot(w, w)) break;
  }
  return w;
}

}  // namespace

void BodySet::initialise(const State& state, std::vector<BodyConstraint> body_constraints) {
  const std::size_t n = state.bodies.info.size();
  rotation.assign(n, Mat3::identity());
  mobility.assign(n, Mobility{});
  trial.assign(n, BodyTrial{});
  inverse_mass_.resize(n);
  inertia_.resize(n);
  inverse_inertia_.resize(n);
  for (std::size_t b = 0; b < n; ++b) {
    const BodyInfo& info = state.bodies.info[b];
    inverse_mass_[b] = 1.0 / info.mass;
    inertia_[b] = info.principal_inertia;
    inverse_inertia_[b] = {1.0 / inertia_[b].x, 1.0 / inertia_[b].y, 1.0 / inertia_[b].z};
    mobility[b].inverse_mass = inverse_mass_[b];
    rotation[b] = to_matrix(state.bodies.motion[b].orientation);
  }
  constraints = std::move(body_constraints);
  for (std::size_t c = 0; c < constraints.size(); ++c)
    mobility[static_cast<std::size_t>(constraints[c].body)].constraint = static_cast<Index>(c);
}

void BodySet::register_state(Registry& registry) {
  registry.keep({"bodies.rotation", "1", "rigid.drift"}, rotation);
  registry.keep({"bodies.mobility", "1/mass, 1/(mass*length^2)", "rigid.kick"}, mobility);
  registry.keep({"bodies.constraints", "mixed", "rigid.kick"}, constraints);
}

void BodySet::update_mobility(std::size_t b) {
  Mobility& m = mobility[b];
  if (m.constraint == none) {
    m.angular = rotated_diagonal(rotation[b], inverse_inertia_[b]);
    return;
  }
  BodyConstraint& c = constraints[static_cast<std::size_t>(m.constraint)];
  c.linear_mobility = {};
  const auto n = c.linear.complement();
  for (int i = 0; i < 3 - c.linear.count(); ++i) c.linear_mobility += outer(n[i], n[i]) * inverse_mass_[b];
  m.angular = c.angular_mobility(rotated_diagonal(rotation[b], inertia_[b]));
}

void BodySet::advance(const State& state, std::size_t b, double h) {
  const BodyMotion& now = state.bodies.motion[b];
  BodyTrial& t = trial[b];
  if (mobility[b].constraint == none) {
    t.constrained_velocity = t.velocity;
    const Vec3 body_momentum = times_transposed(rotation[b], t.angular_momentum);
    t.angular_velocity =
        rotation[b] * half_step_angular_velocity(body_momentum, inertia_[b], inverse_inertia_[b], h);
  } else {
    const BodyConstraint& c = constraints[static_cast<std::size_t>(mobility[b].constraint)];
    t.constrained_velocity = c.linear.particular() + c.linear.project(t.velocity);
    t.angular_velocity = constrained_angular_velocity(c, mobility[b].angular, rotated_diagonal(rotation[b], inertia_[b]),
                                                      t.angular_momentum, h);
  }
  t.center = now.center + t.constrained_velocity * h;
  Quat q = hughes_winget(t.angular_velocity * h) * now.orientation;
  // One Newton step towards unit length: products of unit quaternions leave it by rounding only.
  const double stretch = 1.5 - 0.5 * (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w * stretch, q.x * stretch, q.y * stretch, q.z * stretch};
  t.orientation = q;
  t.rotation = to_matrix(q);
}

Vec3 BodySet::angular_momentum_after(std::size_t b, double h) const {
  const BodyTrial& t = trial[b];
  if (mobility[b].constraint == none) return t.angular_momentum;
  const Vec3 spin = inertia_times(b, t.angular_velocity);
  return spin + (0.5 * h) * cross(t.angular_velocity, spin);
}

Vec3 BodySet::inertia_times(std::size_t b, const Vec3& w) const {
  const Vec3 local = times_transposed(rotation[b], w);
  return rotation[b] * Vec3{inertia_[b].x * local.x, inertia_[b].y * local.y, inertia_[b].z * local.z};
}

Vec3 BodySet::inverse_inertia_times(std::size_t b, const Vec3& l) const {
  const Vec3 local = times_transposed(rotation[b], l);
  return rotation[b] *
         Vec3{inverse_inertia_[b].x * local.x, inverse_inertia_[b].y * local.y, inverse_inertia_[b].z * local.z};
}

}  // namespace kardan
