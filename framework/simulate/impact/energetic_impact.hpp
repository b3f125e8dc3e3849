// The energetic law of restitution for the contacts that touch: applies spring_impact.hpp to a System.
//
// Closed contacts, and those that touch without having struck, take part with e = 0. The loss of a contact is that of
// its own course: (1 - e^2) times the energy that its compressions stored, and the work of friction.
//
// An impact without collision begins with an approach that is tiny compared with the slip. Where sliding friction
// drives contacts into each other, the springs are compressed until the slip has ended or turned, however small the
// approach was; elsewhere nothing happens.
#pragma once

#include <vector>

#include "simulate/impact/impact_directions.hpp"

namespace trammel::simulate {

class EnergeticImpact {
 public:
  // Arguments and result as in Impact::solve.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system,
                                                       std::vector<TouchingContact>& touching, Vec& dv);
  bool cut_short() const { return cut_short_; }  // the last impact (SpringImpact::cut_short)

 private:
  void add_approaches(const std::vector<TouchingContact>& touching, double times, Vec& rates) const;
  // Removes the approaches by the least impulses that keep contacts at rest that end at rest.
  void let_approaches_vanish(const std::vector<TouchingContact>& touching, Vec& P, Vec& u, Vec& dv) const;

  ImpactDirections directions_;
  bool cut_short_ = false;
};

}  // namespace trammel::simulate
