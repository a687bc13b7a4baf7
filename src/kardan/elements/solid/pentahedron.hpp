// The two-point pentahedron (ELFORM 15): nodes 0, 1, 2 one triangle, 3, 4, 5 the other.
//
// Source: Hallquist, LS-DYNA Theory Manual 2006, "Solid elements"; the twist's control is derived here.
//
// Shape functions L_i (1 -+ t)/2 with the area coordinates L_i; points at the triangles' centre, t = +-1/sqrt 3, weights 1/2. With
// x^-, x^+ of the two triangles and xi = L_1, eta = L_2,
//   x_xi = (x_1 - x_0)^- (1-t)/2 + (x_1 - x_0)^+ (1+t)/2,  x_eta likewise with 2,  x_t = (mean x^+ - mean x^-)/2,
// L = (v_xi c_xi^T + v_eta c_eta^T + v_t c_t^T)/J, c_xi = x_eta x x_t ..., J = x_xi.c_xi. The rule integrates the volume exactly.
//
// Of the twelve deformations the points do not see the twist, the rotation of one triangle against the other about the normal n of
// both. Its rate is the difference of the spins about n, D = n.(curl v^+ - curl v^-)/2, zero in every linear field. It is
// resisted by an antisymmetric stress +-M skew(n) of equal moments at the two points,
//   dM/dt = QM mu (3/4) (J_p/A)/(h/2)^2 D,   J_p/A = (sum of the squared edges)/36,  h the height,
// which for QM = 1 is the energy of the prism's torsion without warping (polar moment J_p of the triangle of area A). The power of the
// two moments is V M D.
#pragma once

#include "kardan/elements/solid/solid_point.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Derivatives of a field at a point; `sign` of t.
template <class R>
struct PentahedronGradient {
  Vec3T<R> xi, eta, t;

  KARDAN_INLINE PentahedronGradient(const Vec3T<R> (&n)[6], double sign) {
    constexpr double g = 0.57735026918962576451;
    const R low(0.5 * (1 - sign * g)), high(0.5 * (1 + sign * g));
    xi = (n[1] - n[0]) * low + (n[4] - n[3]) * high;
    eta = (n[2] - n[0]) * low + (n[5] - n[3]) * high;
    t = ((n[3] + n[4] + n[5]) - (n[0] + n[1] + n[2])) * R(1.0 / 6.0);
  }
};

/// c_xi, c_eta, c_t and J of the positions' derivatives.
template <class R>
struct PentahedronCofactors {
  Vec3T<R> xi, eta, t;
  R jacobian;

  KARDAN_INLINE explicit PentahedronCofactors(const PentahedronGradient<R>& x)
      : xi(cross(x.eta, x.t)), eta(cross(x.t, x.xi)), t(cross(x.xi, x.eta)), jacobian(dot(x.xi, xi)) {}
};

/// V over the largest face, quadrilaterals by their diagonals.
template <class R>
KARDAN_INLINE R pentahedron_length(const Vec3T<R> (&x)[6], const R& volume) {
  const auto size = [](const Vec3T<R>& a, const Vec3T<R>& b) {
    const Vec3T<R> n = cross(a, b);
    return dot(n, n);
  };
  const R ends = max(size(x[1] - x[0], x[2] - x[0]), size(x[4] - x[3], x[5] - x[3]));
  const R sides = max(max(size(x[4] - x[0], x[3] - x[1]), size(x[5] - x[1], x[4] - x[2])), size(x[3] - x[2], x[5] - x[0]));
  return volume / (R(0.5) * sqrt(max(ends, sides)));
}

/// Unit normal of the mean of both triangles.
template <class R>
KARDAN_INLINE Vec3T<R> mean_normal(const Vec3T<R> (&x)[6]) {
  const Vec3T<R> across = cross((x[1] - x[0]) + (x[4] - x[3]), (x[2] - x[0]) + (x[5] - x[3]));
  return across * (R(1.0) / sqrt(dot(across, across)));
}

/// QM mu (3/4) (J_p/A)/(h/2)^2 on the mean of both triangles.
template <class R>
KARDAN_INLINE R twist_stiffness(const SolidProperties& p, const Vec3T<R> (&x)[6], const Vec3T<R>& normal) {
  const Vec3T<R> a = ((x[1] - x[0]) + (x[4] - x[3])) * R(0.5), b = ((x[2] - x[1]) + (x[5] - x[4])) * R(0.5), c = -(a + b);
  const R half_height = dot(normal, ((x[3] + x[4] + x[5]) - (x[0] + x[1] + x[2]))) * R(1.0 / 6.0);
  return R(p.hourglass_scale / 48.0) * (dot(a, a) + dot(b, b) + dot(c, c)) / (half_height * half_height);
}

