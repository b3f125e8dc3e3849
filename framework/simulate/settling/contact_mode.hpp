// Which contacts are closed and which of them stick, and what happens at an event: first impacts, then the
// accelerations decide.
//
// Rules for set-valued contacts (Restitution) at an event at time t. Other files refer to them by number.
// ContactModes::settle applies them in this order:
//
//     impact       1  ContactImpacts        2  Chatter, Rocking    9  lock_latches           (here)
//     decision     3  Participants          5  Participants        7  Drift                  (simulate/decision)
//                 10  BearingDecision      11  ModeDecision, WhatFollows
//     verdicts     3 to 6  Verdicts        12  HeldAtBounds       13  IdleContacts           (simulate/verdicts)
//                 14  ModesByForces        15  SpringBounds
//     no solution  8  ImpactWithoutCollision                                                 (here)
//
//  1. Impact: every contact that touches and closes strikes, together with all that touch or are closed, of bodies that
//     joints, forces or contacts connect (impact_laws.hpp).
//  2. Capture (chatter.hpp, rocking.hpp): an impact slower than capture_speed has e = 0. So has a rebound with e < 1
//     that the steps in contact cannot follow: with fixed steps, if its flight 2 u+/|gap acceleration| would last fewer
//     than chatter_steps of them; with controlled steps, if it would rise less than chatter_steps times the error that
//     a position may have. The impact is solved again with e = 0 for these contacts. Each repetition lowers the number
//     of contacts with e > 0, so this ends.
//     A contact may open only because others struck, by too little to be followed (a block that rocks to rest, discs of
//     a pile that knock against each other), whether or not it had an impulse of its own in that impact. Such contacts
//     keep no rate: their impacts would go on without end in a finite time. A contact that stuck or was open keeps no
//     slip from the impact if its friction ends the slip within a distance as short: until then it may open others,
//     whose impacts leave a slip again. An impact is decided by impulses alone; where these are small beside the loads
//     times the shortest time that steps resolve, the loads decide. The problem of rule 3 with all these contacts at
//     rest finds those that rest. Then v is projected onto the motions in which they, and all other contacts without a
//     rate, have no rate.
//     This is the least change of v, so it takes energy; the loss is reported with the impact. Where ending all
//     these rates would make another contact approach, the fastest of them are left. A contact whose rate it does not
//     end, since its row nearly depends on others, keeps that rate and opens.
//  3. Contacts that touch without a rate afterwards are candidates. They close where the forces of the complementarity
//     problem
//         A = A_free + D N,   0 <= N complementary to A >= 0      (A gap accelerations, N normal forces)
//     push; where the gap accelerates apart they stay open ("lift"). An open contact also stays open if its force is
//     round-off: without it the gap would not close.
//  4. A closed contact opens where its normal force falls through 0; rule 3 decides the others again. The single forces
//     of redundant contacts (three feet of a planar block) are not unique: such contacts open only where rule 3 opens
//     them.
//
// Set-valued friction, also of compliant contacts, is part of the same problem (contact_problem.hpp), in which the
// normal forces of compliant contacts are given:
//  5. A contact slides, T = -mu N slip/|slip|, or it is at rest: new contacts without slip, contacts that stick, and
//     contacts whose slip has just reached 0. A contact at rest sticks where mu_0 (mu, once it has let go) suffices;
//     otherwise it slides in the direction in which it accelerates. In space a slip may turn instead of stopping. Its
//     zero is located along the direction that it had where the step began (system/point/slip.hpp). If the slip across
//     that direction is then more than `least_slip`, it has turned, and slides on in its new direction; otherwise it
//     counts as rest. So a slip that falls below `least_slip`, 1e-7 of the scene's speed, passes through rest. Fixed
//     steps do not resolve the end of a slip that turns: with them, also the slip that a tenth of a step takes away
//     counts as rest.
//  6. A contact whose friction reaches its bound lets go: mu decides at once, reduced by a part of 1e-8 so that
//     friction does not hold it exactly at the bound where mu = mu_0. It slides, or opens where sliding would need a
//     pulling force (large mu). All other contacts at rest are checked at the same instant.
//  7. A slip that the steps have left in contacts at rest (a drift) is ended by the least change of v. Other contacts
//     whose slip ends with it (the third foot of a table), and those whose slip follows from the rates of the contacts
//     at rest, are then at rest as well, and rule 5 is applied again. In space, drift that is round-off is ended too,
//     since it would turn the friction of a contact that begins to slide. It turns slow slips, so these have their
//     directions afterwards.
//  8. Rigid contacts may have no solution with finite forces (Painleve's rod), or forces that grow beyond all bounds as
//     that state is approached (simulate/event refuses controlled steps past it). Then an impact without collision
//     stops or turns the slip: rule 1 with nothing approaching, in which dependent contacts, none of which could part
//     alone, yield a little. Where slips differ by orders of magnitude (at the corner and at the foot of a block that
//     turns by a clearance), it ends the slowest ones, and faster ones go on; where forces are still not finite,
//     another impact follows. Friction counts as larger in it by what the state is short of that point; where joints
//     have locked and the search for this impact gives up, by a part of 1e-7. If this impact has no solution, other
//     contacts may carry from there on (a table whose feet share otherwise as its slip turns), or forces that exist at
//     this instant do. If there are none, the run ends with a message; so it does if modes contradict each other at one
//     instant (Simulator).
//  9. A contact that never releases (a latch) locks after rule 1 if it touches without a rate. It is no candidate; its
//     row is held like a joint's from then on, through the decision that follows and all later impacts.
// 10. Joints with friction take part like compliant contacts; their normal force is the load of their bearings. This
//     load depends on the forces sought, so the problem is solved in rounds (bearing_decision.hpp). In impacts they rub
//     under the impulses of their reactions (bearing_impulses.hpp). A joint that locks itself while it slides has no
//     finite forces: it jams by rule 8. Rounds that find no modes prove nothing; where everything rests, loads exist
//     and are sought as in impacts.
// 11. Rule 3 may not decide which contacts press: a contact that was closed has neither force nor acceleration, and the
//     others do not hold it (a stack below a ceiling that begins to tip), or has only what is left of a force at the
//     instant found for its end, or no solution is found to round-off. Then the same problem is solved for the state a
//     moment later, or later still if that leaves it open; contacts that share rows then are all decided by it. Of
//     several solutions then, the one near that of this instant is sought first. If there is none, rule 8 applies.
// 12. The friction of a contact at rest may be at its bound while its tangents depend on rows of other contacts, some
//     of which slide (blocks that push each other along a channel). The shares of springs (complementarity/shares)
//     would exceed the bound, give another motion than that found, or leave a sliding contact without a force that
//     presses in the solution. Such a contact keeps T = mu N like one that slides, without a slip; so does a joint at
//     rest beside them (an arm that a box drags along), and a contact of a group of which nothing slides but which has
//     lost what it could spare (feet of a portal open where its hinges reach their bounds). If mu < mu_0 it has let go
//     (rule 6), and all modes are decided again.
// 13. A contact without a force stays closed (idle) only while rows of contacts that carry hold it. Where these come to
//     depend on each other (a stack that becomes a strut), they do not, and it opens: its force as a spring passes 0
//     there, which locates that state. They may also cease to hold it where contacts that touched at one point part:
//     then a change of bases is an event. So it is where a row that followed from others no longer does: forces that
//     hold both would be as many times larger as the contacts' distance is smaller than their bodies. If the problem
//     has several solutions then, the one is taken in which a contact that has shared opens and parts fastest
//     (ModeDecision::open_freed): a foot below a hinge about which its body turns parts, and presses on only with
//     friction that ends the turn. Which contacts are idle affects the motion if others slide, so the forces in the
//     modes decided are computed: if the contacts move otherwise than found, only those without any force count as
//     idle; if forces pull or leave a cone, contacts whose force may be an error (up to 1e-6 of the largest of their
//     island) count as idle, too, or else none does. A contact with such a force that pulls by its row in these modes
//     opens, if its gap then accelerates apart (IdleContacts::open_pulling_ones).
// 14. The forces in the modes decided may still pull or leave a cone, although the problem has a solution: springs'
//     shares are not admissible, and others are another motion (rows of blocks between walls). Where no cone is round
//     (in the plane, or where all slide), forces are then taken whose modes leave no share free: as few parts along
//     edges of cones as there are independent rows at rest. A contact without a part is idle, and one at rest with a
//     single part keeps T = mu N (rule 12), unless no other row holds its tangent.
// 15. Contacts at rest could press against each other, as the floor and the ceiling of a channel without clearance do,
//     and hold by their friction whatever pushes. Springs do not press so (complementarity/shares/springs_at_rest). If
//     forces as springs do not hold those of a group that rest, friction of its contacts is bounded by their springs'
//     normal forces, that of its sliding ones (feet on a belt below a table) follows from them, those at their bounds
//     let go, and all modes are decided again: until the normal forces in the modes decided are those of the friction,
//     up to their errors if the modes come up again. So a clearance of 0 is the limit of small ones, and rigid contacts
//     move as stiff compliant ones. Where this comes to no end (a stack that has locked while it slid), rest stays, by
//     any forces. Rule 12 decides groups in which something slides and a contact at rest is at its bound. Which springs
//     press is part of the modes: while loads change little by little they hold as long as they can, and then pass to
//     others without an event (renew_springs), but not to such as would be wedged in. Springs of contacts that
//     can be wedged in follow the loads step by step (complementarity/spring_motion), have the forces of these springs,
//     and let go where there are none.
//     Where such contacts come to rest out of sliding, without an impact, they begin with the normal forces that they
//     had until then (pressed_until_now.hpp), and rest wherever these springs hold them, though they could also slide
//     back (complementarity/forces_at_rest); otherwise they begin with the least forces.
//
// `rebound: constrained` makes candidates of contacts that separate at e u-. `restart: carry` leaves a as it was and
// starts the multipliers of new rows from 0. `onset: next_step` only changes when an event is seen.
//
// Compliant contacts (ContactForce) switch their force on when the gap falls through 0 and off when it rises through 0.
//
// Degenerate cases: contact_forces.hpp. If there are several solutions, Lemke's is taken, whose search begins where no
// force acts.
#pragma once

