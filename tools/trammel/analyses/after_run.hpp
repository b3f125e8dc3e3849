// What `trammel run` does after its run: `--verify`, and what to change after a failure.
#pragma once

#include <filesystem>

#include "arguments.hpp"
#include "commands/simulation.hpp"

namespace trammel::tool {

// Runs the scene again, by finer steps and by another method; adds an error for each observable to the results.
void verify(const Arguments& arguments, plugin::Registry& registry, const scene::Scene& scene,
            const std::filesystem::path& folder, bool quiet);

// Searches for changes of the scene that get past the failure; adds them to the report and the results.
void find_remedy(const Arguments& arguments, plugin::Registry& registry, simulate::RunReport& report,
                 const std::filesystem::path& folder);

}  // namespace trammel::tool
