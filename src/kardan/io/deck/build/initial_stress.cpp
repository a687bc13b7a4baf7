// *INITIAL_STRESS_SHELL, _SOLID (_SET) and _BEAM.
//
// Layouts: LS-DYNA keyword manual I. The lines of LARGE = 1 have fields of 16 columns, five a line; a shell's histories and tensors begin lines
// of their own, a solid's and a beam's follow the plastic strain.
#include <algorithm>
#include <string>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"
#include "kardan/model/beam_sections.hpp"

namespace kardan::deck {

namespace {

std::int64_t lines_of(std::int64_t values, std::int64_t per_line) { return values > 0 ? (values + per_line - 1) / per_line : 0; }

/// The elements that a first card names; empty with a message where there are none.
std::vector<Index> elements_of(Builder& b, const Card& card, ElementKind kind, bool set) {
  if (set) {
    const Index s = b.sets->reference(card, "sid", kind == ElementKind::shell ? SetKind::shell : SetKind::solid);
    return s == none ? std::vector<Index>{} : b.model.element_sets[static_cast<std::size_t>(s)].elements;
  }
  const Index e = b.elements[static_cast<std::size_t>(kind)].index(card.id("eid", IdKind::element));
  if (e != none) return {e};
  card.error("eid", "element " + card.text("eid") + " is not defined", "correct the number or take the entry away");
  return {};
}

/// Takes lines of history values; whether one of them is not zero.
bool take_histories(Block& block, const char* layout, std::int64_t lines) {
  bool any = false;
  for (std::int64_t i = 0; i < lines; ++i) {
    const Card card = block.next(layout);
    for (std::size_t k = 0; k < card.field_count(); ++k) any = any || card.real(static_cast<int>(k)) != 0;
  }
  return any;
}

constexpr std::array<const char*, 6> global_fields{"sigxx", "sigyy", "sigzz", "sigxy", "sigyz", "sigzx"};
constexpr std::array<const char*, 6> beam_fields{"sig11", "sig22", "sig33", "sig12", "sig23", "sig31"};

/// A point on one line, or on two of which the first has `on_first` of the components.
InitialStress::Point read_point(const std::array<const char*, 6>& fields, std::size_t on_first, const Card& first, const Card& second) {
  InitialStress::Point point;
  for (std::size_t c = 0; c < 6; ++c) point.stress[c] = (c < on_first ? first : second).real(fields[c], dimension::stress);
  point.plastic_strain = (on_first < 6 ? second : first).real("eps");
  if (point.plastic_strain < 0) {
    (on_first < 6 ? second : first).error("eps", "is negative, expected an effective plastic strain", "give 0 or more");
    point.plastic_strain = 0;
  }
  return point;
}

/// Stresses are in global axes: an include that is turned would have to turn them.
void refuse_turned(Builder& b, const Card& card) {
  if (!card.block().context().affine.is_identity)
    b.unsupported(card, "large", "initial stresses in an include that is moved (*INCLUDE_TRANSFORM) are not available", "give them in the main deck");
}

void refuse_thermal(Builder& b, const Card& card) {
  for (const char* field : {"nthint", "nthhsv"}) b.refuse_nonzero(card, field, "the thermal histories of initial stresses", "leave NTHINT and NTHHSV at 0");
}

std::size_t count_of(const Card& card, const char* field) { return static_cast<std::size_t>(std::max<std::int64_t>(1, card.integer(field))); }

void keep(Builder& b, InitialStress&& entry) {
  if (!entry.elements.empty()) b.model.initial_stresses.push_back(std::move(entry));
}

/// Beams of ELFORM 2 have no points.
bool has_resultants(const Model& model, const std::vector<Index>& beams) {
  if (beams.empty()) return false;
  const Index section = model.parts[static_cast<std::size_t>(model.beams.part[static_cast<std::size_t>(beams.front())])].section;
  return section != none && model.sections[static_cast<std::size_t>(section)].beam.elform == beam_elform::belytschko_schwer;
}

/// Every place through the thickness must be given at as many points as there are in the plane.
bool layered(InitialStress& entry) {
  std::vector<double> t;
  for (const InitialStress::Point& point : entry.points) t.push_back(point.t);
  std::sort(t.begin(), t.end());
  const auto per_layer = static_cast<std::size_t>(entry.planes);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool same = i > 0 && t[i] - t[i - 1] <= 1e-6;
    if (same != (i % per_layer != 0)) return false;
  }
  return true;
}

/// What the first card of all three keywords says.
InitialStress entry_of(Builder& b, const Card& card, ElementKind kind, bool set) {
  InitialStress entry;
  entry.kind = kind;
  entry.elements = elements_of(b, card, kind, set);
  refuse_turned(b, card);
  return entry;
}

}  // namespace

