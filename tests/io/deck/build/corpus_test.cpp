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

}  // namespace
}  // namespace kardan::deck
