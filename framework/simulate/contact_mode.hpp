// Which contacts are closed, and what happens at an event: impacts, then the accelerations decide.
//
// Rules for set-valued contacts (Restitution), at an event at time t:
//  1. Impact of every contact that touches and closes, with all that touch or are closed (impact.hpp).
//  2. Capture: slower than capture_speed, e = 0. With fixed steps also a rebound whose flight 2 u+/|gap acceleration| would
//     last fewer than chatter_steps contact steps: the impact is solved again with e = 0 for it. Each repetition lowers the
//     number of contacts with e > 0, so this ends.
//  3. Contacts that then touch without rate are candidates. They close where the forces of the linear complementarity problem
//         A = A_free + D N,   0 <= N complementary to A >= 0      (A gap accelerations, N normal forces)
//     push; where the gap accelerates apart they stay open ("lift").
//  4. A closed contact opens where its normal force falls through 0; the others are decided anew as in 3.
// `rebound: constrained` makes candidates of contacts that separate at e u-, `restart: carry` leaves a as it was and starts
// the multipliers of new rows from 0, `onset: next_step` only changes when an event is seen.
//
// Compliant contacts (ContactForce) switch their force on when the gap falls through 0 and off when it rises through 0.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "simulate/contact_event.hpp"
#include "simulate/impact.hpp"

namespace trammel::simulate {

// Changes seen at one instant, by contact.
struct ContactChanges {
  std::vector<int> struck;    // open Restitution contacts whose gap fell through 0
  std::vector<int> released;  // closed Restitution contacts whose force fell through 0
  std::vector<int> toggled;   // ContactForce: force on or off
  bool empty() const { return struck.empty() && released.empty() && toggled.empty(); }
  void clear() { struck.clear(), released.clear(), toggled.clear(); }
};

class ContactModes {
 public:
  // `chatter_time`: rebounds shorter than this stick [s]; 0: none.
  ContactModes(model::AssembledSystem& system, double chatter_time) : system_(system), chatter_time_(chatter_time) {}

  // Applies the changes at `state`: v jumps, modes and sizes change, a and lambda are solved anew. Appends the events.
  // Returns the kinetic energy that impacts took, beyond what is attributed to contacts, i.e. through moving rows [J].
  double settle(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events);

  bool any_closed() const;
  // Closer than this counts as touching [m]: round-off of positions of the size of the scene.
  static double touching_gap(const State& state);

 private:
  void toggle(const State& state, const std::vector<int>& contacts, std::vector<ContactEvent>& events);
  void find_touching(const State& state, const ContactChanges& changes);
  double strike(State& state);
  bool capture_chatter(const State& state, const Vec& v);
  void find_candidates(const ContactChanges& changes);
  void free_accelerations(double t, const Vec& q, const Vec& v);
  void close_pushing(const State& state);
  void finish(State& state, const std::vector<int>& rows_before, const Vec& lambda_before, bool carry,
              std::vector<ContactEvent>& events);
  Restitution::Treatment treatment(int contact) const {
    return system_.model().contacts[contact].restitution->treatment();
  }

  model::AssembledSystem& system_;
  double chatter_time_;
  Impact impact_;
  model::Modes before_, modes_;
  std::vector<TouchingContact> touching_;
  std::vector<int> candidates_;
  std::vector<bool> pushes_;
  Vec dv_, v_before_, a_, lambda_, gap_accelerations_;
};

}  // namespace trammel::simulate
