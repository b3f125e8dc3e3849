#include "complementarity/programs/friction_cone.hpp"

#include <algorithm>
#include <cmath>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

using Tangent = ContactPoint::Tangent;

constexpr int most_newton_steps = 50, sweeps = 200;  // of Newton's method, and between two of its attempts
constexpr int most_sweeps = 128 * sweeps;            // alone
// Of the natural map, relative to its terms: solved, and where the steps no longer decrease it, which is round-off of
// A F.
constexpr double solved_to = 1e-14, stalled_at = 1e-12;
constexpr double shortest_part = 1e-3;   // of a step of Newton's method
constexpr double least_decrease = 1e-4;  // of the predicted one (Armijo)

class Cones {
 public:
  Cones(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b) : points_(points), A_(A), b_(b) {
    r_.setZero(b.size());  // tangents of known slips and without friction have none
    for (const ContactPoint& p : points) {
      if (p.normal >= 0) r_[p.normal] = over(A(p.normal, p.normal));
      if (!p.held()) continue;
      double trace = 0;
      for (int k = 0; k < p.tangents; ++k) trace += A(p.tangent + k, p.tangent + k);
      r_.segment(p.tangent, p.tangents).setConstant(over(trace));
    }
    scale_ = r_.cwiseProduct(b).lpNorm<Eigen::Infinity>();
  }

  // Newton's method begins at what the sweeps have reached, after 200, 400, 800, ... of them.
  bool sweep_on(Vec& F) {
    for (int done = 0, next = sweeps; next <= most_sweeps; next *= 2) {
      for (; done < next; ++done) sweep(F);
      Vec tried = F;
      evaluate(tried);
      if (!newton(tried)) continue;
      F = tried;
      return true;
    }
    return false;
  }

  bool solve(Vec& F, int rounds) {
    evaluate(F);
    for (int round = 0; round < rounds; ++round) {
      if (newton(F)) return true;
      for (int i = 0; i < sweeps; ++i) sweep(F);
      evaluate(F);
    }
    return false;
  }

 private:
  static double over(double x) { return x > 0 ? 1 / x : 1; }

  double normal_force(const ContactPoint& p, const Vec& F, const Vec& a) const {
    return p.normal >= 0 ? std::max(0.0, F[p.normal] - r_[p.normal] * a[p.normal]) : p.given;
  }

  void evaluate(const Vec& F) {
    a_ = A_ * F + b_;
    phi_ = F;
    for (const ContactPoint& p : points_) {
      const double N = normal_force(p, F, a_);
      if (p.normal >= 0) phi_[p.normal] -= N;
      if (p.tangent < 0) continue;
      if (p.kind == Tangent::sliding) phi_.segment(p.tangent, p.tangents) -= F[p.normal] * p.ratio.head(p.tangents);
      if (!p.held()) continue;
      const Vec pushed = F.segment(p.tangent, p.tangents) - r_[p.tangent] * a_.segment(p.tangent, p.tangents);
      const double size = pushed.norm(), bound = p.coefficient * N;
      phi_.segment(p.tangent, p.tangents) -= size > bound ? Vec(bound / size * pushed) : pushed;
    }
  }

  // J = dPhi/dF of the piece at F.
  void linearise(const Vec& F) {
    const Eigen::Index m = F.size();
    J_.setIdentity(m, m);
    for (const ContactPoint& p : points_) {
      const bool presses = p.normal >= 0 && F[p.normal] > r_[p.normal] * a_[p.normal];
      Vec N_F = Vec::Zero(m);  // of the normal force in the projection
      if (presses) N_F = -r_[p.normal] * A_.row(p.normal).transpose(), N_F[p.normal] += 1;
      if (p.normal >= 0) J_.row(p.normal) -= N_F.transpose();
      if (p.tangent < 0) continue;
      const int n = p.tangents;
      if (p.kind == Tangent::sliding) J_.block(p.tangent, p.normal, n, 1) -= p.ratio.head(n);
      if (!p.held()) continue;
      Mat X_F = -r_[p.tangent] * A_.middleRows(p.tangent, n);
      X_F.middleCols(p.tangent, n) += Mat::Identity(n, n);
      const Vec pushed = F.segment(p.tangent, n) - r_[p.tangent] * a_.segment(p.tangent, n);
      const double size = pushed.norm(), bound = p.coefficient * normal_force(p, F, a_);
      if (size <= bound) {
        J_.middleRows(p.tangent, n) -= X_F;
        continue;
      }
      const Vec e = pushed / size;
      const Mat turn = bound / size * (Mat::Identity(n, n) - e * e.transpose());
      J_.middleRows(p.tangent, n) -= turn * X_F + p.coefficient * e * N_F.transpose();
    }
  }

  bool solved(const Vec& F) const {
    return phi_.lpNorm<Eigen::Infinity>() <= solved_to * (scale_ + F.lpNorm<Eigen::Infinity>());
  }

  bool newton(Vec& F) {
    Vec trial;
    double size = phi_.norm();
    for (int iteration = 0; iteration < most_newton_steps; ++iteration) {
      if (solved(F)) return true;
      linearise(F);
      const Vec step = -Eigen::CompleteOrthogonalDecomposition<Mat>(J_).solve(phi_);
      if (!step.allFinite()) return false;
      bool smaller = false;
      for (double part = 1; part > shortest_part && !smaller; part /= 2) {
        trial = F + part * step;
        evaluate(trial);
        smaller = phi_.norm() < (1 - least_decrease * part) * size;
      }
      if (!smaller) {
        evaluate(F);
        return phi_.lpNorm<Eigen::Infinity>() <= stalled_at * (scale_ + F.lpNorm<Eigen::Infinity>());
      }
      F = trial;
      size = phi_.norm();
    }
    return false;
  }

  void sweep(Vec& F) const {
    for (const ContactPoint& p : points_) {
      double N = p.given;
      if (p.normal >= 0) {
        const double a_n = A_.row(p.normal).dot(F) + b_[p.normal];
        N = F[p.normal] = std::max(0.0, F[p.normal] - r_[p.normal] * a_n);
      }
      if (p.tangent < 0) continue;
      if (p.kind == Tangent::sliding) F.segment(p.tangent, p.tangents) = N * p.ratio.head(p.tangents);
      if (!p.held()) continue;
      const Vec a_t = A_.middleRows(p.tangent, p.tangents) * F + b_.segment(p.tangent, p.tangents);
      const Vec pushed = F.segment(p.tangent, p.tangents) - r_[p.tangent] * a_t;
      const double size = pushed.norm(), bound = p.coefficient * N;
      F.segment(p.tangent, p.tangents) = size > bound ? Vec(bound / size * pushed) : pushed;
    }
  }

  const std::vector<ContactPoint>& points_;
  const Mat& A_;
  const Vec& b_;
  Vec r_, a_, phi_;
  Mat J_;
  double scale_ = 0;
};

}  // namespace

bool solve_cones(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, int rounds) {
  return A.allFinite() && b.allFinite() && Cones(points, A, b).solve(F, rounds);
}

bool sweep_cones(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F) {
  return A.allFinite() && b.allFinite() && Cones(points, A, b).sweep_on(F);
}

}  // namespace trammel::complementarity
