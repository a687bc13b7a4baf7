// Messages to the user: collected while a deck is read and a model is assembled, shown together.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace kardan {

enum class Severity { notice, warning, error };

/// Where in the deck a message comes from; an empty file means "the model as a whole".
struct SourceLocation {
  std::string file;
  int line = 0;    ///< 1-based; 0 = not known
  int column = 0;  ///< 1-based; 0 = the whole line
};

/// One message: what is wrong, where, and what cures it.
struct Diagnostic {
  Severity severity = Severity::error;
  SourceLocation where;
  std::string keyword;  ///< e.g. "*CONSTRAINED_JOINT_REVOLUTE"; may be empty
  std::string field;    ///< e.g. "N3"; may be empty
  std::string message;  ///< what was found and what was expected
  std::string cure;     ///< what to do; may be empty
};

/// "file:line:column: error: *KEYWORD, field N3: message" and, on a second line, the cure.
std::string to_string(const Diagnostic& diagnostic);

/// Collects messages; errors beyond `error_limit` are counted, not kept.
class Diagnostics {
 public:
  static constexpr std::size_t error_limit = 50;

  void add(Diagnostic diagnostic);
  void error(std::string message, std::string cure = {}, std::string keyword = {}, SourceLocation where = {});
  void warning(std::string message, std::string cure = {}, std::string keyword = {}, SourceLocation where = {});
  void notice(std::string message, std::string keyword = {}, SourceLocation where = {});

  const std::vector<Diagnostic>& all() const { return entries_; }
  std::size_t error_count() const { return errors_; }
  std::size_t warning_count() const { return warnings_; }
  bool ok() const { return errors_ == 0; }

 private:
  std::vector<Diagnostic> entries_;
  std::size_t errors_ = 0, warnings_ = 0;
};

/// The deck cannot be run (exit code 2); the collected messages say why.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Diagnostics diagnostics);
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Diagnostics diagnostics_;
};

/// A run broke (exit code 1): what() names ids and positions of the culprit.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kardan

/// An internal contradiction: a fault of Kardan, never of the user. Always on; costs nothing where it stands.
#define KARDAN_ASSERT(condition) ((condition) ? void(0) : ::kardan::assertion_failed(#condition, __FILE__, __LINE__))

namespace kardan {
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);
}
