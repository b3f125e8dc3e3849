// Where the energy goes.
//
//     E_start + supplied + refinements = E + dissipated,       dissipated = impacts + contact damping + dampers + numerical
//
// Impacts are exact (impact.hpp). Powers of drives, moving rows, dampers and compliant contacts are integrated along accepted
// steps by Simpson's rule, the state in the middle from the cubic Hermite interpolation of v and the matching one of q;
// nothing is evaluated there while all powers are 0 but for round-off. `numerical` is what remains: the error of the integrator, of that rule,
// and of corrections. A row that is switched on while its contact moves (`rebound: constrained`) does work too; it counts as
// supplied by constraints.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "model/assembled_system.hpp"

namespace trammel::simulate {

class Ledger {
 public:
  explicit Ledger(model::AssembledSystem& system);

  void start(const State& state);    // the energy to begin with; restart follows once a and lambda are known
  void restart(const State& state);  // powers at `state`, after a jump
  void step(const State& now, const State& next);
  void impact(int contact, double energy) { impacts_[contact] += energy; }
  void moving_rows(double supplied) { constraints_ += supplied; }
  void refinement(double gained) { refinements_ += gained; }

  double energy_start() const { return energy_start_; }
  double energy() const { return energy_start_ + supplied() + refinements_ - (impact_total() + contacts_ + dampers_); }  // due by now
  double supplied() const { return drives_ + constraints_; }
  double drives() const { return drives_; }
  double constraints() const { return constraints_; }
  double refinements() const { return refinements_; }  // gained where coordinates were replaced
  double dampers() const { return dampers_; }
  double contact_damping() const { return contacts_; }
  const std::vector<double>& impacts() const { return impacts_; }
  double impact_total() const;

  void archive(Archive& a);

 private:
  model::AssembledSystem::Balance balance(double t, const Vec& q, const Vec& v, const Vec& lambda);
  model::AssembledSystem& system_;
  model::AssembledSystem::Balance now_;
  double energy_start_ = 0, drives_ = 0, constraints_ = 0, dampers_ = 0, contacts_ = 0, refinements_ = 0;  // [J]
  std::vector<double> impacts_;
  Vec q_, v_, dq_, lambda_;
};

}  // namespace trammel::simulate
