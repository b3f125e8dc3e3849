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
  std::vector<std::string> command;  // the program's arguments
};

const char* to_string(Status status);

// What every result.json begins with: status, reason, scene, and how it was made (provenance.hpp).
nlohmann::ordered_json result_head(const scene::Scene& scene, const Setup& setup, const Outcomes& outcomes);
nlohmann::ordered_json to_json(const Energy& energy);
// The columns of series.csv and events.csv: {"series": [{"name", "unit", "meaning", "path"}, ...], "events": [...]}.
nlohmann::ordered_json columns_json(const Setup& setup, Recorder::Books books);
// The parts of the picture that do not move, for the report (animation_line.hpp); empty if a component throws at the
// state, as it may where a run has failed.
nlohmann::ordered_json drawing_json(model::AssembledSystem& system, const State& state);
std::string title_of(const scene::Scene& scene);  // the scene's file if it has no title

// The content of result.json. energy_dissipated is positive when energy was lost, cause by cause; its entry `numerical`
// is what no cause explains, and energy_drift the negative of it:
//     energy_drift = E - (E_start + supplied - dissipated by the named causes)
std::string result_json(const scene::Scene& scene, const Setup& setup, Simulator& simulator, const Outcomes& outcomes);

// A few lines for a person.
std::string summary(const scene::Scene& scene, const Setup& setup, Simulator& simulator, const Outcomes& outcomes,
                    const std::filesystem::path& folder);

}  // namespace trammel::simulate
