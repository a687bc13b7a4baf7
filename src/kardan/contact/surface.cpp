#include "kardan/contact/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "kardan/model/beam_sections.hpp"
#include "kardan/model/element_shape.hpp"
#include "kardan/model/properties.hpp"

namespace kardan {

namespace {

/// The distinct nodes of a face, ascending, the rest `none`: the same for all elements that have the face.
using FaceKey = std::array<NodeIndex, 4>;

struct FaceHash {
  std::size_t operator()(const FaceKey& k) const {
    std::size_t h = 0;
    for (const NodeIndex n : k) h = (h ^ static_cast<std::size_t>(n + 1)) * 0x9E3779B97F4A7C15u;
    return h ^ (h >> 29);
  }
};

FaceKey key_of(std::array<NodeIndex, 4> nodes) {
  std::sort(nodes.begin(), nodes.end());
  std::fill(std::unique(nodes.begin(), nodes.end()), nodes.end(), none);
  return nodes;
}

/// A face of a solid without repeated nodes, a triangle repeating its third; the first node is `none` where fewer than three are left.
std::array<NodeIndex, 4> face_of(const std::array<NodeIndex, 8>& solid, std::size_t face) {
  std::array<NodeIndex, 4> nodes{none, none, none, none};
  std::size_t count = 0;
  for (const std::size_t k : hexahedron_faces[face]) {
    const NodeIndex n = solid[k];
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(count), n) == nodes.begin() + static_cast<std::ptrdiff_t>(count))
      nodes[count++] = n;
  }
  if (count < 3) return {none, none, none, none};
  if (count == 3) nodes[3] = nodes[2];
  return nodes;
}

double shortest_side(const ElementCoordinates<4>& x, bool triangle) {
  double shortest = std::min(norm(x[1] - x[0]), norm(x[2] - x[1]));
  shortest = std::min(shortest, norm(x[0] - x[3]));
  return triangle ? shortest : std::min(shortest, norm(x[3] - x[2]));
}

double longest_diagonal(const ElementCoordinates<4>& x, bool triangle) {
  if (triangle) return std::max({norm(x[1] - x[0]), norm(x[2] - x[1]), norm(x[0] - x[2])});
  return std::max(norm(x[2] - x[0]), norm(x[3] - x[1]));
}

/// K = E/(3 (1 - 2 nu)); 0 where the material has no E. Nearly incompressible ones stop at nu = 0.495.
double bulk_modulus(double youngs_modulus, double poissons_ratio) {
  return youngs_modulus / (3 * (1 - 2 * std::min(poissons_ratio, 0.495)));
}

bool inside(const std::optional<std::array<Vec3, 2>>& box, const Vec3& x) {
  if (!box) return true;
  const auto& [low, high] = *box;
  return x.x >= low.x && x.y >= low.y && x.z >= low.z && x.x <= high.x && x.y <= high.y && x.z <= high.z;
}

}  // namespace

SurfaceRules surface_rules(const Model& model, const Contact& contact) {
  SurfaceRules rules;
  rules.automatic = contact.automatic;
  rules.shell_thickness = contact.shell_thickness;
  rules.limited_thickness = contact.single && !model.control.contact.full_thickness;
  rules.solid_thickness = contact.solid_thickness;
  rules.solid_modulus = contact.solid_stiffness;
  rules.eroding = contact.eroding;
  return rules;
}

bool adjacent(const Segment& a, const Segment& b) {
  for (const NodeIndex i : a.nodes)
    for (const NodeIndex j : b.nodes)
      if (i == j) return true;
  return false;
}

/// Gathers the segments and nodes of one side.
class SurfaceBuilder {
 public:
  SurfaceBuilder(const Model& model, const std::vector<Vec3>& x, const Contact& contact, const ContactSide& side, const SurfaceRules& rules,
                 Surface& surface)
      : model_(model), x_(x), contact_(contact), side_(side), rules_(rules), surface_(surface) {}

  void build(Diagnostics& diagnostics) {
    using Kind = ContactSide::Kind;
    if (side_.kind == Kind::parts || side_.kind == Kind::everything) add_parts();
    if (side_.kind == Kind::segments) add_given_segments(diagnostics);
    gather_nodes();
    if (side_.kind == Kind::nodes) add_given_nodes();
    list_segments_of_nodes();
    number_bodies();
    if (surface_.empty() && side_.kind != Kind::nothing)
      diagnostics.warning(fmt::format("contact {}{}: its {} side has neither segments nor nodes; the contact does nothing", contact_.id,
                                      contact_.title.empty() ? "" : " \"" + contact_.title + "\"",
                                      &side_ == &contact_.tracked ? "tracked (SURFA)" : "reference (SURFB)"),
                          "check the set or part it names, and its box", contact_.keyword);
  }

