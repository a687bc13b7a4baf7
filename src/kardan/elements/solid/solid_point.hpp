// What every solid does at an integration point and with its nodes, whatever its shape. Included by translation units that are
// compiled for one instruction set each.
//
// Strain increments are taken on the geometry of t_{n-1/2}, x_n - v dt/2, forces on that of t_n; the stress is turned by half the
// step's rotation (Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15, 1862-1867), updated, and turned by the other half, so a
// rigid rotation strains nothing and turns the stress exactly. Stress rate of Jaumann.
//
// Bulk viscosity: von Neumann and Richtmyer 1950, J. Appl. Phys. 21, 232-237, and Landshoff 1955, LASL LA-1930; stable step:
// Hallquist, LS-DYNA Theory Manual 2006, "Solid elements" and "Time step calculations for solid elements".
#pragma once

#include "kardan/base/vec3.hpp"
#include "kardan/elements/solid/solid_kernel.hpp"
#include "kardan/elements/tiles/tile_loop.hpp"
#include "kardan/elements/tiles/tile_nodes.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// What a block's elements report and give to their nodes.
template <std::size_t Nodes, std::size_t Components = 3>
struct SolidBlock : BlockReport {
  NodalForces<Nodes, Components> force;
};

/// What a pack is given beside its properties and law: the tile, the block's connectivity, and which lanes of the block it has.
struct PackPlace {
  const TileWork& work;
  const std::uint16_t* connectivity;
  std::size_t first;
};

/// Positions at t_n and velocities of the nodes of a pack. Components: of the nodes' forces.
template <std::size_t Nodes, std::size_t Components = 3>
struct PackNodes {
  Vec3T<Pack> x[Nodes], v[Nodes];

  KARDAN_INLINE explicit PackNodes(const PackPlace& place) {
    for (std::size_t a = 0; a < Nodes; ++a) {
      const std::uint16_t* index = place.connectivity + a * block_lanes + place.first;
      x[a] = gather_vectors<node_stride(Components)>(place.work.node, index);
      v[a] = gather_vectors<node_stride(Components)>(place.work.node + 4, index);
    }
  }
};

/// Angular velocities of the nodes of a pack, of elements whose nodes turn.
template <std::size_t Nodes>
KARDAN_INLINE void gather_spins(const PackPlace& place, Vec3T<Pack> (&omega)[Nodes]) {
  for (std::size_t a = 0; a < Nodes; ++a) {
    omega[a] = gather_vectors<node_stride(6)>(place.work.node + 8, place.connectivity + a * block_lanes + place.first);
  }
}

/// The value that node `a` carries behind its position (TileElements::node_values()).
KARDAN_INLINE Pack gather_node_value(const PackPlace& place, std::size_t a) {
  Pack r;
  for (std::size_t l = 0; l < Pack::lanes; ++l)
    r.v[l] = place.work.node[node_stride(3) * place.connectivity[a * block_lanes + place.first + l] + 3];
  return r;
}

