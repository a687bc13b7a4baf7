// What every formulation of solids must keep, and what each is made for.
#include <omp.h>

#include <numbers>
#include <random>

#include "elements/solid_meshes.hpp"
#include "kardan/base/isa.hpp"
#include "kardan/base/rotation.hpp"
#include "kardan/elements/geometry.hpp"
#include "kardan/elements/solid/solid_shape.hpp"

namespace kardan {
namespace {

using namespace test;

/// A formulation and the shape of its elements: conforming meshes of hexahedra, of two wedges or six tetrahedra a cube.
struct Formulation {
  int elform;
  int nodes;
  int hourglass;
};
std::ostream& operator<<(std::ostream& out, const Formulation& f) {
  return out << "ELFORM " << f.elform << ", " << f.nodes << " nodes, IHQ " << f.hourglass;
}

template <class Warp>
void mesh_of(Bench& b, const Formulation& f, int nx, int ny, int nz, Warp warp, double nu = 0.3) {
  const PartIndex p = b.solid_part(density, e_modulus, nu);
  b.model.sections[0].solid.elform = f.elform;
  b.model.control.hourglass_type = f.hourglass;
  mesh(b, p, nx, ny, nz, warp);
  if (f.nodes == 8) return;
  const SolidElements cubes = b.model.solids;
  b.model.solids = {};
  for (const auto& c : cubes.nodes) {
    if (f.nodes == 6) {
      b.solid(p, {c[0], c[1], c[2], c[2], c[4], c[5], c[6], c[6]});
      b.solid(p, {c[0], c[2], c[3], c[3], c[4], c[6], c[7], c[7]});
      continue;
    }
    // Six tetrahedra around the diagonal 0-6 (Kuhn): faces of neighbours match.
    static constexpr int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
    for (const auto& [i, j] : path) b.solid(p, {c[0], c[i], c[j], c[6], c[6], c[6], c[6], c[6]});
  }
}

class SolidFormulation : public ::testing::TestWithParam<Formulation> {};

INSTANTIATE_TEST_SUITE_P(All, SolidFormulation,
                         ::testing::Values(Formulation{1, 8, 6}, Formulation{1, 6, 4}, Formulation{1, 4, 1}, Formulation{2, 8, 1},
                                           Formulation{2, 6, 1}, Formulation{3, 8, 1}, Formulation{3, 6, 1}, Formulation{10, 4, 1}, Formulation{13, 4, 1}, Formulation{15, 6, 1}));

/// Angular velocities of all nodes that have rotary inertia.
template <class F>
void spin(Bench& b, F&& spin_of_node) {
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    if (b.state.nodes.inertia[n] > 0) b.state.nodes.omega[n] = spin_of_node(n);
  }
}

/// Irons' patch after one finite step: uniform stress, no force on inner nodes, no hourglass energy.
TEST_P(SolidFormulation, PassesThePatchTest) {
  Bench b;
  mesh_of(b, GetParam(), 3, 3, 3, distort);
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 0;
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  const Mat3 stretch = (some_gradient() + transpose(some_gradient())) * 0.5e-3;
  std::vector<Vec3> x = b.model.nodes.x;
  for (Vec3& p : x) p += stretch * p;
  move_to(b, x, 1e-6);
  b.forces();
  b.look();
  const Mat3 d = stretch * inverse(Mat3::identity() + stretch * 0.5);  // on the geometry of the middle of the step
  const double jacobian = determinant(Mat3::identity() + stretch);
  const double swelling = GetParam().elform == 13 || GetParam().elform == 2 ? 2 * (jacobian - 1) / (jacobian + 1) : trace(d);
  const Mat3 expected = Mat3::identity() * (lambda * trace(d)) + d * (2 * mu);
  for (const StressVector& s : b.state.results.solid.stress) {
    const Mat3 difference = to_tensor(s) - expected;
    const double mean = trace(difference) / 3;  // the volume strain of the nodes' volumes differs in third order
    EXPECT_LT(size_of(difference - Mat3::identity() * mean), 1e-10 * size_of(expected));
    EXPECT_LT(std::abs(mean), (lambda + 2 * mu / 3) * std::abs(swelling - trace(d)) + 1e-10 * size_of(expected));
  }
  double inner = 0, outer = 0;
  for (int n = 0; n < 64; ++n) {
    const auto inside = [](int i) { return i == 1 || i == 2; };
    double& largest = inside(n % 4) && inside(n / 4 % 4) && inside(n / 16) ? inner : outer;
    largest = std::max(largest, norm(b.state.nodes.force[static_cast<std::size_t>(n)]));
  }
  EXPECT_GT(outer, 0.1 * size_of(expected));
  EXPECT_LT(inner, 1e-10 * outer);
  EXPECT_LT(std::abs(b.state.energy.hourglass), 1e-10 * b.state.energy.internal);
}

/// A strained body with every mode in it turns by 360 degrees in 120 steps: stress and forces turn, the energies stay.
TEST_P(SolidFormulation, RigidRotationTurnsTheStressAndLeavesTheEnergy) {
  Bench b;
  mesh_of(b, GetParam(), 2, 1, 1, distort);
  b.start();
  std::vector<Vec3> strained = b.model.nodes.x;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.004, 0.004);
  for (Vec3& p : strained) p += some_gradient() * p * 0.01 + Vec3{uniform(random), uniform(random), uniform(random)};
  move_to(b, strained, 1e-3);
  spin(b, [&](std::size_t) { return Vec3{uniform(random), uniform(random), uniform(random)} * 1e3; });
  b.forces();
  move_to(b, strained, 1e-3);  // at rest: viscous forces are gone
  spin(b, [](std::size_t) { return Vec3{}; });
  b.forces();
  b.look();
  const std::vector<Vec3> f0 = b.state.nodes.force, m0 = b.state.nodes.moment;
  const std::vector<StressVector> s0 = b.state.results.solid.stress;
  const double energy = b.state.energy.internal, springs = b.state.energy.hourglass;
  ASSERT_GT(energy, 0.0);
  const Vec3 axis = normalized(Vec3{2, -3, 1});
  for (int i = 1; i <= 120; ++i) {
    const double angle = 2 * std::numbers::pi * i / 120;
    const Mat3 k = skew(axis), q = Mat3::identity() + k * std::sin(angle) + k * k * (1 - std::cos(angle));
    std::vector<Vec3> x = strained;
    for (Vec3& p : x) p = q * p;
    move_to(b, x, 1e-3);
    spin(b, [&](std::size_t) { return axis * (2 * std::numbers::pi / 120 / 1e-3); });
    b.forces();
    if (i % 30 != 0) continue;
    b.look();
    for (std::size_t e = 0; e < s0.size(); ++e) {
      const Mat3 before = to_tensor(s0[e]);
      EXPECT_LT(size_of(to_tensor(b.state.results.solid.stress[e]) - q * before * transpose(q)), 1e-9 * size_of(before)) << i;
    }
    for (std::size_t n = 0; n < f0.size(); ++n) {
      EXPECT_LT(norm(b.state.nodes.force[n] - q * f0[n]), 1e-9 * norm(f0[n])) << i;
      EXPECT_LE(norm(b.state.nodes.moment[n] - q * m0[n]), 1e-9 * norm(m0[n])) << i;
    }
  }
  EXPECT_NEAR(b.state.energy.internal, energy, 1e-9 * energy);
  EXPECT_NEAR(b.state.energy.hourglass, springs, 1e-9 * energy);
}

