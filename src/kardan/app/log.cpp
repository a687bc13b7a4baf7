#include "kardan/app/log.hpp"

#include <fmt/format.h>

namespace kardan::app {

void Log::open_file(const std::filesystem::path& path, bool append) {
  file_.open(path, append ? std::ios::app : std::ios::out);
  if (!file_) throw RunError(fmt::format("cannot write {}", path.string()));
}

void Log::line(const std::string& text) {
  clear_live();
  out_ << text << '\n' << std::flush;
  if (file_.is_open()) file_ << text << '\n' << std::flush;
}

void Log::error(const std::string& text) {
  clear_live();
  err_ << text << '\n' << std::flush;
  if (file_.is_open()) file_ << text << '\n' << std::flush;
}

void Log::diagnostics(const Diagnostics& diagnostics, std::size_t first) {
  for (std::size_t i = first; i < diagnostics.all().size(); ++i) {
    const Diagnostic& d = diagnostics.all()[i];
    d.severity == Severity::error ? error(to_string(d)) : line(to_string(d));
  }
  if (diagnostics.error_count() > Diagnostics::error_limit)
    error(fmt::format("… and {} more errors", diagnostics.error_count() - Diagnostics::error_limit));
}

void Log::live(const std::string& text) {
  if (!terminal_) return;
  out_ << '\r' << text;
  if (text.size() < live_width_) out_ << std::string(live_width_ - text.size(), ' ');
  live_width_ = text.size();
  out_ << std::flush;
}

void Log::clear_live() {
  if (live_width_ == 0) return;
  out_ << '\r' << std::string(live_width_, ' ') << '\r';
  live_width_ = 0;
}

}  // namespace kardan::app
