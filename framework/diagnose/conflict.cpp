#include "diagnose/conflict.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <trammel/decompositions.hpp>

#include "diagnose/redundancy.hpp"
#include "run/row_tolerance.hpp"
#include "system/on_rows/onto_rows.hpp"

namespace trammel::simulate {
namespace {

using model::RowGroup;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr int most_rows = 1000;  // at a time: they are dense here, n^3 operations
constexpr int most_newton_steps = 50;
constexpr double well_within = 1e-3;  // of the allowed violation: Newton's method stops there

// Rows of chosen joints and bodies.
class RowSelection {
 public:
  RowSelection(model::AssembledSystem& system, const RowTolerance& allowed, std::vector<RowGroup> groups)
      : system_(system), allowed_(allowed), groups_(std::move(groups)) {}

  // Tests positions, then velocities and accelerations, which are linear. Velocities that the rows do not require must
  // not count: where the rank is about to change, no motion may continue with them.
  bool can_hold(State s) const {
    if (!find_positions(s)) return false;
    const Vec v = s.v;
    for (const Vec& start : {v, Vec(Vec::Zero(v.size()))}) {
      s.v = start;
      if (find_velocities(s) && has_accelerations()) return true;
    }
    return false;
  }

 private:
  // Newton's method with steps of minimum norm, shortened where they do not reduce the residual.
  bool find_positions(State& s) const {
    constexpr double least_step = 1e-2, least_gain = 0.1;
    double now = move_to(s, s.q);
    for (int i = 0; i < most_newton_steps && now > well_within * allowed_.length; ++i) {
      const Vec dq = -minimum_norm(rows_of(system_.g()));
      double step = 1, then = 0;
      Vec q;
      for (; step > least_step; step /= 2) {
        system_.retract(s.q, step * dq, q);
        then = move_to(s, q);
        if (then < (1 - least_gain * step) * now) break;
      }
      if (!(step > least_step)) break;
      s.q = q;
      now = then;
    }
    move_to(s, s.q);
    return now < allowed_.length;
  }
  double move_to(const State& s, const Vec& q) const {
    system_.move_to(s.t, q, s.v);
    return rows_of(system_.g()).norm();
  }

  bool find_velocities(State& s) const {
    system_.move_to(s.t, s.q, s.v);
    s.v -= minimum_norm(rows_of(system_.g_dot()));
    system_.move_to(s.t, s.q, s.v);
    return rows_of(system_.g_dot()).norm() < allowed_.speed;
  }

  bool has_accelerations() const {
    Vec gamma;
    system_.constraint_acceleration(Vec::Zero(system_.sizes().nv), gamma);
    const Vec wanted = -rows_of(gamma);
    const Vec a = minimum_norm(wanted);
    system_.constraint_acceleration(a, gamma);
    return rows_of(gamma).norm() < allowed_.missed_acceleration(wanted.norm());
  }

  Vec rows_of(const Vec& all) const {
    std::vector<double> some;
    for (const RowGroup& rows : groups_)
      some.insert(some.end(), all.data() + rows.first, all.data() + rows.first + rows.count);
    return Eigen::Map<const Vec>(some.data(), Eigen::Index(some.size()));
  }

