// Rule 14 of contact_mode.hpp: forces that leave no share free, where no cone is round.
//
//     F = F_o + D x,   A_R F + b_R = 0,   x >= 0     R: rows at rest;  D: a column (1, ratio) for each edge of a cone;
//                                                    F_o: forces of joints and of other participants
//
// Nonnegative least squares ends at columns that are independent, so at most as many parts x are positive as rows of R
// are independent.
#include <algorithm>
#include <limits>
#include <optional>

#include "complementarity/contact_order.hpp"
#include "complementarity/exact_modes.hpp"
#include "complementarity/islands.hpp"
#include "complementarity/programs/nonnegative_least_squares.hpp"
#include "complementarity/shares/carrying_equations.hpp"
#include "simulate/contact/contact_problem.hpp"

namespace trammel::simulate {
namespace {

// Relative to the accelerations that the forces of an island have to cancel: what they may leave.
constexpr double cancelled = 1e-9;
// Of the largest part of a force: a smaller one is none.
constexpr double no_part = 1e-10;

}  // namespace

std::vector<ContactProblem::Edge> ContactProblem::edges_of(const std::vector<std::size_t>& members,
                                                           const model::Modes& modes) const {
  std::vector<Edge> edges;
  for (const std::size_t i : members) {
    const Participant& p = who[i];
    const model::ContactMode& mode = modes.contacts[std::size_t(p.contact)];
    if (!p.unilateral || !mode.closed) continue;
    if (points_[i].tangent < 0 || p.tangent == Participant::Tangent::none)
      edges.push_back({i, Tangential::Zero()});
    else if (p.tangent == Participant::Tangent::sliding)
      edges.push_back({i, p.ratio});
    else if (mode.friction == model::ContactMode::Friction::slide)
      edges.push_back({i, -p.mu * mode.direction});
    else
      edges.push_back({i, {-p.mu, 0}}), edges.push_back({i, {p.mu, 0}});
  }
  return edges;
}

// Normals that are closed and tangents that stick.
std::vector<Eigen::Index> ContactProblem::rows_at_rest(const std::vector<std::size_t>& members,
                                                       const model::Modes& modes) const {
  std::vector<Eigen::Index> rows;
  for (const std::size_t i : members) {
    const model::ContactMode& mode = modes.contacts[std::size_t(who[i].contact)];
    if (!mode.closed) continue;
    if (points_[i].normal >= 0) rows.push_back(points_[i].normal);
    if (mode.friction == model::ContactMode::Friction::stick) rows.push_back(points_[i].tangent);
  }
  return rows;
}

// Tangents that no other rows hold keep sticking.
void ContactProblem::keep_held(const std::vector<std::size_t>& members, const model::Modes& modes,
                               std::vector<bool>& at_edge) const {
  std::vector<Eigen::Index> rows;
  const auto sticks = [&](std::size_t i) {
    return modes.contacts[std::size_t(who[i].contact)].friction == model::ContactMode::Friction::stick;
  };
  for (const std::size_t i : members) {
    if (!modes.contacts[std::size_t(who[i].contact)].closed) continue;
    if (points_[i].normal >= 0) rows.push_back(points_[i].normal);
    if (sticks(i) && !at_edge[i] && who[i].N > 0) rows.push_back(points_[i].tangent);
  }
  for (const std::size_t i : members) {
    if (!at_edge[i] || !sticks(i) || complementarity::follows(delassus_, rows, points_[i].tangent)) continue;
    at_edge[i] = false;
    rows.push_back(points_[i].tangent);
  }
}

// A contact that sticks in space has a round cone; the force of every other one is a sum of forces along edges.
bool ContactProblem::has_round_cone(std::size_t i, const model::Modes& modes) const {
  const model::ContactMode& mode = modes.contacts[std::size_t(who[i].contact)];
  return points_[i].tangents > 1 && points_[i].tangent >= 0 && mode.friction == model::ContactMode::Friction::stick;
}

// D: a column for each edge.
Mat ContactProblem::directions_of(const std::vector<Edge>& edges) const {
  Mat D = Mat::Zero(F_.size(), Eigen::Index(edges.size()));
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const complementarity::ContactPoint& p = points_[edges[k].who];
    D(p.normal, Eigen::Index(k)) = 1;
    if (p.tangent >= 0) D.col(Eigen::Index(k)).segment(p.tangent, p.tangents) = edges[k].ratio.head(p.tangents);
  }
  return D;
}

