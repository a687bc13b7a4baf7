// A deck in a string, built.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "kardan/io/deck/build/build.hpp"

namespace kardan::deck {

struct Built {
  explicit Built(const std::string& text, BuildOptions options = {}) {
    Deck deck =
        read_deck_text("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n" + text + "\n*END\n", "deck.k", ".", {}, diagnostics);
    model = build_model(deck, options, diagnostics);
  }
  std::string messages() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += to_string(d) + "\n";
    for (const Diagnostic& d : model.unsupported) all += "unsupported: " + to_string(d) + "\n";
    return all;
  }
  /// A message of this severity whose text holds `part`.
  const Diagnostic* find(Severity severity, const std::string& part) const {
    for (const Diagnostic& d : diagnostics.all()) {
      if (d.severity == severity && to_string(d).find(part) != std::string::npos) return &d;
    }
    return nullptr;
  }
  const Diagnostic* error(const std::string& part) const { return find(Severity::error, part); }
  const Diagnostic* warning(const std::string& part) const { return find(Severity::warning, part); }
  const Diagnostic* unsupported(const std::string& part) const {
    for (const Diagnostic& d : model.unsupported) {
      if (to_string(d).find(part) != std::string::npos) return &d;
    }
    return nullptr;
  }

  Diagnostics diagnostics;
  Model model;
};

/// Two rigid blocks, parts 1 and 2, of one hexahedron each on the nodes 1-8 and 11-18; 21 to 26 lie free.
inline const std::string two_blocks = R"(*NODE
1,0,0,0
2,1,0,0
3,1,1,0
4,0,1,0
5,0,0,1
6,1,0,1
7,1,1,1
8,0,1,1
11,0,0,1
12,1,0,1
13,1,1,1
14,0,1,1
15,0,0,2
16,1,0,2
17,1,1,2
18,0,1,2
21,2,0,0
22,3,0,0
23,2,1,0
24,2,0,0
25,2,0,4
26,2,5,0
*PART
lower
1,1,1
*PART
upper
2,1,1
*SECTION_SOLID
1,1
*MAT_RIGID
1,2.0,200.,0.3
0
0
*ELEMENT_SOLID
1,1,1,2,3,4,5,6,7,8
2,2,11,12,13,14,15,16,17,18
)";

}  // namespace kardan::deck
