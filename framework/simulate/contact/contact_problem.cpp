#include "simulate/contact/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <trammel/decompositions.hpp>

#include "complementarity/exact_modes.hpp"
#include "complementarity/islands.hpp"
#include "complementarity/shares/carrying_equations.hpp"
#include "simulate/contact/ending_impulses.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

namespace {

// The part of x that belongs to the tangents of a contact.
Eigen::VectorBlock<Vec> along(Vec& x, const complementarity::ContactPoint& p) {
  return x.segment(p.tangent, p.tangents);
}

// Rates of the rows that carry appear at most as many times in a row that they hold. A larger factor shows that the
// carrying rows are about to depend on each other (a strut that becomes upright).
constexpr double most_times = 1e3;

// The bound of friction that no longer holds its contact is reduced by this part, which exceeds the round-off of
// solutions, so that the contact is found to slide.
constexpr double below_bound = 1e-8;

// Contacts that yield do so by this part of the largest approach in their island.
constexpr double part_of_approach = 1e-3;

// Relative to the largest acceleration: those that count as 0 once a vanishing approach is taken out of a solution that
// was found with it. It exceeds the change by the approach and by `part_of_approach` of it.
constexpr double judged_at_rest = 1e-4;

// Takes the tangents from `point`, and returns them as those of a contact whose normal force is given.
complementarity::ContactPoint apart(complementarity::ContactPoint& point, double pressed) {
  complementarity::ContactPoint tangents = point;
  tangents.normal = -1;
  tangents.given = pressed;
  point.tangent = -1;
  point.kind = complementarity::ContactPoint::Tangent::none;
  return tangents;
}

// Static or kinetic coefficient.
double bound_of(const Participant& p) {
  if (p.yielded) return (1 - below_bound) * p.mu;
  return p.let_go ? p.mu : p.mu_0;
}

}  // namespace

void ContactProblem::prepare(model::AssembledSystem& system) {
  directions_.clear();
  points_.clear();
  pushed_.clear();
  by_rows_.clear();
  for (const Participant& p : who) {
    complementarity::ContactPoint point;
    if (p.unilateral) point.normal = int(directions_.size()), directions_.push_back({p.contact, 0});
    if (p.given_pushes && p.tangent == Participant::Tangent::sliding) {
      pushed_.push_back({points_.size(), Eigen::Index(directions_.size())});
      directions_.push_back({p.contact, 1});
    } else if (p.tangent != Participant::Tangent::none) {
      point.tangent = int(directions_.size()), point.tangents = system.tangents(p.contact);
      for (int k = 0; k < point.tangents; ++k) directions_.push_back({p.contact, 1 + k});
    }
    points_.push_back(point);
    const SetValuedFriction* const friction = system.model().contacts[std::size_t(p.contact)].coulomb;
    by_rows_.push_back(friction && friction->decide() == SetValuedFriction::Decide::at_events);
  }
  system.impulse_response(directions_, jump_, delassus_);
}

// Participants that did not take part nearby have no forces there; their accelerations are those of this problem.
complementarity::NearbySolution ContactProblem::forces_of(const std::vector<Participant>& nearby) const {
  if (nearby.empty()) return {};
  std::vector<const Participant*> known;
  for (const Participant& p : who) {
    const auto same = [&p](const Participant& other) { return other.contact == p.contact; };
    const auto found = std::find_if(nearby.begin(), nearby.end(), same);
    known.push_back(found == nearby.end() ? nullptr : &*found);
  }
  Vec F = Vec::Zero(b_.size());
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (!known[i]) continue;
    if (points_[i].normal >= 0) F[points_[i].normal] = known[i]->N;
    if (points_[i].tangent >= 0) along(F, points_[i]) = known[i]->T.head(points_[i].tangents);
  }
  Vec a = delassus_ * F + b_;
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (!known[i]) continue;
    if (points_[i].normal >= 0) a[points_[i].normal] = known[i]->a_n;
    if (points_[i].tangent >= 0) along(a, points_[i]) = known[i]->a_t.head(points_[i].tangents);
  }
  return {F, a};
}

