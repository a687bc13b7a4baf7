// The force between a node and a segment that it has penetrated by p.
//
// Normal: f = k p + c dp/dt >= 0. Stiffness k by SOFT, with s = SLSFAC and the stiffnesses of node and segment (surface.hpp):
//   0   k0 = s * the smaller of segment and node (PENOPT 1), the segment's (2) or the node's (3, 4, 5)
//   1   max(k0, SOFSCL m*/(2 dt^2)),       m* the smallest mass of the node and the corners
//   2   max(k0, s m1 m2/(m1 + m2)/(2 dt^2)), m1 the node's mass, m2 the corners' mean
// The segment's stiffness is that of its corners (means of their segments) at the closest point: a node that slides from one segment to the next meets
// no jump of it. Sources: Hallquist, LS-DYNA Theory Manual 2006, "Contact-impact algorithm"; LSTC, FAQ contact.soft1.
//
// Always k <= alpha m_eff/dt^2, 1/m_eff = 1/m_s + sum w_i/m_i. A point of mass m_s on the point sum w_i x_i of masses m_i moves relative to it, under a force f along n,
// by f (1/m_s + sum w_i^2/m_i), no more than f/m_eff, so that the spring alone has omega^2 <= k/m_eff and central differences are stable for
// omega dt < 2, alpha < 4. In a pile of shells with contact in both directions a node takes part in about four touches, two of its own and two as a corner:
// alpha = 0.4 leaves room for them and for the elements. The bound is idle for the usual k0 of shells up to four or five times as long as thick.
// dt follows the run's step only upwards and in steps of 5 %, so that k, and with it the stored energy, does not change every cycle.
//
// Damping c = 2 VDC sqrt(k m_eff), at most beta m_eff/dt: the velocity is half a step old, and central differences with it are stable for
// c dt/m + k dt^2/(2 m) < 2; four touches with beta = 0.2 use up 1.6. Friction: a spring of k/2 along the surface, where
// shells are stiffer by themselves, cut off at mu f (Coulomb), mu = FD + (FS - FD) exp(-DC |v|),
// and at VC times the segment's area.
#pragma once

// Rigid contacts (*CONTACT_RIGID_…) have a curve F(p) instead, exactly as given: by FCM
//   1   of the sum of all normal forces over the largest penetration, shared in proportion to the penetrations
//   2   of each node's force over its penetration
//   3   of the pressure on each node's share of area over its penetration
// Unloading from the largest penetration q is along F(q) - US (q - p); LCDC adds DSF c(v_n), a force over the speed of approach.

#include "kardan/contact/surface.hpp"
#include "kardan/contact/touch.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

/// Motion of a node relative to the closest point, masses and stiffness there.
struct TouchMotion {
  double stiffness = 0;        ///< of the segment's surface
  Vec3 velocity;               ///< at t_{n-1/2}
  double dt = 0;               ///< t_n - t_{n-1}
  double inverse_mass = 0;     ///< 1/m_eff
  double lightest = 0;         ///< m*
  double reduced = 0;          ///< m1 m2/(m1 + m2)
};

class PenaltyLaw {
 public:
  PenaltyLaw(const Model& model, const Contact& contact) : model_(&model), contact_(&contact) {}

  /// The run's step: stiffnesses follow where it has grown by more than 5 %.
  void follow_step(double dt);
  double& step() { return step_; }

  bool has_friction() const;
  /// The curve gives the sum of all forces (FCM = 1): `total` and the sum of penetrations must be known before any force is.
  bool shares_total() const { return contact_->rigid_curve && contact_->curve_method == 1; }
  /// Force on penetration for shares_total(): F(largest)/sum. `touches` of both directions.
  double force_of_penetration(double largest, double sum) const;
  /// Force on the node, times `share`; brings touch.friction and touch.largest up to date. @return what friction dissipates in the step
  double apply(const SurfaceNode& node, const Segment& segment, const TouchMotion& motion, double share, Touch& touch) const;

  double scale_of_total = 0;  ///< what force_of_penetration() said in this cycle

 private:
  double curve_force(const SurfaceNode& node, const TouchMotion& motion, double p, const Touch& touch) const;
  double stiffness(const SurfaceNode& node, const TouchMotion& motion) const;
  const Friction& friction(PartIndex tracked, PartIndex reference, Friction& mixed) const;
  double slide(const Friction& law, const Segment& segment, const TouchMotion& motion, double k, double normal, Touch& touch) const;

  const Model* model_;
  const Contact* contact_;
  double step_ = 0;
};

}  // namespace kardan