TEST_P(SolidFormulation, ForcesConserveLinearAndAngularMomentum) {
  Bench b;
  mesh_of(b, GetParam(), 5, 4, 6, distort);
  b.start();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double dt = b.state.clock.dt_previous = 1e-3;
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      b.state.nodes.v[n] = Vec3{uniform(random), uniform(random), uniform(random)} * 10.0;
      b.state.nodes.x[n] += b.state.nodes.v[n] * dt;
    }
    spin(b, [&](std::size_t) { return Vec3{uniform(random), uniform(random), uniform(random)} * 10.0; });
    b.forces();
    Vec3 force, moment;
    double size = 0, arm = 0;
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      force += b.state.nodes.force[n];
      moment += cross(b.state.nodes.x[n], b.state.nodes.force[n]) + b.state.nodes.moment[n];
      size += norm(b.state.nodes.force[n]);
      arm = std::max(arm, norm(b.state.nodes.x[n]));
    }
    EXPECT_LT(norm(force), 1e-12 * size);
    EXPECT_LT(norm(moment), 1e-12 * size * arm);
  }
}

/// Free vibration at half the stable step: the sum of the energies of the ledger stays, so the work of the stresses is that of the forces.
TEST_P(SolidFormulation, EnergyIsKeptInFreeVibration) {
  Bench b;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-12;
  Formulation f = GetParam();
  if (f.hourglass == 1) f.hourglass = 4;
  mesh_of(b, f, 3, 2, 2, distort);
  b.start();
  double initial = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(x.x + x.y), std::cos(x.z), std::sin(x.x)} * 5.0;
    initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
  }
  spin(b, [&](std::size_t n) { return b.state.nodes.v[n]; });
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) initial += 0.5 * b.state.nodes.inertia[n] * dot(b.state.nodes.omega[n], b.state.nodes.omega[n]);
  b.forces();
  const double dt = 0.25 * b.elements->stable_time_step();
  double worst = 0, stored = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Vec3> v = b.state.nodes.v, omega = b.state.nodes.omega;
    b.step(dt);
    double kinetic = 0;
    for (std::size_t n = 0; n < v.size(); ++n) {
      kinetic += 0.5 * b.state.nodes.mass[n] * dot(v[n], b.state.nodes.v[n]) +
                 0.5 * b.state.nodes.inertia[n] * dot(omega[n], b.state.nodes.omega[n]);
    }
    if (i == 0) continue;  // the first kick is half a step
    worst = std::max(worst, std::abs(kinetic + b.state.energy.internal + b.state.energy.hourglass - initial));
    stored = std::max(stored, b.state.energy.internal);
  }
  EXPECT_GT(stored, 0.1 * initial);
  EXPECT_LT(worst, 5e-3 * initial);
}

