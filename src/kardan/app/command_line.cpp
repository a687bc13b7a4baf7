#include "kardan/app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <ostream>

#include "kardan/app/version.hpp"

namespace kardan::app {

namespace {

/// LS-DYNA's way of calling: key=value words.
bool speaks_ls_dyna(const std::vector<std::string>& arguments) {
  return !arguments.empty() && arguments[0].find('=') != std::string::npos && arguments[0][0] != '-';
}

/// Turns LS-DYNA's key=value words into a `run` with Kardan's options; notes say which words mean nothing here.
std::vector<std::string> translate_ls_dyna(const std::vector<std::string>& words, std::vector<std::string>& notes) {
  std::vector<std::string> arguments{"run"};
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    std::string key = word.substr(0, equals);
    for (char& c : key) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (key == "i") {
      arguments.push_back(value);
    } else if (key == "ncpu") {
      arguments.insert(arguments.end(), {"-j", value.starts_with('-') ? value.substr(1) : value});
    } else if (key == "endtime") {
      arguments.insert(arguments.end(), {"--end", value});
    } else if (key == "memory" || key == "memory2") {
      notes.push_back(fmt::format("{}: not needed, Kardan takes the memory it uses", word));
    } else if (equals == std::string::npos || word.starts_with('-')) {
      arguments.push_back(word);
    } else {
      throw CLI::ValidationError(word, "is not an LS-DYNA argument that Kardan takes (i=, ncpu=, endtime=, memory=)");
    }
  }
  return arguments;
}

const std::map<std::string, JointHolding> holdings{{"exact", JointHolding::exact}, {"penalty", JointHolding::penalty}};

void add_model_options(CLI::App& command, RunRequest& run, std::string& isa) {
  command.add_option("-j,--threads", run.threads, "threads; the result is the same to the last bit for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("--end", run.end_time, "end time, instead of the deck's ENDTIM")->check(CLI::PositiveNumber);
  command.add_option("--dt", run.dt, "time step: constant where nothing deforms, else an upper bound")
      ->check(CLI::PositiveNumber);
  command.add_option("--joints", run.joints, "how joints are held: exact (Lagrange multipliers) or penalty")
      ->transform(CLI::CheckedTransformer(holdings, CLI::ignore_case));
  command.add_option("--isa", isa, "instruction set: x86-64-v2, x86-64-v3, x86-64-v4 or native");
  command.add_option("--without", run.without, "leave out a family of keywords: contact (*CONTACT_…, *RIGIDWALL_…)")
      ->check(CLI::IsMember({"contact"}));
}

void settle_isa(RunRequest& run, const std::string& name) {
  if (name.empty()) return;
  run.isa = isa_from(name);
  if (!run.isa) throw CLI::ValidationError("--isa", name + " is not x86-64-v2, x86-64-v3, x86-64-v4 or native");
  if (*run.isa > native_isa())
    throw CLI::ValidationError("--isa", fmt::format("this processor has {}, not {}", to_string(native_isa()), name));
}

void settle_checkpoint(RunRequest& run, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    const auto number = [&](std::size_t from) {
      double value = 0;
      const char* const end = word.data() + word.size();
      const auto [stop, error] = std::from_chars(word.data() + from, end, value);
      if (error != std::errc{} || stop != end || !(value > 0))
        throw CLI::ValidationError("--checkpoint", word + " needs a positive number");
      return value;
    };
    if (!run.checkpoint) run.checkpoint.emplace();
    if (word.starts_with("every=")) run.checkpoint->seconds = number(6);
    else if (word.starts_with("cycles=")) run.checkpoint->cycles = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(number(7), 1e15)));
    else throw CLI::ValidationError("--checkpoint", word + " is neither every=SECONDS nor cycles=N");
  }
}

}  // namespace

Command parse_command_line(std::vector<std::string> arguments, std::ostream& out, std::ostream& err) {
  Command command;
  CLI::App program{"Kardan: explicit finite elements for crash and mechanisms. Reads LS-DYNA keyword decks, writes d3plot "
                   "and binout.", "kardan"};
  program.footer("Exit codes: 0 normal termination, 1 error termination, 2 bad input or usage.\n"
                 "LS-DYNA's way works too: kardan i=deck.k ncpu=2");
  program.require_subcommand(0, 1);
  bool version = false, markdown = false;
  std::string isa;
  std::vector<std::string> checkpoint;
  program.add_flag("--version", version, "version, commit, compiler, instruction set, MPI");

  CLI::App* run = program.add_subcommand("run", "run a deck");
  run->add_option("deck", command.run.deck, "LS-DYNA keyword deck");
  add_model_options(*run, command.run, isa);
  run->add_option("-o,--output", command.run.output, "folder of the results (default results/<deck name>)");
  run->add_option("--checkpoint", checkpoint, "restart files every so often: every=SECONDS of wall time, or cycles=N")
      ->allow_extra_args(false);
  run->add_option("--restart", command.run.restart, "go on with the run whose restart files are in this folder");
  CLI::App* check = program.add_subcommand("check", "read a deck, set the model up and report on it, without running it");
  check->add_option("deck", command.run.deck, "LS-DYNA keyword deck")->required();
  add_model_options(*check, command.run, isa);

  CLI::App* verify = program.add_subcommand("verify", "run verification cases and compare them with their oracles");
  verify->add_option("names", command.verify.names, "cases or groups (default: all quick ones)");
  verify->add_flag("--list", command.verify.list, "list cases and figures without running them");
  verify->add_flag("--json", command.verify.json, "one JSON object a figure");
  verify->add_flag("--markdown", command.verify.markdown, "tables for docs/verification.md");
  verify->add_option("--root", command.verify.root, "folder with the groups of cases");

  CLI::App* keywords = program.add_subcommand("keywords", "the keywords Kardan knows and what it does with each");
  keywords->add_flag("--markdown", markdown, "as a Markdown table")->required();

  try {
    if (speaks_ls_dyna(arguments)) arguments = translate_ls_dyna(arguments, command.run.notes);
    std::reverse(arguments.begin(), arguments.end());  // the order in which CLI11 takes a vector
    program.parse(arguments);
    settle_isa(command.run, isa);
    settle_checkpoint(command.run, checkpoint);
    if (run->parsed() && command.run.deck.empty() && command.run.restart.empty())
      throw CLI::RequiredError("deck (or --restart DIR)");
  } catch (const CLI::ParseError& error) {
    command.exit_code = program.exit(error, out, err) == 0 ? normal_termination : bad_input;
    return command;
  }
  if (version) {
    out << version_text();
  } else if (run->parsed()) {
    command.kind = Command::Kind::run;
  } else if (check->parsed()) {
    command.kind = Command::Kind::check;
  } else if (verify->parsed()) {
    command.kind = Command::Kind::verify;
  } else if (keywords->parsed()) {
    command.kind = Command::Kind::keywords;
  } else {
    err << program.help();
    command.exit_code = bad_input;
  }
  return command;
}

}  // namespace kardan::app
