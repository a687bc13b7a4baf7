// From rigid parts, nodal rigid bodies, merges and extra nodes to bodies: masses by hand, and what is said of wrong decks.
#include "kardan/rigid/body_assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "kardan/base/rotation.hpp"
#include "kardan/model/model.hpp"

namespace kardan::test {
namespace {

/// Rigid parts of shell elements with masses at their nodes, put together without a reader.
class Deck {
 public:
  Deck() { model.materials.push_back({1, "rigid", RigidMaterial{}}); }

  NodeIndex node(const Vec3& x, double mass, double rotary = 0) {
    model.nodes.id.push_back(101 + static_cast<UserId>(model.nodes.id.size()));
    model.nodes.x.push_back(x);
    model.nodes.constrained.push_back(0);
    mass_.push_back(mass);
    rotary_.push_back(rotary);
    return static_cast<NodeIndex>(model.nodes.size()) - 1;
  }
  /// Part of quadrilaterals; of no element if `nodes` is empty.
  PartIndex part(const std::vector<std::array<NodeIndex, 4>>& shells, RigidMaterial material = {}) {
    model.materials.push_back({static_cast<UserId>(model.materials.size()) + 1, "rigid", material});
    Part p;
    p.id = 11 + static_cast<UserId>(model.parts.size());
    p.material = static_cast<Index>(model.materials.size()) - 1;
    model.parts.push_back(p);
    const auto index = static_cast<PartIndex>(model.parts.size()) - 1;
    for (const auto& nodes : shells) {
      model.shells.id.push_back(static_cast<UserId>(model.shells.size()) + 1);
      model.shells.part.push_back(index);
      model.shells.nodes.push_back(nodes);
    }
    return index;
  }
  /// A quadrilateral in general position with masses m, 2m, 3m, 4m.
  std::array<NodeIndex, 4> quad(const Vec3& at, double m) {
    return {node(at, m), node(at + Vec3{1, 0.1, 0}, 2 * m), node(at + Vec3{1.1, 0.9, 0.3}, 3 * m), node(at + Vec3{0, 1, -0.2}, 4 * m)};
  }
  void give(PartIndex p, double mass, const Vec3& center, const Vec3& inertia) {
    GivenInertia g;
    g.mass = mass;
    g.center = center;
    g.inertia = Mat3::diagonal(inertia);
    model.parts[static_cast<std::size_t>(p)].inertia = g;
  }
  PartIndex nodal_body(UserId id, std::vector<NodeIndex> nodes) {
    Part p;
    p.id = id;
    p.nodal_rigid_body = static_cast<Index>(model.nodal_rigid_bodies.size());
    model.parts.push_back(p);
    NodalRigidBody body;
    body.id = id;
    body.part = static_cast<PartIndex>(model.parts.size()) - 1;
    body.nodes = std::move(nodes);
    model.nodal_rigid_bodies.push_back(body);
    return body.part;
  }
  Index frame(const Quat& q) {
    Frame f;
    f.axes = to_matrix(normalized(q));
    model.frames.push_back(f);
    return static_cast<Index>(model.frames.size()) - 1;
  }

  void assemble() {
    state = {};
    diagnostics = {};
    state.nodes.resize(model.nodes.size());
    state.nodes.x = model.nodes.x;
    state.nodes.mass = mass_;
    state.nodes.inertia = rotary_;
    assembly = assemble_bodies(model, state, diagnostics);
  }
  /// The message of the given severity that holds all the words, "" if there is none.
  std::string message(Severity severity, const std::vector<std::string>& words) const {
    for (const Diagnostic& d : diagnostics.all()) {
      const auto holds = [&](const std::string& w) { return d.message.find(w) != std::string::npos; };
      if (d.severity == severity && std::all_of(words.begin(), words.end(), holds)) return d.message;
    }
    return {};
  }
  double mass_of(NodeIndex n) const { return mass_[static_cast<std::size_t>(n)]; }

  Model model;
  State state;
  Diagnostics diagnostics;
  BodyAssembly assembly;

