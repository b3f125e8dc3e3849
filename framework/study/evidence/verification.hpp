// How far a finished run can be trusted: repeats the scene with finer steps and with a method of another family.
//
//     finer steps    h/2, or a tolerance ten times smaller; with a method of order p the difference to it is
//                    1 - 2^-p of the error of the run (Richardson)
//     other method   shares no formula with the first; shows errors that smaller steps do not: of events, of the method
//
// The larger of the two differences is the estimate. Repetitions end after `price` times the CPU time of the run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "study/cases/batch.hpp"

namespace trammel::study {

struct Repetition {
  std::string what;       // "hht_alpha with step 5e-05 s"
  std::string failure;    // empty: it reached the end
  double cpu = 0;         // [s]
  double difference = 0;  // largest, divided by scales, until trusted_until
};

struct ObservableError {
  std::string name;
  double error = 0;  // estimate over the records until trusted_until, in the observable's unit
  double scale = 0;  // largest change from the start
  double t = 0;      // [s] where it is largest
  std::string reason;
};

struct Verification {
  std::vector<Repetition> repetitions;
  std::vector<ObservableError> observables;
  double trusted_until = 0;      // [s] after this time the repetitions differ by more than a tenth of a scale
  double end = 0;                // [s] of the run
  double price = 0;              // CPU time of all repetitions, relative to that of the run
  std::optional<double> target;  // of error/scale
  bool met() const;              // every estimate meets the target, to the end

  std::vector<std::string> sentences() const;  // for the user, the verdict first
  nlohmann::ordered_json to_json() const;
};

// `run`: the result of the run; `cpu` [s] its cost. Throws SceneError.
Verification verify(const SceneSource& source, plugin::Registry& registry, const CaseResult& run,
                    std::optional<double> target, double price = 3);

// The observed columns of a finished run in its folder. Throws std::runtime_error.
CaseResult read_run(const std::filesystem::path& folder, const scene::Scene& scene);
// Adds the verification to the folder's result.json.
void record(const Verification& verification, const std::filesystem::path& folder);

}  // namespace trammel::study
