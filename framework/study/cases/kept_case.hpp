// A case with its results folder: a run as by `trammel run` or `trammel static`, with the same result as one in memory.
#pragma once

#include <filesystem>

#include "study/cases/case_run.hpp"

namespace trammel::study {

// Uses only `witness` and `interrupt` of the options. A case that is refused leaves no folder. Nothing is thrown.
CaseResult run_kept_case(const scene::Scene& scene, plugin::Registry& registry, const std::filesystem::path& folder,
                         const CaseOptions& options);

}  // namespace trammel::study
