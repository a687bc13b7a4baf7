// A deck is run and sampled as case.json says.
#include <unistd.h>

#include "kardan/app/verify/runner.hpp"

#include <fstream>

#include <gtest/gtest.h>

namespace kardan::verify {
namespace {

class Runner : public ::testing::Test {
 protected:
  Runner() {
    run_.name = "free";
    run_.deck = std::filesystem::path(KARDAN_SOURCE_DIR) / "verification/mechanisms/law_part_inertia/part_inertia.k";
    run_.sample = 0.02;
    run_.steps = 8;
    run_.end = 0.1;
  }
  verify::Run run_;
};

TEST_F(Runner, SamplesStandAtTheirTimes) {
  const auto series = record(run_, {nlohmann::json::parse(R"({"body": 1, "quantity": "center", "components": [0]})")});
  ASSERT_EQ(series.size(), 1u);
  ASSERT_EQ(series[0].size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const double t = 0.02 * static_cast<double>(i);
    EXPECT_DOUBLE_EQ(series[0].time[i], t);
    EXPECT_NEAR(series[0].values[i], 0.3 + t * t, 1e-13) << "constant force: leapfrog is exact";
  }
}

TEST_F(Runner, SamplesOfTheDecksOwnStepAreInterpolated) {
  run_.deck = std::filesystem::path(KARDAN_SOURCE_DIR) / "verification/deformable/bar_wall/bar_200.k";
  run_.sample = 1e-7;
  run_.steps = 0;
  run_.end = 2e-6;
  const auto own = record(run_, {nlohmann::json::parse(R"({"node": 801, "quantity": "displacement", "components": [0]})")});
  ASSERT_EQ(own[0].size(), 21u);
  for (std::size_t i = 0; i < 21; ++i) {
    EXPECT_DOUBLE_EQ(own[0].time[i], 1e-7 * static_cast<double>(i));
    EXPECT_NEAR(own[0].values[i], -10 * own[0].time[i], 1e-15) << "the free end has not heard of the wall";
  }
}

TEST_F(Runner, WhatCannotBeRunIsSaid) {
  run_.deck = "/nowhere/deck.k";
  EXPECT_THROW(record(run_, {}), CaseError);
}

TEST_F(Runner, UnknownBodiesAreRefused) {
  EXPECT_THROW(record(run_, {nlohmann::json::parse(R"({"body": 99, "quantity": "center"})")}), CaseError);
}

TEST_F(Runner, ARunThatEndsEarlyIsRefused) {
  const auto file = std::filesystem::path(::testing::TempDir()) / ("kardan_verify_endcyc_" + std::to_string(::getpid()) + ".k");
  {
    std::ifstream in(run_.deck);
    std::ofstream out(file);
    for (std::string line; std::getline(in, line);) {
      out << line << '\n';
      if (line == "*CONTROL_TERMINATION") {
        std::getline(in, line);
        out << "1,5\n";  // ENDCYC
      }
    }
  }
  run_.deck = file;
  EXPECT_THROW(record(run_, {nlohmann::json::parse(R"({"energy": "total"})")}), CaseError);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace kardan::verify
