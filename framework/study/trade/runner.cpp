#include "study/trade/runner.hpp"

namespace trammel::study {

std::vector<CaseResult> Runner::operator()(const std::vector<Overrides>& cases, double limit, double perturbation) {
  Batch batch{source_, registry_, jobs_, {}};
  batch.finished = [this](const CaseResult& r) {
    spent_ += r.cpu + r.cpu_set_up;
    ++runs_;
    if (finished_) finished_();
  };
  batch.options.cpu_limit = limit, batch.options.interrupt = interrupt_, batch.options.perturbation = perturbation;
  return batch(cases);
}

}  // namespace trammel::study
