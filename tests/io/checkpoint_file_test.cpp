// Restart files: what is written comes back, and damage is noticed.
#include "kardan/io/checkpoint/checkpoint_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/writers_fixture.hpp"
#include "kardan/base/diagnostics.hpp"

namespace kardan {
namespace {

using ::testing::HasSubstr;

struct Arrays {
  std::vector<double> fixed{1.5, -0.0, 3e300};
  std::vector<std::int32_t> list{7, 8, 9, 10};
  std::vector<double> none;
  bool flag = true;
  Registry registry;
  int restored = 0;

  Arrays() {
    registry.add({"fixed", "length", "test"}, fixed);
    registry.keep_list({"list", "1", "test"}, list);
    registry.add({"none", "1", "test"}, none);
    registry.keep_value({"flag", "1", "test"}, flag);
    registry.after_restore([this] { ++restored; });
  }
};

std::string fault_of(const std::filesystem::path& path, const Registry& registry) {
  try {
    CheckpointFile(path).restore(registry);
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

TEST(CheckpointFile, GivesBackWhatWasWritten) {
  const auto path = testing::output_directory() / "file";
  Arrays a, b;
  b.fixed = {0, 0, 0};
  b.list = {};
  b.flag = false;
  write_checkpoint(path, {{"name", "x"}}, a.registry);
  const CheckpointFile file(path);
  EXPECT_EQ(file.head()["name"], "x");
  file.restore(b.registry);
  EXPECT_EQ(b.fixed, a.fixed);
  EXPECT_TRUE(std::signbit(b.fixed[1]));
  EXPECT_EQ(b.list, a.list);
  EXPECT_TRUE(b.flag);
  EXPECT_EQ(b.restored, 1);
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".tmp"));
}

TEST(CheckpointFile, NoticesEveryChangedByteAndEveryLostTail) {
  const auto path = testing::output_directory() / "file";
  Arrays arrays;
  write_checkpoint(path, {{"name", "x"}}, arrays.registry);
  const std::vector<char> bytes = testing::bytes_of(path);
  const auto write = [&](const std::vector<char>& changed) {
    std::ofstream(path, std::ios::binary).write(changed.data(), static_cast<std::streamsize>(changed.size()));
  };
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i >= 12 && i < 16) continue;  // means nothing
    std::vector<char> changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    write(changed);
    EXPECT_NE(fault_of(path, arrays.registry), "") << "byte " << i;
    write({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(i)});
    EXPECT_NE(fault_of(path, arrays.registry), "") << "cut at " << i;
  }
  write(bytes);
  EXPECT_EQ(fault_of(path, arrays.registry), "");
}

TEST(CheckpointFile, NamesAnArrayThatDoesNotFitAndChangesNothing) {
  const auto path = testing::output_directory() / "file";
  Arrays a, b;
  write_checkpoint(path, {}, a.registry);
  b.fixed = {4, 5};
  b.flag = false;
  EXPECT_THAT(fault_of(path, b.registry), HasSubstr("holds 3 items of 8 bytes of \"fixed\", the run has 2"));
  EXPECT_FALSE(b.flag);
  EXPECT_EQ(b.restored, 0);
  double more = 0;
  a.registry.add_value({"more", "1", "test"}, more);
  EXPECT_THAT(fault_of(path, a.registry), HasSubstr("holds 4 arrays, the run has 5"));
}

TEST(CheckpointFile, LeavesTheOldOneWhereTheNewOneCannotBeWritten) {
  const auto folder = testing::output_directory();
  Arrays arrays;
  write_checkpoint(folder / "file", {{"name", "old"}}, arrays.registry);
  std::filesystem::create_directory(folder / "file.tmp");  // stands where the new one would
  EXPECT_THROW(write_checkpoint(folder / "file", {{"name", "new"}}, arrays.registry), RunError);
  EXPECT_EQ(CheckpointFile(folder / "file").head()["name"], "old");
}

}  // namespace
}  // namespace kardan
