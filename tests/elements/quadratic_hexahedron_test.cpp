// The quadratic hexahedron with nodes that turn (ELFORM 3): what its rotations are for, and what they cost.
#include <Eigen/Dense>
#include <numbers>
#include <random>

#include "elements/solid_meshes.hpp"
#include "kardan/base/rotation.hpp"
#include "kardan/elements/geometry.hpp"

namespace kardan {
namespace {

using namespace test;

/// nx x ny x nz elements of ELFORM `elform`, moved by `warp`, without bulk viscosity.
template <class Warp>
void mesh_of(Bench& b, int elform, std::array<int, 3> n, double nu, Warp warp) {
  const PartIndex p = b.solid_part(density, e_modulus, nu);
  b.model.sections[0].solid.elform = elform;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-12;
  mesh(b, p, n[0], n[1], n[2], warp);
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
}

/// The stiffness of the structure as its forces have it, six degrees of freedom a node: translations, rotations.
Eigen::MatrixXd stiffness(Bench& b) {
  const auto count = static_cast<Eigen::Index>(b.model.nodes.size());
  Eigen::MatrixXd k(6 * count, 6 * count);
  const double dt = b.state.clock.dt_previous = 1e-6, small = 1e-3;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(6 * count), now(6 * count);
  for (Eigen::Index j = 0; j < 6 * count; ++j) {
    const auto node = static_cast<std::size_t>(j / 6), c = static_cast<std::size_t>(j % 3);
    Vec3& moved = j % 6 < 3 ? b.state.nodes.v[node] : b.state.nodes.omega[node];
    moved[c] = small;
    b.forces();
    moved[c] = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index a = 0; a < 3; ++a) {
        now[6 * i + a] = b.state.nodes.force[static_cast<std::size_t>(i)][static_cast<std::size_t>(a)];
        now[6 * i + 3 + a] = b.state.nodes.moment[static_cast<std::size_t>(i)][static_cast<std::size_t>(a)];
      }
    }
    k.col(j) = (before - now) / (small * dt);
    before = now;
  }
  return k;
}

/// Squares of the angular frequencies, ascending, of the degrees of freedom that have inertia and whose node is not `held`.
template <class Held>
Eigen::VectorXd squares_of_frequencies(Bench& b, Held&& held) {
  const Eigen::MatrixXd k = stiffness(b);
  std::vector<Eigen::Index> free;
  std::vector<double> inertia;
  for (Eigen::Index i = 0; i < k.rows(); ++i) {
    const auto n = static_cast<std::size_t>(i / 6);
    const double m = i % 6 < 3 ? b.state.nodes.mass[n] : b.state.nodes.inertia[n];
    if (!(m > 0) || held(b.model.nodes.x[n])) continue;
    free.push_back(i);
    inertia.push_back(m);
  }
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd own(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      own(i, j) = 0.5 * (k(free[p], free[q]) + k(free[q], free[p])) / std::sqrt(inertia[p] * inertia[q]);
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(own, Eigen::EigenvaluesOnly).eigenvalues();
}

/// A linear field with rotations of half its curl: uniform stress, neither force nor moment on inner nodes.
TEST(QuadraticHexahedron, PassesThePatchTestWithTurningNodes) {
  Bench b;
  mesh_of(b, 3, {3, 3, 3}, 0.3, distort);
  const Mat3 l = some_gradient();
  const double dt = b.state.clock.dt_previous = 1e-9;
  const Vec3 half_curl = Vec3{l[2].y - l[1].z, l[0].z - l[2].x, l[1].x - l[0].y} * 0.5;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    b.state.nodes.v[n] = l * b.model.nodes.x[n];
    b.state.nodes.omega[n] = half_curl;
  }
  b.forces();
  b.look();
  const Mat3 rate = l * inverse(Mat3::identity() - l * (0.5 * dt)), d = (rate + transpose(rate)) * (0.5 * dt);
  const Mat3 expected = Mat3::identity() * (lambda * trace(d)) + d * (2 * mu);
  for (const StressVector& s : b.state.results.solid.stress) EXPECT_LT(size_of(to_tensor(s) - expected), 1e-8 * size_of(expected));
  double inner = 0, outer = 0, inner_moment = 0, outer_moment = 0;
  for (int n = 0; n < 64; ++n) {
    const auto inside = [](int i) { return i == 1 || i == 2; };
    const auto node = static_cast<std::size_t>(n);
    const bool is_inner = inside(n % 4) && inside(n / 4 % 4) && inside(n / 16);
    double &force = is_inner ? inner : outer, &moment = is_inner ? inner_moment : outer_moment;
    force = std::max(force, norm(b.state.nodes.force[node]));
    moment = std::max(moment, norm(b.state.nodes.moment[node]));
  }
  EXPECT_GT(outer, 0.1 * size_of(expected));
  EXPECT_GT(outer_moment, 0.01 * size_of(expected));
  EXPECT_LT(inner, 1e-10 * outer);
  EXPECT_LT(inner_moment, 1e-10 * outer_moment);
}