void build_initial_stress_shell(Builder& b, Block& block) {
  const bool set = block.keyword.ends_with("_SET");
  while (!block.at_end()) {
    const Card card = block.next("card0");
    InitialStress entry = entry_of(b, card, ElementKind::shell, set);
    entry.planes = static_cast<int>(count_of(card, "nplane"));
    refuse_thermal(b, card);
    b.ignored(card, "ntensr", "tensors of histories are not taken");
    const bool large = card.integer("large") != 0;
    const std::size_t points = static_cast<std::size_t>(entry.planes) * count_of(card, "nthick");
    for (std::size_t i = 0; i < points; ++i) {
      const Card first = block.next(large ? "large1" : "stress");
      if (!first.present()) return;
      entry.points.push_back(read_point(global_fields, large ? 4 : 6, first, block.next_if(large, "large2")));
      entry.points.back().t = first.real("t");
      const char* more = large ? "large_history" : "history";
      const std::int64_t per_line = large ? 5 : 8, tensors_per_line = large ? 5 : 6;
      entry.histories = take_histories(block, more, lines_of(card.integer("nhisv"), per_line)) || entry.histories;
      take_histories(block, more, lines_of(card.integer("ntensr"), tensors_per_line));
    }
    if (entry.planes != 1 && entry.planes != 4) {
      card.error("nplane", "found " + card.text("nplane") + ", expected 1 or 4 points in the plane", "correct it");
    } else if (!layered(entry)) {
      card.error("nthick", "the places T of the points do not make layers of NPLANE points", "give every T at NPLANE points");
    } else {
      keep(b, std::move(entry));
    }
  }
}

void build_initial_stress_solid(Builder& b, Block& block) {
  const bool set = block.keyword.ends_with("_SET");
  while (!block.at_end()) {
    const Card card = block.next("card0");
    InitialStress entry = entry_of(b, card, ElementKind::solid, set);
    refuse_thermal(b, card);
    b.refuse_nonzero(card, "iveflg", "initial volumes and energies with initial stresses", "leave IVEFLG at 0");
    const bool large = card.integer("large") != 0;
    if (!large && card.integer("nhisv") != 0) card.error("nhisv", "is not 0, but LARGE = 0 has no place for histories", "use LARGE = 1");
    const std::size_t points = count_of(card, "nint");
    for (std::size_t i = 0; i < points; ++i) {
      const Card first = block.next(large ? "large1" : "stress"), second = block.next_if(large, "large2");
      if (!first.present()) return;
      entry.points.push_back(read_point(global_fields, large ? 5 : 6, first, second));
      for (const char* field : {"hisv1", "hisv2", "hisv3"}) entry.histories = entry.histories || (large && second.real(field) != 0);
      if (large) entry.histories = take_histories(block, "large_history", lines_of(card.integer("nhisv") - 3, 5)) || entry.histories;
    }
    keep(b, std::move(entry));
  }
}

void build_initial_stress_beam(Builder& b, Block& block) {
  constexpr std::array<const char*, 6> names{"f11", "t11", "m12", "m13", "m22", "m23"};
  constexpr std::array<Dimension, 6> dimensions{dimension::force, dimension::moment, dimension::moment,
                                                dimension::moment, dimension::moment, dimension::moment};
  while (!block.at_end()) {
    const Card card = block.next("card0");
    InitialStress entry = entry_of(b, card, ElementKind::beam, false);
    b.refuse_nonzero(card, "naxes", "the axes of a beam with initial stresses", "leave NAXES at 0: they are those of its nodes");
    entry.local = card.integer("local") == 1;
    const bool large = card.integer("large") != 0;
    const std::int64_t points = card.integer("npts");
    const bool resultants = points <= 1 && has_resultants(b.model, entry.elements);
    for (std::int64_t i = 0; i < std::max<std::int64_t>(1, points); ++i) {
      const Card first = block.next(large ? (resultants ? "large_resultants1" : "large1") : (resultants ? "resultants" : "stress"));
      const Card second = block.next_if(large, resultants ? "large_resultants2" : "large2");
      if (!first.present()) return;
      if (resultants) {
        for (std::size_t c = 0; c < 6; ++c) entry.resultants.push_back((large && c == 5 ? second : first).real(names[c], dimensions[c]));
      } else {
        entry.points.push_back(read_point(beam_fields, large ? 5 : 6, first, second));
      }
      for (const char* field : {"hisv1", "hisv2", "hisv3"}) entry.histories = entry.histories || (large && second.real(field) != 0);
      if (large) entry.histories = take_histories(block, "large_history", lines_of(card.integer("nhisv") - 3, 5)) || entry.histories;
    }
    keep(b, std::move(entry));
  }
}

}  // namespace kardan::deck
