// The contacts that take part at one instant, and their forces or impulses: solves the problem of
// complementarity/contact_forces.hpp for a System.
//
// Static and kinetic coefficients: first mu_0 holds every tangent at rest. Tangents that it cannot hold let go: they
// get mu, and the problem is solved again, which checks the others under the remaining forces. At least one more
// tangent lets go in each repetition, so this ends. A tangent that mu holds after all stays at rest.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "complementarity/contact_forces.hpp"
#include "complementarity/shares/carrying_rows.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

using model::Tangential;

// x / |x|; the direction of the first tangent if x is 0.
inline Tangential direction_of(const Tangential& x) {
  const double length = std::hypot(x[0], x[1]);  // of denormal numbers too
  return length > 0 ? Tangential(x / length) : Tangential(1, 0);
}

struct Participant {
  enum class Tangent { none, resting, sliding };
  int contact = 0;
  bool unilateral = true;     // its normal force is unknown
  double given = 0;           // [N] the normal force otherwise
  bool given_pushes = false;  // sliding under `given`, whose friction a_n and a_t do not contain yet
  Tangent tangent = Tangent::none;
  double mu_0 = 0, mu = 0;                    // resting
  Tangential ratio = Tangential::Zero();      // sliding: T / N
  Tangential direction = Tangential::Zero();  // sliding: of the slip velocity, length 1
  bool let_go = false;                        // resting: mu applies from the start; afterwards: mu_0 did not hold it
  bool yielded = false;  // resting, let go: its friction has reached its bound and does not hold it there
  bool slid_until_now = false;
  std::optional<double> pressed_until_now = {};  // [N]
  double pressed = -1;  // [N] the normal force of its friction or of the bound of it, where springs decide it (rule 15)

  double nothing = 0;     // accelerations or velocities up to this count as 0 in its island
  double least_slip = 0;  // resting: |a_t| up to this is no slip, whatever the round-off is
  double vanishing = 0;   // an approach < 0 added to a_n; of several solutions its limit, as it vanishes, is taken

  // Found: force [N] or impulse [N s], and acceleration or velocity, along normal and tangents.
  double N = 0, a_n = 0;
  bool idle = false;  // closed without a force, in a group with dependent rows of which some slide
  Tangential T = Tangential::Zero(), a_t = Tangential::Zero();
  double no_slip = 0;    // |a_t| up to this is no slip
  double violation = 0;  // of the solution of its island

  // True if the friction found is at the bound that this coefficient gives, up to `near_bound` of it: the reduction of
  // a bound to break a tie (contact_problem.cpp) and the round-off of solutions are far smaller.
  bool at_bound(double coefficient) const { return T.norm() > (1 - near_bound) * coefficient * bounding(); }
  double bounding() const { return pressed >= 0 ? pressed : N; }  // [N]
  bool slides_under_springs() const { return unilateral && tangent == Tangent::sliding && pressed >= 0; }
  static constexpr double near_bound = 1e-6;
};

class ContactProblem {
 public:
  std::vector<Participant> who;

