// The one-point hexahedron (ELFORM 1) with exact mean gradients, stress rate of Jaumann and hourglass control.
// Included by translation units that are compiled for one instruction set each; see base/simd.hpp.
//
// Sources: Flanagan and Belytschko 1981, Int. J. Numer. Meth. Eng. 17, 679-706 (mean gradient, hourglass vectors and
// control); Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15, 1862-1867 (rotation of a finite step); von Neumann
// and Richtmyer 1950, J. Appl. Phys. 21, 232-237, and Landshoff 1955, LASL LA-1930 (bulk viscosity); Hallquist, LS-DYNA
// Theory Manual 2006, "Solid elements" and "Time step calculations for solid elements".
//
// Everything is done on coefficients of the eight sign patterns of the nodes, not on the nodes. With natural
// coordinates r, s, t = +-1 of node I a nodal field is a_I = a0 + a1 r + a2 s + a3 t + a4 rs + a5 st + a6 rt + a7 rst
// (24 additions there, 24 back). With x1 ... x7 of the coordinates the mean gradient operator B_I = dV/dx_I = integral
// of grad N_I has the coefficients
//   B1 = x2 x x3 + (x4 x x6)/3     B4 = (x2 x x5 - x1 x x6)/3
//   B2 = x3 x x1 + (x5 x x4)/3     B5 = (x3 x x6 - x2 x x4)/3
//   B3 = x1 x x2 + (x6 x x5)/3     B6 = (x1 x x4 - x3 x x5)/3,   B0 = B7 = 0   (x between vectors: cross product),
// found by integrating the products of the trilinear map; V = (8/3) sum_a x_a.B_a, mean velocity gradient L = (8/V) sum
// v_a B_a^T, forces of a stress F_a = sigma B_a. They are what Flanagan and Belytschko write out by nodes (their eq. 16
// and appendix).
//
// Hourglass: modes a = 4 ... 7, h_a their sign patterns, g_a = h_a - (8/V) B.x_a, rates q_a = g_a.v = 8 (v_a - L x_a),
// forces g_a Q_a, in coefficients F_a += Q_a and sigma -= (8/V) sum Q_a x_a^T:
//   Q_a = QM rho c V^(2/3)/4 q_a                          (IHQ 1, 2, 3)
//   dQ_a/dt = QM (lambda + 2 mu) (B:B/V)/16 q_a           (IHQ 4, 5), which turns with the material.
// The vectors g are orthogonal to every linear field: constant strains and rotations are free of them, also at
// distorted elements.
//
// Strain increments are taken on the geometry of t_{n-1/2}, x_n - v dt/2, forces on that of t_n; the stress is turned
// by half the step's rotation, updated, and turned by the other half, so a rigid rotation strains nothing and turns the
// stress exactly.
#pragma once

#include "kardan/base/vec3.hpp"
#include "kardan/elements/solid/solid_kernel.hpp"
#include "kardan/elements/tiles/tile_loop.hpp"
#include "kardan/elements/tiles/tile_nodes.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Coefficients 1 ... 7 of a nodal field by sign patterns r, s, t, rs, st, rt, rst, at [0] ... [6].
template <class R>
struct Modes {
  Vec3T<R> a[7];
};

template <class R>
KARDAN_INLINE Modes<R> to_modes(const Vec3T<R> (&n)[8]) {
  const Vec3T<R> s12 = n[0] + n[1], d12 = n[1] - n[0], s43 = n[3] + n[2], d43 = n[2] - n[3];
  const Vec3T<R> s56 = n[4] + n[5], d56 = n[5] - n[4], s87 = n[7] + n[6], d87 = n[6] - n[7];
  const Vec3T<R> low_s = s43 - s12, low_r = d12 + d43, low_rs = d43 - d12;
  const Vec3T<R> high_s = s87 - s56, high_r = d56 + d87, high_rs = d87 - d56;
  const R f(0.125);
  return {{(low_r + high_r) * f, (low_s + high_s) * f, ((s56 + s87) - (s12 + s43)) * f, (low_rs + high_rs) * f,
           (high_s - low_s) * f, (high_r - low_r) * f, (high_rs - low_rs) * f}};
}

