// What an integrator is: a rule that advances a System by one step.
//
// It sees no contact, no event and no scene; it is told that something changed (`restart`), never what. Step sizes are
// chosen by the Simulator. A working method is about 60 lines: see plugins/integrators/newmark.
#pragma once

#include <trammel/archive.hpp>
#include <trammel/component.hpp>
#include <trammel/outcome.hpp>
#include <trammel/system.hpp>
#include <trammel/transfer.hpp>

namespace trammel {

// One point of a solution. Consistent (rows satisfied, a and lambda from the equations of motion) when handed over.
struct State {
  double t = 0;
  Vec q, v, a, lambda;
};

// Claims of a method; each is measured by its tests.
struct Traits {
  int order = 1;  // of q and v with constant steps, constraints included
  bool implicit = false;
  int steps = 1;                // of memory: 1 for one-step methods, 4 for fourth-order Adams
  bool holds_position = false;  // g = 0 at the end of each step, to the iteration's tolerance
  bool holds_velocity = false;  // G v + g_t = 0 likewise
  bool rows = true;  // false: only for systems without rows (nc = 0); scenes that have or make some are refused
};

class Integrator : public Component {
 public:
  virtual Traits traits() const = 0;

  // Something jumped, or sizes changed: forget the past, start from `now`. Always called before the first step.
  virtual void restart(System&, const State& now) = 0;

  // A trial: from `now` to `next` over h > 0. Leaves no trace but `next`: the Simulator repeats it with other h to
  // locate events. `next` comes in with any content of any size; reject instead of returning numbers that are not
  // finite.
  virtual Outcome step(System&, const State& now, double h, State& next) = 0;

  // The trial from `now` became the solution: history moves here and only here. After a correction `next` is not what
  // the trial gave; its a and lambda are solved anew.
  virtual void accept(System&, const State& /*now*/, const State& /*next*/) {}

  // History for resuming.
  virtual void archive(Archive&) {}
};

// Abilities: an integrator that also derives from one of these offers it.

// Weights of the error norm: component i counts relative to absolute + relative |x_i|.
struct Tolerance {
  double relative = 1e-6;
  double absolute = 1e-6;
};

class ErrorEstimate {
 public:
  virtual ~ErrorEstimate();
  // Weighted root-mean-square of the local error of the last trial, over q (as increments) and v; <= 1 is acceptable.
  // It shrinks with h to the power error_order().
  virtual double error(System&, const State& now, const State& next, const Tolerance&) = 0;
  virtual int error_order() const = 0;
};

class DenseOutput {
 public:
  virtual ~DenseOutput();
  // State inside the last trial, theta in [0, 1]; fills t, q, v. Numbers that are not finite: the method finds none there.
  virtual void interpolate(System&, const State& now, const State& next, double theta, State& at) = 0;
};

// For a system whose coordinates were replaced by others (a refined mesh).
class Resizable {
 public:
  virtual ~Resizable();
  // Carries the history through the transfer; called instead of `restart`. `now` is in the new coordinates already, its a
  // and lambda solved anew. Of the history velocities, accelerations and increments go through Transfer::v; forces and
  // multipliers do not transfer: evaluate them anew.
  virtual void resize(System&, const Transfer&, const State& now) = 0;
};

}  // namespace trammel