/// A cube has six rigid motions and six fields that nothing resists: equal turning of all nodes, and for each axis turning about it that
/// changes along it.
TEST(QuadraticHexahedron, FieldsWithoutStiffnessAreThoseOfTheTheory) {
  Bench b;
  mesh_of(b, 3, {1, 1, 1}, 0.3, identity);
  const Eigen::VectorXd w2 = squares_of_frequencies(b, [](const Vec3&) { return false; });
  EXPECT_LT(std::abs(w2[11]), 1e-7 * w2[47]);
  EXPECT_GT(w2[12], 1e-3 * w2[47]);
}

/// The stable step is below 2/omega of the element by itself, whatever its shape, and for bricks not far below.
TEST(QuadraticHexahedron, StepIsBelowThatOfTheLargestFrequency) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto ratio = [&](const Vec3& size, double amplitude, double nu) {
    Bench b;
    mesh_of(b, 3, {1, 1, 1}, nu, [&](const Vec3& x) {
      const Vec3 moved = x + Vec3{uniform(random), uniform(random), uniform(random)} * amplitude;
      return Vec3{size.x * moved.x, size.y * moved.y, size.z * moved.z};
    });
    b.forces();
    const double step = b.elements->stable_time_step();
    const Eigen::VectorXd w2 = squares_of_frequencies(b, [](const Vec3&) { return false; });
    return 2 / std::sqrt(w2[w2.size() - 1]) / step;
  };
  for (const double nu : {0.0, 0.3, 0.45}) {
    for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{1, 1, 0.2}, Vec3{1, 0.2, 0.2}, Vec3{1, 0.5, 0.3}}) {
      const double brick = ratio(size, 0, nu);
      EXPECT_GE(brick, 1.0) << nu;
      EXPECT_LT(brick, 1.35) << nu;
      for (int i = 0; i < 5; ++i) EXPECT_GE(ratio(size, 0.2, nu), 1.0) << nu;
    }
  }
}

/// Pure bending of one brick, curvature k with the anticlastic -nu k: u = k x z, v = -nu k y z, w = -k x^2/2 + nu k (y^2 - z^2)/2, turned by half
/// its curl. All of it is in the element's fields but w = -nu k z^2/2, a quadratic stretch of the edges along z: with e_zz = 0 the energy
/// is E I k^2/2 times ((lambda (1 - nu)^2 + 2 mu (1 + nu^2))/E, which is 1 for nu = 0.
TEST(QuadraticHexahedron, BendingOfABrickIsThatOfABeamButForTheQuadraticStretch) {
  constexpr double k = 1e-5;
  const Vec3 half{1.7, 0.8, 1.1};
  const Mat3 turn = to_matrix(from_rotation_vector(Vec3{0.3, -0.7, 0.4}));
  for (const double nu : {0.0, 0.3}) {
    Bench b;
    mesh_of(b, 3, {1, 1, 1}, nu, [&](const Vec3& x) {
      return turn * Vec3{half.x * (2 * x.x - 1), half.y * (2 * x.y - 1), half.z * (2 * x.z - 1)};
    });
    const double dt = b.state.clock.dt_previous = 1e-6;
    for (std::size_t n = 0; n < 8; ++n) {
      const Vec3 x = transpose(turn) * b.model.nodes.x[n];
      const Vec3 u{k * x.x * x.z, -nu * k * x.y * x.z, 0.5 * k * (-x.x * x.x + nu * (x.y * x.y - x.z * x.z))};
      const Vec3 curl{nu * k * x.y + nu * k * x.y, k * x.x + k * x.x, 0};
      b.state.nodes.v[n] = turn * u * (1 / dt);
      b.state.nodes.omega[n] = turn * curl * (0.5 / dt);
      b.state.nodes.x[n] += turn * u;
    }
    b.forces();
    b.look();
    const double lame = nu * e_modulus / ((1 + nu) * (1 - 2 * nu)), shear = e_modulus / (2 * (1 + nu));
    const double inertia = 2 * half.y * std::pow(2 * half.z, 3) / 12, beam = 0.5 * e_modulus * inertia * k * k * 2 * half.x;
    const double stiffer = (lame * (1 - nu) * (1 - nu) + 2 * shear * (1 + nu * nu)) / e_modulus;
    EXPECT_NEAR(b.state.energy.internal / (beam * stiffer), 1.0, 1e-4) << nu;
  }
}

