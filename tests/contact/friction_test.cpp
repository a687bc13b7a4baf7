// Sliding with and without friction, and resting.
#include <gtest/gtest.h>

#include <numbers>

#include "contact/contact_run.hpp"

namespace kardan {
namespace {

constexpr double gravity = 10, thick = 0.02;

/// Gravity in the direction `down` (unit vector times g).
void add_gravity(test::Meshes& m, const Vec3& down) {
  const CurveIndex one = m.curve({0, 1}, {1, 1});
  for (int axis = 0; axis < 3; ++axis) {
    BodyLoad load;
    load.axis = axis;
    load.curve = one;
    load.scale = -down[static_cast<std::size_t>(axis)];  // a body load is the acceleration of the frame
    if (load.scale != 0) m.model.body_loads.push_back(load);
  }
}

/// A plane of irregular segments at z = 0.
PartIndex add_floor(test::Meshes& m, int n, double length) {
  const PartIndex p = m.fixed_shell_part(thick);
  const NodeIndex first = m.plate(p, n, n / 2, {-0.5, -1, 0}, {length, 0, 0}, {0, 2, 0});
  for (NodeIndex i = first; i < m.node_count(); ++i) {
    Vec3& x = m.model.nodes.x[i];
    x.x += 0.01 * std::sin(37.0 * i);
    x.y += 0.03 * std::sin(11.0 * i);
  }
  return p;
}

/// Points on an incline of 25 degrees, each with a friction of its own: below tan(25 degrees) they slide with g (sin - mu cos), above it they stay; with decay they
/// follow its law; VC limits the friction force.
TEST(Friction, OnAnInclineIsCoulombs) {
  const double angle = 25 * std::numbers::pi / 180, sine = std::sin(angle), cosine = std::cos(angle), mass = 2;
  test::Meshes m;
  const PartIndex floor = add_floor(m, 20, 8);
  const struct Case {
    Friction law;
  } cases[] = {{{0, 0, 0, 0}}, {{0.2, 0.2, 0, 0}}, {{0.4, 0.4, 0, 0}}, {{0.48, 0.48, 0, 0}}, {{0.9, 0.3, 0, 0}}, {{0.4, 0.1, 2, 0}}, {{0.4, 0.4, 0, 0}}};
  std::vector<NodeIndex> point;
  std::vector<double> area;
  for (const Case& c : cases) {
    point.push_back(m.point({0, -0.6 + 0.2 * static_cast<double>(point.size()), 0.5 * thick}, mass, {}));
    Contact& contact = m.nodes_to_surface({point.back()}, {floor});
    contact.friction = c.law;
    contact.damping = 1;
  }
  m.model.contacts.back().friction.shear_limit = 10;  // about 0.16 of area: 1.6 of the 7.2 that mu N would be
  add_gravity(m, Vec3{sine, 0, -cosine} * gravity);
  const double end = 0.8;
  m.model.control.termination.end_time = end;
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 1e-4}, diagnostics);
  test::Watch watch;
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  const auto way = [&](std::size_t i) { return solver.state().nodes.x[point[i]].x; };
  const auto expected = [&](double mu) { return 0.5 * gravity * (sine - mu * cosine) * end * end; };
  EXPECT_NEAR(way(0), expected(0), 1e-3 * expected(0));
  EXPECT_NEAR(way(1), expected(0.2), 2e-3 * expected(0));
  EXPECT_NEAR(way(2), expected(0.4), 2e-3 * expected(0));
  EXPECT_LT(way(3), 1e-5);  // sticks: the deflection of the spring
  double x = 0, v = 0;      // decay: the law integrated
  for (int i = 0; i < 8000; ++i) {
    const double mu = 0.1 + 0.3 * std::exp(-2 * v), a = gravity * (sine - mu * cosine);
    x += (v + 0.5 * a * 1e-4) * 1e-4;
    v += a * 1e-4;
  }
  EXPECT_NEAR(way(5), x, 0.01 * x);
  EXPECT_GT(way(6), expected(0.4));
  EXPECT_LT(way(6), expected(0));
  EXPECT_LT(watch.energy_error, 2e-3 * std::abs(solver.state().energy.external_work));
  const ContactReport& slides = solver.state().contacts[2];
  EXPECT_NEAR(slides.friction_energy, 0.4 * mass * gravity * cosine * way(2), 0.01 * slides.friction_energy);
  EXPECT_NEAR(slides.force.z, mass * gravity * cosine, 1e-3 * mass * gravity);
}

