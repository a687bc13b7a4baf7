// What the tests of the whole program share: a folder of their own, and a rigid cube.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace kardan::app {

/// A folder of its own for each test.
class FolderTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() /
             (std::string("kardan_") + test->test_suite_name() + "_" + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  nlohmann::json summary(const std::string& results) {
    std::ifstream file(folder / results / "summary.json");
    return nlohmann::json::parse(file);
  }

  std::filesystem::path folder;
};

/// A rigid cube of 2 x 2 x 2, density 1.25 (mass 10): part 1 and what it is made of.
inline const std::string rigid_cube = R"(*PART
cube
1,1,1
*SECTION_SOLID
1,1
*MAT_RIGID
1,1.25,2.1e5,0.3
0
0
*NODE
1,0,0,0
2,2,0,0
3,2,2,0
4,0,2,0
5,0,0,2
6,2,0,2
7,2,2,2
8,0,2,2
*ELEMENT_SOLID
1,1,1,2,3,4,5,6,7,8
)";

}  // namespace kardan::app
