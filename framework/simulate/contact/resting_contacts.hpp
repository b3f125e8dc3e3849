// Which contacts push on a system at rest. Compliant ones are always evaluated: their law gives 0 while they are apart.
// Contacts with rows are closed where they push (gap = 0, force >= 0) and open elsewhere. To find these, those that
// penetrate are closed and those that pull by more than the round-off of the forces on them (force_noise.hpp) are
// opened, until there are none.
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class RestingContacts {
 public:
  // Markers that follow a law of time stand still during the object's lifetime; its destructor opens all contacts.
  explicit RestingContacts(model::AssembledSystem& system);
  ~RestingContacts();
  RestingContacts(const RestingContacts&) = delete;
  RestingContacts& operator=(const RestingContacts&) = delete;

  // These three work at the system's point and return true if the rows have changed.
  void close_what_may_push();
  bool close_penetrating();
  // Opens a limited number of contacts in all.
  bool release_pulling(const Vec& lambda);
  // Lets contacts with friction stick, so that what rests on a moving base moves with it.
  void carry_along();

 private:
  std::vector<int> pulling(const Vec& lambda);

  model::AssembledSystem& system_;
  model::Modes modes_;
  ContactScale scale_;
  int released_ = 0;
};

}  // namespace trammel::simulate
