// Rule 13 of contact_mode.hpp: which contacts of a group stay closed without a force, and which open.
#pragma once

#include <vector>

#include "simulate/verdicts/forces_in_modes.hpp"

namespace trammel::simulate {

class IdleContacts {
 public:
  IdleContacts(const ContactScene& scene, ContactsAtEvent& at, ContactProblem& problem, ForcesInModes& forces)
      : scene_(scene), at_(at), problem_(problem), forces_(forces) {}

  // Finds the idle contacts and the groups that share, once verdicts are taken.
  void find_shares(const State& state);
  // A contact whose force in the solution may be its error pulls if its row makes this force exact. It opens, if it
  // parts then; the contacts of one island together.
  void open_pulling_ones(const State& state);
  // Contacts with forces up to `none` times the largest, by island, are idle. Returns the smallest others.
  std::vector<double> share(const std::vector<double>& none);

 private:
  // By island.
  struct Idle {
    model::Modes decided;            // before any is idle
    std::vector<double> up_to;       // of the largest force: contacts with no more are idle
    std::vector<double> least = {};  // of the largest force: the least one of those that are not idle
    std::vector<bool> doubtful = {};
  };
  void fewer_idle(const State& state, Idle& idle);
  void more_idle(const State& state, Idle& idle);
  bool doubts_remain(const State& state, Idle& idle);
  void share_doubtful(double up_to, Idle& idle);
  void share(Idle& idle);
  void doubt(Idle& idle) const;
  bool open_loose_ones();

  const ContactScene& scene_;
  ContactsAtEvent& at_;
  ContactProblem& problem_;
  ForcesInModes& forces_;
};

}  // namespace trammel::simulate
