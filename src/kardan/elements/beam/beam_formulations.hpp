// The formulations of beams: forces conjugate to the increments of beam_frame.hpp, and the square of the highest frequency.
// Included by translation units that are compiled for one instruction set each; see base/simd.hpp.
//
// Stable step: 2/omega. A free element with mass m and rotary inertia I at each node has the frequencies, l its length,
//   stretch  omega^2 = 2 EA/(l m),  twist  2 GJ/(l I),  bending with equal and opposite ends  2 EI/(l I), and
//   bending with equal ends, which tilts the chord: of a cubic beam 12 EI/(l (1+phi)) (1/(2 I) + 2/(m l^2)), of one point of
//   integration (shear) k GA (2/(l m) + l/(2 I)).
// With m = rho A l/2 and I = m (I_max/A + l^2/12) that of the cubic beam is the bound of Hallquist, LS-DYNA Theory Manual 2006,
// "Time step calculations for beam and truss elements", c dt = l/2 [3 I (3/(12 I + A l^2) + 1/(A l^2))]^(-1/2); that of the stretch is
// c dt = l. Elements of a mesh only hold one another: the smallest step of the elements is a bound for the mesh (Irons and Treharne
// 1971, AFFDL-TR-71-160).
#pragma once

#include "kardan/elements/beam/beam_frame.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// What a formulation reads of an element, beside the increments.
template <class R>
struct BeamElement {
  const BeamProperties& properties;
  const StepTime& step;
  R mass, inertia;   ///< at each node
  R constant[6];
  double* points;    ///< history of the points
  R intact{1.0};     ///< out: 0 where the element has failed
};

/// The Belytschko-Schwer beam (ELFORM 2), a cubic beam with the resultants' stiffness on the initial length l:
///   N' = EA/l l',  T' = GJ/l twist',  M_s' = EI_ss/(l (1+phi_s)) [4+phi_s, 2-phi_s; 2-phi_s, 4+phi_s] bend_s',  about t likewise,
///   phi_s = 12 EI_ss/(G A_s l^2).
/// Source: Belytschko, Schwer and Klein 1977; phi: Przemieniecki 1968, Theory of Matrix Structural Analysis, sec. 5.6.
/// Constants: EA/l, GJ/l, EI_ss/(l (1+phi_s)), phi_s, EI_tt/(l (1+phi_t)), phi_t.
struct BelytschkoSchwer {
  explicit BelytschkoSchwer(const BeamProperties&) {}
  static constexpr std::size_t point_values() { return 0; }

  template <class R>
  KARDAN_INLINE void update(const BeamElement<R>& e, const BeamIncrement<R>& d, BeamForce<R>& q) const {
    q.axial += e.constant[0] * d.elongation;
    q.torsion += e.constant[1] * d.twist;
    bend(e.constant[2], e.constant[3], d.bend_s, q.moment_s);
    bend(e.constant[4], e.constant[5], d.bend_t, q.moment_t);
  }

  template <class R>
  KARDAN_INLINE R frequency_square(const BeamElement<R>& e, const R& l) const {
    const R stiffness = max(e.constant[2], e.constant[4]);
    const R equal = R(12.0) * stiffness * (R(0.5) / e.inertia + R(2.0) / (e.mass * l * l));
    const R opposite = R(2.0) * max(e.constant[2] * (R(1.0) + e.constant[3]), e.constant[4] * (R(1.0) + e.constant[5])) / e.inertia;
    return max(max(R(2.0) * e.constant[0] / e.mass, R(2.0) * e.constant[1] / e.inertia), max(equal, opposite));
  }

 private:
  template <class R>
  KARDAN_INLINE static void bend(const R& stiffness, const R& phi, const R (&d)[2], R (&m)[2]) {
    const R own = stiffness * (R(4.0) + phi), other = stiffness * (R(2.0) - phi);
    m[0] += own * d[0] + other * d[1];
    m[1] += other * d[0] + own * d[1];
  }
};

/// A point of a law, loaded and stored.
template <class R, class Law>
KARDAN_INLINE BeamPoint<R> update_point(const Law& law, const BeamStress<R>& strain, const StepTime& step, double* h) {
  BeamPoint<R> point{{R::load(h), R::load(h + block_lanes), R::load(h + 2 * block_lanes)}, strain, R(0.0)};
  law.update(point, step, h + 3 * block_lanes);
  point.stress.rr.store(h);
  point.stress.rs.store(h + block_lanes);
  point.stress.tr.store(h + 2 * block_lanes);
  return point;
}

/// The truss (ELFORM 3): N = A sigma, with the rate of strain l'/l and the area of the start.
/// Source: Hallquist, LS-DYNA Theory Manual 2006, "Truss element". Constants: A.
template <class Law>
struct Truss {
  Law law;

  explicit Truss(const BeamProperties& p) : law(p.law) {}
  std::size_t point_values() const { return beam_point_values(law.history()); }

  template <class R>
  KARDAN_INLINE void update(BeamElement<R>& e, const BeamIncrement<R>& d, BeamForce<R>& q) const {
    const BeamPoint<R> point = update_point(law, BeamStress<R>{d.elongation / d.length, R(0.0), R(0.0)}, e.step, e.points);
    q.axial = e.constant[0] * point.stress.rr;
    e.intact = R(1.0) - point.failed;
  }

