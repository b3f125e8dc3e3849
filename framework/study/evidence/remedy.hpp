// Finds, by trials, one change with which a failed scene passes the time of its failure.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>
#include <trammel/integrator.hpp>

#include "study/cases/batch.hpp"

namespace trammel::study {

struct Remedy {
  std::string what;     // "finer steps: hht_alpha with step 5e-05 s"
  Overrides overrides;  // as --set takes them
  double from = 0;      // [s] where the trial began
  double passes = 0;    // [s] where it ended, without a failure
};

struct Failure {
  double t = 0;                    // [s]
  std::optional<State> last_good;  // simulate::RunReport; none: only the scene's start is known
};

struct SearchLimits {
  double cpu = 0;  // [s] of all trials together
  simulate::Interrupt* interrupt = nullptr;
};

struct RemedySearch {
  enum class End { helped, nothing_helped, out_of_time, interrupted };
  End end = End::nothing_helped;
  std::optional<Remedy> remedy;   // if one helped
  int tried = 0;                  // changes that the scene accepts
  double from = 0;                // [s] where the last trials began
  double cpu = 0, cpu_limit = 0;  // [s] taken and given

  std::string sentence() const;  // for the user
  nlohmann::ordered_json to_json() const;
};

// [s] CPU time that a failed run may spend on the search.
double search_limit(double cpu_of_run);

// Tries finer steps, projected rows, other methods, and more events, each in a process of its own: from the last good
// state, and if nothing helps there, from the start. A change helps if the run passes the failure by a hundredth of its
// time, and by the time between the last good state and the failure, and if the method has not changed the energy there
// by more than EnergyWatch::unexplained.
RemedySearch find_remedy(const SceneSource& source, plugin::Registry& registry, const Failure& failure,
                         const SearchLimits& limits);

// Writes it to result.json of the failed run; returns the file's new text.
std::string record(const RemedySearch& search, const std::filesystem::path& folder);

}  // namespace trammel::study
