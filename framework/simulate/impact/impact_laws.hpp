// Which law an impact follows: Newton's (impact.hpp), Poisson's (poisson_impact.hpp) or the energetic one
// (spring_impact.hpp).
//
// Contacts that touch share one impact, and so one law, if joints, forces or contacts connect their bodies: among those
// that were open and approach, the one that comes last in the order newton, poisson, energetic; each keeps its own e.
// So the energy of an energetic contact that strikes cannot grow through another that strikes with it. Joints with
// friction take part in Newton's impact; after an impact by another law they rub under the loads of all of it
// (rubbing_after.hpp). An impact without collision (contact_mode.hpp, rule 8) has no restitution and follows Newton's
// law. If that gives no impulse, because it judges friction by the slip at the end, the springs of the energetic law
// decide.
#pragma once

#include <vector>

#include "simulate/impact/energetic_impact.hpp"
#include "simulate/impact/impact.hpp"
#include "simulate/impact/poisson_impact.hpp"
#include "simulate/impact/rubbing_after.hpp"

namespace trammel::simulate {

class ImpactLaws {
 public:
  // Arguments and result as in Impact::solve.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system, const State& state,
                                                       double at_rest, std::vector<TouchingContact>& touching, Vec& dv);
  bool cut_short() const { return cut_short_; }  // the last impact (SpringImpact::cut_short)

 private:
  complementarity::ContactSolution end_slip(model::AssembledSystem& system, std::vector<TouchingContact>& touching,
                                            Vec& dv);
  complementarity::ContactSolution strike(model::AssembledSystem& system, double at_rest,
                                          std::vector<TouchingContact>& touching, Vec& dv);

  Impact newton_;
  PoissonImpact poisson_;
  EnergeticImpact energetic_;
  RubbingAfter rubbing_after_;
  Restitution::ImpactLaw law_ = Restitution::ImpactLaw::newton;  // of the last impact
  bool cut_short_ = false;
};

}  // namespace trammel::simulate
