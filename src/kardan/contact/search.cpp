#include "kardan/contact/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace kardan {

namespace {

/// What a bound in single precision is made smaller by, so that it stays one.
constexpr double rounded_down = 1 - 1e-6;

struct SegmentShape {
  std::array<Vec3, 4> x;
  Vec3 center, normal;
  double radius2 = 0, warp = 0;  ///< largest square distance of a corner from the centre, largest distance from the mean plane
};

SegmentShape shape_of(const Segment& s, const std::vector<Vec3>& x) {
  SegmentShape shape;
  for (std::size_t k = 0; k < 4; ++k) shape.x[k] = x[s.nodes[k]];
  const double third = corners(s) == 3 ? 0.0 : 1.0;
  shape.center = (shape.x[0] + shape.x[1] + shape.x[2] + shape.x[3] * third) * (1 / (3 + third));
  const Vec3 n = cross(shape.x[2] - shape.x[0], third > 0 ? shape.x[3] - shape.x[1] : shape.x[2] - shape.x[1]);
  const double length = norm(n);
  shape.normal = length > 0 ? n * (1 / length) : Vec3{};
  for (const Vec3& corner : shape.x) {
    const Vec3 r = corner - shape.center;
    shape.radius2 = std::max(shape.radius2, dot(r, r));
    shape.warp = std::max(shape.warp, std::abs(dot(r, shape.normal)));
  }
  return shape;
}

}  // namespace

Index CandidateSearch::cell(double x, int axis) const {
  const double c = (x - origin_[axis]) * inverse_cell_;
  return static_cast<Index>(std::clamp(c, 0.0, static_cast<double>(count_[axis] - 1)));
}

/// Origin, cells and table for the nodes where they are now.
void CandidateSearch::make_grid(const SearchInput& in) {
  const std::vector<SurfaceNode>& nodes = in.nodes->nodes();
  const std::vector<Segment>& segments = in.segments->segments();
  if (sized_segments_ != segments.size()) {
    sized_segments_ = segments.size();
    size_ = reach_ = 0;
    for (const Segment& s : segments) size_ += std::sqrt(s.area) / static_cast<double>(segments.size());
    for (const SurfaceNode& n : nodes) reach_ = std::max(reach_, n.half_thickness);
  }
  boxes_.assign(node_pieces_.count(), Box{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}});
  for_each_piece(node_pieces_, [&](std::size_t piece, std::size_t begin, std::size_t end) {
    Box box = boxes_[piece];
    for (std::size_t p = begin; p < end; ++p)
      for (std::size_t a = 0; a < 3; ++a) {
        box.low[a] = std::min(box.low[a], (*in.x)[nodes[p].node][a]);
        box.high[a] = std::max(box.high[a], (*in.x)[nodes[p].node][a]);
      }
    boxes_[piece] = box;
  });
  Box all = boxes_.front();
  for (const Box& box : boxes_)
    for (std::size_t a = 0; a < 3; ++a) {
      all.low[a] = std::min(all.low[a], box.low[a]);
      all.high[a] = std::max(all.high[a], box.high[a]);
    }
  const double longest = std::max({all.high.x - all.low.x, all.high.y - all.low.y, all.high.z - all.low.z});
  cell_ = std::max(size_ + in.margin, longest * 1e-6);  // cell numbers of an axis fit well into an Index
  inverse_cell_ = 1 / cell_;
  for (std::size_t a = 0; a < 3; ++a) {
    origin_[a] = all.low[a];
    count_[a] = static_cast<std::int64_t>((all.high[a] - all.low[a]) * inverse_cell_) + 1;
  }
}

void CandidateSearch::sort_nodes(const SearchInput& in) {
  const std::vector<SurfaceNode>& nodes = in.nodes->nodes();
  placed_.start(node_pieces_.count(), cell_pieces_.count());
  for_each_piece(node_pieces_, [&](std::size_t piece, std::size_t begin, std::size_t end) {
    placed_.open(piece);
    for (std::size_t p = begin; p < end; ++p) {
      const Vec3& x = (*in.x)[nodes[p].node];
      const std::int64_t linear = cell(x.x, 0) + count_[0] * (cell(x.y, 1) + count_[1] * std::int64_t{cell(x.z, 2)});
      const auto place = static_cast<std::uint32_t>(static_cast<std::uint64_t>(linear) & (table_ - 1));
      placed_.put(piece, cell_pieces_.of(place), {{x, static_cast<Index>(p)}, place});
    }
  });
  entries_.resize(nodes.size());
  first_.resize(table_ + 1);
  std::vector<Index> before(cell_pieces_.count() + 1, 0);  // entries of the pieces before each
  for (std::size_t b = 0; b < cell_pieces_.count(); ++b) before[b + 1] = before[b] + static_cast<Index>(placed_.size(b));
  for_each_piece(cell_pieces_, [&](std::size_t piece, std::size_t begin, std::size_t end) {
    std::vector<Index> next(end - begin, 0);
    placed_.each(piece, [&](const PlacedEntry& e) { ++next[e.cell - begin]; });
    Index sum = before[piece];
    for (std::size_t c = begin; c < end; ++c) {
      first_[c] = sum;
      sum += std::exchange(next[c - begin], sum);
    }
    placed_.each(piece, [&](const PlacedEntry& e) { entries_[next[e.cell - begin]++] = e.entry; });
  });
  first_[table_] = static_cast<Index>(nodes.size());
}

