// The length of the next step.
//
// Fixed steps end exactly at the times asked for: from t to the next stop T there are n = ceil((T - t)/h) equal steps,
// and the last one ends at T exactly, so no drift accumulates. If (T - t)/n is h up to the rounding of T and t, h
// itself is used, bit for bit the same each time, which multistep methods need.
//
// With a tolerance the steps follow the PI controller of Gustafsson (Hairer, Wanner II, IV.2): after a step with error
// e <= 1
//
//     h <- h min(5, max(0.2, 0.9 e^(-0.7/p) e_old^(0.4/p))),     after a rejected one h <- h max(0.1, 0.9 e^(-1/p))
//
// with p the order of the estimate. Even steps (for methods with OscillatingSteps) change only if the larger of the
// last two errors allows a step at least a quarter longer, or after a rejection; the last few before a stop have equal
// lengths. A step shortened only to reach a stop does not shorten the following ones.
#pragma once

#include <string>

#include <trammel/archive.hpp>

#include "run/settings.hpp"

namespace trammel::simulate {

class StepControl {
 public:
  // `every` [s]: time between records, the scale of the first step if the scene gives none (not the end of the run, so
  // that a run resumed with a later end takes the same steps). `order` of the error estimate.
  StepControl(const StepChoice& choice, double every, int order, bool even = false);

  bool controlled() const { return !choice_.fixed; }
  const Tolerance& tolerance() const { return choice_.tolerance; }

  struct Proposal {
    double h;       // [s]
    double t_next;  // [s] time at its end, exact
  };
  Proposal propose(double t, double stop, double most);  // `most` [s]: limits controlled steps

  void accepted(const Proposal& taken, double error);  // the whole proposal became the solution
  void rejected_for_error(double h, double error);
  void rejected(double h);  // the method rejected the step: half of a fixed step follows, a quarter of a controlled one
  bool too_small(double t) const;  // after rejections: no shorter step is left to try
  // After events and changes of modes: discards the plan up to the next stop.
  void interrupted() { planned_ = 0; }
  double smallest(double t) const;  // [s]
  // [s] Times of this size are not resolved to shorter steps.
  static double resolution(double t);

  void archive(Archive& a, const std::string& prefix);

 private:
  void plan(double t, double stop, double h);

  StepChoice choice_;
  double every_;
  int order_;
  bool even_;
  // fixed and even: the plan from t0 to the stop, with steps of at most planned_for
  double t0_ = 0, stop_ = 0, h_ = 0, planned_for_ = 0;
  long long planned_ = 0, done_ = 0;
  int halvings_ = 0;
  // controlled
  double wish_ = 0;  // [s]
  double error_before_ = 1;
};

}  // namespace trammel::simulate
