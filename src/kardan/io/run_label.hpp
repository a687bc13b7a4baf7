// What every result file says of the run it comes from.
#pragma once

#include <string>

namespace kardan {

struct RunLabel {
  std::string title;    ///< *TITLE of the deck
  std::string version;  ///< of the program, e.g. "kardan 0.1.0"
  std::string date;     ///< "MM/DD/YYYY"
};

/// `text` cut or filled with blanks to `width`.
inline std::string padded(std::string text, std::size_t width) {
  text.resize(width, ' ');
  return text;
}

}  // namespace kardan