/// Over the borders of irregular flat segments a pressed node keeps its velocity.
/// One contact, two blocks on an incline of 25 degrees, coefficients by pairs of parts (*DEFINE_FRICTION) or as means of the parts' own (FS = -1, *PART_CONTACT): one
/// block sticks at 0.6, the other slides at 0.2.
TEST(Friction, GoesByPairsOfParts) {
  const double angle = 25 * std::numbers::pi / 180, sine = std::sin(angle), cosine = std::cos(angle), end = 0.3;
  for (const auto source : {Contact::FrictionSource::table, Contact::FrictionSource::part}) {
    test::Meshes m;
    const PartIndex floor = add_floor(m, 20, 4), sticks = m.solid_part(ElasticMaterial{1000, 1e8, 0.3, 0, 0}), slides = m.solid_part(ElasticMaterial{1000, 1e8, 0.3, 0, 0});
    std::vector<NodeIndex> middle;
    for (const PartIndex part : {sticks, slides}) middle.push_back(m.block(part, {2, 2, 2}, {0, part == sticks ? -0.6 : 0.2, 0.5 * thick}, {0.4, 0.4, 0.2}) + 13);
    Contact& contact = m.surface_to_surface({sticks, slides}, {floor});
    contact.damping = 0.5;
    contact.friction_source = source;
    if (source == Contact::FrictionSource::table) {
      contact.friction_table = 0;
      m.model.friction_tables = {{1, {0.9, 0.9, 0, 0}, {{{floor}, {sticks}, {0.6, 0.6, 0, 0}}, {{slides}, {floor}, {0.2, 0.2, 0, 0}}}}};
    } else {
      for (const auto& [part, mu] : {std::pair{floor, 0.4}, std::pair{sticks, 0.8}, std::pair{slides, 0.0}})
        m.model.parts[part].contact = PartContact{.friction = {mu, mu, 0, 0}};
    }
    add_gravity(m, Vec3{sine, 0, -cosine} * gravity);
    m.model.control.termination.end_time = end;
    Diagnostics diagnostics;
    Solver solver(m.model, {}, diagnostics);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    const auto way = [&](std::size_t i) { return solver.state().nodes.x[middle[i]].x - m.model.nodes.x[middle[i]].x; };
    EXPECT_LT(std::abs(way(0)), 1e-4);
    const double expected = 0.5 * gravity * (sine - 0.2 * cosine) * end * end;
    EXPECT_NEAR(way(1), expected, 0.01 * expected);
  }
}

TEST(Sliding, OverFlatBordersHasNoKick) {
  test::Meshes m;
  const PartIndex floor = add_floor(m, 30, 6);
  const NodeIndex n = m.point({0, -0.5, 0.5 * thick}, 2, {7, 1.3, 0});
  m.nodes_to_surface({n}, {floor});
  add_gravity(m, {0, 0, -1000});
  m.model.control.termination.end_time = 0.6;
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 5e-5}, diagnostics);
  test::Watch watch;
  double lowest = 1;
  watch.each = [&](const Model&, const State& s) { lowest = std::min(lowest, s.nodes.x[n].z); };
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  EXPECT_GT(solver.state().nodes.x[n].x, 4);
  EXPECT_NEAR(solver.state().nodes.v[n].x, 7, 1e-9);
  EXPECT_NEAR(solver.state().nodes.v[n].y, 1.3, 1e-9);
  EXPECT_LT(lowest, 0.5 * thick);
  EXPECT_GT(lowest, 0.45 * thick);
}

