// An error of a plugin: library, component, call, time and cause. Exit code 3.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

namespace trammel::plugin {

// The origin of a component, for messages.
struct Origin {
  std::string file;       // the shared library
  std::string component;  // kind and name: "body rigid_body"
  std::string path;       // path of its object in the scene: "bodies.rod"
};

class PluginError : public std::runtime_error {
 public:
  // Error of the library: not found, truncated, of another build, ...
  PluginError(std::string file, std::string cause);
  // Error in a call into one of its components; without t for calls outside the run.
  PluginError(Origin origin, std::string call, std::string cause, std::optional<double> t = {});

  // The same error with the number of the step, which the Simulator adds.
  PluginError in_step(long long step) const;

  const Origin& origin() const { return origin_; }
  const std::string& call() const { return call_; }
  const std::string& cause() const { return cause_; }
  std::optional<double> t() const { return t_; }
  std::optional<long long> step() const { return step_; }

 private:
  PluginError(Origin origin, std::string call, std::string cause, std::optional<double> t,
              std::optional<long long> step);

  Origin origin_;
  std::string call_, cause_;
  std::optional<double> t_;
  std::optional<long long> step_;
};

}  // namespace trammel::plugin