#include <vector>

#include "simulate/decision/mode_decision.hpp"
#include "simulate/results/contact_event.hpp"
#include "simulate/settling/carried_forces.hpp"
#include "simulate/settling/contact_failure.hpp"
#include "simulate/settling/contact_impacts.hpp"
#include "simulate/settling/impact_without_collision.hpp"
#include "simulate/settling/present_contacts.hpp"

namespace trammel::simulate {

class ContactModes {
 public:
  ContactModes(model::AssembledSystem& system, const ContactScale& scale, const Settings& settings)
      : scene_{system, scale, settings.contact_step, settings.chatter_steps}, system_(system) {}

  // Applies the changes at `state`: v jumps, modes and sizes change, a and lambda are solved anew. Appends the events.
  void settle(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events);

  // Of the last event: energy lost in its impacts [J].
  const std::vector<ImpactLoss>& losses() const { return impacts_.losses(); }
  double lost_elsewhere() const { return impacts_.lost_elsewhere(); }
  double least_acceleration(int contact) const {  // [m/s^2] a smaller one counts as no acceleration
    return decision_.instant().least_acceleration(contact);
  }
  // Of all events.
  ImpactWarnings& impact_warnings() { return impacts_.warnings(); }
  const ImpactWarnings& impact_warnings() const { return impacts_.warnings(); }