/// Nodal values of coefficients whose constant one is zero.
template <class R>
KARDAN_INLINE void to_nodes(const Modes<R>& m, Vec3T<R> (&n)[8]) {
  const auto layer = [&](const Vec3T<R>& c, const Vec3T<R>& r, const Vec3T<R>& s, const Vec3T<R>& rs, int first) {
    const Vec3T<R> s12 = c - s, s43 = c + s, d12 = r - rs, d43 = r + rs;
    n[first] = s12 - d12;
    n[first + 1] = s12 + d12;
    n[first + 2] = s43 + d43;
    n[first + 3] = s43 - d43;
  };
  layer(-m.a[2], m.a[0] - m.a[5], m.a[1] - m.a[4], m.a[3] - m.a[6], 0);
  layer(m.a[2], m.a[0] + m.a[5], m.a[1] + m.a[4], m.a[3] + m.a[6], 4);
}

/// Mean gradient: coefficients B1 ... B6 and the volume.
template <class R>
struct MeanGradient {
  Vec3T<R> b[6];
  R volume;
};

template <class R>
KARDAN_INLINE MeanGradient<R> mean_gradient(const Modes<R>& x) {
  const R third(1.0 / 3.0);
  const auto& a = x.a;
  MeanGradient<R> g{{cross(a[1], a[2]) + cross(a[3], a[5]) * third, cross(a[2], a[0]) + cross(a[4], a[3]) * third,
                     cross(a[0], a[1]) + cross(a[5], a[4]) * third, (cross(a[1], a[4]) - cross(a[0], a[5])) * third,
                     (cross(a[2], a[5]) - cross(a[1], a[3])) * third, (cross(a[0], a[3]) - cross(a[2], a[4])) * third},
                    R{}};
  for (int k = 0; k < 6; ++k) g.volume += dot(a[k], g.b[k]);
  g.volume *= R(8.0 / 3.0);
  return g;
}

/// (8/V) sum_k a_k b_k^T over the given coefficients.
template <int Count, class R>
KARDAN_INLINE Mat3T<R> sum_outer(const Vec3T<R>* a, const Vec3T<R>* b, const R& factor) {
  Mat3T<R> m;
  for (int i = 0; i < 3; ++i) {
    const auto c = static_cast<std::size_t>(i);
    Vec3T<R> row;
    for (int k = 0; k < Count; ++k) row += b[k] * a[k][c];
    m[c] = row * factor;
  }
  return m;
}

/// Rotation by half of the step's: with tan(angle/2) = |t| of Hughes and Winget, tan(angle/4) = |u|, u = t / (1 +
/// sqrt(1 + t.t)), Q = I + 2 (U + U U)/(1 + u.u).
template <class R>
KARDAN_INLINE Mat3T<R> half_rotation(const Mat3T<R>& l, const R& dt) {
  const R h = R(0.25) * dt;
  const Vec3T<R> t{(l[2].y - l[1].z) * h, (l[0].z - l[2].x) * h, (l[1].x - l[0].y) * h};
  const Vec3T<R> u = t * (R(1.0) / (R(1.0) + sqrt(R(1.0) + dot(t, t))));
  const R f = R(2.0) / (R(1.0) + dot(u, u));
  const Vec3T<R> w = u * f;
  const R xx = u.x * w.x, yy = u.y * w.y, zz = u.z * w.z, xy = u.x * w.y, yz = u.y * w.z, zx = u.z * w.x;
  const R one(1.0);
  return {{{{one - yy - zz, xy - w.z, zx + w.y},
            {xy + w.z, one - xx - zz, yz - w.x},
            {zx - w.y, yz + w.x, one - xx - yy}}}};
}

/// Q s Q^T.
template <class R>
KARDAN_INLINE SymmetricTensor<R> turned(const Mat3T<R>& q, const SymmetricTensor<R>& s) {
  const Mat3T<R> full{{{{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}}}};
  const Vec3T<R> x = full * q[0], y = full * q[1], z = full * q[2];
  return {dot(q[0], x), dot(q[1], y), dot(q[2], z), dot(q[0], y), dot(q[1], z), dot(q[2], x)};
}

/// Turns the tensors that a law's history begins with.
template <class R>
KARDAN_INLINE void turn_tensors(const Mat3T<R>& q, std::size_t count, double* history) {
  for (std::size_t i = 0; i < count; ++i) {
    double* h = history + i * 6 * block_lanes;
    store_tensor(turned(q, load_tensor<R>(h)), h);
  }
}

/// V^(1/3) by two steps of Newton's method from the root of the cycle before; the volume of an element changes little a
/// cycle.
template <class R>
KARDAN_INLINE R cube_root(const R& v, const R& before) {
  R l = before;
  for (int i = 0; i < 2; ++i) l = (l + l + v / (l * l)) * R(1.0 / 3.0);
  return l;
}