// In the order of b; NaN in islands where nothing has slid, and where a force is unknown. Empty if nothing has slid.
Vec ContactProblem::pressed_until_now() const {
  if (std::none_of(who.begin(), who.end(), [](const Participant& p) { return p.slid_until_now; })) return {};
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> island = islands();
  std::vector<bool> slid(who.size(), false);
  for (std::size_t i = 0; i < who.size(); ++i) slid[island[i]] = slid[island[i]] || who[i].slid_until_now;
  Vec N = Vec::Constant(b_.size(), unknown);
  for (std::size_t i = 0; i < who.size(); ++i)
    if (points_[i].normal >= 0 && slid[island[i]]) N[points_[i].normal] = who[i].pressed_until_now.value_or(unknown);
  return N;
}

complementarity::ContactSolution ContactProblem::solve_once(const Mat& A, const std::vector<Participant>& nearby,
                                                            Search search) {
  for (std::size_t i = 0; i < who.size(); ++i) {
    const Participant& p = who[i];
    complementarity::ContactPoint& point = points_[i];
    point.given = p.given;
    if (p.tangent == Participant::Tangent::resting)
      point.kind = complementarity::ContactPoint::Tangent::resting, point.coefficient = bound_of(p);
    else if (p.tangent == Participant::Tangent::sliding)
      point.kind = complementarity::ContactPoint::Tangent::sliding, point.ratio = p.ratio;
  }
  std::vector<complementarity::ContactPoint> points = points_;
  std::vector<double> nothing, violation;
  for (const Participant& p : who) nothing.push_back(p.nothing);
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (who[i].slides_under_springs()) points[i].kind = complementarity::ContactPoint::Tangent::none;
    if (who[i].tangent != Participant::Tangent::resting || who[i].pressed < 0) continue;
    points.push_back(apart(points[i], who[i].pressed));
    nothing.push_back(who[i].nothing);
  }
  const complementarity::ContactSolution solution = complementarity::solve_contacts(
      points, A, b_, F_, a_, nothing, violation, {forces_of(nearby), pressed_until_now()}, search);
  for (std::size_t i = 0; i < who.size(); ++i) who[i].violation = violation[i];
  return solution;
}

// Contacts that depend on each other, as a stack between floor and ceiling, cannot all part again. They yield a little:
// for the impulses that end a slip, by a small part of their approach, so that no slip outlasts the approach.
Mat ContactProblem::yielding() const {
  Mat A = delassus_;
  for (const complementarity::Island& island : complementarity::islands(points_, delassus_)) {
    double approach = 0;
    for (const std::size_t i : island.members) approach = std::max(approach, -who[i].vanishing);
    const double largest = b_(island.rows).lpNorm<Eigen::Infinity>();
    for (const Eigen::Index k : island.rows)
      if (largest > 0) A(k, k) *= 1 + part_of_approach * approach / largest;
  }
  return A;
}

complementarity::ContactSolution ContactProblem::solve(double nothing) {
  for (Participant& p : who) p.nothing = nothing;
  return solve();
}

// b: accelerations without the forces sought, and with the known ones: those of participants that are pushed, and the
// friction of those that slide under the forces of springs.
void ContactProblem::set_known_accelerations() {
  b_.resize(Eigen::Index(directions_.size()));
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (points_[i].normal >= 0) b_[points_[i].normal] = who[i].a_n + who[i].vanishing;
    if (points_[i].tangent >= 0) along(b_, points_[i]) = who[i].a_t.head(points_[i].tangents);
  }
  for (const Pushed& p : pushed_) b_[p.direction] = who[p.who].a_t[0];
  for (const Pushed& p : pushed_) b_ += push(p) * delassus_.col(p.direction);
  for (std::size_t i = 0; i < who.size(); ++i)
    if (const auto& point = points_[i]; who[i].slides_under_springs())
      b_ += who[i].pressed * delassus_.middleCols(point.tangent, point.tangents) * who[i].ratio.head(point.tangents);
}

