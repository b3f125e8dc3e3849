// Steps of any length from a state whose event function is known as a formula, which counts them.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "simulate/event/trial_steps.hpp"

namespace trammel::test {

// f and its slope after a step of length h.
using Formula = std::function<simulate::ValueAndSlope(double)>;

class StepsByFormula : public simulate::StepsFromNow {
 public:
  explicit StepsByFormula(Formula f) : formulas_{std::move(f)} {}
  explicit StepsByFormula(std::vector<Formula> by_contact) : formulas_(std::move(by_contact)) {}

  simulate::ValueAndSlope at(simulate::EventFunction& function, double h) override {
    ++count;
    h_ = h;
    return f(function, h);
  }
  double force_slope(simulate::EventFunction& function, double) override { return f(function, h_).slope; }
  double gap_acceleration(const simulate::EventFunction&) override { return acceleration; }
  // Lengths and speeds of 1: touching is 1e-12 m, impacts leave up to 1e-9 m/s.
  simulate::Scale scale(const simulate::EventFunction&) const override { return {.gaps_and_bodies = 1, .speed = 1}; }

  // Of a contact, positive at first unless `noise` is at least its value, over a step of length h.
  simulate::EventFunction function(simulate::EventFunction::Kind kind, double h, double noise = 0, int contact = 0) {
    simulate::EventFunction made{.contact = contact, .kind = kind, .noise = noise};
    made.now = f(made, 0), made.next = f(made, h);
    return made;
  }
  numerics::Cubic between(const simulate::EventFunction& function, double h) {
    return {0, h, function.now, function.next};
  }

  int count = 0;
  double acceleration = 0;

 private:
  simulate::ValueAndSlope f(const simulate::EventFunction& function, double h) const {
    return formulas_[std::size_t(function.contact)](h);
  }
  std::vector<Formula> formulas_;
  double h_ = 0;
};

}  // namespace trammel::test
