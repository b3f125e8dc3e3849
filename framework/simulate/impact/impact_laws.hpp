// Which law an impact follows: Newton's (impact.hpp), Poisson's (poisson_impact.hpp) or the energetic one
// (spring_impact.hpp).
//
// All contacts that touch share one impact, so they share one law: of those that approach and were open the one that
// comes last in the order newton, poisson, energetic; each keeps its own e. So an energetic contact that strikes is
// never spoiled by another that strikes with it. Joints that rub do so within Newton's impact, and right after one by
// the other laws, under the loads of all of it (rubbing_after.hpp). An impact without collision (contact_mode.hpp, rule
// 8) has no restitution and follows Newton's law; where that gives no impulse, for it judges friction by the slip at
// the end, the course of springs.
#pragma once

#include <vector>

#include "simulate/impact/energetic_impact.hpp"
#include "simulate/impact/impact.hpp"
#include "simulate/impact/poisson_impact.hpp"
#include "simulate/impact/rubbing_after.hpp"

namespace trammel::simulate {

class ImpactLaws {
 public:
  // As Impact::solve.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system, const State& state,
                                                       double at_rest, std::vector<TouchingContact>& touching, Vec& dv);
  bool cut_short() const { return cut_short_; }  // the last one: SpringImpact::cut_short

 private:
  complementarity::ContactSolution end_slip(model::AssembledSystem& system, std::vector<TouchingContact>& touching,
                                            Vec& dv);
  complementarity::ContactSolution strike(model::AssembledSystem& system, double at_rest,
                                          std::vector<TouchingContact>& touching, Vec& dv);

  Impact newton_;
  PoissonImpact poisson_;
  EnergeticImpact energetic_;
  RubbingAfter rubbing_after_;
  Restitution::ImpactLaw law_ = Restitution::ImpactLaw::newton;  // of the last one
  bool cut_short_ = false;
};

}  // namespace trammel::simulate
