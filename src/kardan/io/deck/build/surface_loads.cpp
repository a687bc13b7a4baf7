// *LOAD_SEGMENT, *LOAD_SHELL, *BOUNDARY_NON_REFLECTING.
#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

using Segment = std::array<NodeIndex, 4>;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// The one segment of *LOAD_SEGMENT; none where a node is missing.
std::vector<Segment> one_segment(Builder& b, const Card& card) {
  if (!card.blank("n5") && card.integer("n5") != 0) {
    b.unsupported(card, "n5", "a segment of six or eight nodes is not available", "divide it into segments of four nodes");
    return {};
  }
  Segment s{b.node(card, "n1"), b.node(card, "n2"), b.node(card, "n3"), b.optional_node(card, "n4")};
  if (s[0] == none || s[1] == none || s[2] == none) return {};
  if (s[3] == none) s[3] = s[2];
  return {s};
}

std::vector<Segment> segments_of_set(Builder& b, const Card& card) {
  const Index set = b.sets->reference(card, "ssid", SetKind::segment);
  return set == none ? std::vector<Segment>{} : b.model.segment_sets[at(set)].segments;
}

std::vector<Segment> one_shell(Builder& b, const Card& card) {
  const UserId id = card.id("eid", IdKind::element);
  const Index shell = b.elements[static_cast<std::size_t>(ElementKind::shell)].index(id);
  if (shell == none) {
    card.error("eid", "shell " + std::to_string(id) + " is not defined", "correct the number");
    return {};
  }
  return {segment_of_shell(b, shell)};
}

std::vector<Segment> shells_of_set(Builder& b, const Card& card) {
  std::vector<Segment> segments;
  const Index set = b.sets->reference(card, "esid", SetKind::shell);
  if (set == none) return segments;
  for (const Index shell : b.model.element_sets[at(set)].elements) segments.push_back(segment_of_shell(b, shell));
  return segments;
}

std::vector<Segment> loaded_segments(Builder& b, const std::string& keyword, const Card& card) {
  if (keyword == "LOAD_SEGMENT") return one_segment(b, card);
  if (keyword == "LOAD_SEGMENT_SET") return segments_of_set(b, card);
  return keyword == "LOAD_SHELL_SET" ? shells_of_set(b, card) : one_shell(b, card);
}

}  // namespace

Segment segment_of_shell(const Builder& b, Index shell) {
  Segment s = b.model.shells.nodes[at(shell)];
  if (s[3] == none) s[3] = s[2];
  return s;
}

void build_pressure(Builder& b, Block& block) {
  while (!block.at_end()) {
    if (block.has("ID")) block.next("id");
    const Card card = block.next("card0");
    if (!card.present()) return;
    PressureLoad load;
    load.segments = loaded_segments(b, block.keyword, card);
    if (card.id("lcid", IdKind::curve) < 0) {
      b.unsupported(card, "lcid", "a pressure of a blast function (LCID = " + card.text("lcid") + ") is not available",
                    "give a curve of *DEFINE_CURVE");
      continue;
    }
    load.curve = b.curve_or_constant(card, "lcid");
    load.scale = Builder::real_or(card, "sf", 1.0);
    load.arrival = card.real("at", dimension::time);
    if (load.arrival > 0) card.warning("at", "the curve is read at the time since the arrival, t - AT");
    if (load.curve != none && !load.segments.empty()) b.model.pressure_loads.push_back(std::move(load));
  }
}

void build_non_reflecting(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    NonReflectingBoundary boundary;
    boundary.segments = segments_of_set(b, card);
    boundary.dilatational = card.real("ad") == 0;
    boundary.shear = card.real("as_") == 0;
    if (!boundary.segments.empty()) b.model.non_reflecting.push_back(std::move(boundary));
  });
}

}  // namespace kardan::deck
