// result.json and the summary: what came out of a run.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "commands/simulation.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::simulate {

struct Cost {
  double wall = 0, cpu = 0;  // [s] of the simulation alone, earlier parts of a resumed run included
};

struct Outcomes {
  Status status = Status::done;
  std::string reason;
  Cost cost;
  bool resumed = false;
  std::vector<std::string> command;  // the words that the program was called with
};

const char* to_string(Status status);

// What every result.json begins with: status, reason, scene, and how it was made (provenance.hpp).
nlohmann::ordered_json result_head(const scene::Scene& scene, const Setup& setup, const Outcomes& outcomes);
nlohmann::ordered_json to_json(const Energy& energy);
// The columns of series.csv and events.csv: {"series": [{"name", "unit", "meaning", "path"}, ...], "events": [...]}.
nlohmann::ordered_json columns_json(const Setup& setup, Recorder::Books books);
// What does not move, for the report (animation_line.hpp); empty if a component has no answer at the state at which a
// run has failed.
nlohmann::ordered_json drawing_json(model::AssembledSystem& system, const State& state);
std::string title_of(const scene::Scene& scene);  // its file, if it has none

// As JSON text. energy_dissipated by cause, positive when energy was lost; numerical is what no cause explains and
// energy_drift its negative: E - (E_start + supplied - dissipated by the named causes).
std::string result_json(const scene::Scene& scene, const Setup& setup, Simulator& simulator, const Outcomes& outcomes);

// A few lines for a person.
std::string summary(const scene::Scene& scene, const Setup& setup, Simulator& simulator, const Outcomes& outcomes,
                    const std::filesystem::path& folder);

}  // namespace trammel::simulate
