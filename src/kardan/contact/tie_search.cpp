#include "kardan/contact/tie_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "kardan/contact/closest_point.hpp"
#include "kardan/contact/surface.hpp"

namespace kardan {

namespace {

constexpr double thickness_share = 0.60, diagonal_share = 0.05;  ///< of LS-DYNA's tolerance
constexpr double overhang = 0.02;          ///< of the shorter diagonal: how far a node may stand beyond the segment's border
constexpr double facing = 0.5;             ///< cosine between the normals of segments that face each other
constexpr double cells_across = 32;        ///< at most so many cells along the largest segment
constexpr double touching = 1e-9;          ///< of the segment's size: nearer nodes lie in it
constexpr double rounding = 1e-13;         ///< of a coordinate
constexpr std::size_t listed = 10;         ///< nodes named in a message

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::array<Vec3, 4> corners_of(const Segment& s, const std::vector<Vec3>& x) {
  return {x[at(s.nodes[0])], x[at(s.nodes[1])], x[at(s.nodes[2])], x[at(s.nodes[3])]};
}

double shorter_diagonal(const std::array<Vec3, 4>& x, bool triangle) {
  if (triangle) return std::min({norm(x[1] - x[0]), norm(x[2] - x[1]), norm(x[0] - x[2])});
  return std::min(norm(x[2] - x[0]), norm(x[3] - x[1]));
}

/// Segments by the cells that their boxes, grown by a margin, lie in.
class SegmentGrid {
 public:
  SegmentGrid(const std::vector<Segment>& segments, const std::vector<Vec3>& x, double margin) {
    std::vector<std::array<Vec3, 2>> boxes;
    double mean = 0, largest = 0;
    for (const Segment& s : segments) {
      auto& [low, high] = boxes.emplace_back(std::array<Vec3, 2>{x[at(s.nodes[0])], x[at(s.nodes[0])]});
      for (const Vec3& corner : corners_of(s, x))
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], corner[k] - margin);
          high[k] = std::max(high[k], corner[k] + margin);
        }
      const Vec3 size = high - low;
      const double extent = std::max({size.x, size.y, size.z});
      mean += extent / static_cast<double>(segments.size());
      largest = std::max(largest, extent);
    }
    inverse_cell_ = 1 / std::max(mean, largest / cells_across);
    for (std::size_t s = 0; s < boxes.size(); ++s) {
      const auto low = cell(boxes[s][0]), high = cell(boxes[s][1]);
      for (std::int64_t i = low[0]; i <= high[0]; ++i)
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
          for (std::int64_t k = low[2]; k <= high[2]; ++k) entries_.push_back({key({i, j, k}), static_cast<Index>(s)});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /// Segments whose cells hold x, ascending; some of other cells may be among them.
  template <class F>
  void each_near(const Vec3& x, F&& f) const {
    const std::uint64_t wanted = key(cell(x));
    for (auto e = std::lower_bound(entries_.begin(), entries_.end(), Entry{wanted, 0}); e != entries_.end() && e->first == wanted; ++e)
      f(e->second);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  using Entry = std::pair<std::uint64_t, Index>;

  Cell cell(const Vec3& x) const {
    const auto of = [&](double c) { return static_cast<std::int64_t>(std::floor(c * inverse_cell_)); };
    return {of(x.x), of(x.y), of(x.z)};
  }
  static std::uint64_t key(const Cell& c) {
    std::uint64_t h = 0;
    for (const std::int64_t i : c) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
    return h;
  }

  double inverse_cell_ = 1;
  std::vector<Entry> entries_;
};

/// Finds the tied nodes of one contact.
class TieFinder {
 public:
  TieFinder(const Model& model, const State& state, std::size_t contact, Diagnostics& diagnostics)
      : model_(model), x_(state.nodes.x), index_(contact), contact_(model.contacts[contact]),
        tracked_(model, state, contact_, contact_.tracked, {.automatic = true}, diagnostics),
        reference_(model, state, contact_, contact_.reference, {.automatic = true}, diagnostics) {}

  std::vector<TiedPoint> find(Diagnostics& diagnostics) {
    std::vector<TiedPoint> points;
    std::vector<NodeIndex> loose;
    if (reference_.segments().empty()) return points;
    const SegmentGrid grid(reference_.segments(), x_, largest_tolerance());
    for (const SurfaceNode& node : tracked_.nodes()) {
      const Index nearest = nearest_segment(grid, node);
      if (nearest != none) points.push_back(point(node, nearest));
      else loose.push_back(node.node);
    }
    report(points.size(), loose, diagnostics);
    return points;
  }

 private:
  double tolerance(const Segment& s, const SurfaceNode& node) const {
    if (contact_.tie.distance > 0) return contact_.tie.distance;
    return std::max(thickness_share * 2 * (s.half_thickness + node.half_thickness),
                    diagonal_share * shorter_diagonal(corners_of(s, x_), corners(s) == 3));
  }
  double largest_tolerance() const {
    SurfaceNode thickest;
    for (const SurfaceNode& n : tracked_.nodes()) thickest.half_thickness = std::max(thickest.half_thickness, n.half_thickness);
    double largest = 0;
    for (const Segment& s : reference_.segments())
      largest = std::max(largest, tolerance(s, thickest) + overhang * shorter_diagonal(corners_of(s, x_), corners(s) == 3));
    return largest;
  }

  /// `none` if the node lies over no segment or is too far from all. Of equally close ones the first.
  Index nearest_segment(const SegmentGrid& grid, const SurfaceNode& node) const {
    Index nearest = none;
    double least = 0;
    grid.each_near(x_[at(node.node)], [&](Index i) {
      const Segment& s = reference_.segments()[at(i)];
      if (std::find(s.nodes.begin(), s.nodes.end(), node.node) != s.nodes.end()) return;
      const std::array<Vec3, 4> x = corners_of(s, x_);
      const bool triangle = corners(s) == 3;
      const ClosestPoint c = closest_point(x_[at(node.node)], x, triangle);
      const double reach = tolerance(s, node);
      if (c.square > reach * reach || (nearest != none && c.square >= least)) return;
      const bool inside = c.feature == (triangle ? 7 : 15);
      if (!inside && norm(c.u - c.normal * dot(c.u, c.normal)) > overhang * shorter_diagonal(x, triangle)) return;
      nearest = i;
      least = c.square;
    });
    return nearest;
  }

  TiedPoint point(const SurfaceNode& node, Index segment) const {
    const Segment& s = reference_.segments()[at(segment)];
    const ClosestPoint c = closest_point(x_[at(node.node)], corners_of(s, x_), corners(s) == 3);
    TiedPoint p;
    p.contact = index_;
    p.node = node.node;
    p.element = s.element;
    p.kind = s.kind;
    p.foot.nodes = s.nodes;
    p.foot.weights = c.weights;
    p.foot.corners = static_cast<std::uint8_t>(corners(s));
    if (s.kind == ElementKind::shell && !model_.rigid_part(s.part))
      p.foot.spin = contact_.tie.torsion ? Spin::nodal_with_torsion : Spin::nodal;
    if (c.square > touching * touching * s.area) p.arm = c.u;
    p.normal = s.one_sided ? c.normal : to_its_side(c, node, std::sqrt(s.area));
    p.area = facing_area(node, p.normal);
    return p;
  }

  /// A shell's normal, turned to the node; to the outside of the node's own solid, reversed, where the node lies in the shell.
  Vec3 to_its_side(const ClosestPoint& c, const SurfaceNode& node, double size) const {
    double side = dot(c.u, c.normal);
    if (std::abs(side) <= touching * size) {
      side = 0;
      for (const Index i : tracked_.segments_at(tracked_.place_of(node.node))) {
        const Segment& own = tracked_.segments()[at(i)];
        if (own.one_sided) side -= dot(closest_point(x_[at(node.node)], corners_of(own, x_), corners(own) == 3).normal, c.normal);
      }
    }
    return side < 0 ? -c.normal : c.normal;
  }

  /// Share of the node in those of its segments that face the other side, not those round a solid's edge.
  double facing_area(const SurfaceNode& node, const Vec3& normal) const {
    double area = 0;
    for (const Index i : tracked_.segments_at(tracked_.place_of(node.node))) {
      const Segment& own = tracked_.segments()[at(i)];
      const double cosine = dot(closest_point(x_[at(node.node)], corners_of(own, x_), corners(own) == 3).normal, normal);
      if ((own.one_sided ? -cosine : std::abs(cosine)) > facing) area += own.area / static_cast<double>(corners(own));
    }
    return area;
  }

  double distance_to_surface(NodeIndex node) const {
    double least = 1e300;
    for (const Segment& s : reference_.segments())
      if (std::find(s.nodes.begin(), s.nodes.end(), node) == s.nodes.end())
        least = std::min(least, closest_point(x_[at(node)], corners_of(s, x_), corners(s) == 3).square);
    return std::sqrt(least);
  }

  /// All nodes of a set are meant to be tied, of a surface those that lie on the other one.
  void report(std::size_t tied, const std::vector<NodeIndex>& loose, Diagnostics& diagnostics) const {
    const bool set = contact_.tracked.kind == ContactSide::Kind::nodes || !tracked_.beams().empty();
    const std::string count = fmt::format("contact {}: {} of {} nodes are tied", contact_.id, tied, tied + loose.size());
    if (loose.empty() || (!set && tied > 0)) return diagnostics.notice(count, contact_.keyword);
    std::vector<std::pair<double, NodeIndex>> worst;
    for (std::size_t i = 0; i < loose.size() && i * reference_.segments().size() < 20'000'000; ++i)
      worst.push_back({distance_to_surface(loose[i]), loose[i]});
    std::stable_sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text = count + "; the others are too far from the surface or beside it, node (distance):";
    for (std::size_t i = 0; i < std::min(worst.size(), listed); ++i)
      text += fmt::format("{} {} ({:.4g})", i == 0 ? "" : ",", model_.nodes.id[at(worst[i].second)], worst[i].first);
    diagnostics.warning(text + (loose.size() > listed ? " …" : ""), "move them, or give the distance to be tied as SAST < 0", contact_.keyword);
  }

  const Model& model_;
  const std::vector<Vec3>& x_;
  std::size_t index_;
  const Contact& contact_;
  Surface tracked_, reference_;
};

}  // namespace

std::vector<TiedPoint> find_tied_points(const Model& model, const State& state, std::size_t contact, Diagnostics& diagnostics) {
  return TieFinder(model, state, contact, diagnostics).find(diagnostics);
}

void size_tie_report(const Model& model, const State& state, std::size_t contact, ContactReport& report) {
  const Contact& c = model.contacts[contact];
  Diagnostics said_already;
  if (c.tracked.report_nodes) size_nodal_report(Surface(model, state, c, c.tracked, {.automatic = true}, said_already), 0, report);
  if (c.reference.report_nodes) size_nodal_report(Surface(model, state, c, c.reference, {.automatic = true}, said_already), 1, report);
}

void add_nodal_forces(const TiedPoint& point, const NodeState& nodes, const Vec3& force, const Vec3& at_foot, ContactReport& report) {
  const auto add = [&](std::size_t side, NodeIndex node, const Vec3& f) {
    const std::vector<NodeIndex>& of_side = report.nodes[side];
    if (of_side.empty()) return;
    report.nodal_force[side][static_cast<std::size_t>(std::lower_bound(of_side.begin(), of_side.end(), node) - of_side.begin())] += f;
  };
  add(0, point.node, force);
  if (report.nodes[1].empty()) return;
  SegmentFrame(point.foot, nodes, 0).share(-force, -at_foot, [&](std::size_t n, const Vec3& f, const Vec3&) { add(1, static_cast<NodeIndex>(n), f); });
}

void move_tied_nodes(Model& model, Diagnostics& diagnostics) {
  std::vector<TiedPoint> points;
  State state;
  state.nodes.x = model.nodes.x;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (contact.law != ContactLaw::tied || contact.tie.holding != Tie::Holding::constraint) continue;
    Diagnostics said_later;  // by the solver
    const std::vector<TiedPoint> found = find_tied_points(model, state, c, said_later);
    points.insert(points.end(), found.begin(), found.end());
  }
  if (points.empty()) return;
  std::vector<Index> point_of(model.nodes.size(), none);
  for (std::size_t i = points.size(); i-- > 0;) point_of[at(points[i].node)] = static_cast<Index>(i);  // the first contact holds
  std::vector<double> farthest(model.contacts.size(), 0.0);
  std::vector<NodeIndex> node(model.contacts.size(), none);
  std::vector<std::size_t> moved(model.contacts.size(), 0);
  std::vector<std::uint8_t> visited(points.size(), 0);
  const auto move = [&](auto&& self, std::size_t i) -> void {
    if (visited[i]) return;
    visited[i] = 1;
    const TiedPoint& p = points[i];
    p.foot.each([&](std::size_t k, std::size_t n) {
      if (p.foot.weights[k] != 0 && point_of[n] != none) self(self, at(point_of[n]));
    });
    const Vec3 goal = p.foot.mean(model.nodes.x);
    const double way = norm(goal - model.nodes.x[at(p.node)]);
    if (p.arm == Vec3{} && way <= rounding * norm(goal)) return;  // it lies there
    model.nodes.x[at(p.node)] = goal;
    ++moved[p.contact];
    if (way > farthest[p.contact]) farthest[p.contact] = way, node[p.contact] = p.node;
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (point_of[at(points[i].node)] == static_cast<Index>(i)) move(move, i);
  for (std::size_t c = 0; c < moved.size(); ++c)
    if (moved[c] > 0)
      diagnostics.notice(fmt::format("contact {}: {} nodes are moved onto the surface they are tied to, node {} the farthest: {:.4g}",
                                     model.contacts[c].id, moved[c], model.nodes.id[at(node[c])], farthest[c]), model.contacts[c].keyword);
}

}  // namespace kardan
