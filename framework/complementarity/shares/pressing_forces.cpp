#include "complementarity/shares/pressing_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Relative to A with its diagonal scaled to 1: a smaller pivot shows that a contact depends on the carrying ones [1].
constexpr double dependent = 1e-13;
constexpr double round_off = 1e-14;  // of accelerations
// Of |b| |d|: a larger work b.d proves that nothing gives way. The root of `dependent`: a contact with a smaller pivot
// may still move by as much under d.
constexpr double certain = 3e-7;
// Relative to the forces that accelerations ask for, with A's diagonal scaled to 1.
constexpr double endless = 1e10;
constexpr double no_give = 1e-8;  // root of an entry of its diagonal, of the largest root: below it A is not scaled

class PrincipalPivoting {
 public:
  PrincipalPivoting(const Mat& A, const Vec& b) : scale_(A.diagonal().cwiseMax(0).cwiseSqrt()) {
    const double least = no_give * scale_.maxCoeff();
    for (double& s : scale_) s = s > least ? 1 / s : 1;
    A_ = scale_.asDiagonal() * A * scale_.asDiagonal();
    b_ = scale_.cwiseProduct(b);
    x_.setZero(b.size());
    refused_.assign(std::size_t(b.size()), false);
  }

  LcpOutcome solve(Vec& N) {
    const int most = 50 * int(b_.size()) + 50;
    LcpOutcome outcome = LcpOutcome::gave_up;
    for (int i = 0; i < most && outcome == LcpOutcome::gave_up; ++i) {
      const Eigen::Index j = fastest_approach();
      if (j < 0)
        outcome = LcpOutcome::solved;
      else if (!raise(j))
        outcome = LcpOutcome::no_solution;
    }
    N = scale_.cwiseProduct(outcome == LcpOutcome::no_solution ? balanced_ : x_);
    if (outcome == LcpOutcome::no_solution) N.normalize();
    return outcome;
  }

 private:
  double noise() const {
    return round_off * (b_.lpNorm<Eigen::Infinity>() + (A_.cwiseAbs() * x_).lpNorm<Eigen::Infinity>());
  }

  Eigen::Index fastest_approach() const {
    const Vec a = A_ * x_ + b_;
    Eigen::Index fastest = -1;
    double most = -noise();
    for (Eigen::Index j = 0; j < a.size(); ++j)
      if (a[j] < most && !refused_[std::size_t(j)] && !carries(j)) fastest = j, most = a[j];
    return fastest;
  }

  bool carries(Eigen::Index j) const { return std::find(carrying_.begin(), carrying_.end(), j) != carrying_.end(); }

  // Raises the force j until its contact no longer approaches. False: it grows without bound.
  bool raise(Eigen::Index j) {
    for (;;) {
      const Mat among = A_(carrying_, carrying_);
      const Vec column = A_(carrying_, j);
      const Vec yields = carrying_.empty() ? Vec() : Vec(Eigen::LLT<Mat>(among).solve(column));
      const double left = A_(j, j) - (carrying_.empty() ? 0.0 : A_(j, carrying_).dot(yields));
      const double approach = -(A_.row(j).dot(x_) + b_[j]);
      const double wanted = left > dependent ? approach / left : infinity;
      Eigen::Index first = -1;
      double room = infinity;
      for (Eigen::Index k = 0; k < yields.size(); ++k)
        if (yields[k] > 0 && x_[carrying_[std::size_t(k)]] < room * yields[k])
          first = k, room = x_[carrying_[std::size_t(k)]] / yields[k];
      // If a force decreases only by round-off, the possible step is as large as this.
      const bool unbounded = wanted == infinity && !(room <= endless * b_.lpNorm<Eigen::Infinity>());
      if (unbounded) return end_of(j, yields, approach);
      const double by = std::min(wanted, room);
      for (Eigen::Index k = 0; k < yields.size(); ++k) x_[carrying_[std::size_t(k)]] -= by * yields[k];
      x_[j] += by;
      if (wanted <= room) break;
      x_[carrying_[std::size_t(first)]] = 0;
      carrying_.erase(carrying_.begin() + first);
    }
    carrying_.push_back(j);
    settle();
    std::fill(refused_.begin(), refused_.end(), false);
    return true;
  }

  // If nothing gives way, this is a proof, unless the approach is round-off of dependent contacts. (A strut that is
  // nearly upright gives way by little, and large forces balance each other in it.)
  bool end_of(Eigen::Index j, const Vec& yields, double approach) {
    if (approach <= certain * b_.lpNorm<Eigen::Infinity>() * std::hypot(1, yields.norm())) {
      x_[j] = 0;
      settle();
      refused_[std::size_t(j)] = true;
      return true;
    }
    balanced_.setZero(b_.size());
    balanced_[j] = 1;
    for (Eigen::Index k = 0; k < yields.size(); ++k) balanced_[carrying_[std::size_t(k)]] = std::max(0.0, -yields[k]);
    return false;
  }

  // Computes the forces of the carrying contacts again, without the round-off of the updates.
  void settle() {
    if (carrying_.empty()) return;
    const Mat among = A_(carrying_, carrying_);
    const Vec right = -b_(carrying_), exact = Eigen::LLT<Mat>(among).solve(right);
    for (std::size_t k = 0; k < carrying_.size(); ++k) x_[carrying_[k]] = std::max(0.0, exact[Eigen::Index(k)]);
  }

  Vec scale_;
  Mat A_;
  Vec b_, x_, balanced_;
  std::vector<Eigen::Index> carrying_;
  std::vector<bool> refused_;
};

}  // namespace

LcpOutcome pressing_forces(const Mat& A, const Vec& b, Vec& N) {
  N.setZero(b.size());
  if (!A.allFinite() || !b.allFinite()) return LcpOutcome::gave_up;
  if (b.size() == 0 || b.minCoeff() >= 0) return LcpOutcome::solved;
  return PrincipalPivoting(A, b).solve(N);
}

}  // namespace trammel::complementarity
