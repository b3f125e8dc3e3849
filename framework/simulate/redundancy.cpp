#include "simulate/redundancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/QR>

namespace trammel::simulate {
namespace {

constexpr int most_rows = 1000;          // dense: n^3 operations
constexpr double rank_tolerance = 1e-7;  // sine of a row's angle to those before it
constexpr double tolerance = 1e-8;       // [m], [rad] and their rates: what counts as satisfied

// G^T at the system's point, column by column.
Mat transposed_rows(model::AssembledSystem& system) {
  const Sizes n = system.sizes();
  Mat Gt(n.nv, n.nc);
  Vec column;
  for (int i = 0; i < n.nc; ++i) {
    column.setZero(n.nv);
    system.add_rows_force(1, Vec::Unit(n.nc, i), column);
    Gt.col(i) = column;
  }
  return Gt;
}

// Rows of chosen joints and bodies.
class Chosen {
 public:
  Chosen(model::AssembledSystem& system, std::vector<model::RowGroup> groups)
      : system_(system), groups_(std::move(groups)) {}

  // Positions, then velocities and accelerations, which are linear. What the velocities are beyond those that the rows ask for must
  // not count: where their rank is about to change no motion may go on from them.
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
  // Newton's method with steps of minimum norm, shorter ones where they do not help.
  bool find_positions(State& s) const {
    constexpr double least_step = 1e-2, least_gain = 0.1;
    double now = move_to(s, s.q);
    for (int i = 0; i < 50 && now > 1e-3 * tolerance; ++i) {
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
    return now < tolerance;
  }
  double move_to(const State& s, const Vec& q) const {
    system_.move_to(s.t, q, s.v);
    return rows_of(system_.g()).norm();
  }

  bool find_velocities(State& s) const {
    system_.move_to(s.t, s.q, s.v);
    s.v -= minimum_norm(rows_of(system_.g_dot()));
    system_.move_to(s.t, s.q, s.v);
    return rows_of(system_.g_dot()).norm() < tolerance * std::max(1.0, s.v.norm());
  }

  bool has_accelerations() const {
    Vec gamma;
    system_.constraint_acceleration(Vec::Zero(system_.sizes().nv), gamma);
    const Vec wanted = -rows_of(gamma);
    const Vec a = minimum_norm(wanted);
    system_.constraint_acceleration(a, gamma);
    return rows_of(gamma).norm() < 1e-6 * std::max(1.0, wanted.norm());
  }

  Vec rows_of(const Vec& all) const {
    std::vector<double> some;
    for (const model::RowGroup& rows : groups_)
      some.insert(some.end(), all.data() + rows.first, all.data() + rows.first + rows.count);
    return Eigen::Map<const Vec>(some.data(), Eigen::Index(some.size()));
  }

  // x of least norm with G x = r, in the least-squares sense.
  Vec minimum_norm(const Vec& r) const {
    if (r.size() == 0) return Vec::Zero(system_.sizes().nv);
    const Mat Gt = transposed_rows(system_);
    Mat G(r.size(), Gt.rows());
    Eigen::Index i = 0;
    for (const model::RowGroup& rows : groups_) {
      G.middleRows(i, rows.count) = Gt.middleCols(rows.first, rows.count).transpose();
      i += rows.count;
    }
    Eigen::CompleteOrthogonalDecomposition<Mat> decomposition;
    decomposition.setThreshold(rank_tolerance);
    decomposition.compute(G);
    return decomposition.solve(r);
  }

  model::AssembledSystem& system_;
  std::vector<model::RowGroup> groups_;
};

}  // namespace

std::vector<RedundantRows> redundant_rows(model::AssembledSystem& system, const State& state) {
  std::vector<RedundantRows> found;
  if (system.model().sizes.nc > most_rows) return found;
  system.move_to(state.t, state.q, state.v);
  const Mat Gt = transposed_rows(system);
  Mat basis(Gt.rows(), std::min(Gt.rows(), Gt.cols()));
  Eigen::Index rank = 0;
  for (const model::RowGroup& rows : row_groups(system.model())) {
    RedundantRows here{rows.path, 0, rows.count};
    for (int i = rows.first; i < rows.first + rows.count; ++i) {
      Vec part = Gt.col(i);
      const double length = part.norm();
      for (int twice = 0; twice < 2; ++twice)  // a second pass removes what round-off left of the first
        part -= basis.leftCols(rank) * (basis.leftCols(rank).transpose() * part);
      if (rank < basis.cols() && part.norm() > rank_tolerance * length)
        basis.col(rank++) = part.normalized();
      else
        ++here.redundant;
    }
    if (here.redundant > 0) found.push_back(std::move(here));
  }
  return found;
}

std::vector<std::string> smallest_conflict(model::AssembledSystem& system, const State& start) {
  std::vector<std::string> paths;
  std::vector<model::RowGroup> conflict = row_groups(system.model());
  if (system.model().sizes.nc > most_rows || Chosen(system, conflict).can_hold(start)) return paths;
  // Half of them at a time, then fewer: of many rows few conflict.
  for (std::size_t part = std::max<std::size_t>(1, conflict.size() / 2);; part /= 2) {
    for (std::size_t at = 0; at < conflict.size();) {
      std::vector<model::RowGroup> rest = conflict;
      const auto first = rest.begin() + std::ptrdiff_t(at);
      rest.erase(first, first + std::ptrdiff_t(std::min(part, rest.size() - at)));
      if (Chosen(system, rest).can_hold(start))
        at += part;
      else
        conflict = std::move(rest);
    }
    if (part == 1) break;
  }
  for (const model::RowGroup& rows : conflict) paths.push_back(rows.path);
  return paths;
}

std::string told(const std::vector<std::string>& conflict) {
  if (conflict.size() == 1) return fmt::format("{} alone cannot hold from there", conflict[0]);
  return fmt::format("{} prescribe motions that contradict each other; without any one of them the rest can hold",
                     fmt::join(conflict, ", "));
}

}  // namespace trammel::simulate