/// A node slides round inside a polygonal drum of 72 sides: pressed by its inertia it goes over a border every 5 degrees and keeps its energy.
TEST(Sliding, OverSlightlyCurvedBordersKeepsTheEnergy) {
  test::Meshes m;
  const PartIndex drum = m.fixed_shell_part(thick);
  const int sides = 72;
  std::vector<NodeIndex> ring[3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < sides; ++i) {
      const double phi = 2 * std::numbers::pi * (i + 0.3 * k) / sides;
      ring[k].push_back(m.node({std::cos(phi), std::sin(phi), 0.2 * k}));
    }
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < sides; ++i) m.shell(drum, {ring[k][i], ring[k][(i + 1) % sides], ring[k + 1][(i + 1) % sides], ring[k + 1][i]});
  const double inside = std::cos(std::numbers::pi / sides) - 0.5 * thick - 1e-4;
  const NodeIndex n = m.point({inside, 0, 0.17}, 2, {0, 10, 0.05});
  m.nodes_to_surface({n}, {drum});
  m.model.control.termination.end_time = 0.7;  // more than a round
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 2e-5}, diagnostics);
  test::Watch watch;
  double low = 2, high = 0;
  watch.each = [&](const Model&, const State& s) {
    const double r = std::hypot(s.nodes.x[n].x, s.nodes.x[n].y);
    low = std::min(low, r);
    high = std::max(high, r);
  };
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  EXPECT_LT(watch.energy_error, 0.01 * watch.energy);
  EXPECT_NEAR(norm(solver.state().nodes.v[n]), 10, 0.1);
  EXPECT_LT(high, 1 - 0.4 * thick);
  EXPECT_GT(low, 0.9);  // a billiard ball in a polygon
}

/// Three elastic plates lie on a floor: every contact carries what lies above, and a transducer sees it.
TEST(Resting, AStackOfPlatesCarriesItsWeight) {
  test::Meshes m;
  const ElasticMaterial soft{1000, 1e8, 0.3, 0, 0};
  std::vector<PartIndex> plates{m.fixed_shell_part(thick)};
  m.plate(plates[0], 4, 4, {-0.1, -0.1, 0}, {1.2, 0, 0}, {0, 1.2, 0});
  for (int i = 1; i <= 3; ++i) {
    plates.push_back(m.shell_part(soft, thick));
    m.plate(plates.back(), 3 + i, 4, {0, 0, i * thick}, {1, 0, 0}, {0, 1, 0});
    Contact& contact = m.surface_to_surface({plates[i]}, {plates[i - 1]});
    contact.damping = 0.5;
  }
  Contact transducer;
  transducer.law = ContactLaw::transducer;
  transducer.tracked = test::Meshes::side({plates[0]});
  m.model.contacts.push_back(transducer);
  transducer.tracked = test::Meshes::side({plates[2]});
  transducer.reference = test::Meshes::side({plates[1]});
  m.model.contacts.push_back(transducer);
  DampingLaw damping;
  damping.curve = m.curve({0, 1}, {300, 300});
  m.model.dampings.push_back(damping);
  add_gravity(m, {0, 0, -gravity});
  m.model.control.termination.end_time = 0.15;
  Diagnostics diagnostics;
  Solver solver(m.model, {}, diagnostics);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  const double weight = 1000 * thick * gravity;
  const auto& report = solver.state().contacts;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(report[i].force.z, (3 - i) * weight, 0.02 * weight) << i;
  EXPECT_NEAR(report[3].force.z, -3 * weight, 0.02 * weight);
  EXPECT_NEAR(report[4].force.z, 2 * weight, 0.02 * weight);
  EXPECT_NEAR(report[0].moment.x / report[0].force.z, 0.5, 0.01);  // through the middle
}

}  // namespace
}  // namespace kardan
