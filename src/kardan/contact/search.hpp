// Which segments are near which nodes.
//
// Nodes are counting-sorted into the cells of a regular grid whose linear cell number is taken modulo the size of the table, so that memory
// stays proportional to the nodes whatever their bounding box; far cells that share a place are told apart by coordinates. Every segment looks
// into the rows of cells under its box, inflated by half the thicknesses and the margin. Pairs come out by node ascending, segments ascending: the
// same for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/contact/surface.hpp"

namespace kardan {

/// Segments near each node of a surface, by place in Surface::nodes().
struct Candidates {
  std::vector<Index> first;    ///< by place, and the end: into `segment`
  std::vector<Index> segment;  ///< ascending for each node
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
  struct Pair {
    Index place, segment;
  };
  struct Box {
    Vec3 low, high;
  };

  void sort_nodes(const SearchInput& input);
  Index cell(double x, int axis) const;
  void look_up(const SearchInput& input, Index segment, double reach, std::vector<Pair>& pairs) const;
  template <class F>
  void for_each_row(const Box& box, F&& f) const;
  void group(std::size_t nodes, const std::vector<std::pair<Index, Index>>& always, Candidates& found);

  std::array<double, 3> origin_{};
  double inverse_cell_ = 1;
  std::array<std::int64_t, 3> count_{};   ///< cells along the axes
  std::uint64_t table_ = 1;               ///< places of cells
  std::vector<Index> first_;              ///< by place of a cell, and the end: into entries_
  std::vector<Index> place_of_node_;      ///< work space
  std::vector<Entry> entries_;
  std::vector<std::vector<Pair>> pairs_;  ///< by chunk of segments
};

}  // namespace kardan
