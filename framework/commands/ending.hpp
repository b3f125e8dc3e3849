// How a computation that throws ends: with a reason in its results, and with an exception if the scene or a plugin is
// at fault.
#pragma once

#include <exception>
#include <optional>
#include <string>

#include "simulate/start/setup.hpp"

#include "model/call_site.hpp"

namespace trammel::simulate {

struct Ending {
  // rows: no motion was found, perhaps because the rows contradict each other; output: results cannot be written.
  enum class Cause { rows, output, scene, other };
  Cause cause = Cause::other;
  std::string reason;
  // To be thrown after the results are written; null: neither scene nor plugin is at fault.
  std::exception_ptr thrown;
};

// Where the computation stands.
struct RunPoint {
  double t = 0;
  long long step = 0;
  std::string words;  // "at t = 0.5 s, step 12: "
  model::CallSite call;
};

// To be called in a catch block.
Ending ending(const Setup& setup, const scene::Value& root, const RunPoint& at);

}  // namespace trammel::simulate
