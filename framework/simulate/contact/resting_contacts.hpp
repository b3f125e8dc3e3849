// Which contacts push on a system at rest. Compliant ones are always evaluated: their law says 0 while they are apart.
// Those with rows are closed where they push (gap = 0, force >= 0) and open elsewhere, found by closing what penetrates
// and letting go what pulls, beyond round-off of what acts on it (force_noise.hpp), until neither is left.
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class RestingContacts {
 public:
  // Markers that a law of time moves stand still while this lives; afterwards all contacts are open.
  explicit RestingContacts(model::AssembledSystem& system);
  ~RestingContacts();
  RestingContacts(const RestingContacts&) = delete;
  RestingContacts& operator=(const RestingContacts&) = delete;

  // All three at the system's point; true: the rows have changed.
  void close_what_may_push();
  bool close_penetrating();
  // A hundred times at most: a set that opens and closes for ever has no equilibrium.
  bool release_pulling(const Vec& lambda);
  // What rests on something with friction goes with it.
  void carry_along();

 private:
  std::vector<int> pulling(const Vec& lambda);

  model::AssembledSystem& system_;
  model::Modes modes_;
  ContactScale scale_;
  int released_ = 0;
};

}  // namespace trammel::simulate