/// The lanes of `place`; `history` begins with their values.
template <class R, class Law>
KARDAN_INLINE void pentahedron_pack(const SolidProperties& p, const Law& law, const PackPlace& place, SolidBlock<6>& block, double* history) {
  const StepTime& step = place.work.step;
  const std::size_t first = place.first;
  constexpr std::size_t twist_value = solid_history::own;
  const R dt(step.dt), half_dt(0.5 * step.dt), zero(0.0), half(0.5), one(1.0);
  const PackNodes<6> nodes(place);
  const Vec3T<R>(&x)[6] = nodes.x, (&v)[6] = nodes.v;
  Vec3T<R> middle[6];
  for (int a = 0; a < 6; ++a) middle[a] = x[a] - v[a] * half_dt;
  Mat3T<R> l[2];
  R volume_between{}, divergence{}, share[2];
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? -1 : 1;
    const PentahedronCofactors<R> c(PentahedronGradient<R>(middle, sign));
    const PentahedronGradient<R> rate(v, sign);
    const R inverse = one / c.jacobian;
    for (std::size_t k = 0; k < 3; ++k) l[i][k] = (c.xi * rate.xi[k] + c.eta * rate.eta[k] + c.t * rate.t[k]) * inverse;
    share[i] = half * c.jacobian;
    volume_between += share[i];
    divergence += share[i] * (l[i][0].x + l[i][1].y + l[i][2].z);
  }
  divergence *= one / volume_between;

  const PentahedronCofactors<R> c[2] = {PentahedronCofactors<R>(PentahedronGradient<R>(x, -1)),
                                        PentahedronCofactors<R>(PentahedronGradient<R>(x, 1))};
  const R volume = half * (c[0].jacobian + c[1].jacobian);
  const R ratio = volume / R::load(history + solid_history::volume * block_lanes);
  const R length = pentahedron_length(x, volume);
  const BulkViscosity<R> bulk(p, volume, one / volume, length, divergence, history);

  // The twist.
  const Vec3T<R> normal_between = mean_normal(middle), normal = mean_normal(x);
  const auto spin = [&](const Mat3T<R>& g) {
    return half * dot(normal_between, Vec3T<R>{g[2].y - g[1].z, g[0].z - g[2].x, g[1].x - g[0].y});
  };
  const R rate = spin(l[1]) - spin(l[0]);
  double* const kept = history + twist_value * block_lanes;
  const R moment_before = R::load(kept), moment = moment_before + twist_stiffness(p, middle, normal_between) * rate * dt;
  moment.store(kept);
  const R hourglass_work = half * (moment_before + moment) * rate * dt * volume_between;

  R work{}, modulus(p.longitudinal), failed{};
  Vec3T<R> force[6] = {};
  double* stress = history + (solid_history::own + 1) * block_lanes;
  for (int i = 0; i < 2; ++i, stress += (6 + law.history()) * block_lanes) {
    MaterialPoint<R> point;
    point.volume = ratio;
    point.viscosity = bulk.mean();
    point.modulus = R(p.longitudinal);
    work += share[i] * update_point(law, step, point_motion(l[i], dt), point, stress);
    modulus = max(modulus, point.modulus);
    failed += point.failed;
    point.stress.xx -= bulk.pressure;
    point.stress.yy -= bulk.pressure;
    point.stress.zz -= bulk.pressure;
    // The moments of the two points are equal: M V/(2 share) at each.
    const R m = moment * volume / c[i].jacobian * R(i == 0 ? -1.0 : 1.0);
    const Mat3T<R> s = full_tensor(point.stress) + skew(normal) * m;
    const Vec3T<R> fxi = s * c[i].xi * half, feta = s * c[i].eta * half, ft = s * c[i].t * R(1.0 / 12.0);
    constexpr double g = 0.57735026918962576451;
    const R low(0.5 * (i == 0 ? 1 + g : 1 - g)), high(0.5 * (i == 0 ? 1 - g : 1 + g));
    const Vec3T<R> f0 = -(fxi + feta);
    force[0] += f0 * low - ft;
    force[1] += fxi * low - ft;
    force[2] += feta * low - ft;
    force[3] += f0 * high + ft;
    force[4] += fxi * high + ft;
    force[5] += feta * high + ft;
  }
  work += bulk.work(divergence, dt) * volume_between;
  const auto good = min(c[0].jacobian, c[1].jacobian) > zero;
  report_pack(p, block, first, force, work, hourglass_work, failed, good);
  stable_step(p, length, divergence, modulus, good).store(block.time_step + first);
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
