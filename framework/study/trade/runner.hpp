// Runs cases of one trade within its budget of CPU time, and counts them.
#pragma once

#include "study/cases/batch.hpp"

namespace trammel::study {

class Runner {
 public:
  // `finished` is called after each case.
  Runner(const SceneSource& source, plugin::Registry& registry, double budget, int jobs, simulate::Interrupt* interrupt,
         std::function<void()> finished = {})
      : source_(source),
        registry_(registry),
        budget_(budget),
        jobs_(jobs),
        interrupt_(interrupt),
        finished_(std::move(finished)) {}

  // Each ends after `limit` [s] of CPU time.
  std::vector<CaseResult> operator()(const std::vector<Overrides>& cases, double limit, double perturbation = 0);

  double left() const { return budget_ - spent_; }  // [s] of CPU time
  double budget() const { return budget_; }
  double spent() const { return spent_; }
  int runs() const { return runs_; }
  bool interrupted() const { return interrupt_ && interrupt_->requested(); }
  const SceneSource& source() const { return source_; }
  plugin::Registry& registry() { return registry_; }

 private:
  const SceneSource& source_;
  plugin::Registry& registry_;
  double budget_, spent_ = 0;
  int jobs_, runs_ = 0;
  simulate::Interrupt* interrupt_;
  std::function<void()> finished_;
};

}  // namespace trammel::study
