// What the model itself costs and is worth: each fidelity parameter one rung up and some rungs down its ladder,
// components by their alternatives (trammel/fidelity.hpp), friction and corrections left out, all with the integrator
// that was chosen.
//
// The difference to the scene's own model is the error of the cheaper model; that to a finer one estimates the
// truncation of the scene's own.
#pragma once

#include <string>
#include <vector>

#include "study/trade/errors.hpp"
#include "study/trade/runner.hpp"

namespace trammel::study {

struct Rung {
  std::string what;  // "bodies.beam.modes.axial = 3", "without friction of contacts.tip"
  scene::Override change;
  bool finer = false;
  bool parameter = true;  // false: a part of the scene is left out
};

// One of two dotted paths is part of the other: both cannot be changed together.
bool overlap(const std::string& a, const std::string& b);

std::vector<Rung> ladders(const SceneSource& source, plugin::Registry& registry);

struct RungResult {
  Rung rung;
  CaseResult::Status status = CaseResult::Status::done;
  std::string reason;
  double difference = 0;  // largest scaled difference to the scene's own model
  double cpu = 0;         // [s]
};

}  // namespace trammel::study