  void expose(const Alive& alive) {
    using Kind = ContactSide::Kind;
    if (side_.kind != Kind::parts && side_.kind != Kind::everything) return;
    const std::size_t before = surface_.segments_.size();
    std::vector<FaceKey> known;
    for (const Segment& s : surface_.segments_)
      if (s.kind == ElementKind::solid) known.push_back(key_of(s.nodes));
    std::sort(known.begin(), known.end());
    for (const Face& f : free_faces(wanted_parts(), alive))
      if (!std::binary_search(known.begin(), known.end(), f.key)) add_face(f);
    if (surface_.segments_.size() == before) return;
    for (SurfaceNode& n : surface_.nodes_) n.area = 0;
    for (Segment& s : surface_.segments_) s.body = none;
    list_segments_of_nodes();
    number_bodies();
    for (std::size_t s = before; s < surface_.segments_.size(); ++s)
      for (const NodeIndex n : surface_.segments_[s].nodes) take_means(surface_.place_of(n));
  }

 private:
  struct Face {
    FaceKey key;
    Index solid;
    std::uint8_t face;
  };
  /// A node that beams, or elements of a side of nodes, add.
  struct LooseNode {
    NodeIndex node;
    PartIndex part;
    double half_thickness, stiffness;
  };

  const PartContact* own(PartIndex part) const {
    const auto& contact = model_.parts[part].contact;
    return contact ? &*contact : nullptr;
  }
  bool in_box(const std::array<NodeIndex, 4>& nodes) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](NodeIndex n) { return inside(side_.box, x_[n]); });
  }
  double modulus(PartIndex part, bool solid) const {
    const Index m = model_.parts[part].material;
    if (m == none) return 0;
    const BulkProperties bulk = bulk_properties(model_.materials[m]);
    return bulk_modulus(solid && rules_.solid_modulus > 0 ? rules_.solid_modulus : bulk.youngs_modulus, bulk.poissons_ratio);
  }
  double stiffness_scale(PartIndex part) const {
    const PartContact* p = own(part);
    return side_.stiffness_scale * (p && p->stiffness_scale > 0 ? p->stiffness_scale : 1.0);
  }
  /// Contact thickness of an element `thick` thick.
  double thickness(PartIndex part, double thick) const {
    if (side_.thickness < 0) return 0;
    const PartContact* p = own(part);
    if (p && p->thickness > 0) thick = p->thickness;
    if (side_.thickness > 0) thick = side_.thickness;
    return thick * side_.thickness_scale * (p && p->thickness_scale > 0 ? p->thickness_scale : 1.0);
  }
  bool shells_have_thickness(PartIndex part) const {
    return rules_.automatic || rules_.shell_thickness == 2 || (rules_.shell_thickness == 1 && !model_.rigid_part(part));
  }

  Segment of_shell(Index shell, const std::array<NodeIndex, 4>& nodes) const {
    const ElementCoordinates<4> x = gather_coordinates(x_, nodes);
    const bool triangle = is_triangle(nodes);
    Segment s;
    s.nodes = nodes;
    s.kind = ElementKind::shell;
    s.element = shell;
    s.part = model_.shells.part[shell];
    s.one_sided = !rules_.automatic;
    s.area = shell_area(x);
    const double shortest = shortest_side(x, triangle);
    double thick = shells_have_thickness(s.part) ? thickness(s.part, mean_thickness(model_, shell)) : 0.0;
    if (rules_.limited_thickness) thick = std::min(thick, 0.4 * shortest);
    s.half_thickness = 0.5 * thick;
    s.depth = 0.5 * shortest;
    s.stiffness = modulus(s.part, false) * s.area / longest_diagonal(x, triangle) * stiffness_scale(s.part);
    return s;
  }

  Segment of_solid(Index solid, const std::array<NodeIndex, 4>& nodes) const {
    const double volume = std::abs(solid_volume(gather_coordinates(x_, model_.solids.nodes[solid]), model_.solids.nodes[solid]));
    Segment s;
    s.nodes = nodes;
    s.kind = ElementKind::solid;
    s.element = solid;
    s.part = model_.solids.part[solid];
    s.one_sided = true;
    s.area = shell_area(gather_coordinates(x_, nodes));
    s.half_thickness = 0.5 * (side_.thickness > 0 ? thickness(s.part, 0.0) : rules_.solid_thickness * side_.thickness_scale);
    s.depth = 0.5 * volume / s.area;
    s.stiffness = modulus(s.part, true) * s.area * s.area / volume * stiffness_scale(s.part);
    return s;
  }

  std::vector<std::uint8_t> wanted_parts() const {
    std::vector<std::uint8_t> wanted(model_.parts.size(), side_.kind == ContactSide::Kind::everything);
    for (const PartIndex p : side_.parts) wanted[p] = 1;
    return wanted;
  }

  void add_parts() {
    const std::vector<std::uint8_t> wanted = wanted_parts();
    for (std::size_t e = 0; e < model_.shells.size(); ++e)
      if (wanted[model_.shells.part[e]] && in_box(model_.shells.nodes[e]))
        surface_.segments_.push_back(of_shell(static_cast<Index>(e), model_.shells.nodes[e]));
    for (const Face& f : free_faces(wanted, [](ElementKind, Index) { return true; })) add_face(f);
    for (std::size_t e = 0; e < model_.beams.size(); ++e)
      if (wanted[model_.beams.part[e]]) add_beam(static_cast<Index>(e));
    if (!rules_.eroding) return;
    for (std::size_t e = 0; e < model_.solids.size(); ++e)
      if (wanted[model_.solids.part[e]])
        for (const NodeIndex n : model_.solids.nodes[e]) loose_.push_back({n, model_.solids.part[e], 0, 0});
  }

  void add_face(const Face& f) {
    if (const auto nodes = face_of(model_.solids.nodes[f.solid], f.face); in_box(nodes)) surface_.segments_.push_back(of_solid(f.solid, nodes));
  }

  /// Faces that occur once among all solids of the parts that are left, by solid and face.
  std::vector<Face> free_faces(const std::vector<std::uint8_t>& wanted, const Alive& alive) const {
    std::vector<Face> faces;
    for (std::size_t e = 0; e < model_.solids.size(); ++e) {
      const auto solid = static_cast<Index>(e);
      if (!wanted[model_.solids.part[e]] || !alive(ElementKind::solid, solid)) continue;
      for (std::size_t f = 0; f < 6; ++f)
        if (const auto nodes = face_of(model_.solids.nodes[e], f); nodes[0] != none)
          faces.push_back({key_of(nodes), solid, static_cast<std::uint8_t>(f)});
    }
    const auto by_key = [](const Face& a, const Face& b) {
      return a.key != b.key ? a.key < b.key : std::pair(a.solid, a.face) < std::pair(b.solid, b.face);
    };
    std::sort(faces.begin(), faces.end(), by_key);
    std::vector<Face> free;
    for (auto i = faces.begin(); i != faces.end();) {
      const auto next = std::find_if(i, faces.end(), [&](const Face& f) { return f.key != i->key; });
      if (next - i == 1) free.push_back(*i);
      i = next;
    }
    std::sort(free.begin(), free.end(), [](const Face& a, const Face& b) { return std::pair(a.solid, a.face) < std::pair(b.solid, b.face); });
    return free;
  }

  /// Thickness and stiffness of a node from its segments.
  void take_means(Index place) {
    SurfaceNode& n = surface_.nodes_[place];
    n.stiffness = 0;
    for (const Index s : surface_.segments_at(place)) {
      n.half_thickness = std::max(n.half_thickness, surface_.segments_[s].half_thickness);
      n.stiffness += surface_.segments_[s].stiffness / static_cast<double>(surface_.segments_at(place).size());
    }
  }

  void add_beam(Index beam) {
    const PartIndex part = model_.beams.part[beam];
    const auto& nodes = model_.beams.nodes[beam];
    if (model_.parts[part].section == none || !inside(side_.box, x_[nodes[0]]) || !inside(side_.box, x_[nodes[1]])) return;
    const double area = beam_area(beam_section(model_, beam)), length = norm(x_[nodes[1]] - x_[nodes[0]]);
    if (!(area > 0) || !(length > 0)) return;  // discrete beams
    surface_.beams_.push_back(beam);
    const double radius = 0.5 * thickness(part, 2 * std::sqrt(area / std::numbers::pi));
    for (const NodeIndex n : {nodes[0], nodes[1]})
      loose_.push_back({n, part, radius, modulus(part, false) * area / length * stiffness_scale(part)});
  }

  /// Each given segment takes the first shell, else the first solid, that has its nodes.
  void add_given_segments(Diagnostics& diagnostics) {
    std::unordered_map<FaceKey, Index, FaceHash> shell_of, solid_of;
    for (const auto& nodes : side_.segments) shell_of.emplace(key_of(nodes), none);
    solid_of = shell_of;
    const auto note = [](auto& map, const FaceKey& key, Index element) {
      if (const auto found = map.find(key); found != map.end() && found->second == none) found->second = element;
    };
    for (std::size_t e = 0; e < model_.shells.size(); ++e) note(shell_of, key_of(model_.shells.nodes[e]), static_cast<Index>(e));
    for (std::size_t e = 0; e < model_.solids.size(); ++e)
      for (std::size_t f = 0; f < 6; ++f)
        if (const auto nodes = face_of(model_.solids.nodes[e], f); nodes[0] != none) note(solid_of, key_of(nodes), static_cast<Index>(e));
    std::vector<std::array<NodeIndex, 4>> lost;
    for (const auto& nodes : side_.segments) {
      if (!in_box(nodes)) continue;
      const FaceKey key = key_of(nodes);
      if (const Index shell = shell_of.at(key); shell != none) surface_.segments_.push_back(of_shell(shell, nodes));
      else if (const Index solid = solid_of.at(key); solid != none) surface_.segments_.push_back(of_solid(solid, nodes));
      else lost.push_back(nodes);
    }
    if (!lost.empty()) warn_of_lost(lost, diagnostics);
  }

  void warn_of_lost(const std::vector<std::array<NodeIndex, 4>>& lost, Diagnostics& diagnostics) const {
    std::string text = fmt::format("contact {}: {} of its segments lie on no shell and no face of a solid; they are left out:", contact_.id,
                                   lost.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(lost.size(), 5); ++i) {
      const auto& n = lost[i];
      const Vec3& x = x_[n[0]];
      text += fmt::format("{} {} {} {} {} (at {:g}, {:g}, {:g})", i == 0 ? "" : ",", model_.nodes.id[n[0]], model_.nodes.id[n[1]],
                          model_.nodes.id[n[2]], model_.nodes.id[n[3]], x.x, x.y, x.z);
    }
    if (lost.size() > 5) text += " …";
    diagnostics.warning(text, "take segments of elements, or shells of *MAT_NULL on them", contact_.keyword);
  }

  /// Nodes of a side of nodes, with thickness and stiffness from the shells, solids and beams that have them.
  void add_given_nodes() {
    std::vector<std::uint8_t> wanted(model_.nodes.size(), 0);
    for (const NodeIndex n : side_.nodes) wanted[n] = inside(side_.box, x_[n]);
    for (const NodeIndex n : side_.nodes)
      if (wanted[n]) loose_.push_back({n, none, side_.thickness > 0 ? 0.5 * side_.thickness * side_.thickness_scale : 0.0, 0});
    for (std::size_t e = 0; e < model_.shells.size(); ++e) {
      const auto& nodes = model_.shells.nodes[e];
      if (std::none_of(nodes.begin(), nodes.end(), [&](NodeIndex n) { return wanted[n] != 0; })) continue;
      const Segment s = of_shell(static_cast<Index>(e), nodes);
      for (std::size_t k = 0; k < corners(s); ++k)
        if (wanted[nodes[k]]) loose_.push_back({nodes[k], s.part, s.half_thickness, s.stiffness});
    }
    for (std::size_t e = 0; e < model_.solids.size(); ++e) {
      const auto& nodes = model_.solids.nodes[e];
      if (std::none_of(nodes.begin(), nodes.end(), [&](NodeIndex n) { return n != none && wanted[n] != 0; })) continue;
      const PartIndex part = model_.solids.part[e];
      const double stiffness = modulus(part, true) * std::cbrt(std::abs(solid_volume(gather_coordinates(x_, nodes), nodes))) * stiffness_scale(part);
      for (const NodeIndex n : nodes)
        if (wanted[n]) loose_.push_back({n, part, 0.5 * rules_.solid_thickness * side_.thickness_scale, stiffness});
    }
    for (std::size_t e = 0; e < model_.beams.size(); ++e)
      if (wanted[model_.beams.nodes[e][0]] || wanted[model_.beams.nodes[e][1]]) add_beam(static_cast<Index>(e));
    std::erase_if(loose_, [&](const LooseNode& n) { return !wanted[n.node]; });
    merge_loose_nodes();
  }

  void gather_nodes() {
    for (const Segment& s : surface_.segments_)
      for (std::size_t k = 0; k < corners(s); ++k) loose_.push_back({s.nodes[k], s.part, s.half_thickness, s.stiffness});
    if (side_.kind != ContactSide::Kind::nodes) merge_loose_nodes();
  }

  void merge_loose_nodes() {
    std::stable_sort(loose_.begin(), loose_.end(), [](const LooseNode& a, const LooseNode& b) { return a.node < b.node; });
    for (auto i = loose_.begin(); i != loose_.end();) {
      SurfaceNode n{i->node, none, 0, 0, 0};
      int count = 0;
      const NodeIndex node = i->node;
      for (; i != loose_.end() && i->node == node; ++i) {
        if (n.part == none) n.part = i->part;
        n.half_thickness = std::max(n.half_thickness, i->half_thickness);
        n.stiffness += i->stiffness;
        count += i->stiffness > 0;
      }
      if (count > 1) n.stiffness /= count;
      surface_.nodes_.push_back(n);
    }
  }

  void list_segments_of_nodes() {
    std::vector<Index>& first = surface_.first_at_;
    first.assign(surface_.nodes_.size() + 1, 0);
    const auto each = [&](auto&& f) {
      for (std::size_t s = 0; s < surface_.segments_.size(); ++s)
        for (std::size_t k = 0; k < corners(surface_.segments_[s]); ++k) f(s, static_cast<std::size_t>(surface_.place_of(surface_.segments_[s].nodes[k])));
    };
    each([&](std::size_t, std::size_t place) { ++first[place + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    surface_.segment_at_.resize(static_cast<std::size_t>(first.back()));
    std::vector<Index> next(first.begin(), first.end() - 1);
    each([&](std::size_t s, std::size_t place) {
      surface_.segment_at_[next[place]++] = static_cast<Index>(s);
      const Segment& segment = surface_.segments_[s];
      surface_.nodes_[place].area += segment.area / static_cast<double>(corners(segment));
    });
  }

  /// Segments that hang together by nodes get one number.
  void number_bodies() {
    std::vector<Index>& first = surface_.first_at_;
    Index bodies = 0;
    std::vector<Index> open;
    for (Segment& seed : surface_.segments_) {
      if (seed.body != none) continue;
      seed.body = bodies;
      open.push_back(static_cast<Index>(&seed - surface_.segments_.data()));
      while (!open.empty()) {
        const Segment s = surface_.segments_[open.back()];
        open.pop_back();
        for (std::size_t k = 0; k < corners(s); ++k) {
          const Index place = surface_.place_of(s.nodes[k]);
          for (Index i = first[place]; i < first[place + 1]; ++i) {
            Segment& other = surface_.segments_[surface_.segment_at_[i]];
            if (other.body != none) continue;
            other.body = bodies;
            open.push_back(surface_.segment_at_[i]);
          }
        }
      }
      ++bodies;
    }
  }

  const Model& model_;
  const std::vector<Vec3>& x_;
  const Contact& contact_;
  const ContactSide& side_;
  const SurfaceRules& rules_;
  Surface& surface_;
  std::vector<LooseNode> loose_;
};

Surface::Surface(const Model& model, const State& state, const Contact& contact, const ContactSide& side, const SurfaceRules& rules,
                 Diagnostics& diagnostics) {
  SurfaceBuilder(model, state.nodes.x, contact, side, rules, *this).build(diagnostics);
}

void Surface::expose(const Model& model, const Contact& contact, const ContactSide& side, const SurfaceRules& rules, const Alive& alive) {
  SurfaceBuilder(model, model.nodes.x, contact, side, rules, *this).expose(alive);
}

void Surface::register_state(Registry& registry, const std::string& name) {
  const std::string writer = "contacts.drop_deleted";
  registry.keep_list({name + ".segments", "mixed", writer}, segments_);
  registry.keep({name + ".nodes", "mixed", writer}, nodes_);
  registry.keep({name + ".first_at", "1", writer}, first_at_);
  registry.keep_list({name + ".segment_at", "1", writer}, segment_at_);
}

Index Surface::place_of(NodeIndex node) const {
  const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), node, [](const SurfaceNode& n, NodeIndex i) { return n.node < i; });
  return found != nodes_.end() && found->node == node ? static_cast<Index>(found - nodes_.begin()) : none;
}

void size_nodal_report(const Surface& surface, std::size_t side, ContactReport& report) {
  for (const SurfaceNode& n : surface.nodes()) {
    report.nodes[side].push_back(n.node);
    report.nodal_area[side].push_back(n.area);
  }
  for (const Segment& s : surface.segments()) report.segments[side].push_back(s.nodes);
  report.nodal_force[side].assign(report.nodes[side].size(), Vec3{});
}

}  // namespace kardan
