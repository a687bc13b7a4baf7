#include "kardan/parallel/tile.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

namespace {

constexpr int levels = 16;

/// Scales points of a box to the integer cube of the Hilbert curve, all axes alike.
class IntegerCube {
 public:
  explicit IntegerCube(const std::vector<Vec3>& points) {
    low_ = points.front();
    Vec3 high = low_;
    for (const Vec3& p : points) {
      for (std::size_t i = 0; i < 3; ++i) {
        low_[i] = std::min(low_[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
    const double side = std::max({high.x - low_.x, high.y - low_.y, high.z - low_.z});
    scale_ = side > 0 ? ((1u << levels) - 1) / side : 0.0;
  }
  std::uint64_t key(const Vec3& p) const {
    const Vec3 u = (p - low_) * scale_;
    return hilbert_key(static_cast<std::uint32_t>(u.x), static_cast<std::uint32_t>(u.y), static_cast<std::uint32_t>(u.z));
  }

 private:
  Vec3 low_;
  double scale_ = 0;
};

/// Elements in the order of their tiles: by part, then along the curve, then by index.
std::vector<Index> order_elements(const TileInput& in) {
  const std::size_t n = in.nodes_per_element;
  std::vector<Vec3> centroid(in.elements.size());
  for (std::size_t i = 0; i < centroid.size(); ++i) {
    for (std::size_t a = 0; a < n; ++a) centroid[i] += in.x[in.nodes[in.elements[i] * n + a]];
  }
  const IntegerCube cube(centroid);
  std::vector<std::tuple<PartIndex, std::uint64_t, Index>> keys(centroid.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i] = {in.part[in.elements[i]], cube.key(centroid[i]), in.elements[i]};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& k) { return std::get<2>(k); });
  return order;
}

/// The nodes of a tile's elements, ascending, behind those of the tiles before it: gathering them and summing their slots then goes
/// through memory in runs. `local` gets their numbers in the tile.
void number_nodes(const TileInput& in, std::span<const Index> elements, Tile& tile, TileMesh& mesh, std::vector<std::int32_t>& local) {
  for (const Index e : elements) {
    for (std::size_t a = 0; a < in.nodes_per_element; ++a) {
      const NodeIndex node = in.nodes[e * in.nodes_per_element + a];
      if (local[node] != none) continue;
      local[node] = 0;
      mesh.node.push_back(node);
    }
  }
  std::sort(mesh.node.begin() + static_cast<std::ptrdiff_t>(tile.first_node), mesh.node.end());
  tile.nodes = mesh.node.size() - tile.first_node;
  for (std::size_t k = 0; k < tile.nodes; ++k) local[mesh.node[tile.first_node + k]] = static_cast<std::int32_t>(k);
}

}  // namespace

std::uint64_t hilbert_key(std::uint32_t ux, std::uint32_t uy, std::uint32_t uz) {
  std::uint32_t x[3] = {ux, uy, uz};
  constexpr std::uint32_t top = 1u << (levels - 1);
  for (std::uint32_t q = top; q > 1; q >>= 1) {  // inverse undo
    const std::uint32_t p = q - 1;
    for (std::uint32_t& axis : x) {
      if (axis & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ axis) & p;
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];  // Gray encode
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    if (x[2] & q) t ^= q - 1;
  }
  std::uint64_t key = 0;
  for (int bit = levels - 1; bit >= 0; --bit) {
    for (const std::uint32_t axis : x) key = (key << 1) | (((axis ^ t) >> bit) & 1u);
  }
  return key;
}

TileMesh cut_tiles(const TileInput& in, std::size_t tile_size) {
  TileMesh mesh;
  const std::size_t n = mesh.nodes_per_element = in.nodes_per_element;
  if (in.elements.empty()) return mesh;
  KARDAN_ASSERT(tile_size * n <= std::numeric_limits<std::uint16_t>::max());
  const std::vector<Index> order = order_elements(in);
  std::vector<std::int32_t> local(in.x.size(), none);  // of the nodes of the tile being made
  for (std::size_t begin = 0; begin < order.size();) {
    Tile tile;
    tile.part = in.part[order[begin]];
    std::size_t end = begin;
    while (end < order.size() && end - begin < tile_size && in.part[order[end]] == tile.part) ++end;
    tile.elements = end - begin;
    tile.first_block = mesh.element.size() / block_lanes;
    tile.blocks = (tile.elements + block_lanes - 1) / block_lanes;
    tile.first_node = mesh.node.size();
    number_nodes(in, std::span(order).subspan(begin, tile.elements), tile, mesh, local);
    for (std::size_t b = 0; b < tile.blocks; ++b) {
      const std::size_t base = mesh.connectivity.size();
      mesh.connectivity.resize(base + n * block_lanes);
      for (std::size_t l = 0; l < block_lanes; ++l) {
        const Index e = order[std::min(begin + b * block_lanes + l, end - 1)];
        mesh.element.push_back(e);
        for (std::size_t a = 0; a < n; ++a) {
          mesh.connectivity[base + a * block_lanes + l] = static_cast<std::uint16_t>(local[in.nodes[e * n + a]]);
        }
      }
    }
    for (std::size_t k = tile.first_node; k < mesh.node.size(); ++k) local[mesh.node[k]] = none;
    mesh.tiles.push_back(tile);
    begin = end;
  }
  return mesh;
}

SlotSum::SlotSum(const TileMesh& mesh, std::size_t node_count, std::size_t components)
    : components_(components), values_(mesh.node.size() * components, 0.0) {
  KARDAN_ASSERT(mesh.node.size() < std::numeric_limits<std::uint32_t>::max());
  std::vector<std::uint32_t> next(node_count, 0);
  for (const NodeIndex n : mesh.node) ++next[n];
  std::uint32_t first = 0;
  for (std::size_t n = 0; n < node_count; ++n) {
    if (next[n] == 0) continue;
    nodes_.push_back(static_cast<NodeIndex>(n));
    first_.push_back(first);
    first += std::exchange(next[n], first);
  }
  first_.push_back(first);
  slot_.resize(mesh.node.size());
  for (std::size_t k = 0; k < mesh.node.size(); ++k) slot_[next[mesh.node[k]]++] = static_cast<std::uint32_t>(k);
}

void SlotSum::add_to(std::vector<Vec3>& force, std::vector<Vec3>& moment, NodeIndex begin, NodeIndex end) const {
  const bool with_moments = components_ == 6;
  auto i = static_cast<std::size_t>(std::lower_bound(nodes_.begin(), nodes_.end(), begin) - nodes_.begin());
  constexpr std::size_t ahead = 48;  // slots and sums that are asked for before their turn: a node's slots lie in different tiles
  for (; i < nodes_.size() && nodes_[i] < end; ++i) {
    if (first_[i] + ahead < slot_.size()) __builtin_prefetch(values_.data() + slot_[first_[i] + ahead] * components_);
    if (i + ahead < nodes_.size()) {
      __builtin_prefetch(&force[nodes_[i + ahead]], 1);
      if (with_moments) __builtin_prefetch(&moment[nodes_[i + ahead]], 1);
    }
    Vec3 f, m;
    for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k) {
      const double* s = values_.data() + slot_[k] * components_;
      f += Vec3{s[0], s[1], s[2]};
      if (with_moments) m += Vec3{s[3], s[4], s[5]};
    }
    force[nodes_[i]] += f;
    if (with_moments) moment[nodes_[i]] += m;
  }
}

}  // namespace kardan