/// f(first entry, end) for every run of entries that box and slab may hold together; a cell of the table is met once.
template <class F>
void CandidateSearch::for_each_row(const Box& box, const Slab& slab, F&& f) const {
  const std::int64_t x0 = cell(box.low.x, 0), x1 = cell(box.high.x, 0), y0 = cell(box.low.y, 1), y1 = cell(box.high.y, 1);
  const std::int64_t z0 = cell(box.low.z, 2), z1 = cell(box.high.z, 2);
  const std::int64_t from = x0 + count_[0] * (y0 + count_[1] * z0), to = x1 + count_[0] * (y1 + count_[1] * z1);
  if (static_cast<std::uint64_t>(to - from) + 1 >= table_) {  // cells of the box may share places: look at every node once
    f(Index{0}, first_[table_]);
    return;
  }
  const Vec3& n = slab.normal;
  const double inverse = std::abs(n.x) > 1e-3 ? 1 / n.x : 0.0, half_cell = 0.5 * cell_;
  // In the row about (y, z) the distance from the plane along x = center.x lies within `spread` of its value in the row's middle.
  const double spread = slab.half + half_cell * (std::abs(n.y) + std::abs(n.z)) + 1e-6 * cell_ +
                        (inverse == 0 ? std::abs(n.x) * (box.high.x - box.low.x) : 0.0);
  for (std::int64_t z = z0; z <= z1; ++z)
    for (std::int64_t y = y0; y <= y1; ++y) {
      const double middle = n.y * (origin_[1] + static_cast<double>(y) * cell_ + half_cell - slab.center.y) +
                            n.z * (origin_[2] + static_cast<double>(z) * cell_ + half_cell - slab.center.z);
      std::int64_t a = x0, b = x1;
      if (inverse != 0) {
        const double at = slab.center.x - middle * inverse, way = spread * std::abs(inverse);
        a = std::max(a, std::int64_t{cell(at - way, 0)});
        b = std::min(b, std::int64_t{cell(at + way, 0)});
        if (at + way < box.low.x || at - way > box.high.x) continue;
      } else if (std::abs(middle) > spread) {
        continue;
      }
      const std::uint64_t begin = static_cast<std::uint64_t>(a + count_[0] * (y + count_[1] * z)) & (table_ - 1);
      const std::uint64_t end = begin + static_cast<std::uint64_t>(b - a) + 1;
      f(first_[begin], first_[std::min(end, table_)]);
      if (end > table_) f(Index{0}, first_[end - table_]);
    }
}

void CandidateSearch::look_up(const SearchInput& in, Index segment, std::size_t piece) {
  const Segment& s = in.segments->segments()[segment];
  const SegmentShape shape = shape_of(s, *in.x);
  const double inflate = s.half_thickness + in.margin + reach_;
  Box own{shape.x[0], shape.x[0]};
  for (const Vec3& corner : shape.x)
    for (std::size_t a = 0; a < 3; ++a) {
      own.low[a] = std::min(own.low[a], corner[a]);
      own.high[a] = std::max(own.high[a], corner[a]);
    }
  const Vec3 by{inflate, inflate, inflate};
  const Box box{own.low - by, own.high + by};
  const double largest = std::sqrt(shape.radius2) + inflate, tiny = 1e-6 * largest;
  const BodyIndex body = (*in.body)[s.nodes[0]];
  const bool rigid = body != none && std::all_of(s.nodes.begin(), s.nodes.end(), [&](NodeIndex n) { return (*in.body)[n] == body; });
  for_each_row(box, {shape.center, shape.normal, inflate + shape.warp}, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Entry& e = entries_[i];
      const Vec3 r = e.x - shape.center;
      const double from_plane = std::abs(dot(r, shape.normal)) - shape.warp;
      if (from_plane > inflate || dot(r, r) > largest * largest) continue;
      const double from_box = std::max({own.low.x - e.x.x, e.x.x - own.high.x, own.low.y - e.x.y, e.x.y - own.high.y, own.low.z - e.x.z, e.x.z - own.high.z});
      if (from_box > inflate) continue;
      const SurfaceNode& node = in.nodes->nodes()[e.place];
      if (node.node == s.nodes[0] || node.node == s.nodes[1] || node.node == s.nodes[2] || node.node == s.nodes[3]) continue;
      if ((rigid && (*in.body)[node.node] == body) || (*in.dead_node)[e.place]) continue;
      const double gap = std::max(from_plane, from_box) - s.half_thickness - node.half_thickness;
      // Two nodes approach each other by at most twice the travel; inside a one-sided segment the finder wants half of that.
      const double wake = gap > in.awake + tiny ? (s.one_sided ? 0.25 : 0.5) * gap * rounded_down : 0.0;
      pairs_.put(piece, node_pieces_.of(static_cast<std::size_t>(e.place)), {e.place, segment, static_cast<float>(wake)});
    }
  });
}