// With rigid contacts; if these have no solution for vanishing approaches, with contacts that yield.
complementarity::ContactSolution ContactProblem::solve_rigid_or_yielding(const std::vector<Participant>& nearby,
                                                                         Search search) {
  complementarity::ContactSolution solution = solve_once(delassus_, nearby, search);
  const bool approach = std::any_of(who.begin(), who.end(), [](const Participant& p) { return p.vanishing < 0; });
  if (solution.outcome != LcpOutcome::solved && approach) solution = solve_once(yielding(), {}, search);
  // Without a solution for a vanishing approach, contacts that do not approach may still have one.
  if (solution.outcome == LcpOutcome::no_solution && approach) solution.outcome = LcpOutcome::gave_up;
  return solution;
}

// Tangents that their friction does not hold let go. True if mu < mu_0 for any of them: the problem has changed.
bool ContactProblem::let_slipping_go() {
  bool changed = false;
  for (std::size_t i = 0; i < who.size(); ++i) {
    Participant& p = who[i];
    if (p.tangent != Participant::Tangent::resting || p.let_go) continue;
    if (along(a_, points_[i]).norm() <= no_slip(i)) continue;
    p.let_go = true;
    changed = changed || p.mu < p.mu_0;
  }
  return changed;
}

void ContactProblem::take_found() {
  for (const Pushed& p : pushed_) F_[p.direction] = push(p);
  for (std::size_t i = 0; i < who.size(); ++i) {
    Participant& p = who[i];
    if (p.slides_under_springs()) along(F_, points_[i]) = p.pressed * p.ratio.head(points_[i].tangents);
    p.N = p.given;
    if (points_[i].normal >= 0) p.N = F_[points_[i].normal], p.a_n = a_[points_[i].normal];
    if (const int n = points_[i].tangents; points_[i].tangent >= 0)
      p.T.head(n) = along(F_, points_[i]), p.a_t.head(n) = along(a_, points_[i]);
    p.no_slip = no_slip(i);
  }
}

complementarity::ContactSolution ContactProblem::solve(const std::vector<Participant>& nearby, Search search) {
  set_known_accelerations();
  complementarity::ContactSolution solution;
  do {
    solution = solve_rigid_or_yielding(nearby, search);
    if (solution.outcome != LcpOutcome::solved) return solution;
  } while (let_slipping_go());
  if (!let_approaches_vanish()) solution.outcome = LcpOutcome::gave_up;
  take_found();
  return solution;
}

double ContactProblem::no_slip(std::size_t participant) const {
  const complementarity::ContactPoint& p = points_[participant];
  const double nothing = who[participant].nothing;
  if (p.tangent < 0) return 0;
  const auto rows = Eigen::seqN(p.tangent, p.tangents);
  const Vec terms = b_(rows).cwiseAbs() + delassus_(rows, Eigen::all).cwiseAbs() * F_.cwiseAbs();
  const double round_off =
      complementarity::scale_of_slip(complementarity::round_off_of_slip * terms.maxCoeff(), nothing);
  return std::min(nothing, std::max(who[participant].least_slip, round_off));
}

bool ContactProblem::let_approaches_vanish() {
  bool any = false;
  for (std::size_t i = 0; i < who.size(); ++i)
    if (who[i].vanishing < 0) any = true, b_[points_[i].normal] -= who[i].vanishing;
  if (!any) return true;
  for (const complementarity::Island& island : complementarity::islands(points_, delassus_)) {
    double nothing = 0;
    for (const std::size_t i : island.members) nothing = std::max(nothing, who[i].nothing);
    const Mat A = delassus_(island.rows, island.rows);
    const Vec b = b_(island.rows);
    Vec F = F_(island.rows), a = A * F + b;
    if (!complementarity::make_exact(island.points, A, b, judged_at_rest, F, a)) return false;
    if (!(complementarity::violation(island.points, A, b, F, a, nothing) <= complementarity::largest_violation))
      return false;
    F_(island.rows) = F, a_(island.rows) = a;
  }
  return true;
}

