// A small model with every kind of thing the result files show, and its state as a known function of time.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan::testing {

/// Parts: 5 beam, 7 spring, 10 rigid shells, 20 solid, 30 deformable shells (a quadrilateral and a triangle), 99 a
/// nodal rigid body. User ids are neither dense nor in the deck's order.
Model make_model();

/// Body 0 (part 10) turns about z with `spin` and moves with `velocity`; body 1 (the nodal rigid body) stands still;
/// the other nodes move with `velocity` too.
struct Motion {
  Vec3 velocity{1.0, -2.0, 0.5};
  double spin = 40.0;
};
State make_state(const Model& model);
void advance(const Model& model, State& state, double time, double dt, const Motion& motion = {});

/// A fresh, empty folder for the running test's files.
std::filesystem::path output_directory();

/// A file as bytes, or as words of one type.
inline std::vector<char> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
std::vector<T> words_of(const std::filesystem::path& path) {
  const std::vector<char> bytes = bytes_of(path);
  EXPECT_EQ(bytes.size() % sizeof(T), 0u);
  std::vector<T> words(bytes.size() / sizeof(T));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(T));
  return words;
}

/// Runs a script of tests/io/python with /usr/bin/python3; returns its exit code and what it printed.
struct ScriptResult {
  int exit_code = 0;
  std::string output;
};
ScriptResult run_script(const std::string& script, const std::string& arguments);
/// /usr/bin/python3 can import this module.
bool python_has(const std::string& module);

}  // namespace kardan::testing
