#include "simulate/impact/bearing_impulses.hpp"

#include <algorithm>
#include <limits>

#include <trammel/decompositions.hpp>

namespace trammel::simulate {
namespace {

using complementarity::ContactSolution;
using complementarity::LcpOutcome;

constexpr int most_rounds = 60;
// Of the largest load: largest difference between two rounds, some units of the round-off of a solution.
constexpr double settled = 1e-13;
// Of the largest load: step of the differences. The function is piecewise linear, or nearly so: they are taken on that
// side of N to which the rounds go, so that they belong to its piece also where N is next to a kink.
constexpr double difference = 1e-6;
constexpr double shortest_step = 1e-3;  // of Newton's method
// Of the largest load by an impulse: a smaller load is round-off of the reactions.
constexpr double no_load = 1e-9;

// Modes in which rows hold all participants.
model::Modes all_held(const model::AssembledSystem& system, const std::vector<Participant>& who) {
  model::Modes modes = system.modes();
  modes.shared.clear();
  for (const Participant& p : who) {
    model::ContactMode& mode = modes.contacts[std::size_t(p.contact)];
    mode.closed = true;
    const bool sticks = p.tangent != Participant::Tangent::none;
    mode.friction = sticks ? model::ContactMode::Friction::stick : model::ContactMode::Friction::none;
  }
  return modes;
}

}  // namespace

void BearingImpulses::prepare(model::AssembledSystem& system, const State& state, const std::vector<Participant>& who) {
  system_ = &system;
  bearings_.clear(), columns_.clear();
  std::vector<model::ContactDirection> directions;
  const auto add = [&](std::size_t i, int row) {
    columns_.push_back({i, row});
    directions.push_back({who[i].contact, row});
  };
  for (std::size_t i = 0; i < who.size(); ++i) {
    const bool joint = system.model().contacts[std::size_t(who[i].contact)].joint.has_value();
    if (joint) bearings_.push_back(i);
    if (!joint) add(i, 0);
    const bool along = who[i].tangent == Participant::Tangent::resting;
    for (int k = 1; k <= system.tangents(who[i].contact) && along; ++k) add(i, k);
  }
  if (bearings_.empty()) return;
  Mat jump, delassus;
  system.impulse_response(directions, jump, delassus);
  response_ = delassus.diagonal();
  const Mat held = Mat(system.sparse_rows()).topRows(system.held_rows()).transpose();
  const Eigen::CompleteOrthogonalDecomposition<Mat> reactions(held);
  const model::Modes before = system.modes();
  system.set_modes(all_held(system, who));
  system.move_to(state.t, state.q, state.v);
  reaction_.resize(held.cols(), Eigen::Index(columns_.size()));
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    Vec on_rows = Vec::Zero(system.sizes().nc), left = Vec::Zero(system.sizes().nv);
    if (const int row = system.row(directions[k]); row >= 0) on_rows[row] = 1;
    system.add_reaction(1, on_rows, left);
    system.add_mass_times(-1, jump.col(Eigen::Index(k)), left);
    reaction_.col(Eigen::Index(k)) = Vec(reactions.solve(left));
  }
  system.set_modes(before);
  system.move_to(state.t, state.q, state.v);
}

Vec BearingImpulses::reaction(const std::vector<Participant>& who) const {
  Vec sum = Vec::Zero(reaction_.rows());
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Participant& p = who[columns_[k].who];
    sum += (columns_[k].row == 0 ? p.N : p.T[columns_[k].row - 1]) * reaction_.col(Eigen::Index(k));
  }
  return sum;
}

