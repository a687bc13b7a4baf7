// Kinematics that all beams of two nodes share: an element turns with the line of its nodes, and about it with their mean rotation.
// Included by translation units that are compiled for one instruction set each; see base/simd.hpp.
//
// Sources: Belytschko, Schwer and Klein 1977, Int. J. Numer. Meth. Eng. 11, 65-84 (co-rotational beam, deformations measured from the
// chord); Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15, 1862-1867 (increments on the geometry of the middle of the step).
//
// Axes: r from node 1 to node 2, s and t = r x s across, l the distance. With nodal velocities v and angular velocities w the chord
// turns at r x (v2 - v1)/l, and the rates of deformation and the forces conjugate to them are
//   elongation  l'                                        N
//   twist       (w2 - w1).r                               T
//   bend_s[a]   w_a.s + (v2 - v1).t/l   (about s, node a)  M_s[a]
//   bend_t[a]   w_a.t - (v2 - v1).s/l   (about t, node a)  M_t[a]
// From the equality of power the nodes resist with
//   f2 = N r + (M_s[1] + M_s[2])/l t - (M_t[1] + M_t[2])/l s = -f1,   m_a = M_s[a] s + M_t[a] t +- T r,
// which balance force and moment whatever the six are.
//
// Twist of a bent beam. With the accumulated rotations b_s, b_t of a node (the sums of bend_s, bend_t) its axis is tilted from the chord
// by b_t s - b_s t, and a shaft that turns about such an axis would seem to twist by pi b^2 in every turn. The twist of a node is therefore
// taken about the mean of its axis and the chord, r + (b_t s - b_s t)/2 (rotation of least swing, then twist):
//   twist  (w2 - w1).r + h_2 - h_1,   h_a = (b_t bend_s - b_s bend_t)/2 at node a,
// and s is carried by (h_1 + h_2)/2 besides. The conjugate moments are M_s[a] +- T b_t/2, M_t[a] -+ T b_s/2 at nodes 2, 1. A bent shaft
// keeps its torque for thousands of turns (error per turn: of fourth order in b); a rigid rotation has h = 0.
//
// Increments are taken on the geometry at t_{n-1/2} (the elongation exactly, from both lengths), forces on that at t_n: a rigid rotation
// deforms nothing, to rounding. s is carried by the spin of the chord and the mean twist of the nodes.
#pragma once

#include "kardan/base/simd_math.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/elements/beam/beam_kernel.hpp"
#include "kardan/elements/tiles/tile_loop.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Increments of deformation over the step.
template <class R>
struct BeamIncrement {
  R elongation, twist;
  R bend_s[2], bend_t[2];  ///< at nodes 1, 2
  R length;                ///< in the middle of the step
  R end_length;            ///< at t_n
};

/// Forces conjugate to the increments, in the order in which an element keeps them.
template <class R>
struct BeamForce {
  R axial, torsion;
  R moment_s[2], moment_t[2];

  KARDAN_INLINE static BeamForce load(const double* h) {
    return {R::load(h), R::load(h + block_lanes), {R::load(h + 2 * block_lanes), R::load(h + 3 * block_lanes)},
            {R::load(h + 4 * block_lanes), R::load(h + 5 * block_lanes)}};
  }
  KARDAN_INLINE void store(double* h) const {
    axial.store(h);
    torsion.store(h + block_lanes);
    for (std::size_t a = 0; a < 2; ++a) {
      moment_s[a].store(h + (2 + a) * block_lanes);
      moment_t[a].store(h + (4 + a) * block_lanes);
    }
  }
};

/// Accumulated rotations of the nodes against the chord.
template <class R>
struct BeamTilt {
  R s[2], t[2];

  KARDAN_INLINE static BeamTilt load(const double* h) {
    return {{R::load(h), R::load(h + block_lanes)}, {R::load(h + 2 * block_lanes), R::load(h + 3 * block_lanes)}};
  }
  KARDAN_INLINE void store(double* h) const {
    for (std::size_t a = 0; a < 2; ++a) {
      s[a].store(h + a * block_lanes);
      t[a].store(h + (2 + a) * block_lanes);
    }
  }
};

template <class R>
struct BeamAxes {
  Vec3T<R> r, s, t;
  R length;
};

