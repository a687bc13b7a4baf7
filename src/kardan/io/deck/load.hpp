// One call from a file to a model.
#pragma once

#include <filesystem>

#include "kardan/io/deck/build/build.hpp"
#include "kardan/io/deck/deck.hpp"

namespace kardan::deck {

struct LoadOptions {
  ReadOptions read;
  BuildOptions build;
};

/// Reads a deck with its includes and builds the model of it; see read_deck and build_model for what goes where.
/// @param files  gets the files that were read
Model load_model(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics, std::vector<DeckFile>* files = nullptr);

}  // namespace kardan::deck
