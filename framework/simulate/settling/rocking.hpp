// Rule 2 of contact_mode.hpp: separations and slips that are too brief to follow end, by the least change of v.
#pragma once

#include <vector>

#include "simulate/settling/chatter.hpp"

namespace trammel::simulate {

class Rocking {
 public:
  // `touching`: the contacts with their rates after an impact, which change with v.
  Rocking(const ContactScene& scene, std::vector<TouchingContact>& touching) : scene_(scene), touching_(touching) {}

  // The system is at `state`. Contacts that nothing connects with these keep all their rates, drift included. Returns
  // the energy that this takes [J].
  double end(State& state, const BriefMotions& brief);

 private:
  double end_of(std::size_t island, State& state, BriefMotions brief);
  double end_rates_of(std::size_t island, State& state, const BriefMotions& brief);
  bool none_made_to_approach(std::size_t island, const std::vector<TouchingContact>& after_impact) const;
  bool leave_fastest(std::size_t island, BriefMotions& brief) const;
  double take_rates(State& state, const std::vector<bool>& rests, const std::vector<bool>& stops);

  const ContactScene& scene_;
  std::vector<TouchingContact>& touching_;
};

}  // namespace trammel::simulate