 private:
  std::vector<double> mass_, rotary_;
};

/// Points with mass summed by the definition: tensor about `center`, entry by entry.
struct ByHand {
  double mass = 0;
  Vec3 center;
  Mat3 inertia{};
};
ByHand by_hand(const Deck& deck, const std::vector<NodeIndex>& nodes) {
  ByHand h;
  for (NodeIndex n : nodes) h.mass += deck.mass_of(n);
  for (NodeIndex n : nodes) h.center += deck.model.nodes.x[static_cast<std::size_t>(n)] * (deck.mass_of(n) / h.mass);
  for (NodeIndex n : nodes) {
    const Vec3 r = deck.model.nodes.x[static_cast<std::size_t>(n)] - h.center;
    const double m = deck.mass_of(n);
    h.inertia += Mat3{{{{m * (r.y * r.y + r.z * r.z), -m * r.x * r.y, -m * r.x * r.z},
                        {-m * r.x * r.y, m * (r.x * r.x + r.z * r.z), -m * r.y * r.z},
                        {-m * r.x * r.z, -m * r.y * r.z, m * (r.x * r.x + r.y * r.y)}}}};
  }
  return h;
}

Mat3 tensor(const BodyInfo& info) {
  const Mat3 r = to_matrix(info.initial_orientation);
  return r * Mat3::diagonal(info.principal_inertia) * transpose(r);
}
double distance(const Mat3& a, const Mat3& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum);
}
void expect_body(const BodyInfo& info, const ByHand& h) {
  EXPECT_NEAR(info.mass, h.mass, 1e-13 * h.mass);
  EXPECT_LT(norm(info.initial_center - h.center), 1e-13);
  EXPECT_LT(distance(tensor(info), h.inertia), 1e-12 * trace(h.inertia));
}
std::vector<NodeIndex> joined(std::initializer_list<std::array<NodeIndex, 4>> quads) {
  std::set<NodeIndex> all;
  for (const auto& q : quads) all.insert(q.begin(), q.end());
  return {all.begin(), all.end()};
}

TEST(BodyAssembly, LumpedMassesGiveMassCentreAndTensor) {
  Deck deck;
  const auto a = deck.quad({1, 2, 3}, 0.5), b = deck.quad({3, 2, 4}, 0.25);
  deck.part({a, {a[1], b[0], b[3], a[2]}, b});  // nodes of neighbouring elements count once
  deck.assemble();
  ASSERT_TRUE(deck.diagnostics.ok());
  ASSERT_EQ(deck.state.bodies.info.size(), 1u);
  expect_body(deck.state.bodies.info[0], by_hand(deck, joined({a, b})));
  // Arms lead back to the nodes.
  const BodyNodes& nodes = deck.assembly.nodes;
  ASSERT_EQ(nodes.node.size(), 8u);
  const BodyInfo& info = deck.state.bodies.info[0];
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_LT(norm(info.initial_center + to_matrix(info.initial_orientation) * nodes.arm[i] -
                   deck.model.nodes.x[static_cast<std::size_t>(nodes.node[i])]), 1e-13);
}

TEST(BodyAssembly, NodalRigidBodyEqualsPartOfTheSameNodes) {
  Deck deck;
  const auto q = deck.quad({1, 2, 3}, 0.5);
  const PartIndex part = deck.nodal_body(70, {q.begin(), q.end()});
  deck.assemble();
  ASSERT_TRUE(deck.diagnostics.ok());
  const BodyInfo& info = deck.state.bodies.info[0];
  expect_body(info, by_hand(deck, joined({q})));
  EXPECT_TRUE(info.nodal);
  EXPECT_EQ(info.id, 70);
  EXPECT_EQ(deck.state.bodies.of_part[static_cast<std::size_t>(part)], 0);
}

TEST(BodyAssembly, MergedChainIsOneBodyInAnyOrderOfTheCards) {
  for (const bool outer_first : {true, false}) {
    Deck deck;
    const auto a = deck.quad({0, 0, 0}, 1), b = deck.quad({2, 0, 0}, 0.5);
    const std::array<NodeIndex, 4> c{b[1], deck.node({5, 0, 1}, 2), deck.node({5, 1, 0}, 1), b[2]};  // shares two nodes with b
    const PartIndex pa = deck.part({a}), pb = deck.part({b}), pc = deck.part({c});
    deck.model.merges = {{pa, pb, 0}, {pb, pc, 0}};
    if (!outer_first) std::swap(deck.model.merges[0], deck.model.merges[1]);
    deck.assemble();
    ASSERT_TRUE(deck.diagnostics.ok());
    ASSERT_EQ(deck.state.bodies.info.size(), 1u);
    EXPECT_EQ(deck.state.bodies.info[0].id, 11);
    expect_body(deck.state.bodies.info[0], by_hand(deck, joined({a, b, c})));
    for (PartIndex p : {pa, pb, pc}) EXPECT_EQ(deck.state.bodies.of_part[static_cast<std::size_t>(p)], 0);
    EXPECT_EQ(deck.assembly.nodes.node.size(), 10u);
  }
}

TEST(BodyAssembly, MergeFlagDecidesWhetherAGivenInertiaIsUpdated) {
  for (const int flag : {0, 1}) {
    Deck deck;
    const auto a = deck.quad({0, 0, 0}, 1), b = deck.quad({2, 0, 0}, 0.5);
    const PartIndex pa = deck.part({a}), pb = deck.part({b});
    deck.give(pa, 7.0, {0.1, 0.2, 0.3}, {1, 2, 2.5});
    deck.model.merges = {{pa, pb, flag}};
    deck.assemble();
    ASSERT_TRUE(deck.diagnostics.ok());
    const BodyInfo& info = deck.state.bodies.info[0];
    MassProperties expected{7.0, {0.1, 0.2, 0.3}, Mat3::diagonal({1, 2, 2.5})};
    if (flag == 1) {
      const ByHand added = by_hand(deck, joined({b}));
      // Two masses on a rod: the reduced mass times what its length adds.
      const Vec3 d = added.center - expected.center;
      const double reduced = 7.0 * added.mass / (7.0 + added.mass);
      expected.inertia += added.inertia + (Mat3::identity() * dot(d, d) - outer(d, d)) * reduced;
      expected.center += d * (added.mass / (7.0 + added.mass));
      expected.mass += added.mass;
    }
    EXPECT_NEAR(info.mass, expected.mass, 1e-13) << flag;
    EXPECT_LT(norm(info.initial_center - expected.center), 1e-13) << flag;
    EXPECT_LT(distance(tensor(info), expected.inertia), 1e-11) << flag;
  }
}

TEST(BodyAssembly, GivenInertiaOfAMergedPartCountsAsGiven) {
  Deck deck;
  const auto a = deck.quad({0, 0, 0}, 1), b = deck.quad({2, 0, 0}, 0.5);
  const PartIndex pa = deck.part({a}), pb = deck.part({b});
  deck.give(pb, 7.0, {0.1, 0.2, 0.3}, {1, 2, 2.5});
  deck.model.merges = {{pa, pb, 0}};
  deck.assemble();
  ASSERT_TRUE(deck.diagnostics.ok());
  EXPECT_NEAR(deck.state.bodies.info[0].mass, by_hand(deck, joined({a})).mass + 7.0, 1e-13);
}

TEST(BodyAssembly, ExtraNodesCountUnlessTheInertiaIsGivenWithoutTheFlag) {
  for (const bool given : {false, true})
    for (const int flag : {0, 1}) {
      Deck deck;
      const auto a = deck.quad({0, 0, 0}, 1);
      const PartIndex p = deck.part({a});
      const NodeIndex extra = deck.node({3, 3, 3}, 2.0);
      deck.model.extra_nodes.push_back({p, {extra, a[0]}, flag});  // a node of the part itself counts once
      if (given) deck.give(p, 7.0, {0, 0, 0}, {1, 2, 2.5});
      deck.assemble();
      ASSERT_TRUE(deck.diagnostics.ok());
      const double alone = given ? 7.0 : 10.0;
      const double expected = given && flag == 0 ? alone : alone + 2.0;
      EXPECT_NEAR(deck.state.bodies.info[0].mass, expected, 1e-13) << "given " << given << " flag " << flag;
      EXPECT_EQ(deck.state.nodes.body[static_cast<std::size_t>(extra)], 0);
      EXPECT_EQ(deck.assembly.nodes.node.size(), 5u);
    }
}

TEST(BodyAssembly, EveryListOfExtraNodesHasItsOwnFlag) {
  Deck deck;
  const PartIndex p = deck.part({deck.quad({0, 0, 0}, 1)});
  deck.give(p, 7.0, {0, 0, 0}, {1, 2, 2.5});
  const NodeIndex counted = deck.node({2, 0, 0}, 1.0), not_counted = deck.node({0, 2, 0}, 100.0);
  deck.model.extra_nodes = {{p, {counted}, 1}, {p, {not_counted}, 0}};
  deck.assemble();
  ASSERT_TRUE(deck.diagnostics.ok());
  EXPECT_NEAR(deck.state.bodies.info[0].mass, 8.0, 1e-13);
  EXPECT_LT(norm(deck.state.bodies.info[0].initial_center - Vec3{0.25, 0, 0}), 1e-14);
}

TEST(BodyAssembly, ElementInertiaIsAddedInItsFrame) {
  Deck deck;
  const auto a = deck.quad({0, 0, 0}, 1);
  deck.part({a});
  PointInertia inertia;
  inertia.node = a[1];
  inertia.inertia = Mat3::diagonal({3, 4, 5});
  inertia.frame = deck.frame({0.5, 0.3, -0.2, 0.7});
  deck.model.inertias.push_back(inertia);
  deck.assemble();
  ASSERT_TRUE(deck.diagnostics.ok());
  ByHand expected = by_hand(deck, joined({a}));
  const Mat3& axes = deck.model.frames[0].axes;
  for (std::size_t k = 0; k < 3; ++k)  // sum of J_k e_k e_k^T
    expected.inertia += outer(axes.column(k), axes.column(k)) * (3.0 + static_cast<double>(k));
  expect_body(deck.state.bodies.info[0], expected);
}

TEST(BodyAssembly, LineOfNodesTakesTheirRotaryInertiaOrIsAnError) {
  for (const double rotary : {0.0, 0.01}) {
    Deck deck;
    std::vector<NodeIndex> line;
    for (int i = 0; i < 4; ++i) line.push_back(deck.node({1.0 * i, 2.0 * i, 0}, 1.0, rotary));
    deck.nodal_body(70, line);
    deck.assemble();
    if (rotary > 0) {
      ASSERT_TRUE(deck.diagnostics.ok());
      EXPECT_NEAR(deck.state.bodies.info[0].principal_inertia.x, 0.04, 1e-12);
    } else {
      EXPECT_EQ(deck.diagnostics.error_count(), 1u);
      EXPECT_NE(deck.message(Severity::error, {"nodal rigid body 70", "no moment of inertia", "line"}), "");
    }
  }
}

TEST(BodyAssembly, BodyWithoutMassIsAnError) {
  Deck deck;
  deck.part({deck.quad({0, 0, 0}, 0.0)});
  deck.assemble();
  EXPECT_NE(deck.message(Severity::error, {"rigid part 11", "no mass"}), "");
}

TEST(BodyAssembly, NodeInTwoBodiesIsAnErrorThatNamesThem) {
  Deck deck;
  const auto a = deck.quad({0, 0, 0}, 1);
  const std::array<NodeIndex, 4> b{a[1], deck.node({5, 0, 1}, 2), deck.node({5, 1, 0}, 1), deck.node({4, 1, 0}, 1)};
  deck.part({a});
  deck.part({b});
  deck.assemble();
  EXPECT_NE(deck.message(Severity::error, {"node 102 ", "rigid part 11", "rigid part 12"}), "");
}

TEST(BodyAssembly, EmptyRigidPartIsIgnoredWithAWarning) {
  Deck deck;
  const PartIndex empty = deck.part({}), full = deck.part({deck.quad({0, 0, 0}, 1)});
  deck.assemble();
  EXPECT_TRUE(deck.diagnostics.ok());
  EXPECT_NE(deck.message(Severity::warning, {"rigid part 11", "ignored"}), "");
  EXPECT_EQ(deck.state.bodies.of_part[static_cast<std::size_t>(empty)], none);
  EXPECT_EQ(deck.state.bodies.of_part[static_cast<std::size_t>(full)], 0);
}

TEST(BodyAssembly, ConstraintOnARigidNodeBecomesOneOfTheBody) {
  Deck deck;
  const auto a = deck.quad({0, 0, 0}, 1);
  deck.part({a});
  deck.model.nodes.constrained[static_cast<std::size_t>(a[2])] = dof_z;
  SinglePointConstraint spc;
  spc.nodes = {a[0]};
  spc.dofs = dof_x | dof_ry;
  deck.model.constraints.push_back(spc);
  deck.assemble();
  ASSERT_TRUE(deck.diagnostics.ok());
  EXPECT_EQ(deck.assembly.fixity[0].global, dof_x | dof_z | dof_ry);
  EXPECT_EQ(deck.assembly.fixity[0].local, 0);
  EXPECT_NE(deck.message(Severity::notice, {"node 101 ", "rigid body 11"}), "");
  EXPECT_NE(deck.message(Severity::notice, {"node 103 ", "rigid body 11"}), "");
}

TEST(BodyAssembly, ConstraintsInTwoLocalFramesContradict) {
  Deck deck;
  const auto a = deck.quad({0, 0, 0}, 1);
  deck.part({a});
  for (const double w : {0.9, 0.3}) {
    SinglePointConstraint spc;
    spc.nodes = {a[0]};
    spc.dofs = dof_x;
    spc.frame = deck.frame({w, 0.1, 0.2, 0.3});
    deck.model.constraints.push_back(spc);
  }
  deck.assemble();
  EXPECT_NE(deck.message(Severity::error, {"body 11", "two different local frames", "101"}), "");
}

TEST(BodyAssembly, CodesOfTheRigidMaterial) {
  constexpr std::uint8_t x = 1, y = 2, z = 4;
  const std::array<std::uint8_t, 8> meaning{0, x, y, z, x | y, y | z, z | x, x | y | z};  // LS-DYNA manual, *MAT_RIGID CON1
  for (int code = 0; code < 8; ++code) {
    Deck deck;
    RigidMaterial material;
    material.cmo = 1;
    material.con1 = code;
    material.con2 = 7 - code;
    deck.part({deck.quad({0, 0, 0}, 1)}, material);
    deck.assemble();
    EXPECT_EQ(deck.assembly.fixity[0].global,
              meaning[static_cast<std::size_t>(code)] | meaning[static_cast<std::size_t>(7 - code)] << 3);
    EXPECT_EQ(deck.assembly.fixity[0].local, 0);
  }
}

TEST(BodyAssembly, LocalConstraintsOfTheRigidMaterial) {
  Deck deck;
  RigidMaterial material;
  material.cmo = -1;
  material.frame = deck.frame({0.9, 0.1, 0.2, 0.3});
  material.con2 = dof_y | dof_rz;
  deck.part({deck.quad({0, 0, 0}, 1)}, material);
  deck.assemble();
  EXPECT_EQ(deck.assembly.fixity[0].global, 0);
  EXPECT_EQ(deck.assembly.fixity[0].local, dof_y | dof_rz);
  EXPECT_EQ(deck.assembly.fixity[0].frame, 0);
}

TEST(BodyAssembly, ExtraNodesOnADeformablePartAreAnError) {
  Deck deck;
  deck.model.materials.push_back({9, "elastic", ElasticMaterial{}});
  const PartIndex p = deck.part({});
  deck.model.parts[0].material = static_cast<Index>(deck.model.materials.size()) - 2;
  deck.model.extra_nodes.push_back({p, {deck.node({0, 0, 0}, 1)}, 0});
  deck.assemble();
  EXPECT_NE(deck.message(Severity::error, {"part 11", "not rigid"}), "");
}

TEST(BodyAssembly, MergeOfADeformablePartIsAnErrorAndACircleAWarning) {
  Deck deck;
  const PartIndex a = deck.part({deck.quad({0, 0, 0}, 1)}), b = deck.part({deck.quad({2, 0, 0}, 1)});
  deck.model.merges = {{a, b, 0}, {b, a, 0}};
  deck.assemble();
  EXPECT_TRUE(deck.diagnostics.ok());
  EXPECT_NE(deck.message(Severity::warning, {"12", "11", "circle"}), "");
  EXPECT_EQ(deck.state.bodies.info.size(), 1u);
  deck.model.merges = {{a, none, 0}};
  deck.assemble();
  EXPECT_NE(deck.message(Severity::error, {"not rigid"}), "");
}

}  // namespace
}  // namespace kardan::test