/// V / A_max with the areas of the six faces, half the product of the diagonals.
template <class R>
KARDAN_INLINE R characteristic_length(const Vec3T<R> (&x)[8], const R& volume) {
  const auto face = [&](int a, int b, int c, int d) {
    const Vec3T<R> n = cross(x[c] - x[a], x[d] - x[b]);
    return dot(n, n);
  };
  const R largest = max(max(max(face(0, 3, 2, 1), face(4, 5, 6, 7)), max(face(0, 1, 5, 4), face(1, 2, 6, 5))),
                        max(face(2, 3, 7, 6), face(3, 0, 4, 7)));
  return volume / (R(0.5) * sqrt(largest));
}

/// What a block's elements report and give to their nodes.
struct SolidBlock : BlockReport {
  double tetrahedron[block_lanes];  ///< 3 of a tetrahedron, whose length is its altitude 3 V/A; else 1
  NodalForces<8, 3> force;
};

/// Forces of the hourglass modes at t_n on the geometry of the middle of the step; returns their work over the step.
template <class R>
KARDAN_INLINE R hourglass_forces(const SolidProperties& p, const Modes<R>& x, const Modes<R>& v,
                                 const MeanGradient<R>& g, const Mat3T<R>& l, const Mat3T<R>& q, const R& dt,
                                 const R& area, double* history, Vec3T<R> (&force)[4]) {
  R factor = R(p.hourglass) * area;
  if (p.stiffness_hourglass) {
    R bb{};
    for (int k = 0; k < 6; ++k) bb += dot(g.b[k], g.b[k]);
    factor = R(p.hourglass) * R(8.0) * bb / g.volume * dt;
  }
  R work{};
  for (int k = 0; k < 4; ++k) {
    double* h = history + static_cast<std::size_t>(k) * 3 * block_lanes;
    const Vec3T<R> old{R::load(h), R::load(h + block_lanes), R::load(h + 2 * block_lanes)};
    const Vec3T<R> rate = (v.a[k + 3] - l * x.a[k + 3]) * R(8.0);
    const Vec3T<R> own = rate * factor;
    if (p.stiffness_hourglass) {
      const Vec3T<R> before = q * old, after = before + own;
      work += R(0.5) * dot(before + after, rate) * dt;
      force[k] = q * after;
    } else {
      work += R(0.5) * dot(old + own, rate) * dt;
      force[k] = own;
    }
    force[k].x.store(h);
    force[k].y.store(h + block_lanes);
    force[k].z.store(h + 2 * block_lanes);
  }
  return work;
}

