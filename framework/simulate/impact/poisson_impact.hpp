// Poisson's impact law with Coulomb's friction: compression, then expansion, for all contacts that touch together.
//
//     compression   0 <= N_C  complementary to  u_C >= 0                       u_C = u- + A (N_C, T_C)
//     expansion     0 <= N_E - e N_C  complementary to  u+ >= 0                u+ = u_C + A (N_E, T_E)
//
// N_C, N_E [N s] are normal impulses, u gap rates [m/s]. In each phase friction is one Coulomb decision, judged by the
// slip at its end: |T| <= mu_0 N where s = 0, T = -mu N s/|s| elsewhere. In the expansion the impulse e N_C is given;
// the additional impulse dN keeps contacts from closing again. N_E = e N_C + dN enters as two forces at one point, one
// given and one sought: their cones add up to the cone of N_E. Closed contacts have e = 0.
//
// Without friction and with one contact it is Newton's law, u+ = -e u-. Energy may grow where friction reverses a slip;
// without friction it never does (poisson_impact.cpp). F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral
// Contacts, 1996; they also give back a part of the tangential impulse, which is not done here.
#pragma once

#include <vector>

#include "simulate/contact/contact_problem.hpp"
#include "simulate/impact/impact_directions.hpp"

namespace trammel::simulate {

class PoissonImpact {
 public:
  // Arguments and result as in Impact::solve.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system, double at_rest,
                                                       std::vector<TouchingContact>& touching, Vec& dv);

 private:
  Participant participant(const TouchingContact& c, std::size_t i, const Vec& rates) const;
  // Rates and impulses, in the order of the directions.
  complementarity::ContactSolution compress(model::AssembledSystem& system, double at_rest,
                                            const std::vector<TouchingContact>& touching, Vec& rates, Vec& P);
  complementarity::ContactSolution expand(model::AssembledSystem& system, double at_rest,
                                          const std::vector<TouchingContact>& touching, const Vec& compression,
                                          Vec& rates, Vec& P);
  void take(std::vector<TouchingContact>& touching, const Vec& P_C, const Vec& u_C, const Vec& P_E, const Vec& u) const;

  ImpactDirections directions_;
  ContactProblem problem_;
};

}  // namespace trammel::simulate