std::uint64_t hash_after_cycles(const Formulation& f, int threads, int level) {
  set_kernel_level(level);
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Bench b;
  mesh_of(b, f, 9, 8, 9, distort);
  b.start();
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(3 * x.x), std::cos(5 * x.y), std::sin(4 * x.x + x.z)} * 20.0;
  }
  spin(b, [&](std::size_t n) { return Vec3{std::cos(2 * b.model.nodes.x[n].y), std::sin(b.model.nodes.x[n].z), 1} * 20.0; });
  for (int i = 0; i < 10; ++i) b.step(5e-6);
  omp_set_num_threads(before);
  set_kernel_level(0);
  return b.state.registry.hash();
}

TEST_P(SolidFormulation, ResultsDoNotDependOnThreadsOrInstructionSet) {
  const std::uint64_t one = hash_after_cycles(GetParam(), 1, 0);
  EXPECT_EQ(one, hash_after_cycles(GetParam(), 3, 0));
  EXPECT_EQ(one, hash_after_cycles(GetParam(), 2, 2));
  EXPECT_EQ(one, hash_after_cycles(GetParam(), 2, 3));
}

/// A brick of half edges a, b, c, turned, whose nodes move by `displacement`; the energies by the hourglass control and the point.
template <class Displacement>
std::array<double, 2> energies_of_brick(const Vec3& half, const Formulation& f, double qm, Displacement displacement) {
  Bench b;
  const Mat3 turn = to_matrix(from_rotation_vector(Vec3{0.3, -0.7, 0.4}));
  mesh_of(b, f, 1, 1, 1, [&](const Vec3& x) {
    return turn * Vec3{half.x * (2 * x.x - 1), half.y * (2 * x.y - 1), half.z * (2 * x.z - 1)};
  });
  b.model.control.hourglass_qm = qm;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 0;
  b.start();
  std::vector<Vec3> x = b.model.nodes.x;
  for (Vec3& p : x) p += turn * displacement(transpose(turn) * p);
  move_to(b, x, 1e-6);
  b.forces();
  b.look();
  return {b.state.energy.hourglass, b.state.energy.internal};
}

