// The contacts that take part in one instant, and their forces or impulses: complementarity/contact_forces.hpp for a
// System.
//
// Static and kinetic coefficients: every tangent at rest is first held with mu_0; those that it cannot hold get mu, and
// the problem is solved again, so that the others are checked against what is left. Each repetition lets at least one
// more go, so this ends; a tangent that mu holds after all stays at rest.
#pragma once

#include <vector>

#include "complementarity/contact_forces.hpp"
#include "complementarity/shares/carrying_rows.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

using model::Tangential;

struct Participant {
  enum class Tangent { none, resting, sliding };
  int contact = 0;
  bool unilateral = true;     // its normal force is unknown
  double given = 0;           // [N] else
  bool given_pushes = false;  // where it slides under it: its friction is not in a_n and a_t yet
  Tangent tangent = Tangent::none;
  double mu_0 = 0, mu = 0;                    // resting
  Tangential ratio = Tangential::Zero();      // sliding: T / N
  Tangential direction = Tangential::Zero();  // sliding: of the slip velocity, length 1
  bool let_go = false;                        // resting: mu from the start; in the end: mu_0 did not hold it
  bool yielded = false;  // resting, let go: its friction has reached its bound, it is not held there

  double vanishing = 0;  // of several solutions the one that is left of this approach in addition to a_n

  // Found: force [N] or impulse [N s], and acceleration or velocity, along normal and tangents.
  double N = 0, a_n = 0;
  bool idle = false;  // closed without a force, beside dependent ones that slide
  Tangential T = Tangential::Zero(), a_t = Tangential::Zero();
};

class ContactProblem {
 public:
  std::vector<Participant> who;

  void prepare(model::AssembledSystem& system);  // their directions at the system's point
  // Of each participant: what its normal and its tangent do without the forces to be found, in `a_n` and `a_t`.
  // `nothing`: smaller is 0.
  [[nodiscard]] complementarity::ContactSolution solve(double nothing);
  // Of the gap, of a unilateral participant, without its own force [m/s^2]; after `solve`.
  double acceleration_without(std::size_t participant) const;
  // By how much more its friction could decelerate a slip, of a participant that rests [m/s^2]; after `solve`.
  double deceleration_to_spare(std::size_t participant) const;
  // Of each participant: the number of its island, less than their number; once prepared.
  std::vector<std::size_t> islands() const;
  // Change of v by the forces found as impulses.
  void jump(Vec& dv) const;
  Vec rates(model::AssembledSystem& system) const;  // along their directions [m/s], once prepared
  // Of those that slide along tangents which follow from the normals and from the tangents at rest: the part of their
  // slip that does not follow from the rates of these [m/s]. Infinity where the tangents do not follow.
  std::vector<double> slip_beside_others(const Vec& rates) const;
  // The least change of v that ends the slip `a_t` of all tangents at rest and leaves the unilateral normals alone.
  void end_slip(Vec& dv) const;
  // Unilateral ones without a force that the others keep closed: their rows follow from those of contacts that press.
  std::vector<bool> kept_closed(double nothing) const;
  // In these modes: the least pivot of the equations of their forces, of that which they have without friction of what
  // slides.
  double distance_from_critical(const model::Modes& modes) const;
  // Once their modes are decided: which are idle, and which of those that are closed depend on each other, and how they
  // share.
  void find_idle(const model::Modes& modes);
  std::vector<model::SharedRows> shared_rows(const model::Modes& modes) const;

 private:
  // Sliding under a normal force that is given, but not in a_n and a_t yet: a known force along its tangent.
  struct Pushed {
    std::size_t who;
    Eigen::Index direction;
  };
  complementarity::ContactSolution solve_once(const Mat& A, double nothing);
  Mat yielding() const;  // the Delassus matrix of contacts that are not quite rigid
  double push(const Pushed& p) const { return who[p.who].ratio[0] * who[p.who].given; }  // [N]
  // False: no solution was found that is left of them.
  [[nodiscard]] bool let_approaches_vanish(double nothing);
  // Of what rows hold: a foot whose friction each evaluation decides has none, and shares none.
  std::vector<complementarity::ContactRole> roles(const model::Modes& modes) const;

  std::vector<model::ContactDirection> directions_;
  std::vector<complementarity::ContactPoint> points_;
  std::vector<Pushed> pushed_;
  std::vector<bool> by_rows_;  // by participant: rows hold it where it sticks
  Mat jump_, delassus_;
  Vec b_, F_, a_;
};

}  // namespace trammel::simulate
