// Orders to the real program: signals, and switches in a file.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "app/folder_test.hpp"

namespace kardan::app {
namespace {

namespace fs = std::filesystem;

/// A run that would take hours.
const std::string endless = R"(*KEYWORD
*CONTROL_TERMINATION
1e6
*CONTROL_TIMESTEP
1e-6
*DATABASE_GLSTAT
1e3
*DATABASE_BINARY_D3PLOT
1e5
)" + rigid_cube + R"(*INITIAL_VELOCITY_RIGID_BODY
1,1.0
*END
)";

/// The real program on the endless deck, in a folder of its own.
class Interrupt : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write("endless.k", endless);
  }

  /// Starts it; it runs when this returns.
  void start(bool again = false) {
    const std::string program = KARDAN_BINARY_DIR "/bin/kardan", deck = (folder / "endless.k").string(), results = (folder / "out").string();
    child = fork();
    if (child == 0) {
      if (again) execl(program.c_str(), "kardan", "run", "--restart", results.c_str(), static_cast<char*>(nullptr));
      execl(program.c_str(), "kardan", "run", deck.c_str(), "-o", results.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    // The first progress line stands in the log when the loop runs.
    EXPECT_TRUE(log_has(again ? "goes on from" : "cycle 0"));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  std::string text_of(const std::string& name) const {
    std::ifstream file(folder / "out" / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Waits until the log has the words.
  bool log_has(const std::string& words) const {
    for (int i = 0; i < 300; ++i) {
      if (text_of("kardan.log").find(words) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  /// Waits for its end, which must be an interrupted one with all results; returns its summary.
  nlohmann::json end() const {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    const nlohmann::json summary = nlohmann::json::parse(text_of("summary.json"));
    EXPECT_EQ(summary["termination"]["reason"], "interrupted");
    EXPECT_GT(summary["cycles"].get<long>(), 0);
    EXPECT_LT(summary["time"].get<double>(), 1e6);
    EXPECT_NE(text_of("glstat").find(std::to_string(summary["cycles"].get<long>())), std::string::npos) << "the last cycle stands in glstat";
    return summary;
  }
  void order(const std::string& words) const { std::ofstream(folder / "out" / "d3kil") << words; }

  pid_t child = 0;
};

TEST_F(Interrupt, EndsTheRunWithItsResultsAndARestartFile) {
  start();
  kill(child, SIGTERM);
  const nlohmann::json first = end();
  EXPECT_TRUE(fs::exists(folder / "out" / "checkpoint-000001"));
  start(true);
  kill(child, SIGINT);
  const nlohmann::json second = end();
  EXPECT_GT(second["cycles"].get<long>(), first["cycles"].get<long>());
  EXPECT_TRUE(fs::exists(folder / "out" / "checkpoint-000002"));
  EXPECT_EQ(text_of("glstat").find(std::to_string(first["cycles"].get<long>()) + "\n"), std::string::npos)
      << "the state of the first end was not due and is gone";
}

TEST_F(Interrupt, StatusRestartFileAndStateOnOrder) {
  start();
  kill(child, SIGUSR1);
  order("sw2.\n");
  order("sw3\n");
  EXPECT_TRUE(log_has("restart file checkpoint-000001"));
  const auto size = fs::file_size(folder / "out" / "d3plot01");
  order("SW4 swa");
  for (int i = 0; i < 100 && fs::file_size(folder / "out" / "d3plot01") == size; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GT(fs::file_size(folder / "out" / "d3plot01"), size);
  order("halt");
  EXPECT_TRUE(log_has("\"halt\" is none of sw1"));
  order("stop");
  end();
  EXPECT_FALSE(fs::exists(folder / "out" / "d3kil"));
  EXPECT_FALSE(fs::exists(folder / "out" / "checkpoint-000002"));
}

}  // namespace
}  // namespace kardan::app