  // x of least norm with G x = r, in the least-squares sense. Angles count as displacements at their levers, and rows
  // relative to their length, so that dependence does not depend on the unit of length.
  Vec minimum_norm(const Vec& r) const {
    Vec x = Vec::Zero(system_.sizes().nv);
    if (r.size() == 0) return x;
    std::vector<int> columns;  // with entries in these rows
    Mat G = dense_rows(columns);
    if (columns.empty()) return x;
    const Vec per_lever = system_.coordinate_sizes().levers(columns).cwiseInverse();
    G *= per_lever.asDiagonal();
    Vec length = G.rowwise().norm();
    length = (length.array() > 0).select(length, 1);
    G.array().colwise() /= length.array();
    Eigen::CompleteOrthogonalDecomposition<Mat> decomposition;
    decomposition.setThreshold(rank_tolerance);
    decomposition.compute(G);
    const Vec of_unit_rows = r.cwiseQuotient(length), of_columns = decomposition.solve(of_unit_rows);
    x(columns) = of_columns.cwiseProduct(per_lever);
    return x;
  }
  Mat dense_rows(std::vector<int>& columns) const {
    const SparseRows all = system_.sparse_rows();
    std::vector<int> rows, place(std::size_t(all.cols()), -1);
    for (const RowGroup& group : groups_)
      for (int i = group.first; i < group.first + group.count; ++i) {
        rows.push_back(i);
        for (SparseRows::InnerIterator entry(all, i); entry; ++entry) {
          int& at = place[std::size_t(entry.col())];
          if (at < 0) at = int(columns.size()), columns.push_back(int(entry.col()));
        }
      }
    Mat G = Mat::Zero(Eigen::Index(rows.size()), Eigen::Index(columns.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (SparseRows::InnerIterator entry(all, rows[i]); entry; ++entry)
        G(Eigen::Index(i), place[std::size_t(entry.col())]) = entry.value();
    return G;
  }

  model::AssembledSystem& system_;
  RowTolerance allowed_;
  std::vector<RowGroup> groups_;
};

// The violation of each row after steps of Newton's method with all of them: in positions, otherwise in velocities,
// otherwise in accelerations. Rows that were merely inaccurate are then satisfied, conflicting rows are not. Empty: all
// are satisfied.
Vec missed_rows(model::AssembledSystem& system, const RowTolerance& allowed, State s) {
  model::positions_onto_rows(system, s, {.metric = model::by_coordinates, .allowed = allowed.length, .most = 20});
  if (system.g().norm() > allowed.length) return system.g();
  model::velocities_onto_rows(system, s, model::by_coordinates);
  if (system.g_dot().norm() > allowed.speed) return system.g_dot();
  const Vec no_force = Vec::Zero(system.sizes().nv);
  Vec missed, a, mu;
  system.constraint_acceleration(no_force, missed);
  const double wanted = missed.norm();
  system.factorise(model::by_coordinates, no_force, missed, Factors::projection);
  if (system.correct(no_force, missed, a, mu, Factors::projection)) system.constraint_acceleration(a, missed);
  return missed.norm() > allowed.missed_acceleration(wanted) ? missed : Vec();
}

int group_of(int row, const std::vector<RowGroup>& groups) {
  const auto after = std::find_if(groups.begin(), groups.end(),
                                  [row](const RowGroup& group) { return row < group.first + group.count; });
  return int(after - groups.begin());
}

// The groups ordered outwards from `worst`: each shares columns of G with earlier ones.
std::vector<int> outwards(const SparseRows& G, const std::vector<RowGroup>& groups, int worst) {
  std::vector<std::vector<int>> of_column(static_cast<std::size_t>(G.cols()));
  std::vector<int> order = {worst};
  std::vector<char> seen(groups.size(), 0);
  seen[std::size_t(worst)] = 1;
  const auto each_column = [&](const RowGroup& group, auto&& f) {
    for (int i = group.first; i < group.first + group.count; ++i)
      for (SparseRows::InnerIterator entry(G, i); entry; ++entry) f(std::size_t(entry.col()));
  };
  const auto see = [&](int k) {
    if (!seen[std::size_t(k)]) seen[std::size_t(k)] = 1, order.push_back(k);
  };
  for (int k = 0; k < int(groups.size()); ++k)
    each_column(groups[std::size_t(k)], [&](std::size_t column) { of_column[column].push_back(k); });
  for (std::size_t at = 0; at < order.size(); ++at)
    each_column(groups[std::size_t(order[at])], [&](std::size_t column) {
      for (const int other : of_column[column]) see(other);
    });
  return order;
}

std::vector<RowGroup> conflicting(model::AssembledSystem& system, const RowTolerance& allowed, const State& start,
                                  std::vector<RowGroup> groups) {
  return RowSelection(system, allowed, groups).can_hold(start) ? std::vector<RowGroup>() : groups;
}

// Adds groups around `worst` until they cannot be satisfied together. Empty: those of `most_rows` rows can.
std::vector<RowGroup> conflict_around(int worst, model::AssembledSystem& system, const RowTolerance& allowed,
                                      const State& start, const std::vector<RowGroup>& all) {
  system.move_to(start.t, start.q, start.v);
  const std::vector<int> order = outwards(system.sparse_rows(), all, worst);
  std::vector<RowGroup> some;
  for (int enough = 16, taken = 0; some.size() < order.size() && taken < most_rows; enough *= 2) {
    while (some.size() < order.size() && taken < std::min(enough, most_rows))
      taken += some.emplace_back(all[std::size_t(order[some.size()])]).count;
    std::vector<RowGroup> found = conflicting(system, allowed, start, some);
    std::sort(found.begin(), found.end(), [](const RowGroup& a, const RowGroup& b) { return a.first < b.first; });
    if (!found.empty()) return found;
  }
  return {};
}

// A subset such that the others can be satisfied without any `apart` neighbours of it. Half of the groups are left out
// at a time, then fewer, because only few of many rows conflict.
std::vector<RowGroup> smallest_of(std::vector<RowGroup> conflict, std::size_t& apart, model::AssembledSystem& system,
                                  const RowTolerance& allowed, const State& start) {
  constexpr std::size_t most_tries = 100;
  for (std::size_t part = std::max<std::size_t>(1, conflict.size() / 2);; part /= 2) {
    for (std::size_t at = 0; at < conflict.size();) {
      std::vector<RowGroup> rest = conflict;
      const auto first = rest.begin() + std::ptrdiff_t(at);
      rest.erase(first, first + std::ptrdiff_t(std::min(part, rest.size() - at)));
      if (RowSelection(system, allowed, rest).can_hold(start))
        at += part;
      else
        conflict = std::move(rest);
    }
    apart = part;
    if (part == 1 || 2 * conflict.size() / part > most_tries) return conflict;
  }
}

}  // namespace

Conflict smallest_conflict(model::AssembledSystem& system, const State& start) {
  const std::vector<RowGroup> all = row_groups(system.model());
  const RowTolerance allowed = row_tolerance(system, start);
  const int rows = all.empty() ? 0 : all.back().first + all.back().count;
  std::vector<RowGroup> found;
  if (rows <= most_rows) {
    found = conflicting(system, allowed, start, all);
  } else {
    const Vec missed = missed_rows(system, allowed, start);
    if (missed.size() == 0 || !missed.allFinite()) return {};
    Eigen::Index row = 0;
    missed.head(rows).cwiseAbs().maxCoeff(&row);
    const int worst = group_of(int(row), all);
    found = conflict_around(worst, system, allowed, start, all);
    if (found.empty()) return {{all[std::size_t(worst)].path}, false};
  }
  Conflict conflict;
  std::size_t apart = 1;
  for (const RowGroup& group : smallest_of(std::move(found), apart, system, allowed, start))
    conflict.paths.push_back(group.path);
  conflict.smallest = apart == 1;
  return conflict;
}

std::string names(const Conflict& conflict) {
  constexpr std::size_t most = 12, shown = 4;
  const std::vector<std::string>& all = conflict.paths;
  if (all.size() <= most) return fmt::format("{}", fmt::join(all, ", "));
  return fmt::format("{}, ... ({} more) ..., {}", fmt::join(all.begin(), all.begin() + shown, ", "),
                     all.size() - 2 * shown, fmt::join(all.end() - shown, all.end(), ", "));
}

std::string remark(const Conflict& conflict) {
  return conflict.smallest ? "; without any one of them the rest can hold" : "; not all of them need be part of it";
}

std::string description(const Conflict& conflict) {
  if (conflict.paths.size() == 1)
    return conflict.paths[0] + (conflict.smallest ? " alone cannot hold from there" : " is missed most");
  return fmt::format("{} prescribe motions that contradict each other{}", names(conflict), remark(conflict));
}

}  // namespace trammel::simulate
