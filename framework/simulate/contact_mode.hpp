// Which contacts are closed and which of them stick, and what happens at an event: impacts, then the accelerations
// decide.
//
// Rules for set-valued contacts (Restitution), at an event at time t:
//  1. Impact of every contact that touches and closes, with all that touch or are closed (impact_laws.hpp).
//  2. Capture (chatter.cpp): slower than capture_speed, e = 0. Also a rebound with e < 1 that the steps in contact
//     cannot follow: with fixed ones whose flight 2 u+/|gap acceleration| would last fewer than chatter_steps of them;
//     with controlled ones that would rise less than chatter_steps times the error they may make in a position. The
//     impact is solved again with e = 0 for it. Each repetition lowers the number of contacts with e > 0, so this ends.
//     Contacts that open because others struck, and too little to follow (a block that rocks to rest, discs of a pile
//     that knock against each other: impacts without end in a finite time), keep no rate. Nor do contacts that stuck
//     keep a slip that the impact gave them, if their friction ends it within a way as short: an impact decides by its
//     impulses alone, and where these are small beside the loads times any time that steps resolve, the loads decide.
//     Which these are, the problem of rule 3 tells, with all of them at rest. v is then projected onto the motions in
//     which they and all others without a rate have none: the least change, so it takes energy, which is told with the
//     impact.
//  3. Contacts that then touch without rate are candidates. They close where the forces of the complementarity problem
//         A = A_free + D N,   0 <= N complementary to A >= 0      (A gap accelerations, N normal forces)
//     push; where the gap accelerates apart they stay open ("lift").
//  4. A closed contact opens where its normal force falls through 0; the others are decided anew as in 3. Among
//     redundant contacts (three feet of a planar block) the single forces mean nothing: they open only where 3 says so.
//  9. A contact that never releases (a latch) has locked after rule 1, if it touches without rate: it is no candidate,
//     and its row is held like a joint's from then on, through the decision that follows and all later impacts.
// 10. Joints that rub take part like compliant contacts, with the load of their bearings for a normal force. It follows
//     from the forces sought, so the problem is solved in rounds (bearing_decision.cpp). In impacts they rub under the
//     impulses of their reactions (bearing_impulses.hpp). A joint that locks itself while it slides has no finite
//     forces: it jams by rule 8. Rounds that find no modes prove nothing.
// 11. Where a contact that was closed has neither force nor acceleration, and the others do not hold it (a stack below
//     a ceiling that begins to tip), or where no solution is found to round-off, the problem of rule 3 a moment later
//     tells which of them press then. If that has no solution, rule 8.
// 12. A contact at rest whose friction is at its bound, and whose tangents follow from the rows of others, some of
//     which slide (blocks that push each other along a channel): springs' share would be beyond the bound, and another
//     share of the others is another motion. It keeps T = mu N, like one that slides, without a slip. Where mu is less
//     than mu_0 it has let go (rule 6), and all is decided again.
// `rebound: constrained` makes candidates of contacts that separate at e u-, `restart: carry` leaves a as it was and
// starts the multipliers of new rows from 0, `onset: next_step` only changes when an event is seen.
//
// Compliant contacts (ContactForce) switch their force on when the gap falls through 0 and off when it rises through 0.
//
// Set-valued friction, of either kind, is part of the same problem (contact_problem.hpp), in which the compliant
// contacts' normal forces are given:
//  5. A contact slides, T = -mu N slip/|slip|, or it rests: new contacts without slip, those that stick, and those
//     whose slip has just reached 0. Those at rest stick where mu_0 (and, once they let go, mu) suffices; else they
//     slide the way they accelerate. In space a slip may turn instead of stopping. Its zero is looked for along the
//     direction it had where the step began (system/point/slip.hpp): more than `slow` across it there has turned, and
//     slides on in its own direction; less counts as rest, so a slip that dips below `slow`, 1e-7 of the scene's speed,
//     is taken through rest. Fixed steps do not resolve the end of a slip that turns; there also what a tenth of a step
//     takes away counts as rest.
//  6. A contact whose friction has reached its bound lets go: mu decides at once, less a part of 1e-8, so that it is
//     not held exactly there (mu = mu_0). It slides, or opens where sliding would pull (much friction). All others at
//     rest are checked at the same instant.
//  7. What was left of the slip of those at rest by the steps (a drift) is ended by the least change of v. Others whose
//     slip ends with it (the third foot of a table) are at rest as well, and so are those that what rests leaves no
//     slip: from rule 5 again.
//  8. Where rigid contacts have no solution with finite forces (Painleve's rod), or these grow beyond all bounds as
//     that state is approached (event_location.hpp refuses controlled steps past it), the slip stops or turns in an
//     impact without collision: rule 1 with nothing approaching; dependent contacts, of which none could part alone,
//     yield a little in it. If that has none, the run ends with a message; so do modes that contradict each other at
//     one instant (Simulator).
// Degenerate cases: contact_forces.hpp. Where there are several solutions it is Lemke's, which looks first where no
// force is.
#pragma once