std::vector<complementarity::ContactRole> ContactProblem::roles(const model::Modes& modes) const {
  using Tangent = complementarity::ContactRole::Tangent;
  using Friction = model::ContactMode::Friction;
  std::vector<complementarity::ContactRole> roles;
  for (std::size_t i = 0; i < who.size(); ++i) {
    const Participant& p = who[i];
    const model::ContactMode& mode = modes.contacts[std::size_t(p.contact)];
    complementarity::ContactRole& role = roles.emplace_back();
    role.closed = mode.closed;
    role.idle = p.idle;
    const bool slides = mode.friction == Friction::slide || p.tangent == Participant::Tangent::sliding;
    if (mode.closed && mode.friction == Friction::stick && by_rows_[i]) role.tangent = Tangent::sticks;
    if (mode.closed && p.unilateral && slides) role.tangent = Tangent::slides;
  }
  return roles;
}

std::vector<bool> ContactProblem::kept_closed(const std::vector<double>& nothing) const {
  std::vector<Eigen::Index> pressing;
  for (std::size_t i = 0; i < who.size(); ++i) {
    const Participant& p = who[i];
    if (p.unilateral && p.N > 0) pressing.push_back(points_[i].normal);
    const bool sticks = p.tangent == Participant::Tangent::resting && p.N > 0 && p.a_t.norm() <= p.no_slip;
    for (int k = 0; k < points_[i].tangents && sticks; ++k) pressing.push_back(points_[i].tangent + k);
  }
  std::vector<bool> kept(who.size(), false);
  for (std::size_t i = 0; i < who.size(); ++i)
    if (who[i].unilateral && who[i].N == 0 && who[i].a_n <= nothing[i])
      kept[i] = complementarity::follows(delassus_, pressing, points_[i].normal);
  return kept;
}

std::vector<double> ContactProblem::largest_in_island() const {
  const std::vector<std::size_t> island = islands();
  std::vector<double> of_island(who.size(), 0), all;
  for (std::size_t i = 0; i < who.size(); ++i) of_island[island[i]] = std::max(of_island[island[i]], who[i].N);
  for (const std::size_t k : island) all.push_back(of_island[k]);
  return all;
}

std::vector<double> ContactProblem::find_idle(const model::Modes& modes, const std::vector<double>& none) {
  for (Participant& p : who) p.idle = false;
  const std::vector<complementarity::ContactRole> role = roles(modes);
  const complementarity::CarryingRows carrying = complementarity::carrying_rows(points_, delassus_, role);
  const std::vector<std::size_t> island = islands();
  const std::vector<double> largest = largest_in_island();
  std::vector<double> least(who.size(), 1);
  std::vector<bool> sliding_shares(who.size(), false);  // by island
  for (std::size_t i = 0; i < who.size(); ++i)
    if (carrying.indeterminate[i] && who[i].unilateral &&
        role[i].tangent == complementarity::ContactRole::Tangent::slides)
      sliding_shares[island[i]] = true;
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (!sliding_shares[island[i]]) continue;
    if (!role[i].closed || !who[i].unilateral || !carrying.indeterminate[i]) continue;
    const double part = largest[i] > 0 ? who[i].N / largest[i] : 0;
    who[i].idle = part <= none[island[i]];
    if (!who[i].idle) least[island[i]] = std::min(least[island[i]], part);
  }
  return least;
}

std::vector<bool> ContactProblem::held_by_others(const model::Modes& modes) const {
  const complementarity::CarryingRows carrying = complementarity::carrying_rows(points_, delassus_, roles(modes));
  const auto& [basis, implied, K] = carrying.rows;
  const Vec length = delassus_.diagonal().cwiseSqrt();
  std::vector<bool> held(who.size(), false);
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (!who[i].idle) continue;
    const auto row = std::find(implied.begin(), implied.end(), Eigen::Index(points_[i].normal)) - implied.begin();
    if (row == std::ssize(implied)) continue;
    const double times = K.row(row).transpose().cwiseProduct(length(basis)).lpNorm<1>();
    held[i] = times <= most_times * length[points_[i].normal];
  }
  return held;
}

