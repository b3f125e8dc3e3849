// Runs the checks of a library or of a component, each in a child process, and collects the verdicts.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "testing/kit/check.hpp"

namespace trammel::kit {

struct Request {
  std::string operand;                    // a library's file, or a component's name
  std::string component = {};             // of a library with several; "": all of them
  std::vector<std::string> plugins = {};  // further libraries and folders to look for it
  Level level = Level::quick;
  unsigned seed = 1;
  std::string only = {};                             // one check; "": all
  std::vector<std::string> with = {};                // parameters, JSON objects as in a scene
  std::map<std::string, std::string> expected = {};  // names of checks that may fail, with the reason
  int parallel = 2;
  std::chrono::milliseconds limit = std::chrono::seconds(30);  // of one check; 4 times as long at level full
  bool in_process = false;
};

// The operand names nothing, a check that does not exist, or a component that accepts none of the parameters made up
// for it.
struct NothingToCheck : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// The library cannot be loaded.
struct CannotBeLoaded : std::runtime_error {
  CannotBeLoaded(std::string f, const std::string& cause) : std::runtime_error(cause), file(std::move(f)) {}
  std::string file;
};

// A component as the survey found it, in a child process: this process never loads a library of a stranger.
struct Surveyed {
  std::string kind, name, file, interface;
};
std::vector<Surveyed> survey(const Request& request);

struct Result {
  Words words;
  Finding finding;
  double seconds = 0;
  std::string printed;   // what the check wrote to standard output
  std::string expected;  // the reason why it may fail; "": it must not
  bool counts_as_failed() const;
};

struct Verdicts {
  Surveyed component;
  std::vector<Result> results;
  int count(Verdict verdict) const;
  int asked() const { return int(results.size()) - count(Verdict::skipped); }
  int failed() const;  // of those not expected to
};

// `done` is called after each check.
Verdicts run(const Request& request, const Surveyed& component, const std::function<void(const Result&)>& done = {});

// Of one component: {"component": ..., "checks": [...], "ran": 38, "of": 41, ...}
nlohmann::ordered_json to_json(const Verdicts& verdicts);

}  // namespace trammel::kit
