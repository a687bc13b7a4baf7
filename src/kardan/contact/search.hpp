// Which segments are near which nodes.
//
// Nodes are counting-sorted into the cells of a regular grid whose linear cell number is taken modulo the size of the table, so that memory
// stays proportional to the nodes whatever their bounding box; far cells that share a place are told apart by coordinates. Every segment looks
// into the rows of cells under its box, inflated by half the thicknesses and the margin, as far as they cross the slab about its plane. Pairs come out by
// node ascending, segments ascending. Every loop is cut into pieces by the numbers of nodes, cells and segments (exchange.hpp): the same pairs for any
// number of threads.
//
// A pair comes with a lower bound of its gap, from the segment's plane and box: it need not be looked at before the nodes have moved that far.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/contact/surface.hpp"
#include "kardan/parallel/exchange.hpp"

namespace kardan {

/// Segments near each node of a surface, by place in Surface::nodes().
struct Candidates {
  std::vector<Index> first;    ///< by place, and the end: into `segment` and `wake`
  std::vector<Index> segment;  ///< ascending for each node
  std::vector<float> wake;     ///< travel (motion_meter.hpp) before which the pair cannot touch
};

/// What is searched; all of it belongs to others.
struct SearchInput {
  const Surface* nodes = nullptr;
  const Surface* segments = nullptr;
  const std::vector<Vec3>* x = nullptr;            ///< by node of the model
  const std::vector<BodyIndex>* body = nullptr;    ///< likewise: pairs within one rigid body are left out
  const std::vector<std::uint8_t>* dead_node = nullptr;     ///< by place
  const std::vector<std::uint8_t>* dead_segment = nullptr;  ///< by segment
  double margin = 0;                               ///< pairs are kept whose distance less their thicknesses is below it
  double awake = 0;                                ///< pairs that may be nearer than this are to be looked at from the first cycle on
};

class CandidateSearch {
 public:
  /// Fills `found` with all pairs nearer than the margin (and some a little farther), `always` (node's place, segment; in any order) and no pair
  /// of a node and its own segment.
  void find(const SearchInput& input, const std::vector<std::pair<Index, Index>>& always, Candidates& found);

 private:
  struct Entry {
    Vec3 x;
    Index place;
  };
  struct PlacedEntry {
    Entry entry;
    std::uint32_t cell;  ///< place of its cell in the table
  };
  struct Pair {
    Index place, segment;
    float wake;
  };
  struct Box {
    Vec3 low, high;
  };
  /// Points with |normal . (x - center)| <= half.
  struct Slab {
    Vec3 center, normal;
    double half;
  };

  void make_grid(const SearchInput& input);
  void sort_nodes(const SearchInput& input);
  Index cell(double x, int axis) const;
  void look_up(const SearchInput& input, Index segment, std::size_t piece);
  template <class F>
  void for_each_row(const Box& box, const Slab& slab, F&& f) const;
  void group(std::size_t nodes, Candidates& found) const;
  void add_always(const std::vector<std::pair<Index, Index>>& always, Candidates& found) const;

  std::size_t sized_segments_ = 0;        ///< segments that size_ was made of
  double size_ = 1;                       ///< their mean size
  double reach_ = 0;                      ///< largest half thickness of a node
  std::array<double, 3> origin_{};
  double cell_ = 1, inverse_cell_ = 1;
  std::array<std::int64_t, 3> count_{};   ///< cells along the axes
  std::uint64_t table_ = 1;               ///< places of cells, a power of two
  std::vector<Index> first_;              ///< by place of a cell, and the end: into entries_
  std::vector<Entry> entries_;
  Pieces node_pieces_, cell_pieces_, segment_pieces_;
  std::vector<Box> boxes_;                ///< of the nodes, by piece
  Exchange<PlacedEntry> placed_;          ///< from nodes to cells
  Exchange<Pair> pairs_;                  ///< from segments to nodes
};

}  // namespace kardan
