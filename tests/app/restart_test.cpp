// A run that is broken off and goes on from a restart file ends as the unbroken one, to the last byte of its result files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/folder_test.hpp"
#include "app/restart_decks.hpp"
#include "kardan/app/checkpoints.hpp"
#include "kardan/app/program.hpp"
#include "kardan/contact/tie_search.hpp"
#include "kardan/io/deck/load.hpp"

namespace kardan::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Restart : public FolderTest {
 protected:
  int call(const std::vector<std::string>& arguments) {
    std::ostringstream o, e;
    const int code = run_program(arguments, o, e, false);
    words = o.str() + e.str();
    return code;
  }

  /// Steps of a run into folder/broken: restart files after each of `stored` steps, the end, as if killed, after `steps`.
  void break_off(const fs::path& deck, const std::vector<int>& stored, int steps) {
    RunRequest request;
    request.deck = deck;
    Diagnostics diagnostics;
    std::vector<deck::DeckFile> files;
    Model model = deck::load_model(deck, {}, diagnostics, &files);
    move_tied_nodes(model, diagnostics);
    ASSERT_TRUE(diagnostics.ok()) << to_string(diagnostics.all().front());
    Solver solver(model, {}, diagnostics);
    ResultFiles results(solver, folder / "broken");
    Checkpoints checkpoints(folder / "broken", identity_of(request, files), {}, 0);
    solver.attach(results);
    for (int step = 0; step < steps; ++step) {
      if (std::find(stored.begin(), stored.end(), step) != stored.end()) checkpoints.write(solver, results);
      ASSERT_TRUE(solver.step()) << step;
    }
  }

  std::map<std::string, std::string> results_in(const std::string& name) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder / name)) {
      const std::string file = entry.path().filename().string();
      if (file != "kardan.log" && file != "summary.json" && !file.starts_with("checkpoint-")) files[file] = text_of(entry.path());
    }
    return files;
  }
  std::string hash_of(const std::string& name) { return nlohmann::json::parse(text_of(folder / name / "summary.json"))["state_hash"]; }

  void expect_equal(const std::string& broken) {
    EXPECT_EQ(hash_of(broken), hash_of("whole"));
    const auto whole = results_in("whole"), other = results_in(broken);
    EXPECT_FALSE(whole.empty());
    for (const auto& [name, text] : whole) {
      ASSERT_TRUE(other.contains(name)) << name;
      EXPECT_TRUE(other.at(name) == text) << name;
    }
    EXPECT_EQ(whole.size(), other.size());
  }

  /// The whole run, and broken ones with their restart file after each of `moments`.
  void compare(const fs::path& deck, const std::vector<int>& moments) {
    ASSERT_EQ(call({"run", deck.string(), "-o", (folder / "whole").string()}), 0) << words;
    for (const int moment : moments) {
      fs::remove_all(folder / "broken");
      break_off(deck, {moment}, moment + moment / 7 + 3);
      ASSERT_EQ(call({"run", "--restart", (folder / "broken").string(), "-j", "3"}), 0) << words;
      SCOPED_TRACE(moment);
      expect_equal("broken");
    }
  }

  std::string words;
};

TEST_F(Restart, MechanismGoesOnToTheSameBits) { compare(KARDAN_SOURCE_DIR "/examples/slider_crank/slider_crank.k", {1, 30000}); }

TEST_F(Restart, ContactFailureAndWallGoOnToTheSameBits) { compare(write("tube.k", tube_deck(4, 12, "")), {1, 90, 400, 1000}); }

TEST_F(Restart, ScaledMassesGoOnToTheSameBits) {
  compare(write("tube.k", tube_deck(3, 6, "*CONTROL_TIMESTEP\n0,0.9,0,0,-1.2e-3\n")), {1, 120, 300});
}

TEST_F(Restart, RelaxationIsTakenUpWithinAndBehindIt) { compare(write("spring.k", relaxed_spring), {1, 77, 400, 1000, 1500}); }

