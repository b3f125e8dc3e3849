// Cases on all cores, their results in the order of the cases.
#pragma once

#include <functional>
#include <vector>

#include "study/cases/case_run.hpp"
#include "study/cases/scene_source.hpp"

namespace trammel::study {

using Overrides = std::vector<scene::Override>;

struct Batch {
  const SceneSource& source;
  plugin::Registry& registry;
  int jobs = 0;  // as of Workers
  CaseOptions options;
  std::function<void(const CaseResult&)> finished = {};  // called for each, in any order

  // A case whose process was ended is `failed` with the reason; after an interrupt the rest are `interrupted`.
  std::vector<CaseResult> operator()(const std::vector<Overrides>& cases) const;
};

// Results through a pipe.
std::string packed(const CaseResult& result);
CaseResult unpacked(const std::string& bytes);

}  // namespace trammel::study
