#include "kardan/elements/solid/solid_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kardan/elements/damping_factors.hpp"
#include "kardan/elements/free_sides.hpp"
#include "kardan/elements/geometry.hpp"
#include "kardan/elements/hourglass.hpp"
#include "kardan/elements/initial_stress.hpp"

namespace kardan {

namespace {

using namespace solid_elform;

/// -1 and -2 are 2 with a Jacobian that stiffens slender elements less, which LS-DYNA's makers have not published in full.
constexpr bool selective_elform(int elform) { return elform == selective || elform == slender || elform == slender_exact; }

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

bool erodes(const Model& model) { return model.control.time_step.erode % 10 == 1; }

SolidProperties properties_of(const Model& model, const Part& part, SolidShape shape, const Law& law, std::size_t points) {
  SolidProperties p;
  p.law = {law.constants.get(), law.update, law.history(), law.tensors};
  p.density = law.density;
  p.longitudinal = law.longitudinal;
  p.wave_speed = std::sqrt(law.longitudinal / law.density);
  p.poissons_ratio = law.poissons_ratio;
  p.nodal_pressure = model.sections[at(part.section)].solid.elform == nodal_tetrahedra;
  p.erode = erodes(model);
  p.failing_points = failing_points(law.deletion, static_cast<int>(points));
  const HourglassChoice h = hourglass_of(model, part);
  p.q1 = h.q1;
  p.q2 = h.q2;
  if (h.type == 6 || shape == SolidShape::pentahedron) {
    p.hourglass = SolidHourglass::assumed_strain;
    p.hourglass_scale = h.membrane * law.shear;
  } else if (h.stiffness()) {
    p.hourglass = SolidHourglass::stiffness;
    p.hourglass_scale = h.membrane * law.longitudinal / 16;
  } else {
    p.hourglass_scale = h.membrane * p.density * p.wave_speed / 4;
  }
  return p;
}

TileElements cut(const Model& model, SolidShape shape) {
  static constexpr const char* names[] = {"solids", "tetrahedra", "pentahedra", "quadratic solids"};
  static constexpr std::size_t nodes_of[] = {8, 4, 6, 8}, components[] = {3, 3, 3, 6};
  const std::size_t count = nodes_of[static_cast<std::size_t>(shape)];
  std::vector<Index> elements;
  std::vector<NodeIndex> flat(model.solids.size() * count, 0);
  for (std::size_t e = 0; e < model.solids.size(); ++e) {
    const Part& part = model.parts[at(model.solids.part[e])];
    if (part.section == none || part.material == none || model.rigid_part(model.solids.part[e]) || shape_of(model, e) != shape) continue;
    elements.push_back(static_cast<Index>(e));
    const auto& nodes = model.solids.nodes[e];
    const auto put = [&](const auto& own) { std::copy(own.begin(), own.end(), flat.begin() + static_cast<std::ptrdiff_t>(e * count)); };
    if (count == 8) put(nodes);
    if (shape == SolidShape::tetrahedron) put(*tetrahedron_nodes(nodes));
    if (shape == SolidShape::pentahedron) put(*pentahedron_nodes(nodes));
  }
  return TileElements({names[static_cast<std::size_t>(shape)], "solid", ElementKind::solid, model.solids.id,
                       {elements, model.solids.part, flat, count, model.nodes.x}, components[static_cast<std::size_t>(shape)]},
                      model.nodes.size());
}

/// Own values of a quadratic hexahedron at t = 0.
void start_quadratic(const ElementCoordinates<8>& x, double* own) {
  own[quadratic_history::longest_edge_square * block_lanes] = longest_edge_square(x);
  for (std::size_t i = 0; i < quadratic_point_count; ++i) {
    const QuadraticPoint& q = quadratic_points[i];
    own[(quadratic_history::jacobian + i) * block_lanes] = hexahedron_jacobian(x, {q.r, q.s, q.t});
  }
}

}  // namespace

SolidForces::SolidForces(const Model& model, State& state, Diagnostics& diagnostics)
    : shapes_{Shape{cut(model, SolidShape::hexahedron), {}}, Shape{cut(model, SolidShape::tetrahedron), {}},
              Shape{cut(model, SolidShape::pentahedron), {}}, Shape{cut(model, SolidShape::quadratic), {}}},
      laws_(model.parts.size()),
      nodal_pressure_(model.parts.size(), 0) {
  bool good = true, any = false, deletable = false;
  for (const SolidShape shape : solid_shapes) {
    Shape& own = shapes_[static_cast<std::size_t>(shape)];
    own.formulation.resize(model.parts.size());
    any = any || !own.elements.empty();
    for (const PartIndex part : own.elements.parts()) good = set_up_part(model, shape, part, diagnostics) && good;
  }
  if (!good || !any) return;
  for (Shape& shape : shapes_) {
    shape.elements.start(state);
    start_histories(model, shape);
    deletable = deletable || shape.elements.deletable();
  }
  preload(model, diagnostics);
  TileElements& fours = shapes_[static_cast<std::size_t>(SolidShape::tetrahedron)].elements;
  if (std::find(nodal_pressure_.begin(), nodal_pressure_.end(), 1) != nodal_pressure_.end()) {
    fours.node_values().assign(fours.mesh().node.size(), 1.0);
    nodal_volumes_.set_up(fours, nodal_pressure_, model.nodes.x);
  }
  state.results.solid.stress.assign(model.solids.size(), StressVector{});
  state.results.solid.plastic_strain.assign(model.solids.size(), 0.0);
  if (deletable) state.results.solid.alive.assign(model.solids.size(), 1);
}

void SolidForces::start_histories(const Model& model, Shape& shape) {
  shape.elements.for_each([&](Index solid, PartIndex part, double* own) {
    const SolidFormulation& f = *shape.formulation[at(part)];
    const auto& nodes = model.solids.nodes[at(solid)];
    const double volume = solid_volume(gather_coordinates(model.nodes.x, nodes), nodes);
    own[solid_history::volume * block_lanes] = volume;
    own[solid_history::inverse_size * block_lanes] = 1 / std::cbrt(volume);
    if (&f == &one_point_tetrahedron) own[solid_history::own * block_lanes] = 1;  // volume ratio of the nodes
    if (&f == &quadratic_hexahedron) start_quadratic(gather_coordinates(model.nodes.x, nodes), own + solid_history::own * block_lanes);
    const std::vector<double>& start = laws_[at(part)].start;
    for (std::size_t p = 0; p < f.points; ++p) {
      const std::size_t law = solid_history::stress(f.own_values, start.size(), p) + 6;
      for (std::size_t k = 0; k < start.size(); ++k) own[(law + k) * block_lanes] = start[k];
    }
  });
  const std::vector<std::uint8_t> faces = free_faces(model.solids);
  const auto step_factor = [&](Index solid, PartIndex part) {
    const Law& law = laws_[at(part)];
    return free_solid_factor(model, solid, faces[at(solid)], {law.density, law.shear, law.longitudinal, 0});
  };
  shape.elements.scale_steps(step_factor);
  if (model.stiffness_dampings.empty()) return;
  const auto beta = [&](Index solid, PartIndex part) {
    const StiffnessDamping* damping = stiffness_damping_of(model, part);
    if (damping == nullptr) return 0.0;
    const Law& law = laws_[at(part)];
    const auto& nodes = model.solids.nodes[at(solid)];
    const double length = solid_length(gather_coordinates(model.nodes.x, nodes), nodes);
    return damping_factor(*damping, length * std::sqrt(law.density / law.longitudinal) * step_factor(solid, part));
  };
  shape.elements.set_damping(beta);
  shape.elements.for_each([&](Index solid, PartIndex part, double* own) {
    const SolidFormulation& f = *shape.formulation[at(part)];
    const Law& law = laws_[at(part)];
    for (std::size_t p = 0; law.damping != Law::npos && p < f.points; ++p)
      own[(solid_history::stress(f.own_values, law.history(), p) + 6 + law.damping) * block_lanes] = beta(solid, part);
  });
}

void SolidForces::preload(const Model& model, Diagnostics& diagnostics) {
  PreloadCheck check(model);
  for (const auto& [solid, given] : initial_stresses_of(model, ElementKind::solid)) {
    for (Shape& shape : shapes_) {
      if (shape.elements.values_of(solid) == nullptr) continue;  // of another shape, or of a rigid part
      const PartIndex part = shape.elements.part_of(solid);
      if (check.takes(model, part, laws_[at(part)], *given, diagnostics)) preload_solid(model, *given, solid, shape, diagnostics);
    }
  }
}

void SolidForces::preload_solid(const Model& model, const InitialStress& given, Index solid, Shape& shape, Diagnostics& diagnostics) {
  const PartIndex part = shape.elements.part_of(solid);
  const SolidFormulation& f = *shape.formulation[at(part)];
  const Law& law = laws_[at(part)];
  const std::size_t count = given.points.size();
  const bool unordered = &f == &quadratic_hexahedron;  // which of its points LS-DYNA counts first is not published
  if (count != 1 && (unordered || (count != f.points && count != 8))) {
    diagnostics.error(fmt::format("solid {} is given the initial stresses of {} points; its formulation has {}", model.solids.id[at(solid)], count,
                                  f.points),
                      unordered ? "give one point for the whole element of ELFORM 3" : "give one point for the whole element, or as many as the formulation has", "*INITIAL_STRESS_SOLID");
    return;
  }
  double* const values = shape.elements.values_of(solid);
  const double share = values[solid_history::volume * block_lanes] / static_cast<double>(f.points);
  double energy = 0;
  for (std::size_t p = 0; p < f.points; ++p) {
    double* const own = values + solid_history::stress(f.own_values, law.history(), p) * block_lanes;
    const PointPreload point = solid_preload(given, p, f.points);
    for (std::size_t c = 0; c < 6; ++c) own[c * block_lanes] = point.stress[c];
    energy += share * elastic_energy(law, point.stress);
    preload_history(law, point.plastic_strain, own + 6 * block_lanes);
  }
  shape.elements.add_energy(solid, energy);
}

const SolidFormulation* SolidForces::formulation_of(SolidShape shape, int elform, int esort) {
  switch (shape) {
    case SolidShape::hexahedron:
      return elform == one_point ? &one_point_hexahedron : selective_elform(elform) ? &full_hexahedron : nullptr;
    case SolidShape::tetrahedron:
      return elform == quadratic || (elform == pentahedra && esort != 1) ? nullptr : &one_point_tetrahedron;
    case SolidShape::pentahedron:
      return elform == tetrahedra || elform == nodal_tetrahedra ? nullptr : &two_point_pentahedron;
    case SolidShape::quadratic:
      return &quadratic_hexahedron;
  }
  return nullptr;
}

bool SolidForces::set_up_part(const Model& model, SolidShape shape, PartIndex p, Diagnostics& diagnostics) {
  const Part& part = model.parts[at(p)];
  const Section& section = model.sections[at(part.section)];
  bool good = true;
  const auto refuse = [&](const std::string& what, const std::string& cure, const char* keyword) {
    diagnostics.error("part " + std::to_string(part.id) + " has deformable solids of " + what +
                          ", which this version does not compute",
                      cure, keyword);
    good = false;
  };
  if (section.kind != ElementKind::solid) return false;  // the lumped masses have complained
  // A part of several shapes has one law: the kernels' properties point into it.
  if (!laws_[at(p)].update) {
    std::optional<Law> law = make_law(model, part, LawUse::solid, 1.0, diagnostics);
    if (law) laws_[at(p)] = std::move(*law);
    good = law.has_value();
  }
  const int elform = section.solid.elform;
  const std::string name = "ELFORM = " + std::to_string(elform) + " (section " + std::to_string(section.id) + ")";
  static constexpr const char* shapes[] = {"hexahedra, or wedges that are not sorted (ESORT)", "tetrahedra", "pentahedra", "quadratic"};
  if (elform != one_point && !selective_elform(elform) && elform != quadratic && elform != tetrahedra && elform != nodal_tetrahedra &&
      elform != pentahedra) {
    refuse(name, "use ELFORM = 1, 2 or 3, 10 or 13 for tetrahedra, 15 for pentahedra", "*SECTION_SOLID");
  } else if (!formulation_of(shape, elform, model.control.solid_esort)) {
    refuse(name + " that are " + shapes[static_cast<int>(shape)], "give ELFORM 10 and 13 four nodes, ELFORM 15 six, ELFORM 3 more than four, or use ELFORM = 1",
           "*SECTION_SOLID");
  }
  if (const int type = hourglass_of(model, part).type; type < 1 || type > 6) {
    refuse("hourglass control IHQ = " + std::to_string(type),
           "use IHQ = 1, 2 or 3 (viscous), 4 or 5 (stiffness), 6 (assumed strain), by *HOURGLASS", "*HOURGLASS");
  }
  if (const HourglassChoice h = hourglass_of(model, part);
      good && formulation_of(shape, elform, model.control.solid_esort) == &one_point_hexahedron && h.type <= 3 && h.membrane > 0.15) {
    diagnostics.warning(fmt::format("part {} has viscous hourglass control with QM = {:g}: beyond 0.14 it may be unstable at TSSFAC = 0.9", part.id, h.membrane),
                        "use QM <= 0.1, or IHQ = 4, 5 or 6", "*HOURGLASS");
  }
  if (!good) return false;
  if (elform < 0 && shape == SolidShape::hexahedron) {
    diagnostics.warning("part " + std::to_string(part.id) + ": " + name + " is computed as ELFORM = 2: elements of poor aspect ratio are too stiff in shear",
                        "use ELFORM = 1 with IHQ = 6 where that matters", "*SECTION_SOLID");
  }
  const Law& own = laws_[at(p)];
  Shape& target = shapes_[static_cast<std::size_t>(shape)];
  const SolidFormulation* formulation = target.formulation[at(p)] = formulation_of(shape, elform, model.control.solid_esort);
  if (shape == SolidShape::tetrahedron && elform == nodal_tetrahedra) nodal_pressure_[at(p)] = 1;
  target.elements.set_kernel(p, {kernel_for(formulation->kernels(), own),
                                 std::make_shared<const SolidProperties>(properties_of(model, part, shape, own, formulation->points)),
                                 formulation->history_size(own.history()), own.can_fail || erodes(model), own.deletion.step, erodes(model)});
  return true;
}

void SolidForces::internal_forces(const Model& model, State& state) {
  TileElements& fours = shapes_[static_cast<std::size_t>(SolidShape::tetrahedron)].elements;
  if (!fours.node_values().empty()) nodal_volumes_.compute(fours, state, fours.node_values());
  const auto fault = [&model](const State& now, Index solid) {
    const auto& nodes = model.solids.nodes[at(solid)];
    const double volume = solid_volume(gather_coordinates(now.nodes.x, nodes), nodes);
    return volume <= 0 ? fmt::format("has the negative volume {:.6g}", volume)
                       : std::string("is turned inside out at a corner, or has a value that is not finite");
  };
  for (Shape& shape : shapes_) shape.elements.internal_forces(model, state, fault);
}

void SolidForces::add_forces(State& state, NodeIndex begin, NodeIndex end) const {
  for (const Shape& shape : shapes_) {
    if (!shape.elements.empty()) shape.elements.add_forces(state, begin, end);
  }
}

Governing SolidForces::governing() const {
  Governing smallest = shapes_[0].elements.governing();
  for (const Shape& shape : shapes_) {
    if (shape.elements.governing().time_step < smallest.time_step) smallest = shape.elements.governing();
  }
  return smallest;
}

std::vector<TileElements*> SolidForces::elements() {
  std::vector<TileElements*> all;
  for (Shape& shape : shapes_) all.push_back(&shape.elements);
  return all;
}

std::int64_t SolidForces::deleted() const {
  std::int64_t count = 0;
  for (const Shape& shape : shapes_) count += shape.elements.deleted();
  return count;
}

double SolidForces::eroded_energy() const {
  double energy = 0;
  for (const Shape& shape : shapes_) energy += shape.elements.eroded_energy();
  return energy;
}

void SolidForces::add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
  for (const Shape& shape : shapes_) shape.elements.add_energies(internal, hourglass);
}

void SolidForces::report(SolidResults& results) const {
  for (const Shape& shape : shapes_) {
    shape.elements.for_each([&](Index solid, PartIndex part, const double* own) {
      const SolidFormulation& f = *shape.formulation[at(part)];
      const Law& law = laws_[at(part)];
      const bool alive = shape.elements.alive(solid) > 0;
      StressVector stress{};
      double strain = 0;
      for (std::size_t p = 0; p < f.points; ++p) {
        const double share = f.share(p);
        const double* point = own + solid_history::stress(f.own_values, law.history(), p) * block_lanes;
        for (std::size_t c = 0; c < 6; ++c) stress[c] += share * point[c * block_lanes];
        if (law.plastic_strain != Law::npos) strain += share * point[(6 + law.plastic_strain) * block_lanes];
      }
      results.stress[at(solid)] = alive ? stress : StressVector{};
      if (law.plastic_strain != Law::npos) results.plastic_strain[at(solid)] = strain;
      if (!results.alive.empty()) results.alive[at(solid)] = alive;
    });
  }
}

}  // namespace kardan
