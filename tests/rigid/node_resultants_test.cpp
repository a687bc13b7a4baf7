// Resultants of nodal forces: the same for any number of threads, and of large bodies for any order of the nodes.
#include "kardan/rigid/node_resultants.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace kardan {
namespace {

/// One body for each number of nodes, all nodes loaded by forces of very different size.
struct LoadedBodies {
  State state;
  std::vector<NodeIndex> nodes;
  std::vector<BodyIndex> body;

  explicit LoadedBodies(const std::vector<std::size_t>& sizes) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    const auto vector = [&](double spread) {
      const double scale = std::exp(spread * normal(random));
      return Vec3{normal(random), normal(random), normal(random)} * scale;
    };
    const std::size_t count = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    state.nodes.resize(count);
    state.bodies.motion.resize(sizes.size());
    for (std::size_t b = 0; b < sizes.size(); ++b) {
      state.bodies.motion[b].center = vector(0);
      body.insert(body.end(), sizes[b], static_cast<BodyIndex>(b));
    }
    for (std::size_t n = 0; n < count; ++n) {
      nodes.push_back(static_cast<NodeIndex>(n));
      state.nodes.x[n] = vector(1);
      state.nodes.force[n] = vector(8);
      if (n % 3 == 0) state.nodes.moment[n] = vector(8);
    }
  }
  /// Forces and moments of all bodies.
  std::vector<Vec3> resultants(int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    state.bodies.force.assign(state.bodies.motion.size(), {});
    state.bodies.moment.assign(state.bodies.motion.size(), {});
    add_node_resultants(state, nodes, body);
    omp_set_num_threads(before);
    std::vector<Vec3> all = state.bodies.force;
    all.insert(all.end(), state.bodies.moment.begin(), state.bodies.moment.end());
    return all;
  }
  /// Shuffles the nodes of each large body in the list.
  void shuffle(unsigned seed) {
    for (std::size_t begin = 0, end = 0; begin < nodes.size(); begin = end) {
      while (end < nodes.size() && body[end] == body[begin]) ++end;
      const auto first = nodes.begin() + static_cast<std::ptrdiff_t>(begin), last = nodes.begin() + static_cast<std::ptrdiff_t>(end);
      if (end - begin > nodes_summed_in_order) std::shuffle(first, last, std::mt19937_64(seed));
    }
  }
};

TEST(NodeResultants, DoNotDependOnOrderOrThreads) {
  LoadedBodies bodies({1, 2, 64, 65, 100, 2'047, 2'048, 20'000, 2});
  const std::vector<Vec3> reference = bodies.resultants(1);
  for (const int threads : {1, 2, 3, 7})
    for (const unsigned seed : {1u, 2u}) {
      bodies.shuffle(seed);
      ASSERT_EQ(bodies.resultants(threads), reference) << threads << " threads";
    }
}

TEST(NodeResultants, AreForceAndMomentAboutTheCentre) {
  for (const std::size_t size : {1, 5, 64, 65, 3'000}) {
    LoadedBodies bodies({4, size});
    Vec3 force, moment;
    double magnitude = 0;
    const Vec3 center = bodies.state.bodies.motion[1].center;
    for (std::size_t n = 4; n < 4 + size; ++n) {
      const Vec3 f = bodies.state.nodes.force[n], r = bodies.state.nodes.x[n] - center;
      force += f;
      moment += bodies.state.nodes.moment[n] + cross(r, f);
      magnitude += norm(f) * (1 + norm(r)) + norm(bodies.state.nodes.moment[n]);
    }
    const std::vector<Vec3> all = bodies.resultants(2);
    EXPECT_LE(norm(all[1] - force), 1e-14 * magnitude);
    EXPECT_LE(norm(all[3] - moment), 1e-14 * magnitude);
  }
}

TEST(NodeResultants, OfBalancedForcesAreNothing) {
  LoadedBodies bodies({5'000});
  State& s = bodies.state;
  for (std::size_t n = 0; n < 2'500; ++n) {  // node n + 2500 stands where n does and is pushed the other way
    s.nodes.x[n + 2'500] = s.nodes.x[n];
    s.nodes.force[n + 2'500] = -s.nodes.force[n];
    s.nodes.moment[n + 2'500] = -s.nodes.moment[n];
  }
  EXPECT_EQ(bodies.resultants(2), (std::vector<Vec3>(2)));
}

TEST(NodeResultants, AddToWhatActsOnTheBody) {
  LoadedBodies bodies({100, 3});
  const std::vector<Vec3> alone = bodies.resultants(1);
  bodies.state.bodies.force.assign(2, {1, 2, 3});
  bodies.state.bodies.moment.assign(2, {4, 5, 6});
  bodies.nodes.resize(100);  // nothing is listed of the second body
  bodies.body.resize(100);
  add_node_resultants(bodies.state, bodies.nodes, bodies.body);
  EXPECT_EQ(bodies.state.bodies.force[0], (Vec3{1, 2, 3} + alone[0]));
  EXPECT_EQ(bodies.state.bodies.moment[0], (Vec3{4, 5, 6} + alone[2]));
  EXPECT_EQ(bodies.state.bodies.force[1], (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace kardan
