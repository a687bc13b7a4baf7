// The list of candidates against all pairs of nodes and segments: none is missing, and none sleeps that could touch.
#include "kardan/contact/search.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "contact/meshes.hpp"
#include "kardan/contact/closest_point.hpp"

namespace kardan {
namespace {

constexpr double margin = 0.4, awake = 0.05;

/// Crumpled plates of quadrilaterals one through the other, one of them far away.
struct Crumple {
  Model model;
  State state;
  Surface surface;

  Crumple() {
    test::Meshes m;
    const PartIndex p = m.shell_part(ElasticMaterial{7800, 210e9, 0.3, 0, 0}, 0.2);
    m.plate(p, 24, 24, {}, {24, 0, 0}, {0, 24, 0});
    m.plate(p, 24, 24, {0, 0, 1.5}, {20, 3, 4}, {-2, 22, 3});
    m.plate(p, 12, 6, {900, 5, 1}, {12, 0, 0}, {0, 0, 6});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.3, 0.3);
    for (Vec3& x : m.model.nodes.x) x += Vec3{shift(random), shift(random), 2 * shift(random)};
    model = m.model;
    state.nodes.resize(model.nodes.size());
    state.nodes.x = model.nodes.x;
    Contact contact;
    contact.tracked = test::Meshes::side({p});
    Diagnostics diagnostics;
    surface = Surface(model, state, contact, contact.tracked, {.automatic = true}, diagnostics);
  }
  Candidates find(int threads, const std::vector<std::pair<Index, Index>>& always = {}) const {
    const std::vector<std::uint8_t> node(surface.nodes().size(), 0), segment(surface.segments().size(), 0);
    SearchInput in;
    in.nodes = in.segments = &surface;
    in.x = &state.nodes.x;
    in.body = &state.nodes.body;
    in.dead_node = &node;
    in.dead_segment = &segment;
    in.margin = margin;
    in.awake = awake;
    omp_set_num_threads(threads);
    CandidateSearch search;
    Candidates found;
    for (int twice = 0; twice < 2; ++twice) search.find(in, always, found);
    omp_set_num_threads(1);
    return found;
  }
  double gap(Index place, const Segment& s) const {
    const SurfaceNode& node = surface.nodes()[place];
    std::array<Vec3, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) corner[k] = state.nodes.x[s.nodes[k]];
    return std::sqrt(closest_point(state.nodes.x[node.node], corner, false).square) - s.half_thickness - node.half_thickness;
  }
};

TEST(Search, FindsEveryPairWithinTheMarginAndLetsNoneSleepTooLong) {
  const Crumple c;
  const Candidates found = c.find(1);
  std::size_t near = 0, asleep = 0;
  for (std::size_t p = 0; p < c.surface.nodes().size(); ++p) {
    const auto begin = found.segment.begin() + found.first[p], end = found.segment.begin() + found.first[p + 1];
    ASSERT_TRUE(std::is_sorted(begin, end));
    for (std::size_t s = 0; s < c.surface.segments().size(); ++s) {
      const Segment& segment = c.surface.segments()[s];
      const bool own = std::find(segment.nodes.begin(), segment.nodes.end(), c.surface.nodes()[p].node) != segment.nodes.end();
      const auto at = std::lower_bound(begin, end, static_cast<Index>(s));
      const bool listed = at != end && *at == static_cast<Index>(s);
      const double gap = c.gap(static_cast<Index>(p), segment);
      ASSERT_FALSE(own && listed);
      ASSERT_TRUE(own || listed || gap >= margin) << p << " " << s << " gap " << gap;
      if (!listed) continue;
      const double wake = found.wake[static_cast<std::size_t>(at - found.segment.begin())];
      ASSERT_TRUE(wake == 0 || (gap > awake && wake <= 0.5 * gap)) << p << " " << s << " gap " << gap << " wake " << wake;
      near += gap < margin;
      asleep += wake > 0;
    }
  }
  EXPECT_GT(near, 200u);
  EXPECT_GT(asleep, near / 4);
}

TEST(Search, IsTheSameForAnyNumberOfThreads) {
  const Crumple c;
  const Candidates one = c.find(1);
  for (const int threads : {2, 3}) {
    const Candidates other = c.find(threads);
    EXPECT_EQ(other.first, one.first);
    EXPECT_EQ(other.segment, one.segment);
    EXPECT_EQ(other.wake, one.wake);
  }
}

TEST(Search, PairsThatMustNotBeMissingAreListedOnceAndAwake) {
  const Crumple c;
  const Candidates plain = c.find(1);
  const auto has_some = std::adjacent_find(plain.first.begin(), plain.first.end(), std::less<>());
  ASSERT_NE(has_some, plain.first.end());
  const auto place = static_cast<Index>(has_some - plain.first.begin());
  const Index listed = plain.segment[plain.first[place]];
  const auto segments = static_cast<Index>(c.surface.segments().size());
  const Candidates found = c.find(1, {{place, segments - 1}, {place, listed}, {place, segments - 1}, {place + 5, segments - 2}});
  EXPECT_EQ(found.segment.size(), plain.segment.size() + 2);
  for (const auto& [at_place, segment] : {std::pair<Index, Index>{place, segments - 1}, {place, listed}, {place + 5, segments - 2}}) {
    const auto begin = found.segment.begin() + found.first[at_place], end = found.segment.begin() + found.first[at_place + 1];
    ASSERT_TRUE(std::is_sorted(begin, end));
    const auto at = std::find(begin, end, segment);
    ASSERT_NE(at, end);
    EXPECT_EQ(found.wake[static_cast<std::size_t>(at - found.segment.begin())], 0);
  }
}

}  // namespace
}  // namespace kardan
