// The energy balance of a run, by cause.
//
//     E_start + supplied + refinements = E + dissipated
//     dissipated = impacts + contact damping + friction + dampers + numerical
//
// Impacts are exact (impact.hpp). Powers of drives, moving rows, dampers and compliant contacts are integrated along
// accepted steps:
//   - by Simpson's rule with the state in the middle (between_states.hpp);
//   - by Lobatto's rule with five points for integrators of order above four with dense output;
//   - by the integrator's own quadrature in steps longer than the oscillations in them.
// Inside a step nothing is evaluated if all powers are round-off and nothing slides with friction. (Friction may have
// no power at both ends of a step and some inside, such as from a reversal of the slip to the opening of the contact.)
// `numerical` is the remainder: errors of the integrator and of the quadrature, and corrections. A row that is switched
// on while its contact moves (`rebound: constrained`) does work too, which counts as supplied by constraints.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"
#include "system/between_states.hpp"

namespace trammel::simulate {

class Ledger {
 public:
  Ledger(model::AssembledSystem& system, Integrator& integrator);

  void start(const State& state);    // sets the initial energy; restart follows once a and lambda are known
  void restart(const State& state);  // computes the powers at `state`, after a jump
  void step(const State& now, const State& next);
  void impact(int contact, double energy) { impacts_[contact] += energy; }
  void moving_rows(double supplied) { constraints_ += supplied; }
  void refinement(double gained) { refinements_ += gained; }

  struct Totals {
    double supplied = 0, dissipated = 0;  // [J] since the start
  };
  Totals totals() const { return {supplied(), dissipated()}; }
  // At t + theta h of the last step: by the polynomial through the powers with which it was integrated, by a line if
  // steps are longer than oscillations.
  Totals totals_inside(double theta) const;

  double energy_start() const { return energy_start_; }
  double energy() const { return energy_start_ + supplied() + refinements_ - dissipated(); }  // expected now
  double supplied() const { return drives_ + constraints_ + markers_; }
  double dissipated() const { return impact_total() + contacts_ + friction_.sum() + dampers_; }
  double drives() const { return drives_; }
  double constraints() const { return constraints_; }
  double markers() const { return markers_; }
  double refinements() const { return refinements_; }  // [J] gained by replacing coordinates
  double dampers() const { return dampers_; }
  const Vec& friction() const { return friction_; }  // by contact
  double contact_damping() const { return contacts_; }
  const std::vector<double>& impacts() const { return impacts_; }
  double impact_total() const;

  void archive(Archive& a);

 private:
  struct PowersAt {
    double theta = 0, supplied = 0, dissipated = 0;  // [1], [W]
  };
  const model::AssembledSystem::Balance& balance(double t, const Vec& q, const Vec& v, const Vec& lambda);
  // Powers at the ends: now_, end_.
  void integrate_by_middle(const State& now, const State& next);
  void integrate_by_dense_output(const State& now, const State& next);
  void integrate_by(OscillatingSteps& steps, const State& now, const State& next);
  void evaluate_inside(const State& now, const State& next, double theta);
  double off_rows(const Vec& lambda, double theta);
  double kinetic(const Vec& v);
  void add(double duration, const model::AssembledSystem::Balance& power);
  void add_at(double theta, double duration, const model::AssembledSystem::Balance& power);

  model::AssembledSystem& system_;
  BetweenStates between_;
  DenseOutput* dense_;  // of a smooth method of high order, or none
  model::AssembledSystem::Balance now_, middle_, end_;
  double energy_start_ = 0, drives_ = 0, constraints_ = 0, markers_ = 0, dampers_ = 0, contacts_ = 0;  // [J]
  double energy_scale_ = 0;  // [J] reference of round-off: the initial energy, or the largest kinetic energy since
  double refinements_ = 0;   // [J]
  Vec friction_;
  std::vector<double> impacts_;
  Totals step_begin_;             // before the last step, of length step_
  std::vector<PowersAt> powers_;  // in the last step; empty if nothing was evaluated in it
  double step_ = 0;               // [s]
  Vec g_dot_, g_dot_end_;         // at `now` and at the step's end
  State inside_;
  Vec a_, lambda_, momentum_;
};

}  // namespace trammel::simulate
