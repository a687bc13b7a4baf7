// What a file holds when a write fails, and how a later run goes on with it.
#include "kardan/io/file_sink.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <string>

#include "io/writers_fixture.hpp"
#include "kardan/base/diagnostics.hpp"

namespace kardan {
namespace {

/// No file can grow beyond `bytes` while it lives: a full disk, as a program sees it.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, SIG_DFL);
  }

 private:
  rlimit before_{};
};

std::string text_of(const std::filesystem::path& path) {
  const std::vector<char> bytes = testing::bytes_of(path);
  return {bytes.begin(), bytes.end()};
}

TEST(FileSink, KeepsWhatWasFlushedWhereAWriteFails) {
  const auto path = testing::output_directory() / "file";
  FileSink file(path);
  file.write("complete");
  file.flush();
  {
    const FullDisk full(1000);
    EXPECT_THROW({
      file.write(std::string(600'000, 'x'));
      file.flush();
    }, RunError);
    EXPECT_EQ(text_of(path), "complete");
  }
  EXPECT_THROW(file.write("later"), RunError) << "what was lost would be missing before it";
  EXPECT_EQ(text_of(path), "complete");
}

TEST(FileSink, RemovesAFileThatNeverHadAnything) {
  const auto path = testing::output_directory() / "file";
  const FullDisk full(1000);
  EXPECT_THROW({
    FileSink file(path);
    file.write(std::string(600'000, 'x'));
  }, RunError);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(FileSink, WritesInTheMiddleAndGoesOnBehindAGivenSize) {
  const auto path = testing::output_directory() / "file";
  {
    FileSink file(path);
    file.write("abcdef");
    file.seek(2);
    file.write("CD");
    file.seek(file.size());
    file.write("gh");
    EXPECT_EQ(file.size(), 8);
    file.flush();
  }
  EXPECT_EQ(text_of(path), "abCDefgh");
  {
    FileSink file(path, 4);
    file.write("!");
    file.sync();
  }
  EXPECT_EQ(text_of(path), "abCD!");
  EXPECT_THROW(FileSink(path, 6), RunError);
  EXPECT_THROW(FileSink(path.string() + "x", 0), RunError);
}

}  // namespace
}  // namespace kardan