  // Between events (present_contacts.hpp).
  [[nodiscard]] bool renew_bases(State& state) { return simulate::renew_bases(scene_, state); }
  [[nodiscard]] bool renew_springs(const State& state) { return simulate::renew_springs(scene_, state); }
  void follow_loads(const State& state) { simulate::follow_loads(scene_, state); }
  double distance_from_critical(const State& state) { return simulate::distance_from_critical(scene_, state); }

 private:
  void begin(const State& state);
  void toggle(const State& state, const std::vector<int>& contacts, std::vector<ContactEvent>& events);
  bool strike(State& state, const ContactChanges& changes);
  bool any_friction() const;
  bool any_approaches() const;
  void take_approach_speeds(const ContactChanges& changes);
  void take_modes(State& state, const ContactChanges& changes);
  Unsolved unsolved(double t, const complementarity::ContactSolution& solution) const {
    return {t, solution, decision_.instant().bearings_undecided()};
  }

  ContactScene scene_;
  model::AssembledSystem& system_;
  ContactsAtEvent at_;
  ContactImpacts impacts_{scene_, at_};
  ModeDecision decision_{scene_, at_};
  ImpactWithoutCollision without_collision_{scene_, at_, impacts_, decision_};
  CarriedForces carried_{scene_};
};

}  // namespace trammel::simulate
