// Forces that count turns in space (CountsTurns), told the states that became the solution.
#pragma once

#include <vector>

#include <trammel/counts_turns.hpp>

#include "model/assembled_system.hpp"
#include "simulate/checkpoint.hpp"

namespace trammel::simulate {

class TurnCounts {
 public:
  explicit TurnCounts(model::AssembledSystem& system);
  // Moves the system there if any force asks for it. Throws RunFailed in the name of one that can follow no further.
  void follow(double t, const Vec& q, const Vec& v);
  void archive(JsonArchive& a);

 private:
  struct Counted {
    const model::ForceEntry* entry;
    CountsTurns* force;
  };
  model::AssembledSystem& system_;
  std::vector<Counted> forces_;
};

}  // namespace trammel::simulate
