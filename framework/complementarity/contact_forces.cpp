#include "complementarity/contact_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "complementarity/contact_order.hpp"
#include "complementarity/exact_modes.hpp"
#include "complementarity/forces_at_rest.hpp"
#include "complementarity/islands.hpp"
#include "complementarity/mode_search.hpp"
#include "complementarity/programs/friction_cone.hpp"
#include "complementarity/programs/polyhedral_cone.hpp"
#include "complementarity/shares/pressing_forces.hpp"
#include "complementarity/shares/row_basis.hpp"

namespace trammel::complementarity {
namespace {

// Relative to the largest entry of A: compliances of the contacts, tried in this order; a compliance selects one of
// several solutions. If rows depend on each other, the first ones exceed the perturbation of Lemke's method, so that it
// ends where springs do.
constexpr double compliances[] = {1e-10, 0.0}, dependent_compliances[] = {1e-6, 1e-8, 1e-10, 0.0};
// Relative to the largest: accelerations that count as 0 when exact modes are sought. Those of compliant contacts carry
// the round-off of pivoting, about 1e-10; a contact at rest that is taken to slide can lead to another solution, a
// wedge.
constexpr double judged_at_rest[] = {1e-8, 1e-12};
// A violation as small is the round-off of A F (1e-4 of its terms): no better solution is sought.
constexpr double round_off = 1e-11;
// Relative to b: accelerations of rows that springs may keep closed. They are those of compliant contacts, as above.
constexpr double judged_closed = 1e-8;
// Relative to b: forces whose round-off in A F exceeds this part of b are no solution.
constexpr double most_lost = 1e-4;
// Relative to the largest acceleration of a contact and of all forces: forces that cause less are round-off.
constexpr double round_off_of_forces = 1e-13;
// Largest number of contacts whose modes are searched, and of sets of modes.
constexpr std::size_t few_contacts = 24, few_round_contacts = 4;
constexpr int most_nodes = 20000;

class Cascade {
 public:
  Cascade(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double nothing)
      : points_(points), A_(A), b_(b), nothing_(nothing) {
    for (const ContactPoint& p : points_) {
      friction_ = friction_ || p.held() || p.slides();
      round_ = round_ || (p.held() && p.tangents == 2);
    }
  }

  ContactSolution solve(const Preference& first, ModeSearch search, Vec& F) {
    if (!friction_) return without_friction(F);
    dependent_ = !independent();
    if (first.N.size() > 0 && rests(first.N)) return found(F);
    if (first.nearby.F.size() > 0 && continues(first.nearby)) return found(F);
    for (const double yields : dependent_ ? std::span<const double>(dependent_compliances) : compliances)
      if (by_pivoting(yields)) return found(F);
    if (round_ && (try_cones(0, Vec::Zero(b_.size())) || (best_.size() > 0 && try_cones(0, best_)))) return found(F);
    if (!round_ && least_ > largest_violation) try_cones(0, best_.size() > 0 ? best_ : Vec(Vec::Zero(b_.size())));
    if (least_ <= largest_violation) return found(F);
    if (search == ModeSearch::of_few_contacts && points_.size() <= (round_ ? few_round_contacts : few_contacts)) {
      const LcpOutcome outcome = search_modes(points_, A_, b_, most_nodes, [this](const Vec& near) {
        round_ ? try_cones(0, near, 1) : accept(near);
        return least_ <= largest_violation;
      });
      if (outcome == LcpOutcome::solved) return found(F);
      if (outcome == LcpOutcome::no_solution) return {LcpOutcome::no_solution, least_};
    }
    Vec swept = Vec::Zero(b_.size());
    if (sweep_cones(points_, A_, b_, swept)) accept(swept);
    if (least_ <= largest_violation) return found(F);
    return {LcpOutcome::gave_up, least_};
  }

 private:
  bool rests(const Vec& N) {
    const std::optional<Vec> held = forces_at_rest(points_, A_, b_, N);
    return held && accept(*held);
  }

  // In its modes, or by Newton's method from its forces.
  bool continues(const NearbySolution& nearby) { return accept(nearby.F, nearby.a) || try_cones(0, nearby.F); }

  ContactSolution without_friction(Vec& F) {
    Vec pressing = Vec::Zero(b_.size());
    std::vector<Eigen::Index> normals;
    for (const ContactPoint& p : points_)
      if (p.normal >= 0) normals.push_back(p.normal);
    Vec N;
    const LcpOutcome outcome = pressing_forces(A_(normals, normals), b_(normals), N);
    for (std::size_t k = 0; k < normals.size(); ++k) pressing[normals[k]] = N[Eigen::Index(k)];
    if (outcome == LcpOutcome::no_solution)
      return {outcome, violation(points_, A_, b_, Vec::Zero(b_.size()), nothing_)};
    accept(pressing);
    if (least_ <= largest_violation) return found(F);
    return {LcpOutcome::gave_up, least_};
  }

