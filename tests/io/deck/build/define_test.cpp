// *DEFINE_*, sets, functions of time.
#include "build_fixture.hpp"

#include <cmath>
#include <numbers>

#include "kardan/io/deck/build/curve_function.hpp"

namespace kardan::deck {
namespace {

TEST(BuildDefine, CurveScaleAndOffset) {
  const Built b("*DEFINE_CURVE_TITLE\npulse\n3,0,2.,10.,.5,-1.\n0,0\n1,1\n3,5");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const Curve& c = b.model.curves[0];
  EXPECT_EQ(c.title, "pulse");
  EXPECT_EQ(c.x, (std::vector<double>{1, 3, 7}));
  EXPECT_EQ(c.y, (std::vector<double>{-10, 0, 40}));
}

TEST(BuildDefine, CurveOutOfOrderIsSortedAndSaid) {
  const Built b("*DEFINE_CURVE\n1\n0,1\n2,3\n1,2\n4,0\n4,5");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_NE(b.warning("1 after 2"), nullptr) << b.messages();
  EXPECT_NE(b.warning("one abscissa"), nullptr);
  const Curve& c = b.model.curves[0];
  EXPECT_EQ(c.y, (std::vector<double>{1, 2, 3, 0, 5}));
  for (std::size_t i = 1; i < c.x.size(); ++i) EXPECT_GT(c.x[i], c.x[i - 1]);
}

TEST(BuildDefine, CurveFunctionIsSampledClosely) {
  const Built b(
      "*DEFINE_CURVE_FUNCTION\n1\n10.*SIN(2*PI*TIME*7)+TIME**2\n*DEFINE_CURVE_FUNCTION\n2\nSTEP(TIME,.2,0,.6,\n3.)*2\n*"
      "DEFINE_CURVE_FUNCTION\n3\nIF(TIME-0.3,1.,1.,-2.)");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  double worst = 0;
  for (double t = 0; t < 1; t += 0.000317) {
    worst = std::max(worst, std::fabs(b.model.curves[0].value(t) - (10 * std::sin(14 * std::numbers::pi * t) + t * t)));
  }
  EXPECT_LT(worst, 2e-6);  // 1e-7 of the largest value at the quarter points
  EXPECT_EQ(b.model.curves[1].value(0.1), 0);
  EXPECT_NEAR(b.model.curves[1].value(0.4), 3, 1e-6);
  EXPECT_NEAR(b.model.curves[1].value(0.9), 6, 1e-12);
  EXPECT_EQ(b.model.curves[2].value(0.3 - 1e-8), 1);
  EXPECT_EQ(b.model.curves[2].value(0.3 + 1e-8), -2);
}

TEST(CurveFunctionTest, PrecedenceAndRefusals) {
  EXPECT_EQ(CurveFunction("-2**2+3*(1-4)/2")(0), -4 - 4.5);
  EXPECT_EQ(CurveFunction("2**3**2")(0), 512);
  EXPECT_EQ(CurveFunction("POLY(TIME,1,5,2,3)")(3), 5 + 2 * 2 + 3 * 4);
  EXPECT_EQ(CurveFunction("CHEBY(TIME,0,1,2,3)")(0.5), 1 + 2 * 0.5 + 3 * (2 * 0.25 - 1));
  EXPECT_NEAR(CurveFunction("HAVSIN(TIME,0,0,1,2)")(0.5), 1.0, 1e-15);
  try {
    CurveFunction("1+DX(5,3)");
    FAIL();
  } catch (const CurveFunctionError& error) {
    EXPECT_TRUE(error.solver_variable);
    EXPECT_EQ(error.position, 2u);
  }
  EXPECT_THROW(CurveFunction("SIN(1"), CurveFunctionError);
  EXPECT_THROW(CurveFunction("1 2"), CurveFunctionError);
  EXPECT_THROW(CurveFunction(std::string(100000, '(')), CurveFunctionError);
  EXPECT_THROW(CurveFunction(""), CurveFunctionError);
}

TEST(BuildDefine, FunctionsOfTheSolutionAreRefusedByName) {
  const Built b("*DEFINE_CURVE_FUNCTION\n1\n2*VX(12)");
  EXPECT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_NE(b.unsupported("'VX'"), nullptr) << b.messages();
}

TEST(BuildDefine, TableTakesTheCurvesThatFollow) {
  const Built b(
      "*DEFINE_TABLE\n7\n0.0\n10.0\n*DEFINE_CURVE\n1\n0,0\n1,1\n*DEFINE_CURVE\n2\n0,0\n1,2\n*DEFINE_TABLE\n8\n1.,2\n2.,"
      "1");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_EQ(b.model.tables[0].curve, (std::vector<CurveIndex>{0, 1}));
  EXPECT_EQ(b.model.tables[1].curve, (std::vector<CurveIndex>{1, 0}));
}

TEST(BuildDefine, Frames) {
  const Built b(
      "*NODE\n1,1,1,1\n2,1,3,1\n3,1,1,4\n*DEFINE_COORDINATE_SYSTEM\n1,5,5,5,5,6,5\n4,5,5\n*DEFINE_COORDINATE_NODES\n2,"
      "1,2,3,1,X\n3,1,2,3,0,Y\n4,1,2,3,0,Z\n*DEFINE_COORDINATE_VECTOR\n5,1,0,0,1,1,0");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto& f = b.model.frames;
  EXPECT_EQ(f[0].origin, (Vec3{5, 5, 5}));
  EXPECT_EQ(f[0].axes.column(0), (Vec3{0, 1, 0}));
  EXPECT_EQ(f[0].axes.column(1), (Vec3{-1, 0, 0}));
  EXPECT_TRUE(f[1].moves);
  EXPECT_EQ(f[1].axes.column(0), (Vec3{0, 1, 0}));
  EXPECT_EQ(f[1].axes.column(1), (Vec3{0, 0, 1}));
  EXPECT_EQ(f[2].axes.column(1), (Vec3{0, 1, 0}));  // N1-N2 is the y-axis, N3 in the yz-plane
  EXPECT_EQ(f[2].axes.column(2), (Vec3{0, 0, 1}));
  EXPECT_EQ(f[3].axes.column(2), (Vec3{0, 1, 0}));  // N1-N2 is the z-axis, N3 in the zx-plane
  EXPECT_EQ(f[3].axes.column(0), (Vec3{0, 0, 1}));
  EXPECT_EQ(f[4].axes, Mat3::identity());
}

/// Numbers of the nodes of the set with this number.
std::vector<UserId> ids(const Built& b, UserId set) {
  std::vector<UserId> out;
  for (const NodeSet& s : b.model.node_sets) {
    if (s.id != set) continue;
    for (const NodeIndex n : s.nodes) out.push_back(b.model.nodes.id[static_cast<std::size_t>(n)]);
  }
  return out;
}

TEST(BuildSets, NodesInEveryForm) {
  const Built b(two_blocks +
                "*SET_NODE\n1\n3,2,3\n5\n*SET_NODE_LIST_GENERATE\n2\n7,13,21,21\n*SET_NODE_LIST_GENERATE_"
                "INCREMENT\n3\n1,10,3\n*SET_NODE_COLUMN\n4\n22,1.\n23\n"
                "*SET_NODE_ADD\n5\n1,4\n*SET_NODE_GENERAL\n6\nPART,2\nDBOX,1\nNODE,26\n*DEFINE_BOX\n1,-.5,.5,-9,9,-9,"
                "9\n*SET_NODE_INTERSECT\n7\n1,3,8\n*SET_NODE_GENERAL\n8\nALL\n"
                "*SET_NODE_LIST_COLLECT\n9\n1\n*SET_NODE_LIST_COLLECT\n9\n2");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_EQ(ids(b, 1), (std::vector<UserId>{3, 2, 5}));
  EXPECT_EQ(ids(b, 2), (std::vector<UserId>{7, 8, 11, 12, 13, 21}));
  EXPECT_EQ(ids(b, 3), (std::vector<UserId>{1, 4, 7}));
  EXPECT_EQ(ids(b, 4), (std::vector<UserId>{22, 23}));
  EXPECT_EQ(ids(b, 5), (std::vector<UserId>{3, 2, 5, 22, 23}));
  EXPECT_EQ(ids(b, 6), (std::vector<UserId>{12, 13, 16, 17, 26}));
  EXPECT_TRUE(ids(b, 7).empty());
  EXPECT_EQ(ids(b, 8).size(), b.model.nodes.size());
  EXPECT_EQ(ids(b, 9), (std::vector<UserId>{1, 2}));
}

TEST(BuildSets, PartsSegmentsElements) {
  const Built b(two_blocks +
                "*SET_PART_LIST\n1\n2,1\n*SET_PART_COLUMN\n2\n1,.5\n2,.25\n*SET_SEGMENT\n1\n1,2,3,4\n5,6,7\n*SET_"
                "SEGMENT_GENERAL\n2\nPART,1\nDSEG,4,3,2,1\n*SET_SOLID\n1\n2\n"
                "*SET_SOLID_GENERAL\n2\nALL\nDELEM,1\n*SET_NODE_GENERAL\n5\nSET_SEGMENT,1\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_EQ(b.model.part_sets[0].parts, (std::vector<PartIndex>{1, 0}));
  EXPECT_EQ(b.model.part_sets[1].attribute, (std::vector<double>{.5, .25}));
  EXPECT_EQ(b.model.segment_sets[0].segments[1], (std::array<NodeIndex, 4>{4, 5, 6, 6}));
  EXPECT_EQ(b.model.segment_sets[1].segments.size(), 5u);  // six faces less one
  EXPECT_EQ(b.model.element_sets[0].elements, (std::vector<Index>{1}));
  EXPECT_EQ(b.model.element_sets[1].elements, (std::vector<Index>{1}));
  EXPECT_EQ(b.model.node_sets[0].nodes.size(), 7u);
}

TEST(BuildSets, CirclesAndStrangersAreErrors) {
  const Built b(
      "*NODE\n1,0,0,0\n*SET_NODE_ADD\n1\n2\n*SET_NODE_ADD\n2\n1\n*SET_NODE_LIST\n3\n1,77\n*SET_NODE_LIST\n3\n1");
  EXPECT_NE(b.error("contains itself"), nullptr) << b.messages();
  const Diagnostic* missing = b.error("node 77 is not defined");
  ASSERT_NE(missing, nullptr);
  EXPECT_EQ(missing->where.line, 14);
  EXPECT_EQ(missing->where.column, 3);
  EXPECT_EQ(missing->field, "ID2");
  EXPECT_NE(b.error("node set 3 is defined twice; first at deck.k:13"), nullptr) << b.messages();
}

}  // namespace
}  // namespace kardan::deck