  template <class R>
  KARDAN_INLINE R frequency_square(const BeamElement<R>& e, const R& l) const {
    return R(2.0 * e.properties.youngs_modulus) * e.constant[0] / (l * e.mass);
  }
};

/// The Hughes-Liu beam (ELFORM 1) and spot welds (ELFORM 9): a section rigid in its plane, one point along the axis, stresses
/// integrated over the section. At the point (s, t) of the section, with curvatures k_s = (bend_s[2] - bend_s[1])/l, k_t likewise,
/// shears g_s = -(bend_t[1] + bend_t[2])/2, g_t = (bend_s[1] + bend_s[2])/2 and twist p per length,
///   d_rr = l'/l + t k_s - s k_t,   2 d_rs = g_s - t p,   2 d_tr = g_t + s p;
///   N = int s_rr,  M_s = int t s_rr,  M_t = -int s s_rr,  Q_s = k int s_rs,  Q_t = k int s_tr,  T = int (s s_tr - t s_rs),
/// k = SHRF; and M_s[a] = -+M_s + Q_t l/2, M_t[a] = -+M_t - Q_s l/2. Area and sizes are those of the start.
/// Source: Hughes and Liu 1981, Comput. Meth. Appl. Mech. Eng. 27, 167-181; Hallquist, LS-DYNA Theory Manual 2006, "Hughes-Liu beam".
/// (Kardan writes it with beam_frame.hpp's increments, which are the same for the one point, and does not vary l along the section.)
/// Constants: half sizes in s and t (of the points' coordinates), A, I_ss, I_tt.
/// An element fails when all its points have failed; a spot weld also when, with the limits of *MAT_SPOTWELD,
///   (max(N, 0)/NRR)^2 + (Q_s/NRS)^2 + (Q_t/NRT)^2 + (T/MRR)^2 + (M_s/MSS)^2 + (M_t/MTT)^2 >= 1,   or at the time TFAIL.
template <class Law>
struct HughesLiu {
  Law law;

  explicit HughesLiu(const BeamProperties& p) : law(p.law) {}
  std::size_t point_values() const { return beam_point_values(law.history()); }

  template <class R>
  KARDAN_INLINE void update(BeamElement<R>& e, const BeamIncrement<R>& d, BeamForce<R>& q) const {
    const BeamProperties& p = e.properties;
    const R inverse = R(1.0) / d.length, half(0.5);
    const R stretch = d.elongation * inverse, twist = d.twist * inverse * R(p.torsion);
    const R k_s = (d.bend_s[1] - d.bend_s[0]) * inverse, k_t = (d.bend_t[1] - d.bend_t[0]) * inverse;
    const R g_s = -half * (d.bend_t[0] + d.bend_t[1]), g_t = half * (d.bend_s[0] + d.bend_s[1]);
    const std::size_t point_size = point_values() * block_lanes;
    R n{}, m_s{}, m_t{}, q_s{}, q_t{}, torsion{};
    e.intact = R(0.0);
    for (int i = 0; i < p.points; ++i) {
      const R s = R(p.s[i]) * e.constant[0], t = R(p.t[i]) * e.constant[1], area = R(p.weight[i]) * e.constant[2];
      const BeamPoint<R> point =
          update_point(law, BeamStress<R>{stretch + t * k_s - s * k_t, g_s - t * twist, g_t + s * twist}, e.step,
                       e.points + static_cast<std::size_t>(i) * point_size);
      const BeamStress<R>& stress = point.stress;
      e.intact = max(e.intact, R(1.0) - point.failed);
      n += area * stress.rr;
      m_s += area * t * stress.rr;
      m_t -= area * s * stress.rr;
      q_s += area * stress.rs;
      q_t += area * stress.tr;
      torsion += area * (s * stress.tr - t * stress.rs);
    }
    const R factor(p.shear_factor), arm = R(0.5) * factor * d.end_length;
    if (p.breaks) {
      e.intact = e.intact * unbroken(p, e.step, {max(n, R(0.0)), factor * q_s, factor * q_t, torsion * R(p.torsion), m_s, m_t});
    }
    q = {n, torsion * R(p.torsion), {q_t * arm - m_s, q_t * arm + m_s}, {-q_s * arm - m_t, -q_s * arm + m_t}};
  }

  template <class R>
  KARDAN_INLINE R frequency_square(const BeamElement<R>& e, const R& l) const {
    const R young(e.properties.youngs_modulus), shear(e.properties.shear_modulus);
    const R stretch = R(2.0) * young * e.constant[2] / (l * e.mass);
    const R slide = R(e.properties.shear_factor) * shear * e.constant[2] * (R(2.0) / (l * e.mass) + R(0.5) * l / e.inertia);
    const R turn = R(2.0) * max(young * max(e.constant[3], e.constant[4]), shear * (e.constant[3] + e.constant[4])) / (l * e.inertia);
    return max(stretch, max(slide, turn));
  }

 private:
  /// 1, or 0 where the resultants or the time reach the limits.
  template <class R>
  KARDAN_INLINE static R unbroken(const BeamProperties& p, const StepTime& step, const R (&resultant)[6]) {
    if (p.failure_time > 0 && step.time >= p.failure_time) return R(0.0);
    R sum{};
    for (int i = 0; i < 6; ++i) {
      const R share = resultant[i] * R(p.inverse_limit[i]);
      sum += share * share;
    }
    return select(sum < R(1.0), R(1.0), R(0.0));
  }
};

}  // namespace kardan::KARDAN_ISA_NAMESPACE