/// Axes along `line`, s in the plane of `line` and `in_plane`.
template <class R>
KARDAN_INLINE BeamAxes<R> beam_axes(const Vec3T<R>& line, const Vec3T<R>& in_plane) {
  BeamAxes<R> axes;
  axes.length = sqrt(dot(line, line));
  axes.r = line * (R(1.0) / axes.length);
  const Vec3T<R> across = in_plane - axes.r * dot(axes.r, in_plane);
  axes.s = across * (R(1.0) / sqrt(dot(across, across)));
  axes.t = cross(axes.r, axes.s);
  return axes;
}

/// Motion of an element over a step: x at t_n, the others at t_{n-1/2}.
template <class R>
struct BeamMotion {
  Vec3T<R> line;      ///< x2 - x1
  Vec3T<R> change;    ///< v2 - v1
  Vec3T<R> w[2];
};

/// Deformation over the step dt; carries `axis`, the unit vector s, and the tilts from its beginning to its end.
template <class R>
KARDAN_INLINE BeamIncrement<R> beam_increment(const BeamMotion<R>& m, const R& dt, Vec3T<R>& axis, BeamTilt<R>& b) {
  const Vec3T<R> step = m.change * dt, middle = m.line - step * R(0.5), old = m.line - step;
  const R square = dot(middle, middle);
  const Vec3T<R> spin = cross(middle, m.change) * (R(1.0) / square) +
                        middle * (R(0.5) * dot(m.w[0] + m.w[1], middle) / square);
  const Vec3T<R> turn = spin * dt;  // Hughes-Winget: s += c turn x (s + turn x s / 2), c = 1/(1 + turn^2/4)
  const R c = R(1.0) / (R(1.0) + R(0.25) * dot(turn, turn));
  const Vec3T<R> turned = axis + cross(turn, axis + cross(turn, axis) * R(0.5)) * c;
  const BeamAxes<R> e = beam_axes(middle, axis + turned);
  BeamIncrement<R> d;
  d.length = e.length;
  d.end_length = sqrt(dot(m.line, m.line));
  d.elongation = R(2.0) * dot(middle, step) / (d.end_length + sqrt(dot(old, old)));
  d.twist = dot(m.w[1] - m.w[0], e.r) * dt;
  const R tilt_s = dot(step, e.t) / e.length, tilt_t = dot(step, e.s) / e.length;
  for (int a = 0; a < 2; ++a) {
    d.bend_s[a] = dot(m.w[a], e.s) * dt + tilt_s;
    d.bend_t[a] = dot(m.w[a], e.t) * dt - tilt_t;
  }
  R swept[2];
  for (int a = 0; a < 2; ++a) {
    swept[a] = R(0.5) * (b.t[a] * d.bend_s[a] - b.s[a] * d.bend_t[a]);
    b.s[a] += d.bend_s[a];
    b.t[a] += d.bend_t[a];
  }
  d.twist += swept[1] - swept[0];
  axis = turned + cross(e.r, turned) * (R(0.5) * (swept[0] + swept[1]));
  return d;
}

template <class R>
KARDAN_INLINE R beam_work(const BeamForce<R>& q, const BeamIncrement<R>& d) {
  return q.axial * d.elongation + q.torsion * d.twist + q.moment_s[0] * d.bend_s[0] + q.moment_s[1] * d.bend_s[1] +
         q.moment_t[0] * d.bend_t[0] + q.moment_t[1] * d.bend_t[1];
}

/// With what node 2 resists: force; and both nodes: moment.
template <class R>
struct BeamNodal {
  Vec3T<R> force;
  Vec3T<R> moment[2];
};

template <class R>
KARDAN_INLINE BeamNodal<R> beam_nodal(BeamForce<R> q, const BeamTilt<R>& b, const BeamAxes<R>& e) {
  const R inverse = R(1.0) / e.length, half_torsion = R(0.5) * q.torsion;
  for (int a = 0; a < 2; ++a) {
    const R own = a == 0 ? -half_torsion : half_torsion;
    q.moment_s[a] += own * b.t[a];
    q.moment_t[a] -= own * b.s[a];
  }
  BeamNodal<R> n;
  n.force = e.r * q.axial + e.t * ((q.moment_s[0] + q.moment_s[1]) * inverse) - e.s * ((q.moment_t[0] + q.moment_t[1]) * inverse);
  for (int a = 0; a < 2; ++a) {
    n.moment[a] = e.s * q.moment_s[a] + e.t * q.moment_t[a] + e.r * (a == 0 ? -q.torsion : q.torsion);
  }
  return n;
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
