// Newton's impact law with Coulomb's friction for all contacts that touch, solved together.
//
//     M (v+ - v-) + G_b^T L_b = sum_i n_i L_i + t_i T_i     u_i gap rate [m/s], < 0 when closing; s_i slip velocity
//     G_b v+ = G_b v-                                       bilateral rows keep their rates
//     0 <= L_i  complementary to  u_i+ + e_i u_i- >= 0      for contacts that were open
//     0 <= L_i  complementary to  u_i+ - u_i-     >= 0      for contacts that were closed: they keep u-, a round-off
//     |T_i| <= mu_0 L_i where s_i+ = 0 (it sticks),  T_i = -mu L_i s_i+/|s_i+| elsewhere     (impact_friction.hpp)
//
// L_i, T_i [N s] are the impulses, e_i the restitution of the contact's law at approach speed -u_i-; slower than the
// law's capture_speed e_i = 0.
// Contacts may jam: no impulses part all of them at e_i u_i- (a disc that falls into a groove and that friction holds
// there), or the rates that steps have left in dependent closed contacts contradict each other (a stack that touches
// floor and ceiling). Then the contacts of this island have no rebound, e_i = 0, and end their rates.
// The friction impulse is one Coulomb decision over the whole impact, judged by the slip at its end (Moreau): a slip
// that stops and turns within the impact is not followed, and with e > 0 an eccentric impact may gain energy (Kane's
// paradox), which is reported (impact_warnings.hpp). With the Delassus matrix D this is the problem of
// contact_forces.hpp. Several simultaneous contacts form one problem. Reality may give another result (Pfeiffer,
// Glocker 1996), as a chain of equal balls does. An impact without collision is used where sliding contacts have no
// finite forces (contact_mode.hpp, rule 8). Zero impulse would solve it, too; the solution taken is the limit for
// vanishing approaches, which such contacts cannot end while they slide. If Newton's law has no such solution, the
// course of the impact decides (energetic_impact.hpp).
//
// The energy lost through contact i is -L_i (u_i- + u_i+)/2 - T_i (s_i- + s_i+)/2; the sum is the loss of kinetic
// energy if no row depends on time. Laws that follow the rates through the impact give each contact's part more
// exactly: the difference is `course`.
#pragma once

#include <cmath>
#include <vector>

#include "simulate/contact/contact_problem.hpp"
#include "simulate/impact/bearing_impulses.hpp"

namespace trammel::simulate {

// [1] Times the slip: the approach that starts an impact without collision. It exceeds the error of a solution.
inline constexpr double vanishing_approach = 1e-6;

// A contact that touches, or a joint with friction (bearing_impulses.hpp): its `impulse` is the load of its bearings,
// and its gap has no rate.
struct TouchingContact {
  int contact = 0;
  bool was_closed = false;
  bool without_collision = false;            // its slip must end although nothing approaches
  bool slides = false;                       // before an impact without collision
  bool slides_on = false;                    // without collision: its slip goes on, whatever the impulses
  bool keeps_rates = false;                  // however short the motion that it begins (contact_mode.hpp, rule 2)
  double raised = 0;                         // its coefficients of friction count as larger by this part
  double before = 0;                         // u- [m/s]
  double approach = 0;                       // [m/s] without collision: a vanishing rate, added to u-
  double restitution = 0;                    // e
  std::size_t island = 0;                    // equal for those that act on each other (complementarity/islands.hpp)
  double speed = 0;                          // [m/s] of the impact among these (impact_friction.hpp)
  double impulse = 0;                        // L [N s]
  double after = 0;                          // u+ [m/s]
  Tangential friction = Tangential::Zero();  // T [N s]
  Tangential slip_before = Tangential::Zero(), slip_after = Tangential::Zero();
  // A closed contact that has kept the rate which the steps left in it.
  bool rests_as_before(double rest_speed) const { return was_closed && std::abs(after - before) <= rest_speed; }
  double course = 0;  // [J] loss here minus the loss at the mean rates; the sum over the contacts of an impact is 0
  double energy_lost() const { return course + loss_at_mean_rates(); }
  double loss_at_mean_rates() const {
    return -0.5 * (impulse * (before + after) + friction.dot(slip_before + slip_after));
  }
};

class Impact {
 public:
  // The system is at `state`. On entry `before`, `was_closed` and `restitution` of each contact are set; the jump of v
  // is returned in `dv`. A slip below `at_rest` [m/s] counts as none.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system, const State& state,
                                                       double at_rest, std::vector<TouchingContact>& touching, Vec& dv);

 private:
  BearingImpulses::From gather(model::AssembledSystem& system, std::vector<TouchingContact>& touching);
  void take_coefficients(const model::Model& model, const std::vector<TouchingContact>& touching);
  static double rate_after(const TouchingContact& c, const Participant& p, bool joint, bool jams);
  complementarity::ContactSolution solve_jammed(const std::vector<Participant>& asked, double at_rest,
                                                BearingImpulses::From from,
                                                const std::vector<TouchingContact>& touching, std::vector<bool>& jams);

  ContactProblem problem_;
  BearingImpulses bearings_;
};

}  // namespace trammel::simulate