/// IHQ 6 with QM = 1: a brick in pure bending, of curvature k and with the anticlastic curvature -nu k, stores E I k^2/2 a length; in
/// torsion of twist t without warping mu J_p t^2/2. The claim "exact beam bending" with its closed forms.
TEST(AssumedStrainHourglass, BendingAndTorsionOfABrickAreExact) {
  constexpr double k = 1e-5, nu = 0.3, small = 1e-4;
  const Vec3 h{1.7, 0.8, 1.1};
  const Formulation f{1, 8, 6};
  const double length = 2 * h.x, inertia = (2 * h.y) * std::pow(2 * h.z, 3) / 12;
  // The curvatures also move the nodes by constants along z, which are left out.
  const auto bent = energies_of_brick(h, f, 1.0, [&](const Vec3& x) { return Vec3{k * x.x * x.z, -nu * k * x.y * x.z, 0}; });
  EXPECT_NEAR(bent[0] / (0.5 * e_modulus * inertia * k * k * length), 1.0, small);
  EXPECT_LT(bent[1], small * bent[0]);
  const double polar = (2 * h.y) * (2 * h.z) * (h.y * h.y + h.z * h.z) / 3;
  const auto twisted = energies_of_brick(h, f, 1.0, [&](const Vec3& x) { return Vec3{0, -k * x.x * x.z, k * x.x * x.y}; });
  EXPECT_NEAR(twisted[0] / (0.5 * mu * polar * k * k * length), 1.0, small);
  // The default QM = 0.1 gives a tenth.
  const auto soft = energies_of_brick(h, f, 0.0, [&](const Vec3& x) { return Vec3{k * x.x * x.z, -nu * k * x.y * x.z, 0}; });
  EXPECT_NEAR(soft[0] / bent[0], 0.1, 1e-12);
}

/// The two points of the pentahedron do not see its twist; with QM = 1 the control stores mu J_p t^2/2 a length.
TEST(Pentahedron, TwistIsResistedLikeTorsion) {
  constexpr double k = 1e-5;
  Bench b;
  const PartIndex p = b.solid_part(density, e_modulus, 0.3);
  b.model.sections[0].solid.elform = 15;
  b.model.control.hourglass_qm = 1;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 0;
  const double height = 1.3, side = 0.9;
  std::vector<Vec3> triangle;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3, radius = side / std::sqrt(3.0);
    triangle.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (const double z : {-0.5 * height, 0.5 * height})
    for (const Vec3& x : triangle) b.node({x.x, x.y, z});
  b.solid(p, {0, 1, 2, 2, 3, 4, 5, 5});
  b.start();
  std::vector<Vec3> x = b.model.nodes.x;
  for (Vec3& n : x) n += Vec3{-k * n.z * n.y, k * n.z * n.x, 0};
  move_to(b, x, 1e-6);
  b.forces();
  b.look();
  const double area = std::sqrt(3.0) / 4 * side * side, polar = area * side * side / 12;
  EXPECT_NEAR(b.state.energy.hourglass / (0.5 * mu * polar * k * k * height), 1.0, 1e-6);
  EXPECT_LT(b.state.energy.internal, 1e-6 * b.state.energy.hourglass);
}

