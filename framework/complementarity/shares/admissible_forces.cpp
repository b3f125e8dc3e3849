#include "complementarity/shares/admissible_forces.hpp"

#include <algorithm>
#include <cmath>

#include "linear/dense/decompositions.hpp"

namespace trammel::complementarity {
namespace {

constexpr int most_iterations = 60;
constexpr double round_off_of_lambda = 1e-14;  // of lambda

class DualNewton {
 public:
  DualNewton(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda)
      : contacts_(contacts), E_(E), lambda_(lambda) {
    const Mat all = E * E.transpose();
    size_ = all.trace() / double(std::max<Eigen::Index>(1, all.rows()));
    evaluate(Eigen::LDLT<Mat>(all).solve(lambda));
  }

  void begin_at(const Vec& y) { evaluate(y); }

  double solve(Vec& F) {
    const double size = lambda_.norm();
    for (int i = 0; i < most_iterations && missed_.norm() > round_off_of_lambda * size; ++i)
      if (!step()) break;
    F = F_;
    return missed_.norm();
  }

 private:
  // A step of Newton's method, shortened until the function falls; where the piece is flat, along what is missed, as
  // far as it falls.
  // False: it does not fall.
  bool step() {
    const Mat H = E_ * slope() * E_.transpose();
    const Vec from = y_, left = missed_;
    const double before = value_;
    for (const double stiff : {1e-13, 1e-6, 1.0}) {
      const Mat stiffened = H + stiff * size_ * Mat::Identity(H.rows(), H.cols());
      const Vec direction = Eigen::LDLT<Mat>(stiffened).solve(left);
      for (double part = 1; part > 1e-4; part /= 2) {
        evaluate(from + part * direction);
        if (!(value_ <= before - 1e-4 * part * left.dot(direction) || missed_.norm() <= 0.5 * left.norm())) continue;
        if (part == 1 && stiff == 1) go_on(from, direction);
        return true;
      }
    }
    evaluate(from);
    return false;
  }

  void go_on(const Vec& from, const Vec& direction) {
    double part = 1, lowest = value_;
    for (; part < 1e6; part *= 2, lowest = value_) {
      evaluate(from + 2 * part * direction);
      if (!(value_ < lowest)) break;
    }
    evaluate(from + part * direction);
  }

  void evaluate(const Vec& y) {
    y_ = y;
    pushed_ = E_.transpose() * y;
    F_ = pushed_;
    for (const SharingContact& c : contacts_) project(c);
    missed_ = lambda_ - E_ * F_;
    value_ = conjugate() - lambda_.dot(y_);
  }

  static double length(const SharingContact& c, const Vec& x) {
    double sum = 0;
    for (const Eigen::Index k : c.tangents) sum = std::hypot(sum, x[k]);
    return sum;
  }

  // Onto its cone, or its disk where N is given.
  void project(const SharingContact& c) {
    const double T = length(c, pushed_);
    double bound = c.coefficient * c.given;
    if (c.normal >= 0) {
      const double a = pushed_[c.normal];
      const bool opposite = a <= -c.coefficient * T, inside = !opposite && T <= c.coefficient * a;
      const double on_side = (a + c.coefficient * T) / (1 + c.coefficient * c.coefficient);
      const double N = opposite ? 0 : inside || c.tangents.empty() ? a : on_side;
      F_[c.normal] = N;
      bound = c.coefficient * N;
    }
    if (T > bound)
      for (const Eigen::Index k : c.tangents) F_[k] *= bound / T;
  }

  // max over the cones of F . x - |F|^2/2 at x = E^T y; without what given normal forces are worth.
  double conjugate() const { return F_.dot(pushed_) - 0.5 * F_.squaredNorm(); }