/// Lanes [first, first + R::lanes) of a block.
template <class R, class Law>
KARDAN_INLINE void solid_pack(const SolidProperties& p, const Law& law, const TileWork& work, const std::uint16_t* connectivity,
                              SolidBlock& block, double* history, std::size_t first) {
  namespace kept = solid_history;
  const R dt(work.step.dt), zero(0.0);
  history += first;
  Vec3T<R> corner[8], rate[8];
  for (std::size_t a = 0; a < 8; ++a) {
    const std::uint16_t* index = connectivity + a * block_lanes + first;
    corner[a] = gather_vectors<node_stride(3)>(work.node, index);
    rate[a] = gather_vectors<node_stride(3)>(work.node + 4, index);
  }
  const Modes<R> x = to_modes(corner), v = to_modes(rate);
  const MeanGradient<R> now = mean_gradient(x);
  const R length = characteristic_length(corner, now.volume) * R::load(block.tetrahedron + first);

  MaterialPoint<R> point;
  SymmetricTensor<R>& stress = point.stress;
  Vec3T<R> hourglass[4];
  R divergence;
  const auto alive_before = R::load(block.alive + first) > zero;
  {
    Modes<R> middle;
    const R half_dt(0.5 * work.step.dt);
    for (int k = 0; k < 7; ++k) middle.a[k] = x.a[k] - v.a[k] * half_dt;
    const MeanGradient<R> g = mean_gradient(middle);
    const Mat3T<R> l = sum_outer<6>(v.a, g.b, R(8.0) / g.volume);
    const Mat3T<R> q = half_rotation(l, dt);
    const R half(0.5);
    const SymmetricTensor<R>& d = point.strain = {l[0].x * dt,
                                                  l[1].y * dt,
                                                  l[2].z * dt,
                                                  half * (l[0].y + l[1].x) * dt,
                                                  half * (l[1].z + l[2].y) * dt,
                                                  half * (l[2].x + l[0].z) * dt};
    divergence = l[0].x + l[1].y + l[2].z;
    double* h = history + kept::stress * block_lanes;
    double* const own = history + kept::law * block_lanes;
    double* viscosity = history + kept::viscosity * block_lanes;
    const R original = R::load(history + kept::volume * block_lanes);
    point.volume = now.volume / original;

    // Bulk viscosity, on density and length of t_n.
    double* kept_size = history + kept::size * block_lanes;
    const R size = cube_root(now.volume, R::load(kept_size)), squeeze = max(-divergence, zero);
    size.store(kept_size);
    const R pressure =
        R(p.density) * original / now.volume * size * squeeze * (R(p.q1) * size * squeeze + R(p.q2) * R(p.wave_speed));
    const R both = R::load(viscosity) + pressure;
    pressure.store(viscosity);
    point.viscosity = half * both;
    point.modulus = R(p.longitudinal);
    stress = turned(q, load_tensor<R>(h));
    R energy = contraction(stress, d);
    turn_tensors(q, law.tensors(), own);
    law.update(point, work.step, own);
    turn_tensors(q, law.tensors(), own);
    energy += contraction(stress, d);
    stress = turned(q, stress);
    store_tensor(stress, h);
    energy -= both * divergence * dt;
    stress.xx -= pressure;
    stress.yy -= pressure;
    stress.zz -= pressure;
    select(alive_before, R(0.5) * energy * g.volume, zero).store(block.internal + first);
    const R hourglass_work = hourglass_forces(p, middle, v, g, l, q, dt, size * size, history + kept::hourglass * block_lanes, hourglass);
    select(alive_before, hourglass_work, zero).store(block.hourglass + first);
  }

  const Mat3T<R> arm = sum_outer<4>(hourglass, x.a + 3, R(8.0) / now.volume);
  const Mat3T<R> s{{{{stress.xx - arm[0].x, stress.xy - arm[0].y, stress.zx - arm[0].z},
                     {stress.xy - arm[1].x, stress.yy - arm[1].y, stress.yz - arm[1].z},
                     {stress.zx - arm[2].x, stress.yz - arm[2].y, stress.zz - arm[2].z}}}};
  Modes<R> f;
  for (int k = 0; k < 6; ++k) f.a[k] = s * now.b[k];
  f.a[6] = Vec3T<R>{};
  for (int k = 0; k < 4; ++k) f.a[k + 3] += hourglass[k];
  to_nodes(f, corner);
  const R intact = select(alive_before & (point.failed < R(0.5)), R(1.0), zero);
  intact.store(block.alive + first);
  for (std::size_t a = 0; a < 8; ++a) block.force.set(a, first, corner[a]);

  const R c = sqrt(point.modulus * R(1.0 / p.density)), damping = select(divergence < zero, R(p.q2) * c - R(p.q1) * length * divergence, zero);
  const R stable = length / (damping + sqrt(damping * damping + c * c));
  select(now.volume > zero, stable, -R(1.0)).store(block.time_step + first);
}

/// What tells tetrahedra from the rest.
KARDAN_INLINE void find_tetrahedra(const std::uint16_t* connectivity, SolidBlock& block) {
  for (std::size_t l = 0; l < block_lanes; ++l) {
    const bool tetrahedron = connectivity[2 * block_lanes + l] == connectivity[3 * block_lanes + l] &&
                             connectivity[4 * block_lanes + l] == connectivity[6 * block_lanes + l];
    block.tetrahedron[l] = tetrahedron ? 3.0 : 1.0;
  }
}

/// A tile; Law is Inlined or Called.
template <class Law>
void solid_tile(TileWork& work) {
  const SolidProperties& p = *static_cast<const SolidProperties*>(work.properties);
  const Law law(p.law);
  SolidBlock block;
  for_each_block<8>(work, 3, solid_history::law + law.history(), block,
                    [&](const std::uint16_t* connectivity, std::size_t, double* history) {
                      find_tetrahedra(connectivity, block);
                      for (std::size_t l = 0; l < block_lanes; l += Pack::lanes) {
                        solid_pack<Pack>(p, law, work, connectivity, block, history, l);
                      }
                      block.force.scatter(connectivity, block.alive, work.force);
                    });
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