/// Every way to repeat two parallel edges of a hexahedron is the prism that is left, with a positive volume.
TEST(Pentahedron, IsFoundInEveryDegenerateHexahedron) {
  static constexpr int at[8] = {0, 1, 3, 2, 4, 5, 7, 6};  // node of the natural coordinates: bit 0 r, 1 s, 2 t
  int found = 0;
  for (int a = 1; a < 8; a *= 2) {
    for (int axis = 1; axis < 8; axis *= 2) {
      if (axis == a) continue;
      for (const int level : {0, 7 - a - axis}) {
        std::array<NodeIndex, 8> nodes{0, 1, 2, 3, 4, 5, 6, 7};
        nodes[static_cast<std::size_t>(at[level | a])] = at[level];
        nodes[static_cast<std::size_t>(at[level | a | axis])] = at[level | axis];
        const auto wedge = pentahedron_nodes(nodes);
        ASSERT_TRUE(wedge);
        std::vector<Vec3> x(8);
        for (int bits = 0; bits < 8; ++bits) x[static_cast<std::size_t>(at[bits])] = {1.0 * (bits & 1), 0.5 * (bits & 2), 0.25 * (bits & 4)};
        const auto& w = *wedge;
        const double volume = solid_volume(gather_coordinates(x, std::array{w[0], w[1], w[2], w[2], w[3], w[4], w[5], w[5]}),
                                           {w[0], w[1], w[2], w[2], w[3], w[4], w[5], w[5]});
        EXPECT_NEAR(volume, 0.5, 1e-15);
        ++found;
      }
    }
  }
  EXPECT_EQ(found, 12);
  EXPECT_FALSE(pentahedron_nodes({0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_FALSE(pentahedron_nodes({0, 1, 2, 3, 4, 4, 4, 5}));
}

/// With the volume kept, mean dilatation (ELFORM 2) and nodal
/// pressure (13) bend a nearly incompressible block (nu = 0.4999) several times more easily than the plain tetrahedron (10) does.
TEST(NearlyIncompressible, MeanVolumeFormulationsDoNotLock) {
  const auto stiffness = [](const Formulation& f) {
    Bench b;
    mesh_of(b, f, 4, 4, 4, identity, 0.4999);
    b.model.control.bulk_q1 = b.model.control.bulk_q2 = 0;
    b.start();
    // A displacement without divergence, of which linear elements can follow the shape but not the constant volume at every point.
    std::vector<Vec3> x = b.model.nodes.x;
    for (Vec3& p : x) {
      const double r = 0.5 * std::numbers::pi * p.x, s = 0.5 * std::numbers::pi * p.y;
      p += Vec3{std::sin(r) * std::cos(s), -std::cos(r) * std::sin(s), 0} * 1e-6;
    }
    move_to(b, x, 1e-6);
    b.forces();
    b.look();
    return b.state.energy.internal;
  };
  const double plain = stiffness({10, 4, 1});
  EXPECT_LT(stiffness({2, 8, 1}), 0.05 * plain);
  EXPECT_LT(stiffness({13, 4, 1}), 0.3 * plain);
}

/// Bonet and Burton: where the law is linear, an element's pressure is the mean of its nodes' K ln J.
TEST(NodalPressure, PressureOfAnElementIsTheMeanOfItsNodes) {
  Bench b;
  mesh_of(b, {13, 4, 1}, 2, 2, 2, distort);
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 0;
  b.start();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1e-5, 1e-5);
  std::vector<Vec3> x = b.model.nodes.x;
  for (Vec3& p : x) p += Vec3{uniform(random), uniform(random), uniform(random)};
  move_to(b, x, 1e-6);
  b.forces();
  b.look();
  std::vector<double> before(x.size(), 0.0), now(x.size(), 0.0);
  for (const auto& nodes : b.model.solids.nodes) {
    const std::array<NodeIndex, 4> t = *tetrahedron_nodes(nodes);
    for (const NodeIndex n : t) {
      before[static_cast<std::size_t>(n)] += 0.25 * solid_volume(gather_coordinates(b.model.nodes.x, nodes), nodes);
      now[static_cast<std::size_t>(n)] += 0.25 * solid_volume(gather_coordinates(x, nodes), nodes);
    }
  }
  const double bulk = lambda + 2 * mu / 3;
  double largest = 0;
  for (std::size_t e = 0; e < b.model.solids.size(); ++e) {
    double expected = 0;
    const std::array<NodeIndex, 4> corners = *tetrahedron_nodes(b.model.solids.nodes[e]);
    for (const NodeIndex n : corners)
      expected += 0.25 * bulk * std::log(now[static_cast<std::size_t>(n)] / before[static_cast<std::size_t>(n)]);
    const double mean = trace(to_tensor(b.state.results.solid.stress[e])) / 3;
    EXPECT_NEAR(mean, expected, 1e-4 * bulk * 1e-5);
    largest = std::max(largest, std::abs(expected));
  }
  EXPECT_GT(largest, 1e-6 * bulk);
}

TEST(SolidSections, WhatDoesNotFitTheShapeIsRefused) {
  const auto message = [](const Formulation& f) {
    Bench b;
    mesh_of(b, f, 1, 1, 1, identity);
    b.start();
    return b.diagnostics.ok() ? std::string() : b.diagnostics.all()[0].message;
  };
  EXPECT_NE(message({10, 8, 1}).find("ELFORM = 10 (section 100) that are hexahedra"), std::string::npos);
  EXPECT_NE(message({13, 6, 1}).find("ELFORM = 13"), std::string::npos);
  EXPECT_NE(message({15, 4, 1}).find("that are tetrahedra"), std::string::npos);
  EXPECT_NE(message({15, 8, 1}).find("that are hexahedra"), std::string::npos);
  EXPECT_NE(message({3, 4, 1}).find("that are tetrahedra"), std::string::npos);
  EXPECT_NE(message({4, 4, 1}).find("ELFORM = 4"), std::string::npos);
  EXPECT_EQ(message({10, 4, 1}), "");
}

}  // namespace
}  // namespace kardan
