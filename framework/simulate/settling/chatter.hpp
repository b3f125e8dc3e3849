// Rule 2 of contact_mode.hpp: which motions after an impact are too brief for steps to follow.
#pragma once

#include <map>
#include <vector>

#include "simulate/decision/participants.hpp"

namespace trammel::simulate {

// By index of the touching contacts: `falls`, the separation after the impact is too short to follow; `stops`, the
// slip.
struct BriefMotions {
  std::vector<bool> falls, stops;
  std::size_t first() const;  // that falls or stops; their number if there is none
};

class Chatter {
 public:
  Chatter(const ContactScene& scene, ContactsAtEvent& at) : scene_(scene), at_(at), participants_(scene, at) {}

  // `state` is that after the impact, whose rates at.touching has.
  BriefMotions too_brief(const State& state, const ContactChanges& changes);

 private:
  void judge(const State& state, std::size_t at_rest_now, BriefMotions& brief);
  bool separates(const TouchingContact& c) const;
  bool begins_to_slip(const TouchingContact& c) const;
  const TouchingContact* beginning_to_slip(const Participant& p) const;
  bool stops_at_once(std::size_t participant) const;
  bool let_fast_slips_go();
  std::map<std::size_t, double> fastest_gap_accelerations() const;
  bool cannot_follow(int contact, double separation, double acceleration) const;

  const ContactScene& scene_;
  ContactsAtEvent& at_;
  Participants participants_;
  ContactProblem problem_;       // as if all that touch rested
  std::vector<int> candidates_;  // the first participants
};

}  // namespace trammel::simulate
