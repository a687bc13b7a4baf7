// *INCLUDE and its kin: finding files, circles, shifted IDs, unit factors, transformations.
#include "deck_test_tools.hpp"

#include <sys/stat.h>

#include <cmath>

namespace kardan::deck {
namespace {

using test::find_message;
using test::Read;
using test::TemporaryFolder;

std::vector<std::int64_t> node_ids(Read& read) {
  std::vector<std::int64_t> ids;
  for (Block& block : read.deck.blocks)
    block.for_each("card0", [&](const Card& c) { ids.push_back(c.id("nid", IdKind::node)); });
  return ids;
}

std::string node(int id) {
  return "*NODE\n" + std::to_string(id) + ",0,0,0\n";
}

TEST(Include, TakesTheFilesPlace) {
  TemporaryFolder folder;
  folder.write("sub/a.k", "*KEYWORD\n" + node(2) + "*INCLUDE\nb.k\n*END\nrest\n");
  folder.write("sub/b.k", node(3));
  folder.write("c.k", node(5));
  Read read(
      folder.write("main.k", "*KEYWORD\n" + node(1) + "*INCLUDE\n$ comment\nsub/a.k\nc.k\n" + node(6) + "*END\n"));
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  EXPECT_EQ(node_ids(read), (std::vector<std::int64_t>{1, 2, 3, 5, 6}));
  EXPECT_EQ(read.deck.files.size(), 4u);
}

TEST(Include, FindsFilesInManyWays) {
  TemporaryFolder folder;
  folder.write("parts/deep/a.k", node(1));
  folder.write("parts/b.k", node(2));
  folder.write("x/y/c.k", "*INCLUDE_PATH_RELATIVE\nnear\n*INCLUDE\nd.k\n");
  folder.write("x/y/near/d.k", node(4));
  folder.write("a very long name.k", node(5));
  folder.write("p7.k", node(7));
  const std::string absolute = folder.write("elsewhere.k", node(6)).string();
  Read read(folder.write("main.k",
                         "*INCLUDE\nparts\\deep\\a.k\n*INCLUDE_PATH\nparts\n*INCLUDE\n'b.k'\n*INCLUDE\nx/y/"
                         "c.k\n*INCLUDE\na very long +\nname.k\n" +
                             std::string("*INCLUDE\n") + absolute + "\n*PARAMETER\ni n,7\n*INCLUDE\np&n.k\n"));
  EXPECT_EQ(read.diagnostics.error_count(), 1u)
      << read.messages();  // "a very long" + "name.k" without the blank is another file
  EXPECT_NE(find_message(read.diagnostics, Severity::error, "'a very longname.k' is not found"), nullptr)
      << read.messages();
  EXPECT_EQ(node_ids(read), (std::vector<std::int64_t>{1, 2, 4, 6, 7}));
}

TEST(Include, FaultsNameFileAndLine) {
  TemporaryFolder folder;
  folder.write("a.k", node(1) + "*INCLUDE\nb.k\n");
  folder.write("b.k", "*INCLUDE\na.k\n");
  Read read(folder.write("main.k", "*KEYWORD\n*INCLUDE\nno such file.k\n*INCLUDE\n*INCLUDE\na.k\n" + node(9)));
  const Diagnostic* missing = find_message(read.diagnostics, Severity::error, "'no such file.k' is not found");
  ASSERT_NE(missing, nullptr);
  EXPECT_EQ(missing->where.line, 3);
  EXPECT_NE(missing->cure.find(folder.path().string()), std::string::npos);
  EXPECT_NE(find_message(read.diagnostics, Severity::error, "the name of the file is missing"), nullptr);
  const Diagnostic* circle = find_message(read.diagnostics, Severity::error, "in a circle: a.k -> b.k -> a.k");
  ASSERT_NE(circle, nullptr) << read.messages();
  EXPECT_EQ(circle->where.file, (folder.path() / "b.k").string());
  EXPECT_EQ(node_ids(read), (std::vector<std::int64_t>{1, 9})) << "reading goes on";
}

TEST(Include, MissingDeckUtf16AndTextBeforeTheFirstKeyword) {
  TemporaryFolder folder;
  EXPECT_EQ(Read(folder.path() / "none.k").diagnostics.error_count(), 1u);
  EXPECT_EQ(Read(folder.path()).diagnostics.error_count(), 1u);
  ASSERT_EQ(mkfifo((folder.path() / "pipe.k").c_str(), 0600), 0);
  EXPECT_EQ(Read(folder.path() / "pipe.k").diagnostics.error_count(), 1u) << "and it does not wait for a writer";
  EXPECT_NE(find_message(Read(std::string("\xFF\xFE*\0N\0", 6)).diagnostics, Severity::error, "UTF-16"), nullptr);
  Read read(std::string("$ fine\n\nstray text\n*KEYWORD\n"));
  ASSERT_EQ(read.diagnostics.error_count(), 1u);
  EXPECT_EQ(read.diagnostics.all()[0].where.line, 3);
  EXPECT_TRUE(Read(std::string()).diagnostics.ok());
}

TEST(Include, DepthNumberAndConfinementAreBounded) {
  TemporaryFolder folder;
  for (int i = 0; i < 12; ++i)
    folder.write("f" + std::to_string(i) + ".k",
                 "*INCLUDE\nf" + std::to_string(i + 1) + ".k\nf" + std::to_string(i + 1) + ".k\n");
  folder.write("f12.k", node(1));
  ReadOptions options;
  options.max_include_depth = 5;
  EXPECT_NE(find_message(Read(folder.path() / "f0.k", options).diagnostics, Severity::error, "deeper than 5"), nullptr);
  options = {};
  options.max_files = 100;
  Read many(folder.path() / "f0.k", options);
  EXPECT_NE(find_message(many.diagnostics, Severity::error, "more than 100 files"), nullptr);
  EXPECT_EQ(many.deck.files.size(), 100u);
  options = {};
  options.max_bytes = 200;
  EXPECT_NE(find_message(Read(folder.path() / "f0.k", options).diagnostics, Severity::error, "more than 200 bytes"),
            nullptr);
  options = {};
  options.confine_to = folder.path() / "inside";
  const auto inside = folder.write("inside/main.k", "*INCLUDE\n../f12.k\n*INCLUDE\nok.k\n");
  folder.write("inside/ok.k", node(3));
  Read confined(inside, options);
  EXPECT_NE(find_message(confined.diagnostics, Severity::error, "outside of the folder"), nullptr);
  EXPECT_EQ(node_ids(confined), (std::vector<std::int64_t>{3}));
}

TEST(Include, FormatOfAFileEndsWithIt) {
  TemporaryFolder folder;
  folder.write(
      "long.k",
      "*KEYWORD LONG=Y\n*NODE\n                   2                 0.5                 0.0                 0.0\n");
  Read read(folder.write(
      "main.k", "*KEYWORD\n*INCLUDE\nlong.k\n*NODE\n       3             0.5             0.0             0.0\n"));
  for (Block& block : read.deck.blocks) EXPECT_EQ(block.next("card0").real("x"), 0.5);
}

const char* const shifted =
    "*NODE\n1,1.0,2.0,3.0\n*MAT_ELASTIC\n5,7.8,210.,0.3\n*DEFINE_CURVE\n9\n*SECTION_SOLID\n3\n*SET_NODE_LIST\n4\n*"
    "PART\n\n6,3,5\n*ELEMENT_MASS\n8,1,2.0\n"
    "*DEFINE_VECTOR\n7,0,0,0,1,0,0\n";

TEST(Transform, ShiftsIdsByTheirKind) {
  TemporaryFolder folder;
  folder.write("a.k", shifted);
  folder.write("nested.k", "*INCLUDE_TRANSFORM\na.k\n1,2,3,4,5,6,7\n8\n\n\n");
  Read read(folder.write("main.k", "*INCLUDE_TRANSFORM\nnested.k\n100,200,300,400,500,600,700\n800\n"));
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  EXPECT_EQ(read.block(0).next("card0").id("nid", IdKind::node), 102);
  const Card material = read.block(1).next("card0");
  EXPECT_EQ(material.id("mid", IdKind::material), 409);
  EXPECT_EQ(material.integer("mid"), 5);
  EXPECT_EQ(read.block(2).next("card0").id("lcid", IdKind::curve), 615);
  EXPECT_EQ(read.block(3).next("card0").id("secid", IdKind::other), 811);
  EXPECT_EQ(read.block(4).next("card0").id("sid", IdKind::set), 509);
  read.block(5).next_title();
  EXPECT_EQ(read.block(5).next("card0").id("pid", IdKind::part), 309);
  EXPECT_EQ(read.block(5).info->name, "PART");
  EXPECT_EQ(read.block(6).next("card0").id("eid", IdKind::element), 210);
  EXPECT_EQ(read.block(7).next("card0").id("vid", IdKind::define), 714);
}

TEST(Transform, ZeroStaysZeroAndNegativeKeepsItsSign) {
  TemporaryFolder folder;
  folder.write("a.k", "*MAT_RIGID\n1,1.,1.,0.3\n-1,-3\n\n*ELEMENT_SHELL\n1,0\n");
  Read read(folder.write("main.k", "*INCLUDE_TRANSFORM\na.k\n100,200,300,400,500,600,700\n"));
  read.block(0).next("card0");
  EXPECT_EQ(read.block(0).next("card1").id("con1", IdKind::define), -703);
  EXPECT_EQ(read.block(1).next("card0").id("pid", IdKind::part), 0);
}

TEST(Transform, ConvertsUnits) {
  TemporaryFolder folder;
  folder.write("a.k", shifted);
  // A deck in kg, m, s within one in t, mm, s.
  Read read(folder.write("main.k", "*INCLUDE_TRANSFORM\na.k\n\n\n0.001,1.0,1000.\n\n"));
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  EXPECT_EQ(read.block(0).next("card0").point("x"), (Vec3{1000, 2000, 3000}));
  const Card material = read.block(1).next("card0");
  EXPECT_DOUBLE_EQ(material.real("ro", dimension::density), 7.8e-12);
  EXPECT_DOUBLE_EQ(material.real("e", dimension::stress), 210e-6);
  EXPECT_EQ(material.real("pr", dimension::none), 0.3);
  EXPECT_DOUBLE_EQ(read.block(6).next("card0").real("mass", dimension::mass), 2e-3);
}

Vec3 moved(const std::string& steps, const std::string& units = "") {
  TemporaryFolder folder;
  folder.write("a.k", "*NODE\n1,1.0,2.0,3.0\n");
  Read read(folder.write("main.k",
                         "*DEFINE_TRANSFORMATION\n7\n" + steps + "*INCLUDE_TRANSFORM\na.k\n\n\n" + units + "\n7\n"));
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  return read.block(0).next("card0").point("x");
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT(norm(a - b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(Transform, StepsInTheirOrder) {
  expect_near(moved("TRANSL,10,20,30\n"), {11, 22, 33});
  expect_near(moved("SCALE,2,,0.5\n"), {2, 2, 1.5});
  expect_near(moved("ROTATE,0,0,1,0,0,0,90\n"), {-2, 1, 3});
  expect_near(moved("ROTATE,0,0,2,1,1,0,90\n"), {0, 1, 3});
  expect_near(moved("POINT,1,1,1,0\nPOINT,2,1,1,5\nROTATE,1,2,90\n"), {0, 1, 3});
  expect_near(moved("MIRROR,0,0,1,0,0,2\n"), {1, 2, -1});
  expect_near(moved("transl,1,0,0\nscale,2,2,2\n"), {4, 4, 6});
  expect_near(moved("SCALE,2,2,2\nTRANSL,1,0,0\n"), {3, 4, 6});
  expect_near(moved("TRANSL,1,0,0\n", "1,1,1000"), {1001, 2000, 3000});
  expect_near(moved("    TRANSL       1.0       0.0       0.0\n"), {2, 2, 3});
}

TEST(Transform, ThreePointsToThreePoints) {
  const std::string points =
      "POINT,1,0,0,0\nPOINT,2,1,0,0\nPOINT,3,0,1,0\nPOINT,4,5,5,5\nPOINT,5,5,7,5\nPOINT,6,5,5,9\n";
  expect_near(moved(points + "POS6P,1,2,3,4,5,6\n"), {5 + 3, 5 + 1, 5 + 2});
}

TEST(Transform, NestedOnesApplyFromTheInsideOut) {
  TemporaryFolder folder;
  folder.write("a.k", "*NODE\n1,1.0,2.0,3.0\n");
  folder.write("inner.k", "*DEFINE_TRANSFORMATION\n1\nTRANSL,1,0,0\n*INCLUDE_TRANSFORM\na.k\n\n\n1,1,10\n1\n");
  Read read(folder.write(
      "main.k",
      "*DEFINE_TRANSFORMATION\n2\nROTATE,0,0,1,0,0,0,90\nTRANSL,0,0,7\n*INCLUDE_TRANSFORM\ninner.k\n\n\n1,1,2\n2\n"));
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  // (1,2,3) -> x10, +1 -> (11,20,30) -> x2, turned, +7 -> (-40,22,67)
  expect_near(read.block(0).next("card0").point("x"), {-40, 22, 67});
}

TEST(Transform, Faults) {
  TemporaryFolder folder;
  folder.write("a.k", node(1));
  const auto error = [&](const std::string& text) {
    Read read(folder.write("main.k", text));
    EXPECT_GE(read.diagnostics.error_count(), 1u) << text;
    return read.messages();
  };
  EXPECT_NE(error("*INCLUDE_TRANSFORM\na.k\n\n\n\n5\n").find("transformation 5 is not defined"), std::string::npos);
  EXPECT_NE(error("*INCLUDE_TRANSFORM\na.k\n\n\n-1.,1.,1.\n").find("field FCTMAS: found -1"), std::string::npos);
  EXPECT_NE(error("*INCLUDE_TRANSFORM\na.k\n1x\n").find("field IDNOFF: found '1x'"), std::string::npos);
  EXPECT_NE(error("*INCLUDE_TRANSFORM\na.k\n9999999999999999,\n").find("is too large"), std::string::npos);
  EXPECT_NE(error("*DEFINE_TRANSFORMATION\n1\nTWIST,1\n").find("'TWIST' is not built"), std::string::npos);
  EXPECT_NE(error("*DEFINE_TRANSFORMATION\n1\nROTATE,1,2,90\n").find("POINT 1 is not defined"), std::string::npos);
  EXPECT_NE(error("*DEFINE_TRANSFORMATION\n1\nROTATE,0,0,0,1,0,0,90\n").find("no direction"), std::string::npos);
  EXPECT_NE(error("*DEFINE_TRANSFORMATION\n1\nMIRROR,1,1,1,1,1,1\n").find("no normal"), std::string::npos);
  EXPECT_NE(error("*DEFINE_TRANSFORMATION\n1\nSCALE,0,1,1\n").find("scale factor is zero"), std::string::npos);
  EXPECT_NE(error("*DEFINE_TRANSFORMATION\n1\nTRANSL,1\n*DEFINE_TRANSFORMATION\n1\nTRANSL,1\n").find("a second time"),
            std::string::npos);
}

}  // namespace
}  // namespace kardan::deck
