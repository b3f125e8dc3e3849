// The messages of a run that ends because the contacts have no forces at an instant, or because none were found.
#pragma once

#include <vector>

#include "simulate/contact/contact_scene.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

// The law to try where contacts have no forces or no motion.
inline const char* other_law(bool rigid) {
  return rigid ? "a compliant law, such as continuous_force" : "smooth friction, such as regularized_coulomb";
}

// A search that has ended without a solution. `bearings_undecided`: no modes agreed with the loads of the bearings.
struct Unsolved {
  double t;
  complementarity::ContactSolution solution;
  bool bearings_undecided;
};
[[noreturn]] void fail_without_balance(const ContactScene& scene, const Unsolved& search,
                                       const std::vector<Participant>& who);
[[noreturn]] void fail_without_impact(const ContactScene& scene, const Unsolved& search, const ContactsAtEvent& at);

}  // namespace trammel::simulate