void CandidateSearch::group(std::size_t nodes, Candidates& found) const {
  std::vector<Index> before(node_pieces_.count() + 1, 0);
  for (std::size_t b = 0; b < node_pieces_.count(); ++b) before[b + 1] = before[b] + static_cast<Index>(pairs_.size(b));
  found.first.resize(nodes + 1);
  found.segment.resize(static_cast<std::size_t>(before.back()));
  found.wake.resize(found.segment.size());
  for_each_piece(node_pieces_, [&](std::size_t piece, std::size_t begin, std::size_t end) {
    std::vector<Index> next(end - begin, 0);
    pairs_.each(piece, [&](const Pair& p) { ++next[static_cast<std::size_t>(p.place) - begin]; });
    Index sum = before[piece];
    for (std::size_t p = begin; p < end; ++p) {
      found.first[p] = sum;
      sum += std::exchange(next[p - begin], sum);
    }
    pairs_.each(piece, [&](const Pair& p) {
      const Index to = next[static_cast<std::size_t>(p.place) - begin]++;
      found.segment[to] = p.segment;
      found.wake[to] = p.wake;
    });
  });
  found.first[nodes] = before.back();
}

/// Joins pairs that must not be missing, awake, without repeats. They are few and rare.
void CandidateSearch::add_always(const std::vector<std::pair<Index, Index>>& always, Candidates& found) const {
  std::vector<std::pair<Index, Index>> add = always;
  std::sort(add.begin(), add.end());
  add.erase(std::unique(add.begin(), add.end()), add.end());
  Candidates all;
  auto next = add.begin();
  for (std::size_t p = 0; p + 1 < found.first.size(); ++p) {
    all.first.push_back(static_cast<Index>(all.segment.size()));
    const auto put = [&](Index segment, float wake) {
      all.segment.push_back(segment);
      all.wake.push_back(wake);
    };
    for (Index i = found.first[p]; i < found.first[p + 1]; ++i) {
      for (; next != add.end() && next->first == static_cast<Index>(p) && next->second < found.segment[i]; ++next) put(next->second, 0);
      const bool wanted = next != add.end() && next->first == static_cast<Index>(p) && next->second == found.segment[i];
      put(found.segment[i], wanted ? 0 : found.wake[i]);
      if (wanted) ++next;
    }
    for (; next != add.end() && next->first == static_cast<Index>(p); ++next) put(next->second, 0);
  }
  all.first.push_back(static_cast<Index>(all.segment.size()));
  found = std::move(all);
}

void CandidateSearch::find(const SearchInput& in, const std::vector<std::pair<Index, Index>>& always, Candidates& found) {
  const std::size_t nodes = in.nodes->nodes().size();
  table_ = std::bit_ceil(2 * std::max<std::size_t>(nodes, 1));
  node_pieces_ = Pieces(nodes);
  cell_pieces_ = Pieces(table_);
  segment_pieces_ = Pieces(in.segments->segments().size());
  if (nodes == 0) {
    found = {{0}, {}, {}};
    return;
  }
  make_grid(in);
  sort_nodes(in);
  pairs_.start(segment_pieces_.count(), node_pieces_.count());
  for_each_piece(segment_pieces_, [&](std::size_t piece, std::size_t begin, std::size_t end) {
    pairs_.open(piece);
    for (std::size_t s = begin; s < end; ++s)
      if (!(*in.dead_segment)[s]) look_up(in, static_cast<Index>(s), piece);
  });
  group(nodes, found);
  if (!always.empty()) add_always(always, found);
}

}  // namespace kardan
