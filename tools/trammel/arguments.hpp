// The command line: commands, their options, and the user's arguments.
//
//     trammel COMMAND [OPERAND]... [--option VALUE | --option=VALUE | --flag]...
#pragma once

#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace trammel::tool {

// Process exit codes, a contract with scripts.
// requeue: ended by a batch system's SIGTERM, to be started again (EX_TEMPFAIL of sysexits.h).
enum Exit { done = 0, failed = 1, bad_input = 2, bad_plugin = 3, requeue = 75, interrupted = 130 };

// The command line itself is wrong. Exit code 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Option {
  std::string_view name;   // "--out"
  std::string_view value;  // name of the value in the help, "DIR"; empty: a flag
  std::string_view help;
};

class Arguments;

struct Command {
  std::string_view name;
  std::string_view operand;  // "SCENE"; "DIR...": one or more; empty: takes none
  std::string_view summary;
  std::vector<Option> options;
  Exit (*run)(const Arguments&);
  std::size_t most_operands = 1;

  std::string help() const;
};

class Arguments {
 public:
  // Throws UsageError naming what was found and the nearest option.
  Arguments(const Command& command, std::span<const std::string> words, std::string program);

  const std::string& program() const { return program_; }           // as it was called
  std::vector<std::string> command_line() const;                    // all words
  const std::string& operand() const { return operands_.front(); }  // of a command that has one
  const std::vector<std::string>& operands() const { return operands_; }
  bool has(std::string_view option) const { return values_.contains(option); }
  const std::string& last(std::string_view option) const;       // of an option that was given
  std::vector<std::string> all(std::string_view option) const;  // in the order given

 private:
  std::string program_;
  std::vector<std::string> operands_;
  std::vector<std::string> words_;  // from the command's name on
  std::map<std::string, std::vector<std::string>, std::less<>> values_;
};

// A word as a POSIX shell reads it: quoted if it contains more than letters, digits and harmless signs.
std::string shell_quoted(const std::string& word);

// Options that several commands share.
inline constexpr Option kSet{"--set", "PATH=VALUE",
                             "change a value of the scene, e.g. contacts.tip.restitution=0.3 (repeatable)"};
inline constexpr Option kPlugin{"--plugin", "LIB", "a plugin library, or a folder of them (repeatable)"};
inline constexpr Option kAllowScenePlugins{
    "--allow-scene-plugins", "", "load the libraries that the scene names under \"plugins\": their code runs"};
inline constexpr Option kJobs{"--jobs", "N", "processes; default: one for each core that this process may use"};
inline constexpr Option kVerifyTarget{"--target", "X",
                                      "of --verify: the error wanted, in parts of what an observable changes"};
inline constexpr Option kJson{"--json", "", "print one JSON object on standard output and nothing else"};

// One function per file of the same name; others are in analyses/commands.hpp.
Command run_command();
Command report_command();
Command validate_command();
Command list_command();
Command describe_command();
Command schema_command();
Command seal_command();
Command new_command();

}  // namespace trammel::tool
