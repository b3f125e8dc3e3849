// The energetic law of restitution for the contacts that touch: spring_impact.hpp for a System.
//
// Closed contacts and those that touch without having struck take part with e = 0. A contact's loss is that of its own
// course: what its compressions stored times 1 - e^2, and what friction took.
//
// An impact without collision begins with an approach that is nothing beside the slip: where sliding friction drives
// contacts on into each other the springs are compressed until the slip has ended or turned, however small that was.
// Elsewhere nothing happens.
#pragma once

#include <vector>

#include "simulate/impact/impact_directions.hpp"

namespace trammel::simulate {

class EnergeticImpact {
 public:
  // As Impact::solve.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system,
                                                       std::vector<TouchingContact>& touching, Vec& dv);
  bool cut_short() const { return cut_short_; }  // the last one: SpringImpact::cut_short

 private:
  void begin_without_collision(const std::vector<TouchingContact>& touching);
  // The least impulses that give back the approach with which it began: what ends at rest stays so.
  void let_approaches_vanish(const std::vector<TouchingContact>& touching, Vec& P, Vec& u, Vec& dv) const;

  ImpactDirections directions_;
  bool cut_short_ = false;
};

}  // namespace trammel::simulate
