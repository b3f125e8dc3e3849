// Finds the first event of a contact inside a trial step, and shortens the step to it.
//
// Each contact has a function that is positive until its event:
//     open contact: gap       compliant contact in touch: -gap       closed contact (Restitution): its normal force
// An event shows in three ways: the function is negative at the step's end; it was positive at both ends but dipped between
// them (its slope turns from - to +: the cubic through both ends tells where to look); or, just after a separation, where the
// function starts at round-off, gap < 0 and gap_rate < 0 at the end. It is located by repeating the step with other lengths,
// so to the accuracy of the method itself, down to the rounding of t; the earliest event of all contacts counts.
//
// A shortened step still has a length of at least 4 units in the last place of t, so every event advances time.
//
// The normal force comes from the equations of motion at the step's end; methods that satisfy neither position nor velocity
// rows work on the level of accelerations, there lambda itself is that force, with their stabilisation.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "simulate/contact_mode.hpp"

namespace trammel::simulate {

class EventLocation {
 public:
  EventLocation(model::AssembledSystem& system, Integrator& integrator);

  bool watches() const { return !now_.empty(); }  // there is a contact
  void restart(const State& now);                 // modes or state changed

  enum class Found { nothing, event, step_refused };
  // Looks at the trial now -> next over h. Found::event: h and next are shortened to it, `changes` tells what happened.
  Found examine(const State& now, double& h, State& next);
  const ContactChanges& changes() const { return changes_; }
  long long steps_tried() const { return steps_tried_; }
  void accept(double h);  // next became the solution

  void archive(Archive& a);

 private:
  struct Values {
    double gap = 0, rate = 0, force = 0;
  };
  struct Suspect {
    int contact;
    double high, f_high;  // [s] length of a step after which the event has happened, and the function there
  };
  struct Cubic;

  bool closed(int i) const { return system_.modes().contacts[i].closed; }
  bool by_force(int i) const;
  bool at_step_ends(int i) const;
  double watched(int i, const Values& values) const;
  double slope(int i, const Values& values) const;
  bool happened(int i, const Values& end) const;
  void evaluate(const State& state, std::vector<Values>& values);
  const Values& step_to(const State& now, double h, int i);
  bool dips(const State& now, double h, const State& next, int i, Suspect& suspect);
  bool worth_slopes(int i, double h) const;
  double force_slope(const State& state, double dt, int i);
  double locate(const State& now, const Suspect& suspect);
  void collect(const State& next);

  model::AssembledSystem& system_;
  Integrator& integrator_;
  bool own_force_;  // the integrator's lambda is the force
  double near_ = 0;
  std::vector<Values> now_, next_, probe_;
  std::vector<double> force_before_;  // one step before now
  double h_before_ = 0;               // [s] 0: no step yet since the last change
  std::vector<Suspect> suspects_;
  std::vector<int> at_end_;
  ContactChanges changes_;
  State trial_, moved_;
  Vec a_, lambda_, dq_;
  long long steps_tried_ = 0;
};

}  // namespace trammel::simulate