TEST_F(Restart, GoesOnInAnotherFolderAndLeavesTheFirstAsItIs) {
  const fs::path deck = write("spring.k", relaxed_spring);
  ASSERT_EQ(call({"run", deck.string(), "-o", (folder / "whole").string()}), 0) << words;
  break_off(deck, {1500}, 1800);
  const auto before = results_in("broken");
  ASSERT_EQ(call({"run", "--restart", (folder / "broken").string(), "-o", (folder / "other").string()}), 0) << words;
  expect_equal("other");
  EXPECT_EQ(results_in("broken"), before);
}

TEST_F(Restart, TakesTheFileBeforeADamagedOne) {
  const fs::path deck = write("spring.k", relaxed_spring), newest = folder / "broken" / "checkpoint-000003";
  ASSERT_EQ(call({"run", deck.string(), "-o", (folder / "whole").string()}), 0) << words;
  break_off(deck, {500, 1400, 1700}, 1800);
  EXPECT_FALSE(fs::exists(folder / "broken" / "checkpoint-000001")) << "the last two are kept";
  std::string text = text_of(newest);
  text[text.size() / 2] ^= 4;
  std::ofstream(newest, std::ios::binary) << text;
  ASSERT_EQ(call({"run", "--restart", (folder / "broken").string()}), 0) << words;
  EXPECT_THAT(words, HasSubstr("checkpoint-000003: is damaged near byte"));
  EXPECT_THAT(words, HasSubstr("goes on from " + (folder / "broken" / "checkpoint-000002").string()));
  expect_equal("broken");
}

TEST_F(Restart, TakesTheFileBeforeOneWhoseResultsAreShort) {
  const fs::path deck = write("spring.k", relaxed_spring);
  break_off(deck, {1400, 1700}, 1800);
  fs::resize_file(folder / "broken" / "nodout", 10);
  EXPECT_EQ(call({"run", "--restart", (folder / "broken").string()}), 2);
  EXPECT_THAT(words, HasSubstr("checkpoint-000002 cannot be used: the result file nodout is shorter than it was then"));
  EXPECT_THAT(words, HasSubstr("no restart file in"));
}

TEST_F(Restart, RefusesAnotherDeckAndOtherOptionsByName) {
  const fs::path deck = write("spring.k", relaxed_spring);
  break_off(deck, {1500}, 1800);
  const auto before = results_in("broken");
  EXPECT_EQ(call({"run", "--restart", (folder / "broken").string(), "--dt", "1e-5"}), 2);
  EXPECT_THAT(words, HasSubstr("--dt is 1e-05 now and was not given when the run began"));
  write("spring.k", relaxed_spring + "$ a remark\n");
  EXPECT_EQ(call({"run", "--restart", (folder / "broken").string()}), 2);
  EXPECT_THAT(words, HasSubstr("spring.k is not the file that the run began with"));
  EXPECT_EQ(call({"run", "--restart", folder.string()}), 2);
  EXPECT_THAT(words, HasSubstr("holds no restart file"));
  EXPECT_EQ(results_in("broken"), before);
}

TEST_F(Restart, DeckAndCommandLineAskForRestartFiles) {
  const fs::path deck = write("dumps.k", std::string(relaxed_spring).replace(9, 0, "*DATABASE_BINARY_D3DUMP\n500\n*DATABASE_BINARY_RUNRSF\n600,1\n"));
  ASSERT_EQ(call({"run", deck.string(), "-o", (folder / "by_deck").string()}), 0) << words;
  EXPECT_TRUE(fs::exists(folder / "by_deck" / "checkpoint-000003"));
  ASSERT_EQ(call({"run", deck.string(), "-o", (folder / "by_word").string(), "--checkpoint", "cycles=400"}), 0) << words;
  EXPECT_TRUE(fs::exists(folder / "by_word" / "checkpoint-000004"));
  EXPECT_EQ(hash_of("by_deck"), hash_of("by_word"));
  EXPECT_EQ(call({"run", deck.string(), "--checkpoint", "cycles=none"}), 2);
  EXPECT_EQ(call({"run", deck.string(), "--checkpoint", "often"}), 2);
}

}  // namespace
}  // namespace kardan::app
