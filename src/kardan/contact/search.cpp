#include "kardan/contact/search.hpp"

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

constexpr std::size_t chunk_segments = 512;

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

void CandidateSearch::sort_nodes(const SearchInput& in) {
  const std::vector<SurfaceNode>& nodes = in.nodes->nodes();
  const std::vector<Vec3>& x = *in.x;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const SurfaceNode& n : nodes)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], x[n.node][a]);
      high[a] = std::max(high[a], x[n.node][a]);
    }
  double size = 0;
  for (const Segment& s : in.segments->segments()) size += std::sqrt(s.area);
  size = in.segments->segments().empty() ? 1.0 : size / static_cast<double>(in.segments->segments().size()) + in.margin;
  const double longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  size = std::max(size, longest * 1e-6);  // cell numbers of an axis fit well into an Index
  inverse_cell_ = 1 / size;
  for (std::size_t a = 0; a < 3; ++a) {
    origin_[a] = low[a];
    count_[a] = static_cast<std::int64_t>((high[a] - low[a]) * inverse_cell_) + 1;
  }
  table_ = 2 * nodes.size() + 1;
  first_.assign(table_ + 1, 0);
  place_of_node_.resize(nodes.size());
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const Vec3& at = x[nodes[p].node];
    const std::int64_t linear = cell(at.x, 0) + count_[0] * (cell(at.y, 1) + count_[1] * std::int64_t{cell(at.z, 2)});
    const auto place = static_cast<Index>(static_cast<std::uint64_t>(linear) % table_);
    place_of_node_[p] = place;
    ++first_[place + 1];
  }
  for (std::size_t c = 0; c < table_; ++c) first_[c + 1] += first_[c];
  entries_.resize(nodes.size());
  for (std::size_t p = nodes.size(); p-- > 0;) entries_[--first_[place_of_node_[p] + 1]] = {x[nodes[p].node], static_cast<Index>(p)};
  // first_[c + 1] now is the begin of cell c: shift, and close with the end.
  std::copy(first_.begin() + 1, first_.end(), first_.begin());
  first_[table_] = static_cast<Index>(nodes.size());
}

/// f(first entry, end) for every run of entries that the box may hold; a cell of the table is met once.
template <class F>
void CandidateSearch::for_each_row(const Box& box, F&& f) const {
  const std::int64_t x0 = cell(box.low.x, 0), x1 = cell(box.high.x, 0), y0 = cell(box.low.y, 1), y1 = cell(box.high.y, 1);
  const std::int64_t z0 = cell(box.low.z, 2), z1 = cell(box.high.z, 2);
  const std::int64_t from = x0 + count_[0] * (y0 + count_[1] * z0), to = x1 + count_[0] * (y1 + count_[1] * z1);
  if (static_cast<std::uint64_t>(to - from) + 1 >= table_) {  // cells of the box may share places: look at every node once
    f(Index{0}, first_[table_]);
    return;
  }
  for (std::int64_t z = z0; z <= z1; ++z)
    for (std::int64_t y = y0; y <= y1; ++y) {
      const std::uint64_t begin = static_cast<std::uint64_t>(x0 + count_[0] * (y + count_[1] * z)) % table_;
      const std::uint64_t end = begin + static_cast<std::uint64_t>(x1 - x0) + 1;
      f(first_[begin], first_[std::min(end, table_)]);
      if (end > table_) f(Index{0}, first_[end - table_]);
    }
}

void CandidateSearch::look_up(const SearchInput& in, Index segment, double reach, std::vector<Pair>& pairs) const {
  const Segment& s = in.segments->segments()[segment];
  const SegmentShape shape = shape_of(s, *in.x);
  const double inflate = s.half_thickness + in.margin + reach;
  Box box{shape.x[0], shape.x[0]};
  for (const Vec3& corner : shape.x)
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], corner[a]);
      box.high[a] = std::max(box.high[a], corner[a]);
    }
  const Vec3 by{inflate, inflate, inflate};
  box.low -= by;
  box.high += by;
  const double largest = std::sqrt(shape.radius2) + inflate;
  const BodyIndex body = (*in.body)[s.nodes[0]];
  const bool rigid = body != none && std::all_of(s.nodes.begin(), s.nodes.end(), [&](NodeIndex n) { return (*in.body)[n] == body; });
  for_each_row(box, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Entry& e = entries_[i];
      const Vec3 r = e.x - shape.center;
      if (std::abs(dot(r, shape.normal)) > inflate + shape.warp || dot(r, r) > largest * largest) continue;
      if (e.x.x < box.low.x || e.x.x > box.high.x || e.x.y < box.low.y || e.x.y > box.high.y || e.x.z < box.low.z || e.x.z > box.high.z) continue;
      const NodeIndex node = in.nodes->nodes()[e.place].node;
      if (node == s.nodes[0] || node == s.nodes[1] || node == s.nodes[2] || node == s.nodes[3]) continue;
      if ((rigid && (*in.body)[node] == body) || (*in.dead_node)[e.place]) continue;
      pairs.push_back({e.place, segment});
    }
  });
}

void CandidateSearch::group(std::size_t nodes, const std::vector<std::pair<Index, Index>>& always, Candidates& found) {
  std::vector<Index>& first = found.first;
  first.assign(nodes + 1, 0);
  for (const auto& chunk : pairs_)
    for (const Pair& p : chunk) ++first[p.place + 1];
  for (const auto& [place, segment] : always) ++first[place + 1];
  for (std::size_t p = 0; p < nodes; ++p) first[p + 1] += first[p];
  found.segment.resize(first[nodes]);
  std::vector<Index>& next = place_of_node_;
  next.assign(first.begin(), first.end() - 1);
  for (const auto& chunk : pairs_)
    for (const Pair& p : chunk) found.segment[next[p.place]++] = p.segment;
  if (always.empty()) return;
  for (const auto& [place, segment] : always) found.segment[next[place]++] = segment;
  Index end = 0;  // without repeats, ascending
  for (std::size_t p = 0; p < nodes; ++p) {
    const auto from = found.segment.begin() + first[p], to = found.segment.begin() + first[p + 1];
    std::sort(from, to);
    const auto last = std::unique(from, to);
    const auto moved = std::copy(from, last, found.segment.begin() + end);
    first[p] = end;
    end = static_cast<Index>(moved - found.segment.begin());
  }
  first[nodes] = end;
  found.segment.resize(end);
}

void CandidateSearch::find(const SearchInput& in, const std::vector<std::pair<Index, Index>>& always, Candidates& found) {
  const std::size_t segments = in.segments->segments().size();
  sort_nodes(in);
  double reach = 0;
  for (const SurfaceNode& n : in.nodes->nodes()) reach = std::max(reach, n.half_thickness);
  pairs_.resize((segments + chunk_segments - 1) / chunk_segments);
  const auto chunks = static_cast<std::ptrdiff_t>(pairs_.size());
#pragma omp parallel for schedule(dynamic) if (chunks > 2)
  for (std::ptrdiff_t c = 0; c < chunks; ++c) {
    std::vector<Pair>& pairs = pairs_[c];
    pairs.clear();
    const std::size_t begin = static_cast<std::size_t>(c) * chunk_segments, end = std::min(begin + chunk_segments, segments);
    for (std::size_t s = begin; s < end; ++s)
      if (!(*in.dead_segment)[s]) look_up(in, static_cast<Index>(s), reach, pairs);
  }
  group(in.nodes->nodes().size(), always, found);
}

}  // namespace kardan