  // dPi/dx
  Mat slope() const {
    Mat D = Mat::Zero(pushed_.size(), pushed_.size());
    for (const SharingContact& c : contacts_) {
      const double T = length(c, pushed_), mu = c.coefficient;
      if (c.normal >= 0) {
        const double a = pushed_[c.normal];
        if (c.tangents.empty()) {
          D(c.normal, c.normal) = a > 0;
          continue;
        }
        if (a <= -mu * T) continue;
        if (T <= mu * a) {
          D(c.normal, c.normal) = 1;
          for (const Eigen::Index k : c.tangents) D(k, k) = 1;
          continue;
        }
        add_side(c, T, mu * F_[c.normal], D);
        Vec edge = Vec::Zero(D.rows());
        edge[c.normal] = 1;
        for (const Eigen::Index k : c.tangents) edge[k] = mu * pushed_[k] / T;
        D += edge * edge.transpose() / (1 + mu * mu);
      } else if (const double bound = mu * c.given; T <= bound) {
        for (const Eigen::Index k : c.tangents) D(k, k) = 1;
      } else {
        add_side(c, T, bound, D);
      }
    }
    return D;
  }

  // On a circle of this radius the force turns with what pushes it.
  void add_side(const SharingContact& c, double T, double radius, Mat& D) const {
    for (const Eigen::Index k : c.tangents)
      for (const Eigen::Index l : c.tangents) D(k, l) += radius / T * ((k == l) - pushed_[k] * pushed_[l] / (T * T));
  }

  const std::vector<SharingContact>& contacts_;
  const Mat& E_;
  const Vec& lambda_;
  Vec y_, pushed_, F_, missed_;
  double value_ = 0, size_ = 0;  // size_: of E E^T
};

// Tangents of a contact without friction have no force.
std::size_t tangents(const SharingContact& c) {
  return c.coefficient > 0 ? c.tangents.size() : 0;
}

Vec forces_of(const std::vector<SharingContact>& contacts, const Vec& x, Eigen::Index columns) {
  Vec F = Vec::Zero(columns);
  Eigen::Index first = 0;
  for (const SharingContact& c : contacts) {
    if (c.normal >= 0) F[c.normal] = x[first];
    ++first;
    for (std::size_t k = 0; k < tangents(c); ++k) F[c.tangents[k]] = c.coefficient * x[first++];
  }
  return F;
}

}  // namespace

ConeProgram sharing_program(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda) {
  ConeProgram program;
  Eigen::Index columns = 0, given = E.rows();
  for (const SharingContact& c : contacts) {
    program.cones.push_back(Eigen::Index(1 + tangents(c)));
    columns += program.cones.back();
    if (c.normal < 0) ++given;
  }
  program.D.setOnes(columns);
  program.G.setZero(given, columns);
  program.r.setZero(given);
  program.r.head(E.rows()) = lambda;
  Eigen::Index x = 0, row = E.rows();
  for (const SharingContact& c : contacts) {
    if (c.normal >= 0)
      program.G.col(x).head(E.rows()) = E.col(c.normal);
    else
      program.G(row, x) = 1, program.r[row++] = c.given;
    ++x;
    for (std::size_t k = 0; k < tangents(c); ++k, ++x) {
      program.D[x] = c.coefficient * c.coefficient;
      program.G.col(x).head(E.rows()) = c.coefficient * E.col(c.tangents[k]);
    }
  }
  return program;
}

double admissible_forces(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec& F) {
  constexpr double solved = 1e-12;  // of lambda
  DualNewton newton(contacts, E, lambda);
  double missed = newton.solve(F);
  if (missed <= solved * lambda.norm()) return missed;
  ConeProgram program = sharing_program(contacts, E, lambda);
  const double size = program.r.lpNorm<Eigen::Infinity>();
  program.r /= size;
  const ConeSolution inside = solve_cone_program(program);
  Vec other = forces_of(contacts, size * inside.x, E.cols());
  const auto keep_if_better = [&](double other_missed) {
    if (other_missed < missed) missed = other_missed, F = other;
  };
  keep_if_better((E * other - lambda).norm());
  newton.begin_at(size * inside.y.head(E.rows()));
  keep_if_better(newton.solve(other));
  return missed;
}

}  // namespace trammel::complementarity
