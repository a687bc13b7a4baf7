// The loop of a beam kernel over the elements of a tile.
// Included by translation units that are compiled for one instruction set each; see base/simd.hpp.
#pragma once

#include "kardan/elements/beam/beam_formulations.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Nodal values of a block, gathered: [node][component][lane].
struct BeamBlock : BlockReport {
  double x[2][3][block_lanes];
  double v[2][6][block_lanes];
  double force[2][6][block_lanes];  ///< with which the nodes resist
};

template <class R>
KARDAN_INLINE Vec3T<R> load_vector(const double (*values)[block_lanes], std::size_t first) {
  return {R::load(values[0] + first), R::load(values[1] + first), R::load(values[2] + first)};
}

/// Lanes [first, first + R::lanes) of a block.
template <class R, class Formulation>
KARDAN_INLINE void beam_pack(const BeamProperties& p, const Formulation& formulation, const StepTime& step, BeamBlock& block,
                             double* history, std::size_t first) {
  using namespace beam_history;
  double* const h = history + first;
  const auto row = [&](std::size_t value) { return R::load(h + value * block_lanes); };
  const R zero(0.0);
  const BeamMotion<R> motion{load_vector<R>(block.x[1], first) - load_vector<R>(block.x[0], first),
                             load_vector<R>(block.v[1], first) - load_vector<R>(block.v[0], first),
                             {load_vector<R>(block.v[0] + 3, first), load_vector<R>(block.v[1] + 3, first)}};
  Vec3T<R> s{row(axis), row(axis + 1), row(axis + 2)};
  BeamTilt<R> tilts = BeamTilt<R>::load(h + tilt * block_lanes);
  const BeamIncrement<R> d = beam_increment(motion, R(step.dt), s, tilts);
  tilts.store(h + tilt * block_lanes);
  BeamElement<R> element{p, step, row(mass), row(inertia), {}, h + count * block_lanes};
  for (std::size_t i = 0; i < constants; ++i) element.constant[i] = row(constant + i);
  const BeamForce<R> old = BeamForce<R>::load(h + force * block_lanes);
  BeamForce<R> q = old;
  formulation.update(element, d, q);
  q.store(h + force * block_lanes);
  R living = R::load(block.alive + first);
  select(living > zero, R(0.5) * (beam_work(old, d) + beam_work(q, d)), zero).store(block.internal + first);
  zero.store(block.hourglass + first);
  living = living * element.intact;
  living.store(block.alive + first);

  const BeamAxes<R> axes = beam_axes(motion.line, s);
  for (std::size_t c = 0; c < 3; ++c) axes.s[c].store(h + (axis + c) * block_lanes);
  (R(2.0) / sqrt(formulation.frequency_square(element, axes.length))).store(block.time_step + first);
  const BeamNodal<R> nodal = beam_nodal(q, tilts, axes);
  const auto alive = living > zero;
  for (std::size_t c = 0; c < 3; ++c) {
    const R f = select(alive, nodal.force[c], zero);
    (-f).store(block.force[0][c] + first);
    f.store(block.force[1][c] + first);
    select(alive, nodal.moment[0][c], zero).store(block.force[0][c + 3] + first);
    select(alive, nodal.moment[1][c], zero).store(block.force[1][c + 3] + first);
  }
}

KARDAN_INLINE void gather(const TileWork& work, const std::uint16_t* connectivity, BeamBlock& block) {
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t l = 0; l < block_lanes; ++l) {
      const double* node = work.node + node_stride(6) * connectivity[a * block_lanes + l];
      for (std::size_t c = 0; c < 3; ++c) {
        block.x[a][c][l] = node[c];
        block.v[a][c][l] = node[c + 4];
        block.v[a][c + 3][l] = node[c + 8];
      }
    }
  }
}

KARDAN_INLINE void scatter(const TileWork& work, const std::uint16_t* connectivity, std::size_t lanes, const BeamBlock& block) {
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t l = 0; l < lanes; ++l) {
      double* f = work.sum + sum_stride(6) * connectivity[a * block_lanes + l];
      for (std::size_t c = 0; c < 6; ++c) f[c] -= block.force[a][c][l];
    }
  }
}

/// A tile of a formulation (of beam_formulations.hpp).
template <class Formulation>
void beam_tile(TileWork& work) {
  const BeamProperties& p = *static_cast<const BeamProperties*>(work.properties);
  const Formulation formulation(p);
  const std::size_t history_size = beam_history::count + static_cast<std::size_t>(p.points) * formulation.point_values();
  BeamBlock block;
  for_each_block<2, 6>(work, history_size, block, [&](const std::uint16_t* connectivity, std::size_t lanes, double* history) {
    gather(work, connectivity, block);
    for (std::size_t l = 0; l < block_lanes; l += Pack::lanes) beam_pack<Pack>(p, formulation, work.step, block, history, l);
    scatter(work, connectivity, lanes, block);
  });
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE
