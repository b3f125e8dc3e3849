#include "every_mode.hpp"

#include <cmath>

#include "feasible_point.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Index;
using Tangent = ContactPoint::Tangent;

enum class Mode { open, pressing, sticking, sliding_forward, sliding_backward };

std::vector<Mode> modes_of(const ContactPoint& p) {
  std::vector<Mode> modes;
  if (p.normal >= 0) modes.push_back(Mode::open);
  if (!p.held()) {
    modes.push_back(Mode::pressing);
  } else {
    modes.insert(modes.end(), {Mode::sticking, Mode::sliding_forward, Mode::sliding_backward});
  }
  return modes;
}

// a = A F + b with F = G x + f: `zero` rows of a vanish, `positive` ones times their sign are >= 0.
class OneMode {
 public:
  OneMode(const Problem& problem, const std::vector<Mode>& modes) : problem_(problem), f_(Vec::Zero(problem.b.size())) {
    for (std::size_t i = 0; i < modes.size(); ++i) add(problem.points[i], modes[i]);
  }

  // Accelerations in units of b, forces so that A's diagonal is 1; columns have length 1 then.
  bool has_forces(Vec& F) const {
    const Index n = Index(edges_.size()), slacks = Index(positive_.size()), m = Index(zero_.size()) + slacks;
    Mat G(problem_.b.size(), n);
    for (Index k = 0; k < n; ++k) G.col(k) = edges_[std::size_t(k)];
    const Mat response = problem_.A * G;
    const Vec rest = problem_.A * f_ + problem_.b;
    Mat B = Mat::Zero(m, n + slacks);
    Vec d(m);
    for (Index i = 0; i < Index(zero_.size()); ++i) {
      B.row(i).head(n) = response.row(zero_[std::size_t(i)]);
      d[i] = -rest[zero_[std::size_t(i)]];
    }
    for (Index i = 0; i < slacks; ++i) {
      const auto [row, sign] = positive_[std::size_t(i)];
      B.row(m - slacks + i).head(n) = sign * response.row(row);
      B(m - slacks + i, n + i) = -1;
      d[m - slacks + i] = -sign * rest[row];
    }
    std::vector<std::pair<Index, Index>> sums = balances_;
    B.conservativeResize(m + Index(sums.size()), Eigen::NoChange);
    d.conservativeResize(m + Index(sums.size()));
    for (Index i = 0; i < Index(sums.size()); ++i) {
      B.row(m + i).setZero();
      B(m + i, sums[std::size_t(i)].first) = B(m + i, sums[std::size_t(i)].second) = 1;
      d[m + i] = 1;
    }
    for (Index i = 0; i < B.rows(); ++i)
      if (const double size = B.row(i).norm(); size > 0 && i < m) B.row(i) /= size, d[i] /= size;
    Vec scale = B.colwise().norm();
    for (double& s : scale) s = s > 0 ? 1 / s : 1;
    const double size = d.size() > 0 && d.lpNorm<Eigen::Infinity>() > 0 ? d.lpNorm<Eigen::Infinity>() : 1;
    Vec x;
    const double missed = feasible_point(B * scale.asDiagonal(), d / size, x);
    if (!(missed <= 1e-6)) return false;  // the law itself decides
    F = f_ + size * (G * scale.head(n).cwiseProduct(x.head(n)));
    return true;
  }

 private:
  void add(const ContactPoint& p, Mode mode) {
    if (mode == Mode::open) return positive_.push_back({p.normal, 1.0});
    if (p.normal >= 0) zero_.push_back(p.normal);
    if (mode == Mode::pressing) {
      if (p.normal < 0) return;
      Vec edge = Vec::Unit(f_.size(), p.normal);
      if (p.slides()) edge[p.tangent] = p.ratio[0];
      edges_.push_back(edge);
      return;
    }
    if (mode == Mode::sticking) {
      zero_.push_back(p.tangent);
      add_edge(p, 1), add_edge(p, -1);
      // Under a given N both together are c N.
      if (p.normal < 0) balances_.push_back({Index(edges_.size()) - 2, Index(edges_.size()) - 1});
      return;
    }
    const double way = mode == Mode::sliding_forward ? 1 : -1;
    positive_.push_back({p.tangent, way});
    if (p.normal >= 0)
      add_edge(p, -way);
    else
      f_[p.tangent] = -way * p.coefficient * p.given;
  }

  void add_edge(const ContactPoint& p, double way) {
    Vec edge = Vec::Zero(f_.size());
    if (p.normal >= 0) edge[p.normal] = 1;
    edge[p.tangent] = way * p.coefficient * (p.normal >= 0 ? 1 : p.given);
    edges_.push_back(edge);
  }

  const Problem& problem_;
  Vec f_;
  std::vector<Vec> edges_;
  std::vector<Index> zero_;
  std::vector<std::pair<Index, double>> positive_;
  std::vector<std::pair<Index, Index>> balances_;
};

}  // namespace

bool exists_in_some_mode(const Problem& problem, Vec& F) {
  std::vector<std::vector<Mode>> all;
  for (const ContactPoint& p : problem.points) all.push_back(modes_of(p));
  std::vector<std::size_t> at(all.size(), 0);
  for (;;) {
    std::vector<Mode> modes;
    for (std::size_t i = 0; i < all.size(); ++i) modes.push_back(all[i][at[i]]);
    if (OneMode(problem, modes).has_forces(F) && offence(problem, F, problem.A * F + problem.b) <= little(problem, F))
      return true;
    std::size_t i = 0;
    while (i < all.size() && ++at[i] == all[i].size()) at[i++] = 0;
    if (i == all.size()) return false;
  }
}

}  // namespace trammel::complementarity
