// The length of the next step.
//
// Fixed steps land on the times asked for: from t to the next stop T there are n = ceil((T - t)/h) equal steps, and the
// last one ends at T exactly, so no drift accumulates. If (T - t)/n is h up to the rounding of T and t, h itself is
// used, bit for bit the same each time, as multistep methods like it.
//
// With a tolerance the steps follow the PI controller of Gustafsson (Hairer, Wanner II, IV.2): after a step with error
// e <= 1
//
//     h <- h min(5, max(0.2, 0.9 e^(-0.7/p) e_old^(0.4/p))),     after a rejected one h <- h max(0.1, 0.9 e^(-1/p))
//
// with p the order of the estimate. Even steps (OscillatingSteps) change only when they are to be a quarter longer, by
// the larger of the last two errors, or are rejected; the last few before a stop are of equal length. A step shortened
// only to reach a stop does not shorten the ones after it.
#pragma once

#include <string>

#include <trammel/archive.hpp>

#include "run/settings.hpp"

namespace trammel::simulate {

class StepControl {
 public:
  // `every`: time between records [s], which gives the scale where the scene leaves it open (not the end of the run, so
  // that a run resumed with a later end takes the same steps); `order` of the error estimate.
  StepControl(const StepChoice& choice, double every, int order, bool even = false);

  bool controlled() const { return !choice_.fixed; }
  double fixed_step() const { return choice_.fixed.value_or(0); }
  const Tolerance& tolerance() const { return choice_.tolerance; }

  struct Proposal {
    double h;       // [s]
    double t_next;  // [s] time at its end, exact
  };
  Proposal propose(double t, double stop, double most);  // `most` [s]: limits controlled steps

  void accepted(const Proposal& taken, double error);  // the whole proposal became the solution
  void rejected_for_error(double h, double error);
  void rejected(double h);         // the method refused: try half of it
  bool too_small(double t) const;  // after rejections: no step is left to try
  // Events, other modes: what was planned up to the next stop is void.
  void interrupted() { planned_ = 0; }
  double smallest(double t) const;  // [s]

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
