// Passes accepted states to forces and joints that count turns in space (CountsTurns).
#pragma once

#include <string>
#include <vector>

#include <trammel/counts_turns.hpp>

#include "simulate/results/checkpoint.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class TurnCounts {
 public:
  explicit TurnCounts(model::AssembledSystem& system);
  // Moves the system to the state if any component counts turns. Throws RunFailed with the name of a component that
  // cannot count any further.
  void follow(double t, const Vec& q, const Vec& v);
  void archive(JsonArchive& a);

 private:
  struct Counted {
    std::string path;  // in the scene
    std::string key;   // in the archive
    model::MarkerRef A, B;
    CountsTurns* component;
  };
  model::AssembledSystem& system_;
  std::vector<Counted> counted_;
};

}  // namespace trammel::simulate
