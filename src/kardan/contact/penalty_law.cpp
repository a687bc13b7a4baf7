#include "kardan/contact/penalty_law.hpp"

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

constexpr double tangential = 0.5;  ///< stiffness of sticking over k
constexpr double alpha = 0.4, beta = 0.2;  ///< largest k dt^2/m_eff and c dt/m_eff

bool slides_freely(const Friction& f) { return f.statical == 0 && f.dynamic == 0; }

}  // namespace

void PenaltyLaw::follow_step(double dt) {
  if (dt > 1.05 * step_) step_ = dt;
}

bool PenaltyLaw::has_friction() const {
  return contact_->friction_source != Contact::FrictionSource::own || !slides_freely(contact_->friction);
}

double PenaltyLaw::stiffness(const SurfaceNode& node, const TouchMotion& motion) const {
  const ContactControl& control = model_->control.contact;
  const double bound = motion.inverse_mass > 0 ? alpha / (motion.inverse_mass * step_ * step_) : 0.0;
  double k = control.penalty_option == 1 ? std::min(node.stiffness, motion.stiffness)
                                         : (control.penalty_option == 2 ? motion.stiffness : node.stiffness);
  if (k == 0) k = std::max(node.stiffness, motion.stiffness);
  k *= control.stiffness_scale;
  if (k == 0) return bound;  // materials without E: as stiff as the step allows
  const double dt = contact_->step_of_stiffness > 0 ? contact_->step_of_stiffness : step_;
  if (contact_->soft == 1) k = std::max(k, 0.5 * contact_->soft_scale * motion.lightest / (dt * dt));
  if (contact_->soft == 2) k = std::max(k, 0.5 * control.stiffness_scale * motion.reduced / (dt * dt));
  return bound > 0 ? std::min(k, bound) : k;
}

const Friction& PenaltyLaw::friction(PartIndex a, PartIndex b, Friction& mixed) const {
  if (contact_->friction_source == Contact::FrictionSource::own) return contact_->friction;
  if (contact_->friction_source == Contact::FrictionSource::table) {
    const FrictionTable& table = model_->friction_tables[contact_->friction_table];
    const auto has = [](const std::vector<PartIndex>& parts, PartIndex p) { return std::find(parts.begin(), parts.end(), p) != parts.end(); };
    for (const FrictionTable::Row& row : table.rows)
      if ((has(row.first, a) && has(row.second, b)) || (has(row.first, b) && has(row.second, a))) return row.friction;
    return table.otherwise;
  }
  const auto own = [&](PartIndex p) {
    return p != none && model_->parts[p].contact ? model_->parts[p].contact->friction : Friction{};
  };
  const Friction first = own(a), second = own(b);
  mixed.statical = 0.5 * (first.statical + second.statical);
  mixed.dynamic = 0.5 * (first.dynamic + second.dynamic);
  mixed.decay = 0.5 * (first.decay + second.decay);
  mixed.shear_limit = first.shear_limit > 0 && second.shear_limit > 0 ? std::min(first.shear_limit, second.shear_limit)
                                                                      : std::max(first.shear_limit, second.shear_limit);
  return mixed;
}

/// Radial return of the sticking spring onto Coulomb's limit.
double PenaltyLaw::slide(const Friction& law, const Segment& segment, const TouchMotion& motion, double k, double normal, Touch& touch) const {
  const Vec3& n = touch.direction;
  const double before = norm(touch.friction);
  Vec3 old = touch.friction - n * dot(touch.friction, n);  // turned into the tangent plane of now
  if (const double flat = norm(old); flat > 0) old *= before / flat;
  const Vec3 v = motion.velocity - n * dot(motion.velocity, n);
  const Vec3 trial = old - v * (k * motion.dt);
  const double mu = law.dynamic + (law.statical - law.dynamic) * std::exp(-law.decay * norm(v));
  double limit = std::max(mu, 0.0) * normal;
  if (law.shear_limit > 0) limit = std::min(limit, law.shear_limit * segment.area);
  const double size = norm(trial);
  if (size <= limit) {
    touch.friction = trial;
    return 0;
  }
  touch.friction = trial * (limit / size);
  return limit * (size - limit) / k;
}

double PenaltyLaw::force_of_penetration(double largest, double sum) const {
  return sum > 0 ? model_->curves[contact_->curve].value(largest) / sum : 0.0;
}

double PenaltyLaw::curve_force(const SurfaceNode& node, const TouchMotion& motion, double p, const Touch& touch) const {
  if (p <= 0) return 0;
  const Curve& curve = model_->curves[contact_->curve];
  double force = shares_total() ? scale_of_total * p : curve.value(p);
  if (contact_->curve_method == 3) force *= node.area;
  if (contact_->unload_stiffness > 0 && !shares_total() && p < touch.largest) {
    const double most = curve.value(touch.largest) * (contact_->curve_method == 3 ? node.area : 1.0);
    force = std::max(0.0, most - contact_->unload_stiffness * (touch.largest - p));
  }
  if (contact_->damping_curve != none)
    force += contact_->damping_scale * model_->curves[contact_->damping_curve].value(-dot(motion.velocity, touch.direction));
  return std::max(force, 0.0);
}

double PenaltyLaw::apply(const SurfaceNode& node, const Segment& segment, const TouchMotion& motion, double share, Touch& touch) const {
  const double p = touch.penetration - touch.offset;
  touch.largest = std::max(touch.largest, p);
  const double k = stiffness(node, motion);
  double normal = contact_->rigid_curve ? curve_force(node, motion, p, touch) : k * std::max(p, 0.0);
  if (contact_->damping > 0 && motion.inverse_mass > 0 && p > 0) {
    const double c = std::min(2 * contact_->damping * std::sqrt(k / motion.inverse_mass), beta / (motion.inverse_mass * step_));
    normal = std::max(0.0, normal - c * dot(motion.velocity, touch.direction));
  }
  normal *= share;
  touch.force = touch.direction * normal;
  Friction mixed;
  const Friction& law = friction(node.part, segment.part, mixed);
  if (slides_freely(law)) {
    touch.friction = {};
    return 0;
  }
  const double dissipated = slide(law, segment, motion, tangential * k, normal, touch);
  touch.force += touch.friction;
  return dissipated;
}

}  // namespace kardan