  void prepare(model::AssembledSystem& system);  // finds their directions, at the system's point
  // On entry `a_n` and `a_t` of each participant are its accelerations without the forces sought. Each island is a
  // problem of its own: no scale or tolerance of one counts in another. `nearby`: the participants, with what was found
  // for them, at nearly the same state; solutions near these are sought first, after rest where the forces until now
  // are known (forces_at_rest.hpp).
  using Search = complementarity::ModeSearch;
  [[nodiscard]] complementarity::ContactSolution solve(const std::vector<Participant>& nearby = {},
                                                       Search search = Search::of_few_contacts);
  // The same, with one `nothing` for all.
  [[nodiscard]] complementarity::ContactSolution solve(double nothing);
  // [m/s^2] Acceleration of the gap of a unilateral participant without its own force; after `solve`.
  double acceleration_without(std::size_t participant) const;
  // [m/s^2] Further deceleration of a slip that the friction of a resting participant could give; after `solve`.
  double deceleration_to_spare(std::size_t participant) const;
  // By participant: index of its island, less than the number of participants; after `prepare`.
  std::vector<std::size_t> islands() const;
  // Change of v by the forces found, taken as impulses.
  void jump(Vec& dv) const;
  Vec rates(model::AssembledSystem& system) const;  // along their directions [m/s], once prepared
  // [m/s] For participants that slide: the part of their slip that does not follow from the rates of the normals and of
  // the tangents at rest. Infinite where the tangents do not depend on these.
  std::vector<double> independent_slip(const Vec& rates) const;
  // The least change of v that ends the slip `a_t` of all tangents at rest and leaves the unilateral normals alone.
  void end_slip(Vec& dv) const;
  // The least change of v that ends the rates of all unilateral normals and of all tangents at rest; after `prepare`.
  void come_to_rest(model::AssembledSystem& system, Vec& dv) const;
  // By participant: it is unilateral and has no force, and the others keep it closed: its row depends on those of
  // pressing contacts. `nothing`, by participant: accelerations up to this count as 0.
  std::vector<bool> kept_closed(const std::vector<double>& nothing) const;
  // The smallest pivot of the equations of the forces in these modes, relative to that without the friction of sliding
  // contacts: 0 at Painleve's critical state.
  double distance_from_critical(const model::Modes& modes) const;
  // By participant: the largest normal force found in its island.
  std::vector<double> largest_in_island() const;
  // To be called after the modes are decided: finds the idle contacts, those whose force is up to `none` times the
  // largest of their island. Returns the smallest force, as a part of that largest one, of the contacts that could be
  // idle and are not; 1 if there are none. Both are by island.
  std::vector<double> find_idle(const model::Modes& modes, const std::vector<double>& none);
  // In these islands, where no cone is round: replaces the forces found by others that solve the problem, too. They
  // have no more parts along edges of cones than rows at rest are independent, so that no share of them is free. By
  // participant: it is at rest, its force has one part, |T| = mu N, and other rows hold its tangent.
  std::vector<bool> take_fewest_forces(const model::Modes& modes, const std::vector<bool>& asked);
  // By participant, afterwards: it is idle, and the rows of contacts that carry hold it.
  std::vector<bool> held_by_others(const model::Modes& modes) const;
  // Groups of closed contacts whose rows depend on each other, and how they share their resultants.
  std::vector<model::SharedRows> shared_rows(const model::Modes& modes) const;

 private:
  // A participant that slides under a given normal force: a known force along its tangent, not in a_n and a_t yet.
  struct Pushed {
    std::size_t who;
    Eigen::Index direction;
  };
  // A part of a force on an edge of a cone: T = ratio N.
  struct Edge {
    std::size_t who;
    Tangential ratio;
  };
  // Forces of all directions, of which those of contacts with edges are sums of parts x along these.
  struct EdgeForces {
    Vec F, x;
  };
  bool has_round_cone(std::size_t participant, const model::Modes& modes) const;
  Mat directions_of(const std::vector<Edge>& edges) const;
  Vec forces_beside(const std::vector<Edge>& edges) const;
  std::optional<EdgeForces> forces_along(const std::vector<Edge>& edges, const std::vector<Eigen::Index>& rows) const;
  void take_forces(const EdgeForces& found, const std::vector<Edge>& edges, std::vector<bool>& at_edge);
  std::vector<Eigen::Index> rows_at_rest(const std::vector<std::size_t>& members, const model::Modes& modes) const;
  void keep_held(const std::vector<std::size_t>& members, const model::Modes& modes, std::vector<bool>& at_edge) const;
  std::vector<Edge> edges_of(const std::vector<std::size_t>& members, const model::Modes& modes) const;
  std::vector<std::vector<Eigen::Index>> islands_at_rest() const;
  std::vector<complementarity::SharingGroup> groups_with_idle(const std::vector<complementarity::ContactRole>& role,
                                                              std::vector<bool>& in_them) const;
  void set_known_accelerations();
  complementarity::ContactSolution solve_rigid_or_yielding(const std::vector<Participant>& nearby, Search search);
  bool let_slipping_go();
  void take_found();
  complementarity::ContactSolution solve_once(const Mat& A, const std::vector<Participant>& nearby, Search search);
  Vec pressed_until_now() const;
  complementarity::NearbySolution forces_of(const std::vector<Participant>& nearby) const;
  Mat yielding() const;                           // the Delassus matrix of contacts that are not quite rigid
  double no_slip(std::size_t participant) const;  // [m/s^2]
  double push(const Pushed& p) const { return who[p.who].ratio[0] * who[p.who].given; }  // [N]
  // False: no solution was found as the limit of vanishing approaches.
  [[nodiscard]] bool let_approaches_vanish();
  // Rows hold only what is decided at events: a foot whose friction is decided in each evaluation has no row to share.
  std::vector<complementarity::ContactRole> roles(const model::Modes& modes) const;

  std::vector<model::ContactDirection> directions_;
  std::vector<complementarity::ContactPoint> points_;
  std::vector<Pushed> pushed_;
  std::vector<bool> by_rows_;  // by participant: rows hold it where it sticks
  Mat jump_, delassus_;
  Vec b_, F_, a_;
};

}  // namespace trammel::simulate
