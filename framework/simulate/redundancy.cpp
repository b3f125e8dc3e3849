#include "simulate/redundancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/QR>

namespace trammel::simulate {
namespace {

constexpr int most_rows = 1000;          // the search is dense: n^3 operations
constexpr int most_groups = 60;          // each is left out once, and a state is looked for without it
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

  // Positions by Newton's method with steps of minimum norm, then velocities and accelerations, which are linear.
  bool can_hold(State s) const {
    double before = std::numeric_limits<double>::infinity();
    Vec dq, q;
    for (int i = 0; i < 30; ++i) {
      system_.move_to(s.t, s.q, s.v);
      const Vec g = rows_of(system_.g());
      if (!g.allFinite() || (g.norm() > 0.5 * before && g.norm() > tolerance)) return false;
      before = g.norm();
      if (before < 1e-3 * tolerance) break;
      dq = -minimum_norm(g);
      system_.retract(s.q, dq, q);
      s.q = q;
    }
    if (!(before < tolerance)) return false;

    system_.move_to(s.t, s.q, s.v);
    const Vec dv = -minimum_norm(rows_of(system_.g_dot()));
    s.v += dv;
    system_.move_to(s.t, s.q, s.v);
    if (!(rows_of(system_.g_dot()).norm() < tolerance * std::max(1.0, s.v.norm()))) return false;

    Vec gamma;
    system_.constraint_acceleration(Vec::Zero(system_.sizes().nv), gamma);
    const Vec wanted = -rows_of(gamma);
    const Vec a = minimum_norm(wanted);
    system_.constraint_acceleration(a, gamma);
    return rows_of(gamma).norm() < 1e-6 * std::max(1.0, wanted.norm());
  }

 private:
  Vec rows_of(const Vec& all) const {
    std::vector<double> some;
    for (const model::RowGroup& rows : groups_)
      some.insert(some.end(), all.data() + rows.first, all.data() + rows.first + rows.count);
    return Eigen::Map<const Vec>(some.data(), Eigen::Index(some.size()));
  }

  // x of least norm with G x = r, in the least-squares sense.
  Vec minimum_norm(const Vec& r) const {
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
  const std::vector<model::RowGroup> all = row_groups(system.model());
  if (int(all.size()) > most_groups || system.model().sizes.nc > most_rows) return paths;
  if (Chosen(system, all).can_hold(start)) return paths;
  std::vector<model::RowGroup> conflict = all;
  for (const model::RowGroup& one : all) {
    std::vector<model::RowGroup> rest = conflict;
    std::erase_if(rest, [&](const model::RowGroup& rows) { return rows.first == one.first; });
    if (!Chosen(system, rest).can_hold(start)) conflict = std::move(rest);
  }
  for (const model::RowGroup& rows : conflict) paths.push_back(rows.path);
  return paths;
}

}  // namespace trammel::simulate