  bool by_pivoting(double yields) {
    const PolyhedralCone cone(points_, A_, b_, yields);
    Vec z, w;
    if (solve_lcp(cone.M(), cone.q(), z, w) != LcpOutcome::solved) return false;
    const Vec near = cone.forces(z);
    if (!round_) return accept(near, compliant(yields) * near + b_);
    if (yields > 0 && try_cones(yields, near)) return true;
    return (yields == 0 || !dependent_) && try_cones(0, near);
  }

  bool independent() const {
    std::vector<Eigen::Index> rows(std::size_t(b_.size()));
    std::iota(rows.begin(), rows.end(), Eigen::Index(0));
    return find_basis(A_, rows).implied.empty();
  }

  Mat compliant(double yields) const {
    return A_ + yields * A_.diagonal().maxCoeff() * Mat::Identity(A_.rows(), A_.cols());
  }

  // Newton's method on the cones. Compliant contacts lead it to that of several solutions which springs have; from
  // there the rigid solution is near.
  bool try_cones(double yields, const Vec& start, int rounds = 40) {
    Vec F = start;
    if (yields > 0) {
      if (!solve_cones(points_, compliant(yields), b_, F, rounds)) return false;
      Vec springs;
      if (dependent_ && try_springs(compliant(yields) * F + b_, F, springs) && accept(springs)) return true;
    }
    const bool found = solve_cones(points_, A_, b_, F, rounds);
    return accept(F) && found;
  }

  // Exact shares of equal springs: adds a stiffness against forces along the self-stress of the carrying rows, which
  // makes these forces 0. Rows of idle contacts resist their forces alone, so these are 0 as well. `a`: accelerations
  // of `nearby`.
  bool try_springs(const Vec& a, const Vec& nearby, Vec& F) {
    std::vector<ContactRole> roles = roles_of(points_, nearby, a, judged_closed * b_.lpNorm<Eigen::Infinity>());
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (const int row = points_[i].normal; row >= 0 && !(nearby[row] > 0)) roles[i] = {};
    CarryingRows carrying = carrying_rows(points_, A_, roles);
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!roles[i].closed && follows(A_, carrying.rows.basis, points_[i].normal))
        roles[i].closed = roles[i].idle = true;
    carrying = carrying_rows(points_, A_, roles);
    std::vector<Eigen::Index> rows = carrying.rows.basis;
    rows.insert(rows.end(), carrying.rows.implied.begin(), carrying.rows.implied.end());
    const Eigen::Index n = Eigen::Index(rows.size());
    Mat springs = A_;
    springs(rows, rows) +=
        A_.diagonal().maxCoeff() * (Mat::Identity(n, n) - carrying.share * carrying.rows.resultants());
    F = nearby;
    return solve_cones(points_, springs, b_, F);
  }

  // Keeps the exact solution near `nearby` if it is the best so far, or `nearby` itself if there is no exact one. In
  // space the directions of slip may be known better before, so the better of both counts. True: no better one is
  // needed.
  bool accept(const Vec& nearby) { return accept(nearby, A_ * nearby + b_); }
  bool accept(const Vec& nearby, const Vec& a) {
    for (const double off : judged_at_rest) {
      Vec exact = nearby, a_exact = a, springs;
      if (!make_exact(points_, A_, b_, off, exact, a_exact)) continue;
      keep(exact, a_exact);
      if (round_ && dependent_ && least_ > round_off && try_springs(a_exact, exact, springs))
        keep(springs, A_ * springs + b_);
      if ((!round_ || dependent_) && least_ <= round_off) return true;
    }
    if (round_ || least_ > largest_violation) keep(nearby, A_ * nearby + b_);
    return least_ <= round_off;
  }

  void keep(const Vec& F, const Vec& a) {
    if (friction_ && lost_in_round_off(F)) return;
    const double violated = violation(points_, A_, b_, F, a, nothing_);
    if (!(violated < least_)) return;
    least_ = violated;
    best_ = F;
  }

  // True if A F has lost b in round-off: such forces are no solution (Painleve's critical coefficient).
  bool lost_in_round_off(const Vec& F) const {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    return eps * (A_.cwiseAbs() * F.cwiseAbs()).maxCoeff() > most_lost * b_.lpNorm<Eigen::Infinity>();
  }

  ContactSolution found(Vec& F) const {
    F = best_;
    return {LcpOutcome::solved, least_};
  }

  const std::vector<ContactPoint>& points_;
  const Mat& A_;
  const Vec& b_;
  double nothing_;
  bool friction_ = false, round_ = false, dependent_ = false;  // round: cones in space; dependent: rows of A
  Vec best_;
  double least_ = std::numeric_limits<double>::infinity();
};

// Sets to 0 what is 0 by the conditions.
class WithoutRoundOff {
 public:
  WithoutRoundOff(const Mat& A, const Vec& b, Vec& F, Vec& a) : A_(A), F_(F), a_(a) {
    const Vec from_forces = A.cwiseAbs() * F.cwiseAbs();
    terms_ = b.cwiseAbs() + from_forces;
    largest_ = b.lpNorm<Eigen::Infinity>() + from_forces.lpNorm<Eigen::Infinity>();
  }

