#include "kardan/app/program.hpp"

#include <fmt/format.h>

#include <exception>
#include <ostream>

#include "kardan/app/command_line.hpp"
#include "kardan/app/log.hpp"
#include "kardan/app/run_command.hpp"
#include "kardan/app/verify/verify.hpp"
#include "kardan/io/deck/schema.hpp"

namespace kardan::app {

int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err, bool terminal) {
  const Command command = parse_command_line(arguments, out, err);
  Log log(out, err, terminal);
  try {
    switch (command.kind) {
      case Command::Kind::run:
        return run_deck(command.run, log);
      case Command::Kind::check:
        return check_deck(command.run, log);
      case Command::Kind::verify:
        return verify::run(command.verify, out, err);
      case Command::Kind::keywords:
        out << deck::keyword_table_markdown();
        return normal_termination;
      case Command::Kind::done:
        return command.exit_code;
    }
  } catch (const std::exception& error) {
    log.error(fmt::format("error: {}", error.what()));
  }
  return error_termination;
}

}  // namespace kardan::app