#include <algorithm>
#include <vector>

#include <trammel/integrator.hpp>

#include "run/contact_scale.hpp"
#include "run/settings.hpp"
#include "simulate/contact/contact_problem.hpp"
#include "simulate/impact/impact_laws.hpp"
#include "simulate/impact/impact_warnings.hpp"
#include "simulate/results/contact_event.hpp"

namespace trammel::simulate {

// Changes seen at one instant, by contact.
struct ContactChanges {
  std::vector<int> struck;    // open Restitution contacts whose gap fell through 0
  std::vector<int> released;  // closed Restitution contacts whose force fell through 0
  std::vector<int> toggled;   // ContactForce: force on or off
  std::vector<int> yielded;   // sticking contacts whose friction reached its bound
  std::vector<int> stopped;   // sliding contacts whose slip reached 0
  bool locked = false;        // what slides has no finite forces from here on (rule 8)
  double raised = 0;          // part by which friction then is taken as larger: how far from there the state may be
  bool empty() const {
    return struck.empty() && released.empty() && toggled.empty() && yielded.empty() && stopped.empty() && !locked;
  }
  void clear() {
    struck.clear(), released.clear(), toggled.clear(), yielded.clear(), stopped.clear();
    locked = false, raised = 0;
  }
};

inline bool contains(const std::vector<int>& contacts, int i) {
  return std::find(contacts.begin(), contacts.end(), i) != contacts.end();
}

class ContactModes {
 public:
  ContactModes(model::AssembledSystem& system, const ContactScale& scale, const Settings& settings)
      : system_(system), scale_(scale), steps_(settings.contact_step), chatter_steps_(settings.chatter_steps) {}

  // Applies the changes at `state`: v jumps, modes and sizes change, a and lambda are solved anew. Appends the events.
  void settle(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events);
  // Of the last impacts [J]: through contacts, closed ones too, and beyond them, through moving rows.
  struct Loss {
    int contact;
    double energy;
  };
  const std::vector<Loss>& losses() const { return losses_; }
  double lost_elsewhere() const { return lost_elsewhere_; }
  ImpactWarnings& impact_warnings() { return impact_warnings_; }
  const ImpactWarnings& impact_warnings() const { return impact_warnings_; }

  double nothing() const;                  // [m/s^2] less is no acceleration
  double nothing(double violation) const;  // of a solution found up to that
  // How near the forces of contacts that slide are to having no solution: the least pivot of their equations, of that
  // without friction; 0 at Painleve's critical state, 1 far from it.
  double distance_from_critical(const State& state);
  bool any_closed() const;  // but for the bearings of joints, which always are

  // [s] Of steps with error control, so that no double zero of a slip velocity is stepped over: 0.45 of the shortest
  // period in which a blow on a closed contact with set-valued friction swings back. Below half of it a swing turns at
  // most once within a step, so two zeros in it show in the slopes at its ends (EventLocation::dips finds those of c +
  // cos in every phase up to 0.45, and misses the shallowest from 0.5 on).
  double step_limit(const State& state);
  // Less than this is no friction force [N]: it moves the contact less than `no_acceleration`.
  double friction_noise(int contact);
  // Nothing moves more than that by forces of this size along all of these directions [N].
  double force_noise(const std::vector<model::ContactDirection>& directions);

 private:
  using Friction = model::ContactMode::Friction;
  using Kind = ContactEvent::Kind;