/// Lowest frequency of a cantilever of one layer, length 10 times its height, `count` elements, over that of Euler and Bernoulli.
double cantilever(int elform, double nu, int count) {
  Bench b;
  mesh_of(b, elform, {count, 1, 1}, nu, [=](const Vec3& x) { return Vec3{10.0 / count * x.x, x.y, x.z}; });
  const Eigen::VectorXd w2 = squares_of_frequencies(b, [](const Vec3& x) { return x.x < 1e-9; });
  const double scale = e_modulus / 12 / density / 1e4;  // E I/(rho A L^4)
  Eigen::Index first = 0;
  while (w2[first] < 1e-3 * scale) ++first;  // fields without stiffness come first
  return std::sqrt(w2[first] / (std::pow(1.8751041, 4) * scale));
}

/// One layer is enough: with nu = 0 the first frequency is the beam's, less what shear (0.4 %) and the inertia of the corners' masses
/// and rotations take off, (1/4 h^2 + l^2/8) 4.65/(2 L^2) for elements of the length l: 3 % at l = 2.5 h, 1 % at 1.25 h. With nu = 0.3 the
/// missing stretch makes bending stiffer by at most 1/(1 - nu^2). The full trilinear element locks in shear.
TEST(QuadraticHexahedron, CantileverOfOneLayerHasTheFrequencyOfABeam) {
  const double coarse = cantilever(3, 0, 4), fine = cantilever(3, 0, 8), with_poisson = cantilever(3, 0.3, 8);
  EXPECT_GT(coarse, 0.95);
  EXPECT_LT(coarse, 1.0);
  EXPECT_NEAR(fine, 1.0, 0.02);
  EXPECT_GT(with_poisson, fine);
  EXPECT_LT(with_poisson, fine / std::sqrt(1 - 0.09) * 1.02);
  EXPECT_GT(cantilever(2, 0, 4), 1.5);
}

TEST(QuadraticHexahedron, NodesHaveTheRotaryInertiaOfTheLongestEdge) {
  Bench b;
  mesh_of(b, 3, {1, 1, 1}, 0.3, [](const Vec3& x) { return Vec3{x.x, 2 * x.y, 3 * x.z}; });
  for (std::size_t n = 0; n < 8; ++n) {
    EXPECT_NEAR(b.state.nodes.mass[n], 6 * density / 8, 1e-9);
    EXPECT_NEAR(b.state.nodes.inertia[n], 6 * density / 8 * 9 / 8, 1e-9);
  }
}

/// Stretched until as many points as NUMFIP says are beyond MXEPS: neither forces nor moments are left.
TEST(QuadraticHexahedron, IsDeletedWhenItsPointsHaveFailed) {
  Bench b;
  const PartIndex p = b.solid_part(density, e_modulus, 0.3);
  b.model.sections[0].solid.elform = 3;
  b.model.materials[0].erosion.emplace();
  b.model.materials[0].erosion->max_strain = 1e-3;
  b.model.materials[0].erosion->failing_points = 14;
  mesh(b, p, 1, 1, 1, identity);
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  const auto strongest = [&] {
    double largest = 0;
    for (std::size_t n = 0; n < 8; ++n) largest = std::max({largest, norm(b.state.nodes.force[n]), norm(b.state.nodes.moment[n])});
    return largest;
  };
  double deleted_at = 0;
  for (int i = 0; i < 300; ++i) {
    b.step(1e-5, [] {}, [&] {
      for (std::size_t n = 0; n < 8; ++n) {  // held against turning, so that the strain is the same at all points
        b.state.nodes.v[n] = {b.model.nodes.x[n].x, 0, 0};
        b.state.nodes.omega[n] = {};
      }
    });
    if (i > 1 && deleted_at == 0 && strongest() == 0) deleted_at = b.state.clock.time;
  }
  EXPECT_NEAR(deleted_at, 1e-3, 3e-5);
  EXPECT_EQ(b.state.results.deleted_solids, 1);
  EXPECT_EQ(strongest(), 0);
}

}  // namespace
}  // namespace kardan