// Contacts that carry may come to depend on others, or on each other, as bodies slide. Therefore all rows of an island
// with idle contacts are one group, whichever of them depend on each other at present.
std::vector<complementarity::SharingGroup> ContactProblem::groups_with_idle(
    const std::vector<complementarity::ContactRole>& role, std::vector<bool>& in_them) const {
  using Tangent = complementarity::ContactRole::Tangent;
  std::vector<complementarity::SharingGroup> groups;
  in_them.assign(who.size(), false);
  for (const complementarity::Island& island : complementarity::islands(points_, delassus_)) {
    std::vector<Eigen::Index> rows, idle;
    std::vector<std::size_t> sliding;
    for (const std::size_t i : island.members) {
      const complementarity::ContactPoint& p = points_[i];
      if (role[i].closed && p.normal >= 0) {
        rows.push_back(p.normal);
        if (role[i].idle) idle.push_back(p.normal);
        if (role[i].tangent == Tangent::slides) sliding.push_back(i);
      }
      for (int k = 0; k < p.tangents && role[i].tangent == Tangent::sticks; ++k) rows.push_back(p.tangent + k);
    }
    if (idle.empty()) continue;
    std::optional<complementarity::SharingGroup> group = complementarity::group_with_idle(delassus_, rows, idle);
    if (!group) continue;
    group->sliding = std::move(sliding);
    groups.push_back(std::move(*group));
    for (const std::size_t i : island.members) in_them[i] = true;
  }
  return groups;
}

std::vector<model::SharedRows> ContactProblem::shared_rows(const model::Modes& modes) const {
  const std::vector<complementarity::ContactRole> role = roles(modes);
  const auto directions = [this](const std::vector<Eigen::Index>& rows) {
    std::vector<model::ContactDirection> all;
    for (const Eigen::Index row : rows) all.push_back(directions_[std::size_t(row)]);
    return all;
  };
  std::vector<model::SharedRows> groups;
  const auto add = [&](const complementarity::SharingGroup& group) {
    groups.push_back({directions(group.basis), directions(group.implied), group.K, group.share, {}});
    for (const std::size_t i : group.sliding) groups.back().sliding.push_back(who[i].contact);
  };
  std::vector<bool> with_idle;
  for (const complementarity::SharingGroup& group : groups_with_idle(role, with_idle)) add(group);
  std::vector<int> of_others;
  for (std::size_t i = 0; i < who.size(); ++i)
    if (!with_idle[i]) of_others.push_back(who[i].contact);
  const complementarity::CarryingRows carrying = complementarity::carrying_rows(points_, delassus_, role);
  for (const complementarity::SharingGroup& group : complementarity::sharing_groups(points_, role, carrying)) {
    const int contact = directions_[std::size_t(group.implied.front())].contact;
    if (std::find(of_others.begin(), of_others.end(), contact) != of_others.end()) add(group);
  }
  return groups;
}

double ContactProblem::distance_from_critical(const model::Modes& modes) const {
  const std::vector<complementarity::ContactRole> role = roles(modes);
  double least = 1;
  for (const complementarity::Island& island : complementarity::islands(points_, delassus_)) {
    std::vector<complementarity::ContactRole> own;
    for (const std::size_t i : island.members) own.push_back(role[i]);
    const Mat A = delassus_(island.rows, island.rows);
    const complementarity::CarryingRows carrying = complementarity::carrying_rows(island.points, A, own);
    const auto least_pivot = [&] {
      const Vec none = Vec::Zero(A.rows());
      return complementarity::CarryingEquations(island.points, A, none, own, carrying).least_pivot();
    };
    const double without_friction = least_pivot();
    for (std::size_t k = 0; k < own.size(); ++k)
      if (own[k].tangent == complementarity::ContactRole::Tangent::slides) own[k].ratio = who[island.members[k]].ratio;
    if (without_friction > 0) least = std::min(least, least_pivot() / without_friction);
  }
  return least;
}

