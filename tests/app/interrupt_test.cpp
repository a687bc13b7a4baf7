// Ctrl-C on the real program.
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

namespace kardan::app {
namespace {

namespace fs = std::filesystem;

/// A run that would take hours.
constexpr const char* endless = R"(*KEYWORD
*CONTROL_TERMINATION
1e6
*CONTROL_TIMESTEP
1e-6
*DATABASE_GLSTAT
1e3
*DATABASE_BINARY_D3PLOT
1e5
*PART
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
*INITIAL_VELOCITY_RIGID_BODY
1,1.0
*END
)";

TEST(Interrupt, EndsTheRunWithItsResultsWritten) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const fs::path folder = fs::temp_directory_path() / ("kardan_interrupt_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    std::ofstream(folder / "endless.k") << endless;
    const std::string program = KARDAN_BINARY_DIR "/bin/kardan", deck = (folder / "endless.k").string(),
                      results = (folder / "out").string();
    const pid_t child = fork();
    if (child == 0) {
      execl(program.c_str(), "kardan", "run", deck.c_str(), "-o", results.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    // The first progress line stands in the log when the loop runs.
    for (int i = 0; i < 300; ++i) {
      std::ifstream log(folder / "out" / "kardan.log");
      const std::string text(std::istreambuf_iterator<char>(log), {});
      if (text.find("cycle 0") != std::string::npos) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);

    std::ifstream file(folder / "out" / "summary.json");
    const nlohmann::json summary = nlohmann::json::parse(file);
    EXPECT_EQ(summary["termination"]["reason"], "interrupted");
    EXPECT_GT(summary["cycles"].get<long>(), 0);
    EXPECT_LT(summary["time"].get<double>(), 1e6);
    std::ifstream glstat(folder / "out" / "glstat");
    const std::string text(std::istreambuf_iterator<char>(glstat), {});
    EXPECT_NE(text.find(std::to_string(summary["cycles"].get<long>())), std::string::npos)
        << "the last cycle stands in glstat";
    fs::remove_all(folder);
  }
}

}  // namespace
}  // namespace kardan::app