// F_o: the forces found, without those of the contacts that have edges.
Vec ContactProblem::forces_beside(const std::vector<Edge>& edges) const {
  Vec others = F_;
  for (const Edge& e : edges) {
    const complementarity::ContactPoint& p = points_[e.who];
    others[p.normal] = 0;
    if (p.tangent >= 0) others.segment(p.tangent, p.tangents).setZero();
  }
  return others;
}

// Solves the equations at the top of this file, columns and right side scaled to length one. None: no x >= 0 solves
// them, or there is nothing to cancel.
std::optional<ContactProblem::EdgeForces> ContactProblem::forces_along(const std::vector<Edge>& edges,
                                                                       const std::vector<Eigen::Index>& rows) const {
  const Mat D = directions_of(edges);
  const Vec others = forces_beside(edges);
  Mat B = delassus_(rows, Eigen::all) * D;
  const Vec length = B.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min());
  B = B * length.cwiseInverse().asDiagonal();
  Vec d = -b_(rows) - delassus_(rows, Eigen::all) * others, x;
  const double size = d.norm();
  if (!(size > 0)) return {};
  d /= size;
  if (!(complementarity::nonnegative_least_squares(B, d, x) <= cancelled)) return {};
  x = (x.array() > no_part * x.maxCoeff()).select(x, 0);
  return EdgeForces{others + size * D * x.cwiseQuotient(length), x};
}

void ContactProblem::take_forces(const EdgeForces& found, const std::vector<Edge>& edges, std::vector<bool>& at_edge) {
  std::vector<int> parts(who.size(), 0);
  for (std::size_t k = 0; k < edges.size(); ++k) parts[edges[k].who] += found.x[Eigen::Index(k)] > 0;
  for (const Edge& e : edges) {
    Participant& p = who[e.who];
    const complementarity::ContactPoint& point = points_[e.who];
    p.N = found.F[point.normal];
    if (point.tangent >= 0) p.T.head(point.tangents) = found.F.segment(point.tangent, point.tangents);
    at_edge[e.who] = p.tangent == Participant::Tangent::resting && parts[e.who] == 1;
  }
}

std::vector<bool> ContactProblem::take_fewest_forces(const model::Modes& modes, const std::vector<bool>& asked) {
  std::vector<bool> at_edge(who.size(), false);
  const std::vector<std::size_t> number = islands();
  for (const complementarity::Island& island : complementarity::islands(points_, delassus_)) {
    const auto is_round = [&](std::size_t i) { return has_round_cone(i, modes); };
    if (!asked[number[island.members.front()]]) continue;
    if (std::any_of(island.members.begin(), island.members.end(), is_round)) continue;
    const Mat A = delassus_(island.rows, island.rows);
    const Vec b = b_(island.rows);
    std::vector<std::size_t> members;  // sorted, since forces are not unique and the first of equal edges is taken
    const complementarity::OrderedContacts ordered(island.points, A, b);
    for (const std::size_t k : ordered.order()) members.push_back(island.members[k]);
    const std::vector<Edge> edges = edges_of(members, modes);
    const std::optional<EdgeForces> found = forces_along(edges, rows_at_rest(members, modes));
    if (!found) continue;
    const double nothing = who[island.members.front()].nothing;
    if (!(complementarity::violation(island.points, A, b, found->F(island.rows), nothing) <=
          complementarity::largest_violation))
      continue;
    take_forces(*found, edges, at_edge);
    keep_held(members, modes, at_edge);
  }
  return at_edge;
}

}  // namespace trammel::simulate
