// The measures of verification on histories with known answers.
#include <unistd.h>

#include "kardan/app/verify/measure.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace kardan::verify {
namespace {

Series scalar(std::initializer_list<double> values, double interval = 0.1) {
  Series s;
  for (const double v : values) s.append(static_cast<double>(s.size()) * interval, std::vector{v});
  return s;
}

Comparison with(Measure m, Scale::Kind kind = Scale::Kind::number, double number = 1) {
  Comparison c;
  c.measure = m;
  c.scale = {kind, number};
  return c;
}

TEST(Measure, ErrorsAreFoundWhereTheyAre) {
  const Series s = scalar({1, 2.5, 3}), o = scalar({1, 2, 4});
  EXPECT_DOUBLE_EQ(measure(with(Measure::max_error), s, o), 1.0);
  EXPECT_DOUBLE_EQ(measure(with(Measure::max_error, Scale::Kind::peak), s, o), 0.25);
  EXPECT_DOUBLE_EQ(measure(with(Measure::final_error), s, o), 1.0);
  EXPECT_DOUBLE_EQ(measure(with(Measure::peak_error), s, o), 1.0);
  EXPECT_DOUBLE_EQ(measure(with(Measure::largest), s, {}), 3.0);
  EXPECT_DOUBLE_EQ(measure(with(Measure::drift, Scale::Kind::number, 4), s, {}), 0.5);
  EXPECT_DOUBLE_EQ(measure(with(Measure::drift, Scale::Kind::initial), scalar({2, 3, 2}), {}), 0.5);
}

TEST(Measure, TimesOutsideTheWindowAreLeftOut) {
  Comparison c = with(Measure::max_error);
  c.from = 0.1;
  c.until = 0.2;
  EXPECT_DOUBLE_EQ(measure(c, scalar({9, 1, 2, 9}), scalar({0, 1, 4, 0})), 2.0);
}

TEST(Measure, SamplesAreMatchedByTimeNeverInterpolated) {
  // the oracle stands at every second sample and goes on after the run
  const Series s = scalar({0, 1, 2, 3, 4}, 0.05), o = scalar({0, 2, 4.5, 99}, 0.1);
  EXPECT_DOUBLE_EQ(measure(with(Measure::max_error), s, o), 0.5);
  Series between = scalar({0, 1});
  for (double& t : between.time) t += 0.013;
  EXPECT_THROW(measure(with(Measure::max_error), s, between), CaseError);
}

TEST(Measure, NotANumberNeverPasses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Measure m : {Measure::max_error, Measure::quaternion_error, Measure::largest, Measure::drift})
    EXPECT_TRUE(std::isinf(measure(with(m), scalar({1, nan, 1}), scalar({1, 1, 1}))));
  EXPECT_FALSE(measure(with(Measure::final_error), scalar({1, nan}), scalar({1, 1})) <= 1e300);
}

TEST(Measure, OppositeQuaternionsAreTheSameRotation) {
  Series s, o;
  s.width = o.width = 4;
  for (const double sign : {1.0, -1.0}) {
    s.append(static_cast<double>(s.size()), std::vector{0.6, 0.8, 0.0, 0.0});
    o.append(static_cast<double>(o.size()), std::vector{sign * 0.6, sign * 0.8, 0.0, 0.0});
  }
  EXPECT_DOUBLE_EQ(measure(with(Measure::quaternion_error), s, o), 0.0);
  EXPECT_DOUBLE_EQ(measure(with(Measure::max_error), s, o), 2.0);
}

TEST(Measure, CrossingsOfASineAreItsZeros) {
  Series s;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i + 0.003;
    s.append(t, std::vector{std::sin(t)});
  }
  const auto times = crossings(s, 0);
  ASSERT_EQ(times.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(times[i], std::numbers::pi * static_cast<double>(i + 1), 1e-6);

  Comparison c = with(Measure::crossing_error);
  c.crossings = {std::numbers::pi, 6.3};
  EXPECT_NEAR(measure(c, s, {}), 6.3 - 2 * std::numbers::pi, 1e-6);
  c.crossings.assign(4, 0.0);
  EXPECT_TRUE(std::isinf(measure(c, s, {}))) << "a crossing that never comes must not pass";
}

TEST(Measure, FrequenciesOfTwoSinesOnAnOffsetAreFound) {
  Series s;
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.02 * i, turn = 2 * std::numbers::pi;
    s.append(t, std::vector{3 + std::cos(turn * 0.7 * t) + 0.05 * std::sin(turn * 1.9 * t)});
  }
  EXPECT_NEAR(frequency(s, 0, 20, 0.72, 0.1), 0.7, 1e-4);
  EXPECT_NEAR(frequency(s, 0, 20, 1.8, 0.1), 1.9, 1e-3);
  EXPECT_TRUE(std::isnan(frequency(s, 0, 20, 0.8, 0.05))) << "no peak there: the skirt of another one";
  Comparison c = with(Measure::frequency_error);
  c.frequencies = {0.7, 1.9 / 1.01};
  EXPECT_NEAR(measure(c, s, {}), 0.01, 1e-3);
  c.frequencies = {0.8};
  c.band = 0.05;
  EXPECT_TRUE(std::isinf(measure(c, s, {})));
}

TEST(Measure, TimesOfPeaksAreCompared) {
  EXPECT_DOUBLE_EQ(measure(with(Measure::peak_time_error, Scale::Kind::number, 0.1), scalar({0, 1, -3, 2}), scalar({0, 2, 1, 0})), 1.0);
}

TEST(Measure, ContradictionsAreRefused) {
  Series two;
  two.width = 2;
  two.append(0, std::vector{1.0, 2.0});
  EXPECT_THROW(measure(with(Measure::max_error), scalar({1, 2}), two), CaseError);
  EXPECT_THROW(measure(with(Measure::max_error), scalar({1, 2}), {}), CaseError);
  EXPECT_THROW(measure(with(Measure::max_error, Scale::Kind::peak), scalar({1, 2}), scalar({0, 0})), CaseError);
  EXPECT_THROW(measure_from("nearly"), CaseError);
}

class Table : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    const auto file = std::filesystem::path(::testing::TempDir()) / ("kardan_verify_table_" + std::to_string(::getpid()) + ".csv");
    std::ofstream(file) << text;
    return file;
  }
};

TEST_F(Table, ColumnsAreFoundByName) {
  const Series s = read_table(write("t,a,b\r\n0,1,2\r\n+5.0e-1,-3,4e2\n"), {"b", "a"});
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s.time, (std::vector{0.0, 0.5}));
  EXPECT_EQ(s.values, (std::vector{2.0, 1.0, 400.0, -3.0}));
}

TEST_F(Table, FaultsAreNamed) {
  EXPECT_THROW(read_table(write("t,a\n0,1\n"), {"c"}), CaseError);
  EXPECT_THROW(read_table(write("t,a\n0,1,2\n"), {"a"}), CaseError);
  EXPECT_THROW(read_table(write("t,a\n0,x\n"), {"a"}), CaseError);
  EXPECT_THROW(read_table("/nowhere/table.csv", {"a"}), CaseError);
}

}  // namespace
}  // namespace kardan::verify
