// SWFORC: what the table holds and how the ASCII file prints it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "handmade_model.hpp"
#include "kardan/io/ascii/ascii_writer.hpp"
#include "kardan/io/tables/reporter.hpp"

namespace kardan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(WeldTable, HoldsForcesTypesAndFailure) {
  test::HandmadeModel b;
  State s;
  s.nodes.resize(0);
  WeldReport beam;
  beam.kind = WeldReport::Kind::beam;
  beam.id = 301;
  beam.axial = -12.5;
  beam.shear = 3;
  beam.moment = 0.5;
  beam.torsion = 0.25;
  beam.length = 2;
  WeldReport constraint;
  constraint.id = 8;
  constraint.failed = true;
  constraint.failure_time = 0.125;
  s.welds = {beam, constraint};
  const Snapshot snapshot = Reporter(b.model, s).take(OutputFile::swforc, b.model, s);
  ASSERT_EQ(snapshot.folders.size(), 1u);
  const Folder& f = snapshot.folders[0];
  EXPECT_EQ(f.path, "/swforc");
  EXPECT_THAT(f.meta("ids"), ElementsAre(301, 8));
  EXPECT_THAT(f.meta("types"), ElementsAre(3, 1));
  EXPECT_THAT(f["axial"], ElementsAre(-12.5, 0));
  EXPECT_THAT(f["shear"], ElementsAre(3, 0));
  EXPECT_THAT(f["resultant_moment"], ElementsAre(0.5, 0));
  EXPECT_THAT(f["failure_time"], ElementsAre(0, 0.125));
  EXPECT_THAT(f.integers.at(0).values, ElementsAre(0, 1));
  const std::string text = swforc_text(snapshot);
  EXPECT_THAT(text, HasSubstr("         301   -1.25000E+01    3.00000E+00"));
  EXPECT_THAT(text, HasSubstr("constraint failed"));
}

}  // namespace
}  // namespace kardan
