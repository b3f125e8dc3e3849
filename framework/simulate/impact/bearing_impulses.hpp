// Joints that rub, in an impact: Coulomb's law on the impulses with which their bearings guide.
//
//     M dv + G_b^T Lambda = sum_i D_i F_i      F [N s]: impulses on contacts, and of friction in joints, along the
//     directions D
//     N = sum_k |p_k|,  p = L Lambda           [N s] the load of a joint (system/point/joint_friction.cpp), its
//     reaction impulse Lambda
//     |T| <= mu_0 N where s+ = 0,  T = -mu N s+/|s+| elsewhere
//
// Lambda is linear in F. With loads N given it is the problem of contact_problem.hpp, and the loads Phi(N) follow from
// its solution. What is sought is N = Phi(N). There is one wherever that problem has a continuous solution, since large
// loads hold all joints, which bounds Phi (Brouwer). Rounds N <- Phi(N) end at the least where Phi grows; those that
// come to no end are continued by Newton's method. A joint that locks itself while it slides, Phi > N on the way, so
// comes to rest.
//
// `held`: from loads so large that all joints are held. Without an impact from outside N = 0 solves it, too; this finds
// the impulse by which a sliding joint that locks itself jams, if it has one.
//
// Of joints Coulomb's law takes part; a smooth law gives no impulse.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "simulate/contact/contact_problem.hpp"

namespace trammel::simulate {

class BearingImpulses {
 public:
  enum class From { nothing, held };

  // What impulses on these participants load the bearings among them; the system is at `state`, and is left there.
  void prepare(model::AssembledSystem& system, const State& state, const std::vector<Participant>& who);
  // The problem is prepared, for the same participants. Fills `given` of the bearings: their loads. `applied`: reaction
  // impulses beside those of the impulses sought.
  [[nodiscard]] complementarity::ContactSolution solve(ContactProblem& problem, double at_rest, From from,
                                                       const Vec& applied);
  [[nodiscard]] complementarity::ContactSolution solve(ContactProblem& problem, double at_rest, From from) {
    return solve(problem, at_rest, from, Vec::Zero(reaction_.rows()));
  }
  // Of the islands of the participants (ContactProblem::islands), those together that act on each other by way of the
  // load of a bearing.
  std::vector<std::size_t> join(std::vector<std::size_t> islands, const std::vector<Participant>& who) const;
  // By the impulses N and T of the participants.
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
  Vec response_;  // [1/kg] of each column's rate by its own impulse
  Mat reaction_;  // of the bilateral rows, by columns
};

// Whether a contact of the model is a joint that takes part.
inline bool rubs_in_impacts(const model::ContactEntry& contact) {
  return contact.joint && contact.coulomb;
}

}  // namespace trammel::simulate
