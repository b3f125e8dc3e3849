// `trammel static`: equilibria under growing loads, written as the results of a run are.
#pragma once

#include "commands/simulation.hpp"

namespace trammel::simulate {

// Equilibria under loads that follow t, from simulate.start to simulate.until, a record each (load_path.hpp); writes
// series.csv, animation.ndjson, fields.ndjson and result.json. Throws like run.
RunReport run_static(const scene::Scene& scene, plugin::Registry& registry, const RunOptions& options);

}  // namespace trammel::simulate
