#include "study/trade/runner.hpp"

namespace trammel::study {

std::vector<CaseResult> Runner::operator()(const std::vector<Overrides>& cases, double limit, double perturbation) {
  Batch batch{source_, registry_, jobs_, {}};
  batch.options.cpu_limit = limit, batch.options.interrupt = interrupt_, batch.options.perturbation = perturbation;
  std::vector<CaseResult> results = batch(cases);
  for (const CaseResult& r : results) spent_ += r.cpu + r.cpu_set_up;
  runs_ += int(cases.size());
  return results;
}

}  // namespace trammel::study