std::vector<std::size_t> BearingImpulses::join(std::vector<std::size_t> islands,
                                               const std::vector<Participant>& who) const {
  Mat by_column(Eigen::Index(bearings_.size()), bearings_.empty() ? 0 : Eigen::Index(columns_.size()));
  for (Eigen::Index k = 0; k < by_column.cols(); ++k) by_column.col(k) = loads(who, reaction_.col(k));
  const double least = by_column.size() > 0 ? no_load * by_column.maxCoeff() : 0;
  for (Eigen::Index j = 0; j < by_column.rows(); ++j)
    for (Eigen::Index k = 0; k < by_column.cols(); ++k) {
      if (!(by_column(j, k) > least)) continue;
      const std::size_t joined = islands[bearings_[std::size_t(j)]], other = islands[columns_[std::size_t(k)].who];
      std::replace(islands.begin(), islands.end(), other, joined);
    }
  return islands;
}

Vec BearingImpulses::loads(const std::vector<Participant>& who, const Vec& reaction) const {
  Vec N(Eigen::Index(bearings_.size()));
  Vec lambda = Vec::Zero(std::max(Eigen::Index(system_->sizes().nc), reaction.size()));
  lambda.head(reaction.size()) = reaction;
  for (std::size_t j = 0; j < bearings_.size(); ++j)
    N[Eigen::Index(j)] = system_->normal_force(who[bearings_[j]].contact, lambda);
  return N;
}

// Loads that hold every bearing against all motions.
double BearingImpulses::large_load(const std::vector<Participant>& who) const {
  double impulses = 0, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Participant& p = who[columns_[k].who];
    const double rate = columns_[k].row == 0 ? p.a_n : p.a_t[columns_[k].row - 1];
    if (const double response = response_[Eigen::Index(k)]; response > 0) impulses += std::abs(rate) / response;
  }
  for (const std::size_t j : bearings_)
    if (who[j].mu > 0) least = std::min(least, who[j].mu);
  return std::isfinite(least) ? 1e6 * impulses / least : 0;
}

ContactSolution BearingImpulses::solve(ContactProblem& problem, double at_rest, From from, const Vec& applied) {
  if (bearings_.empty()) return problem.solve(at_rest);
  const std::vector<Participant> asked = problem.who;
  ContactSolution solution;
  const auto follow = [&](const Vec& N) {  // Phi
    problem.who = asked;
    for (std::size_t j = 0; j < bearings_.size(); ++j) problem.who[bearings_[j]].given = N[Eigen::Index(j)];
    solution = problem.solve(at_rest);
    return loads(asked, applied + reaction(problem.who));
  };
  const auto n = Eigen::Index(bearings_.size());
  const auto missed = [&](const Vec& N, const Vec& next) {
    return (next - N).lpNorm<Eigen::Infinity>() / std::max(next.lpNorm<Eigen::Infinity>(), 1e-300);
  };
  const auto newton_step = [&](const Vec& N, const Vec& next) {
    Mat slope = Mat::Identity(n, n);
    const double size = difference * std::max(N.maxCoeff(), next.maxCoeff());
    for (Eigen::Index j = 0; j < n; ++j) {
      const double d = next[j] < N[j] && N[j] > size ? -size : size;
      slope.col(j) -= (follow(N + d * Vec::Unit(n, j)) - next) / d;
    }
    const Vec step = Eigen::FullPivLU<Mat>(slope).solve(next - N);
    return step.allFinite() ? step : Vec(next - N);
  };
  Vec N = Vec::Constant(n, from == From::held ? large_load(asked) : 0);
  Vec next = follow(N);
  for (int round = 0; round < most_rounds; ++round) {
    if (solution.outcome != LcpOutcome::solved) return solution;
    const double left = missed(N, next);
    if (left <= settled) return solution;
    const bool newton = round >= 10;
    const Vec from_here = N, step = newton ? newton_step(N, next) : Vec(next - N);
    for (double part = 1; part > shortest_step; part /= 2) {
      N = (from_here + part * step).cwiseMax(0);
      next = follow(N);
      if (!newton || solution.outcome != LcpOutcome::solved || missed(N, next) < left) break;
    }
  }
  solution.violation = missed(N, next);
  solution.outcome = LcpOutcome::gave_up;
  return solution;
}

}  // namespace trammel::simulate
