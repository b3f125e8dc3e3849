#include "complementarity/mode_relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <trammel/decompositions.hpp>

#include "complementarity/programs/nonnegative_least_squares.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Kind = DecidedMode::Kind;

// [1] Relative to b: a smaller residual of the equations does not prove a contradiction.
constexpr double contradictory = 1e-8;
// Cosine between a column and the residual that counts as round-off.
constexpr double no_slope = 1e-9;
// The residual then proves that there are no forces up to this many times those that cause accelerations of the size of
// b.
constexpr double excluded = 1e4;
// Relative to the terms of its sum: an entry of A F_x that is round-off, which is no stiffness.
constexpr double cancelled = 1e-12;
constexpr int sides = 8;  // of the polygon around the disk

Vector2d direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

// B x = d for x >= 0. F = F_x x; each row is an acceleration or a sum.
class Relaxation {
 public:
  Relaxation(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const std::vector<DecidedMode>& modes)
      : A_(A), b_(b) {
    for (std::size_t i = 0; i < points.size(); ++i) add(points[i], modes[i]);
  }

  RelaxedForces solve() const {
    const Index forces = Index(edges_.size()), all = forces + Index(slacks_.size());
    Mat F_x(b_.size(), forces);
    for (Index k = 0; k < forces; ++k) F_x.col(k) = edges_[std::size_t(k)];
    const double size = b_.lpNorm<Eigen::Infinity>() > 0 ? b_.lpNorm<Eigen::Infinity>() : 1;
    const Index m = Index(rows_.size());
    Mat B = Mat::Zero(m + Index(sums_.size()), all);
    Vec d = Vec::Ones(B.rows());
    B.topLeftCorner(m, forces) = without_round_off(A_(rows_, Eigen::all), F_x) / size;
    d.head(m) = -b_(rows_) / size;
    for (Index k = forces; k < all; ++k)
      for (const auto& [row, entry] : slacks_[std::size_t(k - forces)]) B(row, k) = entry;
    for (Index i = 0; i < Index(sums_.size()); ++i)
      B.row(m + i).segment(sums_[std::size_t(i)].first, sums_[std::size_t(i)].count).setOnes();
    Vec x;
    RelaxedForces result;
    const double missed = nonnegative_least_squares(B, d, x);
    result.verdict = verdict(B, d, x, missed);
    result.F = F_x * x.head(forces);
    result.a = A_ * result.F + b_;
    return result;
  }

 private:
  using Slack = std::vector<std::pair<Index, double>>;  // (row, entry) of one column
  struct Sum {
    Index first, count;  // the sum of these x is 1
  };

  // A F_x without its round-off: at Painleve's critical coefficient a stiffness is exactly 0.
  static Mat without_round_off(const Mat& A, const Mat& F_x) {
    const Mat product = A * F_x, size = A.cwiseAbs() * F_x.cwiseAbs();
    return (product.array().abs() > cancelled * size.array()).select(product, 0.0);
  }

  // By Farkas' lemma the residual r = d - B x is a proof that there is no solution: d.r > 0, and no column has a
  // component along r, or one so small that only excessive forces could cancel r.
  static RelaxedForces::Verdict verdict(const Mat& B, const Vec& d, const Vec& x, double missed) {
    if (missed <= contradictory) return RelaxedForces::Verdict::found;
    Vec rest = d - B * x;
    make_orthogonal(B, x, rest);
    const double slope = std::min(no_slope, missed / excluded) * rest.norm();
    for (Index j = 0; j < B.cols(); ++j)
      if (B.col(j).dot(rest) > slope * B.col(j).norm()) return RelaxedForces::Verdict::doubtful;
    return RelaxedForces::Verdict::none;
  }

  // Makes the residual orthogonal to the columns in use, whose B x leaves round-off.
  static void make_orthogonal(const Mat& B, const Vec& x, Vec& rest) {
    std::vector<Index> used;
    for (Index j = 0; j < x.size(); ++j)
      if (x[j] > 0) used.push_back(j);
    if (used.empty()) return;
    const Mat columns = B(Eigen::all, used);
    rest -= columns * Eigen::ColPivHouseholderQR<Mat>(columns).solve(rest);
  }

  void add(const ContactPoint& p, const DecidedMode& mode) {
    if (p.normal >= 0) {
      if (mode.kind == Kind::undecided || mode.kind == Kind::open)
        slacks_.push_back({{Index(rows_.size()), -1.0}});  // a_n - s = 0
      rows_.push_back(p.normal);
      if (mode.kind == Kind::open) return;
    }
    if (!p.held()) {
      if (p.normal >= 0) add_edge(p, p.slides() ? p.ratio : Vector2d::Zero());
    } else {
      const Index first = Index(edges_.size());
      if (mode.kind == Kind::sliding)
        add_side(p, mode.from, mode.to);
      else
        add_cone(p, mode.kind == Kind::sticking);
      if (p.normal < 0) sums_.push_back({first, Index(edges_.size()) - first});
    }
  }

  void add_edge(const ContactPoint& p, const Vector2d& T) {
    Vec edge = Vec::Zero(b_.size());
    const double N = p.normal >= 0 ? 1 : p.given;
    if (p.normal >= 0) edge[p.normal] = N;
    if (p.tangent >= 0) edge.segment(p.tangent, p.tangents) = N * T.head(p.tangents);
    edges_.push_back(edge);
  }

  void add_cone(const ContactPoint& p, bool sticks) {
    for (int k = 0; k < p.tangents && sticks; ++k) rows_.push_back(p.tangent + k);
    if (p.tangents == 1) return add_edge(p, {p.coefficient, 0}), add_edge(p, {-p.coefficient, 0});
    const double outer = p.coefficient / std::cos(std::numbers::pi / sides);
    for (int k = 0; k < sides; ++k) add_edge(p, outer * direction(2 * std::numbers::pi * k / sides));
  }

  // a_t + x_1 e(from) + x_2 e(to) = 0
  void add_side(const ContactPoint& p, double from, double to) {
    for (const double angle : {from, to}) {
      const Vector2d e = direction(angle);
      add_edge(p, p.coefficient * e);
      Slack slack;
      for (int k = 0; k < p.tangents; ++k) slack.push_back({Index(rows_.size()) + k, e[k]});
      slacks_.push_back(slack);
      if (from == to) break;
    }
    if (from != to) add_edge(p, p.coefficient / std::cos((to - from) / 2) * direction((from + to) / 2));
    for (int k = 0; k < p.tangents; ++k) rows_.push_back(p.tangent + k);
  }

  const Mat& A_;
  const Vec& b_;
  std::vector<Vec> edges_;
  std::vector<Index> rows_;  // of a
  std::vector<Slack> slacks_;
  std::vector<Sum> sums_;
};

}  // namespace

RelaxedForces relaxed_forces(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b,
                             const std::vector<DecidedMode>& modes) {
  return Relaxation(points, A, b, modes).solve();
}

}  // namespace trammel::complementarity
