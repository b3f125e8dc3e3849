// Rule 10 of contact_mode.hpp: which joints with friction stick and slide.
//
// The loads of their bearings bound the friction. They follow from the reactions, and these from the friction and from
// all contacts. Rounds find modes that agree with their own loads:
//
//     modes of the last round -> their exact loads (AssembledSystem::accelerate) -> problem with these loads given ->
//     modes
//
// A joint that locks itself while it slides has no such load: it jams (rule 8). Where everything rests, rounds that
// meet such modes prove nothing: loads exist, since large ones hold all joints. They are found as in impacts
// (impact/bearing_impulses.hpp, with forces for impulses).
//
// A round that gives the same modes again is the check: it has solved the whole problem with the loads of its own
// solution. The first round uses the loads of modes in which everything rests that may rest; so a joint that could rest
// or slide rests. If there are none, it uses the loads without friction.
//
// Rounds may return to earlier modes: mu_0 times the load at rest does not hold the joint, but mu_0 times the load
// while it slides would. In such a cycle each joint that was not held under the load of its own rest has let go, and mu
// decides for it, as after rule 6. If no further joint lets go in a cycle, no modes were found, which proves nothing.
#pragma once

#include <vector>

#include "simulate/verdicts/modes_by_forces.hpp"

namespace trammel::simulate {

class BearingDecision {
 public:
  // Of a problem whose participants are gathered.
  BearingDecision(const ContactScene& scene, ContactsAtEvent& at, ContactProblem& problem, ModesByForces& by_forces)
      : system_(scene.system), at_(at), problem_(problem), by_forces_(by_forces) {}

  void restart() { undecided_ = false; }  // before a decision
  bool any_bearings() const;              // among the participants
  // Decides the modes of all participants, whose accelerations without the forces sought are known.
  [[nodiscard]] complementarity::ContactSolution decide(const State& state);
  bool undecided() const { return undecided_; }  // no modes agreed with the loads of the bearings

 private:
  using Asked = std::vector<Participant>;
  [[nodiscard]] complementarity::ContactSolution decide_in_rounds(const State& state, Asked asked,
                                                                  const model::Modes& open);
  [[nodiscard]] complementarity::ContactSolution decide_at_rest(const State& state, const Asked& asked,
                                                                const model::Modes& open);
  [[nodiscard]] complementarity::ContactSolution take_verdicts_under_loads(const State& state, Asked asked,
                                                                           const model::Modes& open);
  bool was_not_held(const Participant& p, const model::Modes* loads) const;
  void load_bearings_at_rest(const State& state, const model::Modes& open);
  void load_bearings(const State& state, const model::Modes& modes);
  bool is_joint(const Participant& p) const;

  model::AssembledSystem& system_;
  ContactsAtEvent& at_;
  ContactProblem& problem_;
  ModesByForces& by_forces_;
  bool undecided_ = false;
};

}  // namespace trammel::simulate