  bool changes_sign_by_infinity(const State& state, const ContactChanges& changes);
  [[nodiscard]] complementarity::ContactSolution strike_without_collision(State& state, const ContactChanges& changes,
                                                                          bool jumped,
                                                                          std::vector<ContactEvent>& events);
  void tell_impacts(double t, bool without_collision, std::vector<ContactEvent>& events) const;
  void toggle(const State& state, const std::vector<int>& contacts, std::vector<ContactEvent>& events);
  void find_touching(const ContactChanges& changes);
  void find_bearings();
  void strike(State& state, const ContactChanges& changes);
  // Of the touching contacts, by index: whose separation after the impact is too short to follow, and whose slip.
  struct Brief {
    std::vector<bool> falls, stops;
    std::size_t first() const;  // of either; their number if there is none
  };
  Brief too_brief(const State& state, const ContactChanges& changes);
  void judge_brief(std::size_t at_rest_now, Brief& brief);
  bool separates(const TouchingContact& c) const;
  bool begins_to_slip(const TouchingContact& c) const;
  const TouchingContact* beginning_to_slip(const Participant& p) const;
  bool stops_at_once(std::size_t participant) const;
  bool let_fast_slips_go();
  double fastest_gap_acceleration();
  bool capture_chatter(const std::vector<bool>& falls);
  double end_rocking(State& state, const Brief& brief);
  double take_rates(State& state, const std::vector<bool>& rests, const std::vector<bool>& stops);
  bool cannot_follow(int contact, double separation, double acceleration) const;
  void lock(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events);
  void find_candidates(const ContactChanges& changes);
  void open_all(model::Modes& modes) const;
  void gather(const State& state, const ContactChanges& changes, bool jumped);
  void add_friction(const State& state, Participant& p, const ContactChanges& changes, bool jumped);
  bool stop_with_others(ContactChanges& changes);
  bool end_drift(State& state, ContactChanges& changes);
  [[nodiscard]] complementarity::ContactSolution decide(State& state, ContactChanges changes, bool jumped);
  [[nodiscard]] complementarity::ContactSolution take_verdicts();
  void find_shares();
  std::vector<Participant*> held_at_bounds(const State& state);
  void hold(const std::vector<Participant*>& held);
  bool in_balance(double violation) const;
  [[nodiscard]] complementarity::ContactSolution decide_by_what_follows(const State& state, ContactChanges changes,
                                                                        bool jumped,
                                                                        complementarity::ContactSolution so_far);
  // Of joints that rub (bearing_decision.cpp).
  bool has_bearings() const;
  [[nodiscard]] complementarity::ContactSolution decide_with_bearings(const State& state);
  bool was_not_held(const Participant& p, const model::Modes* loads) const;
  void load_bearings_at_rest(const State& state, const model::Modes& open);
  void load_bearings(const State& state, const model::Modes& modes);
  void accelerate_participants();
  void take_verdict(const Participant& p, bool kept_closed);
  void finish(State& state, bool carry);
  void tell_normal(const State& state, const TouchingContact& c, std::vector<ContactEvent>& events);
  void tell_friction(const State& state, std::vector<ContactEvent>& events);
  double stick_speed(int contact) const;
  double slow(int contact) const;
  double at_rest(const std::vector<TouchingContact>& contacts) const;  // [m/s] the largest of theirs
  double unresolved(int contact, const State& state);
  void keep_forces(const State& state);
  void carry_forces(Vec& lambda) const;
  // contact_failure.cpp
  [[noreturn]] void fail_without_balance(double t, const complementarity::ContactSolution& solution) const;
  [[noreturn]] void fail_without_impact(double t, const complementarity::ContactSolution& solution) const;
  [[noreturn]] void fail_without_solution(const char* what, double t, const complementarity::ContactSolution& solution,
                                          const std::vector<Participant>& who) const;
  bool blocked(const std::vector<Participant>& who) const;
  Restitution::Treatment treatment(int contact) const {
    return system_.model().contacts[contact].restitution->treatment();
  }
  double capture_speed(int contact) const;
  bool locks(int contact) const { return treatment(contact).release == Restitution::Release::never; }

  model::AssembledSystem& system_;
  const ContactScale& scale_;
  const StepChoice& steps_;
  double chatter_steps_;
  ImpactLaws impact_;
  ImpactWarnings impact_warnings_;
  ContactProblem problem_;
  model::Modes before_, modes_;
  std::vector<TouchingContact> touching_, bearings_;  // contacts; joints that rub
  std::vector<int> candidates_;
  std::vector<bool> shared_before_;             // by contact: it shared rows with others
  std::vector<Eigen::Vector3d> forces_before_;  // by contact and direction [N], where some are carried over
  std::vector<Loss> losses_;
  double lost_elsewhere_ = 0;
  bool bearings_undecided_ = false;  // in the last decision: no modes agreed with the loads of the bearings
  double largest_ = 0;               // of the accelerations without the forces sought
  Vec dv_, v_before_, a_, lambda_, lambda_before_;
};

}  // namespace trammel::simulate
