// Forces and joints that count turns in space (CountsTurns), told the states that became the solution.
#pragma once

#include <string>
#include <vector>

#include <trammel/counts_turns.hpp>

#include "system/assembled_system.hpp"
#include "simulate/results/checkpoint.hpp"

namespace trammel::simulate {

class TurnCounts {
 public:
  explicit TurnCounts(model::AssembledSystem& system);
  // Moves the system there if any component asks for it. Throws RunFailed in the name of one that can follow no further.
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
