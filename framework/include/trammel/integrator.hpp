// An integrator: a rule that advances a System by one step.
//
// It sees no contact, no event and no scene. `restart` announces that the state jumped or that sizes changed, not why.
// The Simulator chooses the step sizes. A working method takes about 60 lines: see plugins/integrators/newmark.
#pragma once

#include <trammel/archive.hpp>
#include <trammel/component.hpp>
#include <trammel/outcome.hpp>
#include <trammel/system.hpp>
#include <trammel/transfer.hpp>

namespace trammel {

// One point of a solution. The framework passes consistent states: rows satisfied, a and lambda from the equations of
// motion.
struct State {
  double t = 0;
  Vec q, v, a, lambda;
};

// Claims of a method. Each of them is measured by tests. A scene that needs something that the method does not take is
// refused before the run, with the scene's line and the names of methods that take it; `trammel list --matrix` shows
// all combinations. Properties that follow from abilities (error control, dense output, a history that survives new
// coordinates) are not claimed again.
struct Traits {
  // Of q and v with constant steps, constraints included. 0: the error does not depend on h, because the method takes
  // steps of its own inside each step, to tolerances that are its parameters.
  int order = 1;
  bool implicit = false;
  int steps = 1;                // length of the history: 1 for one-step methods, 4 for fourth-order Adams
  bool holds_position = false;  // g = 0 at the end of each step, to the iteration's tolerance
  bool holds_velocity = false;  // G v + g_t = 0 likewise

  // The systems that the method takes; false where it does not.
  bool rows = true;            // nc > 0
  bool redundant_rows = true;  // rows that depend on each other
  bool friction = true;        // set-valued: W != G while a contact slides, and very short steps to the end of a slip
  bool jumps = !implicit;      // f that jumps with v: friction decided at every evaluation
  bool rotations = true;       // q' = N(q) v with N != 1: unit quaternions
  bool events = true;          // `restart` during a run, after a step of any length: contacts, friction, refinement
};

class Integrator : public Component {
 public:
  virtual Traits traits() const = 0;

  // The state jumped, or sizes changed: discard the history and start from `now`. Always called before the first step.
  virtual void restart(System&, const State& now) = 0;

  // A trial step from `now` to `next` with h > 0. It changes nothing that later trials depend on: the Simulator repeats
  // it with other h to locate events. `next` may have any content and size on entry. Reject the step instead of
  // returning numbers that are not finite. Once its vectors have their sizes, a step allocates no memory.
  virtual Outcome step(System&, const State& now, double h, State& next) = 0;

  // The trial from `now` became the solution. History is updated here and nowhere else. After a correction `next`
  // differs from the trial's result, and its a and lambda were solved for again.
  virtual void accept(System&, const State& /*now*/, const State& /*next*/) {}

  // Reads or writes the history, so that a run can resume.
  virtual void archive(Archive&) {}
};

// Abilities: an integrator offers one by deriving from its class as well.

// Weights of the error norm: the error of component i is divided by absolute + relative |x_i|.
struct Tolerance {
  double relative = 1e-6;
  double absolute = 1e-6;
  double absolute_rate = 0;  // [m/s, rad/s] for velocities, if it is larger than `absolute`
  // (nv) If set, error_norm stores each coordinate's part of the sum of squares there. A run that cannot keep the
  // tolerance names the largest ones.
  Vec* parts = nullptr;
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
  // State inside the last trial at theta in [0, 1]; fills t, q, v. Numbers that are not finite mean: no state found
  // there.
  virtual void interpolate(System&, const State& now, const State& next, double theta, State& at) = 0;
};

// For systems whose coordinates are replaced during a run (a refined mesh).
class Resizable {
 public:
  virtual ~Resizable();
  // Maps the history by the transfer; called instead of `restart`. `now` is already in the new coordinates, with a and
  // lambda solved for again. Transfer::v maps velocities, accelerations and increments; forces and multipliers cannot
  // be mapped and must be evaluated again.
  virtual void resize(System&, const Transfer&, const State& now) = 0;
};

}  // namespace trammel
