// Every deck of the corpus: a model, or messages that say precisely why not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <variant>

#include "kardan/io/deck/load.hpp"
#include "kardan/io/report/model_report.hpp"

namespace kardan::deck {
namespace {

const std::filesystem::path corpus = std::filesystem::path(KARDAN_SHARED_DIR) / "corpus";

#define NEEDS_CORPUS() \
  if (!std::filesystem::exists(corpus)) GTEST_SKIP() << "skipped: corpus not present"

std::string messages(const Diagnostics& diagnostics, Severity least = Severity::error) {
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity >= least) text += to_string(d) + "\n";
  }
  return text;
}

TEST(Corpus, EveryDeckGivesAModelOrMessages) {
  NEEDS_CORPUS();
  std::vector<std::filesystem::path> decks;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".k" || extension == ".key") decks.push_back(entry.path());
  }
  std::sort(decks.begin(), decks.end());
  ASSERT_GT(decks.size(), 30u);
  LoadOptions options;
  options.read.without = {"contact"};
  for (const auto& deck : decks) {
    Diagnostics diagnostics;
    const Model model = load_model(deck, options, diagnostics);
    std::cout << std::filesystem::relative(deck, corpus).string() << ": " << diagnostics.error_count() << " errors, "
              << model.unsupported.size() << " unsupported; " << model.nodes.size() << " nodes, "
              << model.shells.size() + model.solids.size() + model.beams.size() + model.discretes.size()
              << " elements, " << model.parts.size() << " parts\n";
    if (std::getenv("KARDAN_SHOW_MESSAGES") != nullptr) {
      std::cout << messages(diagnostics, Severity::warning);
      for (const Diagnostic& d : model.unsupported) std::cout << "  UNSUPPORTED " << to_string(d) << "\n";
    }
    EXPECT_FALSE(model_report(model).empty());
    for (const Diagnostic& d : diagnostics.all()) {
      EXPECT_FALSE(d.message.empty());
      EXPECT_TRUE(d.severity != Severity::error || !d.where.file.empty()) << to_string(d);
    }
  }
}

Model load(const std::string& deck, Diagnostics& diagnostics) {
  LoadOptions options;
  options.read.without = {"contact"};
  return load_model(corpus / deck, options, diagnostics);
}

TEST(Corpus, RevoluteJointDeck) {
  NEEDS_CORPUS();
  Diagnostics diagnostics;
  const Model m = load("dynakw/joint_revolute.k", diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << messages(diagnostics);
  EXPECT_TRUE(m.unsupported.empty());
  EXPECT_EQ(m.nodes.size(), 10u);
  EXPECT_EQ(m.shells.size(), 3u);
  EXPECT_EQ(m.nodes.constrained[4], dof_all);
  EXPECT_EQ(m.sections[0].shell.elform, 2);
  EXPECT_EQ(m.sections[0].shell.thickness[3], 0.1);
  ASSERT_EQ(m.joints.size(), 1u);
  EXPECT_EQ(m.joints[0].kind, JointKind::revolute);
  EXPECT_EQ(m.nodes.id[static_cast<std::size_t>(m.joints[0].nodes[1])], 9);
  ASSERT_EQ(m.joint_stiffnesses.size(), 1u);
  EXPECT_EQ(m.joint_stiffnesses[0].coordinate[0].elastic, 191);
  EXPECT_EQ(m.joint_stiffnesses[0].coordinate[0].friction, 80);
  ASSERT_EQ(m.point_loads.size(), 1u);
  EXPECT_EQ(m.point_loads[0].dof, 5);
  EXPECT_EQ(m.curves[static_cast<std::size_t>(m.point_loads[0].curve)].value(0.005), 50.0);
  EXPECT_EQ(m.control.time_step.scale, 0.8);
  EXPECT_EQ(m.output.requests.at(OutputFile::jntforc).dt, 5e-4);
}

TEST(Corpus, TranslationalJointDeck) {
  NEEDS_CORPUS();
  Diagnostics diagnostics;
  const Model m = load("dynakw/joint_translational.k", diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << messages(diagnostics);
  EXPECT_EQ(m.nodes.size(), 14u);
  ASSERT_EQ(m.joints.size(), 1u);
  EXPECT_EQ(m.joints[0].kind, JointKind::translational);
  EXPECT_EQ(m.nodes.id[static_cast<std::size_t>(m.joints[0].nodes[5])], 103);
  EXPECT_EQ(m.extra_nodes.size(), 3u);
  ASSERT_EQ(m.initial_velocities.size(), 2u);
  EXPECT_EQ(m.initial_velocities[1].velocity, (Vec3{90, 0, 300}));
}

TEST(Corpus, BeltedDummy) {
  NEEDS_CORPUS();
  Diagnostics diagnostics;
  const Model m = load("belted_dummy/belted_dummy_main.k", diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << messages(diagnostics);
  EXPECT_TRUE(m.unsupported.empty());
  EXPECT_EQ(m.nodes.size(), 2043u);
  EXPECT_EQ(m.joints.size(), 14u);
  for (const Joint& joint : m.joints) EXPECT_EQ(joint.kind, JointKind::spherical);
  EXPECT_EQ(m.discretes.size(), 108u);
  EXPECT_EQ(m.sd_orientations.size(), 42u);
  EXPECT_EQ(m.extra_nodes.size(), 15u);
  double mass = 0;
  std::size_t given = 0;
  for (const Part& part : m.parts) {
    if (!part.inertia) continue;
    ++given;
    mass += part.inertia->mass;
    EXPECT_EQ(part.inertia->velocity, (Vec3{14.8, 0, 0}));
  }
  EXPECT_EQ(given, 15u);
  EXPECT_NEAR(mass, 71.5, 4.0);  // a man
  EXPECT_EQ(m.parts[0].inertia->inertia[0].z, 1.424e-4);
  for (std::size_t e = 0; e < m.discretes.size(); ++e) {
    EXPECT_EQ(m.discretes.scale[e], 1.0);
    EXPECT_NE(m.discretes.orientation[e], none);
    const Part& part = m.parts[static_cast<std::size_t>(m.discretes.part[e])];
    EXPECT_EQ(m.sections[static_cast<std::size_t>(part.section)].discrete.dro, 1);
    EXPECT_TRUE(std::holds_alternative<SpringMaterial>(m.materials[static_cast<std::size_t>(part.material)].law));
  }
}

}  // namespace
}  // namespace kardan::deck
