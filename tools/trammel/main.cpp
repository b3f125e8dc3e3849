// trammel: the command-line program. Finds the command, and turns every failure into one exit code and one
// message.
//
// Exit codes: 0 done, 1 the run failed (results kept), 2 bad input, 3 bad plugin, 75 ended by a batch system (to be
// started again), 130 interrupted (resumable).
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analyses.hpp"
#include "arguments.hpp"
#include "crash.hpp"
#include "input.hpp"
#include "last_words.hpp"
#include "manual.hpp"
#include "no_memory.hpp"
#include "scene/suggestion.hpp"
#include "simulate/results/results_folder.hpp"
#include "version.hpp"

namespace trammel::tool {

namespace {

// Those that need no library beside the program.
const std::vector<Command>& own_commands() {
  static const std::vector<Command> own = {run_command(),      validate_command(), report_command(), list_command(),
                                           describe_command(), schema_command(),   new_command(),    seal_command()};
  return own;
}

std::vector<Command> all_commands() {
  std::vector<Command> all = own_commands();
  all.insert(all.end(), analyses().commands.begin(), analyses().commands.end());
  return all;
}

void print_help(const std::vector<Command>& commands) {
  for (const Command& command : commands)
    fmt::print("  trammel {:<20} {}\n", fmt::format("{} {}", command.name, command.operand), command.summary);
}

void print_help() {
  fmt::print("Trammel simulates flexible multibody systems with contact.\n\n");
  print_help(own_commands());
  try {
    print_help(analyses().commands);
  } catch (const AnalysesMissing& missing) {
    fmt::print("\n{}\n", missing.what());
  }
  fmt::print("\n'trammel COMMAND --help' shows a command's options.\n");
}

const Command& find_command(const std::string& name) {
  const bool is_analysis = std::ranges::find(kAnalyses, name) != kAnalyses.end();
  const std::vector<Command>& commands = is_analysis ? analyses().commands : own_commands();
  const auto found = std::ranges::find(commands, name, &Command::name);
  if (found != commands.end()) return *found;
  std::vector<std::string> names(kAnalyses.begin(), kAnalyses.end());
  for (const Command& command : own_commands()) names.emplace_back(command.name);
  throw UsageError(fmt::format("there is no command '{}'{}", name, scene::did_you_mean(name, names)));
}

Exit dispatch(const std::string& program, std::span<const std::string> words) {
  if (words.empty() || words[0] == "help" || words[0] == "--help" || words[0] == "-h") {
    if (words.size() > 1)
      fmt::print("{}", find_command(words[1]).help());
    else
      print_help();
    return words.empty() ? Exit::bad_input : Exit::done;
  }
  if (words[0] == "--version") {
    if (words.size() > 2 || (words.size() == 2 && words[1] != kJson.name))
      throw UsageError(fmt::format("'trammel --version' takes --json only, found '{}'", words.back()));
    print_version(words.size() == 2);
    return Exit::done;
  }
  if (words.size() == 1 && (words[0] == "manual" || words[0] == "completion")) {  // for an installation
    fmt::print("{}", words[0] == "manual" ? manual_page(all_commands()) : bash_completion(all_commands()));
    return Exit::done;
  }
  const Command& command = find_command(words[0]);
  const auto rest = words.subspan(1);
  for (const std::string& word : rest) {
    if (word == "--") break;
    if (word == "--help" || word == "-h") {
      fmt::print("{}", command.help());
      return Exit::done;
    }
  }
  return command.run(Arguments(command, rest, program));
}

// One problem without a place in a file.
std::vector<scene::Problem> problem(const std::exception& error) {
  return {{{}, "", error.what()}};
}

void report(const std::vector<scene::Problem>& problems, const char* text, bool json) {
  if (!json) {
    std::fprintf(stderr, "%s\n", text);
    return;
  }
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const scene::Problem& p : problems)
    all.push_back(
        {{"file", p.at.file}, {"line", p.at.line}, {"column", p.at.column}, {"path", p.path}, {"message", p.message}});
  print_json({{"status", "error"}, {"problems", all}});
}

// Opens closed standard descriptors on /dev/null. Otherwise a file opened later would get such a number, and messages
// would be written into the results.
void open_standard_descriptors() {
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(standard, F_GETFD) < 0 && errno == EBADF && ::open("/dev/null", O_RDWR) < 0) return;
}

int run_program(const std::string& program, std::span<const std::string> words) {
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  const auto fail = [&](Exit code, const std::vector<scene::Problem>& problems, const std::string& text) {
    report(problems, text.c_str(), json);
    return code;
  };
  try {
    return dispatch(program, words);
  } catch (const scene::SceneError& error) {
    return fail(Exit::bad_input, error.problems(), error.what());
  } catch (const UsageError& error) {
    return fail(Exit::bad_input, problem(error), fmt::format("trammel: {}", error.what()));
  } catch (const plugin::UnknownComponent& error) {
    return fail(Exit::bad_input, problem(error), fmt::format("trammel: {}", error.what()));
  } catch (const simulate::FolderRefused& error) {
    return fail(Exit::bad_input, problem(error), fmt::format("trammel: {}", error.what()));
  } catch (const plugin::PluginError& error) {
    return fail(Exit::bad_plugin, problem(error), fmt::format("trammel: {}", error.what()));
  } catch (const std::bad_alloc& error) {
    end_without_memory(error);
  } catch (const std::exception& error) {
    return fail(Exit::failed, problem(error), fmt::format("trammel: {}", error.what()));
  } catch (...) {
    const std::runtime_error error("something unexpected went wrong: an exception that is no std::exception");
    return fail(Exit::failed, problem(error), fmt::format("trammel: {}", error.what()));
  }
}

}  // namespace

}  // namespace trammel::tool

int main(int argc, char** argv) {
  using namespace trammel::tool;
  open_standard_descriptors();
  if (std::any_of(argv, argv + argc, [](const char* word) { return std::strcmp(word, "--json") == 0; })) {
    keep_output_for_json();
    speak_json();
  }
  watch_for_lack_of_memory();
  watch_for_crashes(argv);
  // A file that reaches its size limit then gives a write error, with results kept, and does not end the process.
  std::signal(SIGXFSZ, SIG_IGN);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  int code = run_program(argc > 0 ? argv[0] : "trammel", words);
  ends_by_itself();
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    std::fputs("trammel: could not write to standard output\n", stderr);
    code = code == 0 ? 1 : code;
  }
#if defined(__SANITIZE_ADDRESS__)
  return code;  // the sanitizer checks for leaks
#else
  leave(code);  // a plugin's globals are never destroyed: their destructors cannot spoil the results
#endif
}