/// Rotation by half of the step's: with tan(angle/2) = |t| of Hughes and Winget, tan(angle/4) = |u|, u = t/(1 + s), s = sqrt(1 + t.t),
/// Q = I + 2 (U + U U)/(1 + u.u) = I + T/s + T T/(s (1 + s)).
template <class R>
KARDAN_INLINE Mat3T<R> half_rotation(const Mat3T<R>& l, const R& dt) {
  const R h = R(0.25) * dt;
  const Vec3T<R> t{(l[2].y - l[1].z) * h, (l[0].z - l[2].x) * h, (l[1].x - l[0].y) * h};
  const R one(1.0), s = sqrt(one + dot(t, t)), inverse = one / (s * (one + s));
  const Vec3T<R> w = t * ((one + s) * inverse), u = t * inverse;
  const R xx = u.x * t.x, yy = u.y * t.y, zz = u.z * t.z, xy = u.x * t.y, yz = u.y * t.z, zx = u.z * t.x;
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

template <class R>
KARDAN_INLINE Mat3T<R> full_tensor(const SymmetricTensor<R>& s) {
  return {{{{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}}}};
}

/// Strain increment of a step, and the rotation of half of it.
template <class R>
struct PointMotion {
  SymmetricTensor<R> strain;
  Mat3T<R> turn;
};

/// @param l velocity gradient
template <class R>
KARDAN_INLINE PointMotion<R> point_motion(const Mat3T<R>& l, const R& dt) {
  const R half(0.5);
  return {{l[0].x * dt, l[1].y * dt, l[2].z * dt, half * (l[0].y + l[1].x) * dt, half * (l[1].z + l[2].y) * dt,
           half * (l[2].x + l[0].z) * dt},
          half_rotation(l, dt)};
}

/// Brings the stress at `stress` (history) and the law's values behind it to t_n; point.stress is the stress at t_n. Returns the
/// work of the stress on the strain increment per volume.
template <class R, class Law>
KARDAN_INLINE R update_point(const Law& law, const StepTime& step, const PointMotion<R>& motion, MaterialPoint<R>& point, double* stress) {
  double* const own = stress + 6 * block_lanes;
  point.strain = motion.strain;
  point.stress = turned(motion.turn, load_tensor<R>(stress));
  R work = contraction(point.stress, point.strain);
  turn_tensors(motion.turn, law.tensors(), own);
  law.update(point, step, own);
  turn_tensors(motion.turn, law.tensors(), own);
  work += contraction(point.stress, point.strain);
  point.stress = turned(motion.turn, point.stress);
  store_tensor(point.stress, stress);
  return R(0.5) * work;
}

/// V^(-1/3) by two steps of Newton's method, r <- r (4 - V r^3)/3, from that of the cycle before; the volume of an element changes
/// little a cycle.
template <class R>
KARDAN_INLINE R inverse_cube_root(const R& v, const R& before) {
  R r = before;
  for (int i = 0; i < 2; ++i) r = r * (R(4.0) - v * (r * r * r)) * R(1.0 / 3.0);
  return r;
}

/// Bulk viscosity at t_n on density and length of t_n, where the volume shrinks: rho l |D| (Q1 l |D| + Q2 c).
///
/// l is V^(1/3) (Hallquist), but not more than L, the length of the stable step. Between two faces of area A and mass rho A L/2 the
/// thickness has the frequency omega = 2 c/L, and the viscosity dq/dD = rho l Q2 c the damping ratio xi = dq/dD omega/(2 rho c^2) = Q2 l/L;
/// the step's limit is (sqrt(1 + xi^2) - xi) L/c. stable_step() has xi = Q2, which is right for l = L only: in flat elements V^(1/3) is
/// (a/L)^(2/3) L, at 1 : 20 xi would be 0.44 and the limit 0.65 L/c.
template <class R>
struct BulkViscosity {
  R before, pressure;  ///< at t_{n-1} and t_n
  R size;              ///< V^(1/3) at t_n

  /// @param volume at t_n, @param inverse_volume its inverse, @param length L
  KARDAN_INLINE BulkViscosity(const SolidProperties& p, const R& volume, const R& inverse_volume, const R& length, const R& divergence,
                               double* history) {
    double* const kept = history + solid_history::viscosity * block_lanes;
    double* const kept_root = history + solid_history::inverse_size * block_lanes;
    const R density = R(p.density) * R::load(history + solid_history::volume * block_lanes) * inverse_volume;
    const R root = inverse_cube_root(volume, R::load(kept_root));
    size = volume * (root * root);
    root.store(kept_root);
    const R squeeze = min(size, length) * max(-divergence, R(0.0));
    before = R::load(kept);
    pressure = density * squeeze * (R(p.q1) * squeeze + R(p.q2) * R(p.wave_speed));
    pressure.store(kept);
  }
  /// Of the step.
  KARDAN_INLINE R mean() const { return R(0.5) * (before + pressure); }
  /// Work per volume over the step.
  KARDAN_INLINE R work(const R& divergence, const R& dt) const { return -(mean() * divergence * dt); }
};

/// l/(Q + sqrt(Q^2 + c^2)) with c^2 = modulus/rho and, where the volume shrinks, Q = Q2 c + Q1 l |rate|; negative where the element is
/// inside out.
template <class R, class Mask>
KARDAN_INLINE R stable_step(const SolidProperties& p, const R& length, const R& divergence, const R& modulus, const Mask& good) {
  const R c = sqrt(modulus * R(1.0 / p.density)), zero(0.0);
  const R damping = select(divergence < zero, R(p.q2) * c - R(p.q1) * length * divergence, zero);
  return select(good, length / (damping + sqrt(damping * damping + c * c)), -R(1.0));
}

/// Energies and life of a pack of elements into the block. An element that died, now or before, gives nothing. `failed`: how many of its
/// points have.
template <class R, class Mask>
KARDAN_INLINE void report_life(const SolidProperties& p, BlockReport& block, std::size_t first, const R& internal, const R& hourglass,
                               const R& failed, const Mask& good) {
  const R zero(0.0), one(1.0);
  const auto alive_before = R::load(block.alive + first) > zero;
  R intact = select(alive_before & (failed < R(p.failing_points - 0.5)), one, zero);
  R counted = select(alive_before, one, zero);
  if (p.erode) {
    intact = select(good, intact, zero);
    counted = select(good, counted, zero);
  }
  intact.store(block.alive + first);
  select(counted > zero, internal, zero).store(block.internal + first);
  select(counted > zero, hourglass, zero).store(block.hourglass + first);
}

/// Likewise with the forces on nodes that do not turn.
template <std::size_t Nodes, class R, class Mask>
KARDAN_INLINE void report_pack(const SolidProperties& p, SolidBlock<Nodes>& block, std::size_t first, const Vec3T<R> (&force)[Nodes],
                               const R& internal, const R& hourglass, const R& failed, const Mask& good) {
  report_life(p, block, first, internal, hourglass, failed, good);
  for (std::size_t a = 0; a < Nodes; ++a) block.force.set(a, first, force[a]);  // scatter() leaves out those that are not alive
}

/// A tile of a formulation whose pack is computed by `pack(properties, law, place, block, history)`. The sizes are those of its
/// SolidFormulation.
template <std::size_t Nodes, std::size_t Points, std::size_t OwnValues, class Law, std::size_t Components = 3, class F>
KARDAN_INLINE void solid_tile(TileWork& work, F&& pack) {
  const SolidProperties& p = *static_cast<const SolidProperties*>(work.properties);
  const Law law(p.law);
  SolidBlock<Nodes, Components> block;
  const std::size_t values = solid_history::own + OwnValues + Points * (6 + law.history());
  for_each_block<Nodes, Components>(work, values, block, [&](const std::uint16_t* connectivity, std::size_t, double* history) {
    for (std::size_t l = 0; l < block_lanes; l += Pack::lanes) pack(p, law, PackPlace{work, connectivity, l}, block, history + l);
    block.force.scatter(connectivity, block.alive, work.sum);
  });
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
