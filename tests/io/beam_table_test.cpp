// ELOUT of beams: what the table holds and how the ASCII file prints it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "handmade_model.hpp"
#include "kardan/io/ascii/ascii_writer.hpp"
#include "kardan/io/tables/reporter.hpp"

namespace kardan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(BeamTable, HoldsTheResultantsOfLivingDeformableBeams) {
  test::HandmadeModel b;
  Section section;
  section.kind = ElementKind::beam;
  b.part(section, b.material_of(ElasticMaterial{1, 1, 0, 0, 0}));
  for (const int i : {0, 1, 2}) {
    b.node({1.0 * i, 0, 0});
    b.model.beams.id.push_back(40 + i);
    b.model.beams.part.push_back(0);
    b.model.beams.nodes.push_back({0, 1, none});
  }
  b.model.output.history_beams = {2, 1, 0};
  State s;
  s.nodes.resize(3);
  s.results.beam.resize(3);
  s.results.beam.alive = {1, 0, 1};
  s.results.beam.axial = {1, 2, 3};
  s.results.beam.shear[2] = {4, 5};
  s.results.beam.bending[2] = {6, 7};
  s.results.beam.torsion[2] = 8;
  const Snapshot snapshot = Reporter(b.model, s).take(OutputFile::elout, b.model, s);
  ASSERT_EQ(snapshot.folders.size(), 1u);
  const Folder& f = snapshot.folders[0];
  EXPECT_EQ(f.path, "/elout/beam");
  EXPECT_THAT(f.integers.at(1).values, ElementsAre(42, 40));
  EXPECT_THAT(f["axial"], ElementsAre(3, 1));
  EXPECT_THAT(f["shear_t"], ElementsAre(5, 0));
  EXPECT_THAT(f["moment_s"], ElementsAre(6, 0));
  EXPECT_THAT(f["torsion"], ElementsAre(8, 0));
  EXPECT_THAT(elout_text(snapshot), HasSubstr("  3.000E+00  4.000E+00  5.000E+00  6.000E+00  7.000E+00  8.000E+00"));
}

}  // namespace
}  // namespace kardan
