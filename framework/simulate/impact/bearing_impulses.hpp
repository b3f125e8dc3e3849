// Friction in joints during an impact: Coulomb's law on the impulses with which their bearings guide.
//
//     M dv + G_b^T Lambda = sum_i D_i F_i     F [N s]: impulses on contacts, and of friction in joints, along D
//     N = sum_k |p_k|,  p = L Lambda          N [N s]: load of a joint (system/point/joint_friction.cpp),
//                                             Lambda: its reaction impulse
//     |T| <= mu_0 N where s+ = 0,  T = -mu N s+/|s+| elsewhere
//
// Lambda is linear in F. With given loads N this is the problem of contact_problem.hpp; the loads Phi(N) follow from
// its solution. Sought is N = Phi(N). A solution exists wherever that problem has a continuous solution: large loads
// hold all joints, which bounds Phi (Brouwer). Rounds N <- Phi(N) from 0 end at the least solution if Phi grows with N;
// Newton's method continues rounds that do not end. A joint that locks itself while it slides, with Phi > N on the way,
// comes to rest in this way.
//
// From::held begins with loads that hold all joints. Without an impact from outside N = 0 is a solution too; starting
// from `held` finds the impulse by which a self-locking sliding joint jams, if there is one.
//
// Only joints with Coulomb's law take part; a smooth law gives no impulse.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "simulate/contact/contact_problem.hpp"

namespace trammel::simulate {

class BearingImpulses {
 public:
  enum class From { nothing, held };

  // Computes the loads that unit impulses on these participants cause in the bearings among them. The system is at
  // `state` and returns there.
  void prepare(model::AssembledSystem& system, const State& state, const std::vector<Participant>& who);
  // `problem` has been prepared for the same participants. Sets `given` of the bearings to their loads. `applied`:
  // reaction impulses in addition to those of the impulses sought.
  [[nodiscard]] complementarity::ContactSolution solve(ContactProblem& problem, double at_rest, From from,
                                                       const Vec& applied);
  [[nodiscard]] complementarity::ContactSolution solve(ContactProblem& problem, double at_rest, From from) {
    return solve(problem, at_rest, from, Vec::Zero(reaction_.rows()));
  }
  // Joins those islands of the participants (ContactProblem::islands) that act on each other through the load of a
  // bearing.
  std::vector<std::size_t> join(std::vector<std::size_t> islands, const std::vector<Participant>& who) const;
  // Reaction impulses caused by the impulses N and T of the participants.
  Vec reaction(const std::vector<Participant>& who) const;

 private:
  struct Column {
    std::size_t who;
    int row;  // 0: normal
  };
  Vec loads(const std::vector<Participant>& who, const Vec& reaction) const;
  double large_load(const std::vector<Participant>& who) const;

  model::AssembledSystem* system_ = nullptr;
  std::vector<std::size_t> bearings_;  // among the participants
  std::vector<Column> columns_;
  Vec response_;  // [1/kg] change of each column's rate by its own impulse
  Mat reaction_;  // of the bilateral rows, by column
};

// True if the contact entry is a joint that takes part.
inline bool rubs_in_impacts(const model::ContactEntry& contact) {
  return contact.joint && contact.coulomb;
}

}  // namespace trammel::simulate