double ContactProblem::acceleration_without(std::size_t participant) const {
  const complementarity::ContactPoint& p = points_[participant];
  double own = delassus_(p.normal, p.normal) * F_[p.normal];
  if (p.tangent >= 0)
    own += delassus_.row(p.normal).segment(p.tangent, p.tangents).dot(F_.segment(p.tangent, p.tangents));
  return a_[p.normal] - own;
}

double ContactProblem::deceleration_to_spare(std::size_t participant) const {
  const complementarity::ContactPoint& point = points_[participant];
  const Participant& p = who[participant];
  const double stiff = delassus_.block(point.tangent, point.tangent, point.tangents, point.tangents).trace();
  return stiff / point.tangents * (p.mu * p.N - p.T.norm());
}

std::vector<std::size_t> ContactProblem::islands() const {
  return complementarity::island_of_each(points_, delassus_);
}

void ContactProblem::jump(Vec& dv) const {
  dv.noalias() = jump_ * F_;
}

Vec ContactProblem::rates(model::AssembledSystem& system) const {
  Vec all(Eigen::Index(directions_.size()));
  for (std::size_t k = 0; k < directions_.size(); ++k) all[Eigen::Index(k)] = system.rate(directions_[k]);
  return all;
}

std::vector<double> ContactProblem::independent_slip(const Vec& rates) const {
  std::vector<Eigen::Index> held, others;
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (points_[i].normal >= 0) held.push_back(points_[i].normal);
    if (points_[i].tangent < 0 || who[i].tangent == Participant::Tangent::none) continue;
    std::vector<Eigen::Index>& rows = who[i].tangent == Participant::Tangent::resting ? held : others;
    for (int k = 0; k < points_[i].tangents; ++k) rows.push_back(points_[i].tangent + k);
  }
  const std::vector<Eigen::Index> basis = complementarity::find_basis(delassus_, held).basis;
  const Vec independent = complementarity::beside_basis(delassus_, basis, others, rates);
  std::vector<double> all(who.size(), std::numeric_limits<double>::infinity());
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (who[i].tangent != Participant::Tangent::sliding || points_[i].tangent < 0) continue;
    all[i] = independent.segment(first, points_[i].tangents).norm();
    first += points_[i].tangents;
  }
  return all;
}

// By island: unilateral normals, and tangents at rest.
std::vector<std::vector<Eigen::Index>> ContactProblem::islands_at_rest() const {
  const std::vector<std::size_t> island = islands();
  std::vector<std::vector<Eigen::Index>> rows(who.size());
  for (std::size_t i = 0; i < who.size(); ++i) {
    std::vector<Eigen::Index>& own = rows[island[i]];
    if (points_[i].normal >= 0) own.push_back(points_[i].normal);
    if (who[i].tangent != Participant::Tangent::resting) continue;
    for (int k = 0; k < points_[i].tangents; ++k) own.push_back(points_[i].tangent + k);
  }
  std::erase_if(rows, [](const std::vector<Eigen::Index>& own) { return own.empty(); });
  return rows;
}

void ContactProblem::come_to_rest(model::AssembledSystem& system, Vec& dv) const {
  const Vec all = rates(system);
  dv.setZero(jump_.rows());
  for (const std::vector<Eigen::Index>& held : islands_at_rest())
    dv.noalias() += jump_(Eigen::all, held) * ending_impulses(delassus_(held, held), all(held));
}

void ContactProblem::end_slip(Vec& dv) const {
  Vec slip = Vec::Zero(Eigen::Index(directions_.size()));
  for (std::size_t i = 0; i < who.size(); ++i)
    if (who[i].tangent == Participant::Tangent::resting) along(slip, points_[i]) = who[i].a_t.head(points_[i].tangents);
  dv.setZero(jump_.rows());
  for (const std::vector<Eigen::Index>& held : islands_at_rest())
    dv.noalias() += jump_(Eigen::all, held) * ending_impulses(delassus_(held, held), slip(held));
}

}  // namespace trammel::simulate