  void clear(const ContactPoint& p) {
    const double N = p.normal >= 0 ? clear_normal(p) : p.given;
    if (p.tangent < 0 || p.kind == ContactPoint::Tangent::none) return;
    if (p.kind == ContactPoint::Tangent::sliding)
      F_.segment(p.tangent, p.tangents) = N * p.ratio.head(p.tangents);
    else if (const double bound = p.held() ? p.coefficient * N : 0; bound > 0)
      clear_tangents(p, bound);
    else
      F_.segment(p.tangent, p.tangents).setZero();
  }

 private:
  // Returns the normal force. The round-off of a force is one that causes accelerations as small as theirs: it is
  // smaller where bodies are light.
  double clear_normal(const ContactPoint& p) {
    const bool presses = A_(p.normal, p.normal) * F_[p.normal] > round_off_of_forces * largest_;
    F_[p.normal] = presses ? F_[p.normal] : 0;
    a_[p.normal] = presses ? 0 : std::max(0.0, a_[p.normal]);
    return F_[p.normal];
  }

  // If the force that would make a_t = 0 exceeds the bound, the contact slides; otherwise it is held, and a_t is
  // round-off, that of the terms along its own tangents. Where joints hold the tangent (a slider-crank at a dead
  // centre), A is 0 there and no friction holds it.
  void clear_tangents(const ContactPoint& p, double bound) {
    auto T = F_.segment(p.tangent, p.tangents);
    auto a_t = a_.segment(p.tangent, p.tangents);
    const double stiff = A_.block(p.tangent, p.tangent, p.tangents, p.tangents).trace() / p.tangents;
    const Vec asked = stiff > 0 ? Vec(T - a_t / stiff) : Vec(-a_t);  // [N], or its direction
    const double caused = stiff > 0 ? stiff * asked.norm() : a_t.norm();
    const double own = terms_.segment(p.tangent, p.tangents).maxCoeff();
    const bool slides = caused > stiff * bound + round_off_of_slip * scale_of_slip(own, largest_);
    if (!slides) a_t.setZero();
    if (slides)
      T = bound * asked.normalized();
    else if (const double size = T.norm(); size > bound)
      T *= bound / size;
  }

  const Mat& A_;
  Vec &F_, &a_;
  Vec terms_;       // sums of the absolute values of the terms of a
  double largest_;  // of all of them
};

ContactSolution solve_island(const Island& island, const Mat& A, const Vec& b, Vec& F, Vec& a, double nothing,
                             const Preference& first, ModeSearch search) {
  const OrderedContacts ordered(island.points, A, b);
  const NearbySolution& nearby = first.nearby;
  Vec F_ordered;
  Preference begin;
  if (first.N.size() > 0) begin.N = ordered.ordered(first.N(island.rows));
  if (nearby.F.size() > 0)
    begin.nearby = {ordered.ordered(nearby.F(island.rows)), ordered.ordered(nearby.a(island.rows))};
  const ContactSolution solution =
      Cascade(ordered.points(), ordered.A(), ordered.b(), nothing).solve(begin, search, F_ordered);
  if (solution.outcome != LcpOutcome::solved) return solution;
  Vec a_ordered = ordered.A() * F_ordered + ordered.b();
  WithoutRoundOff both(ordered.A(), ordered.b(), F_ordered, a_ordered);
  for (const ContactPoint& p : ordered.points()) both.clear(p);
  F = ordered.as_named(F_ordered);
  a = ordered.as_named(a_ordered);
  return solution;
}

}  // namespace

ContactSolution solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a,
                               double nothing) {
  std::vector<double> violation;
  return solve_contacts(points, A, b, F, a, std::vector<double>(points.size(), nothing), violation);
}

ContactSolution solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a,
                               const std::vector<double>& nothing, std::vector<double>& violation,
                               const Preference& first, ModeSearch search) {
  F.setZero(b.size());
  a.setZero(b.size());
  violation.assign(points.size(), 0);
  if (b.size() == 0) return {LcpOutcome::solved, 0};
  if (!A.allFinite() || !b.allFinite()) return {LcpOutcome::gave_up, std::numeric_limits<double>::infinity()};
  ContactSolution all{LcpOutcome::solved, 0};
  Vec F_island, a_island;
  for (const Island& island : islands(points, A)) {
    if (island.rows.empty()) continue;
    double counts_as_0 = 0;
    for (const std::size_t i : island.members) counts_as_0 = std::max(counts_as_0, nothing[i]);
    const ContactSolution one = solve_island(island, A(island.rows, island.rows), b(island.rows), F_island, a_island,
                                             counts_as_0, first, search);
    for (const std::size_t i : island.members) violation[i] = one.violation;
    if (one.outcome != LcpOutcome::solved) {
      F.setZero(), a.setZero();
      return one;
    }
    all.violation = std::max(all.violation, one.violation);
    F(island.rows) = F_island;
    a(island.rows) = a_island;
  }
  return all;
}

}  // namespace trammel::complementarity
