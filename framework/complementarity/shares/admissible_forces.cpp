#include "complementarity/shares/admissible_forces.hpp"

#include <algorithm>
#include <cmath>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

constexpr int most_iterations = 60;  // if such forces exist
// If none may exist. More iterations are needed only for thin cones, which the interior point method handles better.
constexpr int first_iterations = 20;
// Relative to lambda: a larger residual of the interior point method shows that there are none.
constexpr double none = 1e-6;
constexpr double round_off_of_lambda = 1e-14;  // of lambda
// What is added to the curvature, relative to that of all springs: against round-off, where pieces are nearly flat, and
// for a step along the residual.
constexpr double stiffenings[] = {1e-13, 1e-6, 1.0};
// Of a step of Newton's method: where it ends if the function does not decrease, and if it decreases without end.
constexpr double shortest_part = 1e-4, longest_part = 1e6;
constexpr double least_decrease = 1e-4;  // of the predicted one (Armijo)

double tangential(const SharingContact& c, const Vec& x) {
  double sum = 0;
  for (const Eigen::Index k : c.tangents) sum = std::hypot(sum, x[k]);
  return sum;
}

void shorten_tangents(const SharingContact& c, double bound, Vec& F) {
  const double T = tangential(c, F);
  if (T > bound)
    for (const Eigen::Index k : c.tangents) F[k] *= bound / T;
}

class DualNewton {
 public:
  DualNewton(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda)
      : contacts_(contacts), E_(E), lambda_(lambda) {
    begin();
  }

  // Starts with the shares of springs, without cones.
  void begin() {
    const Mat all = E_ * E_.transpose();
    size_ = all.trace() / double(std::max<Eigen::Index>(1, all.rows()));
    evaluate(Eigen::LDLT<Mat>(all).solve(lambda_));
  }
  void begin_at(const Vec& y) { evaluate(y); }
  const Vec& y() const { return y_; }

  double solve(Vec& F, int most) {
    const double size = lambda_.norm();
    for (int i = 0; i < most && missed_.norm() > round_off_of_lambda * size; ++i)
      if (!step()) break;
    F = F_;
    return missed_.norm();
  }

 private:
  // A step of Newton's method, shortened until the function decreases; where the piece is flat, a step along the
  // residual as far as the function decreases. False: it does not decrease.
  bool step() {
    const Mat H = curvature();
    const Vec from = y_, left = missed_;
    const double before = value_;
    for (const double stiff : stiffenings) {
      const Mat stiffened = H + stiff * size_ * Mat::Identity(H.rows(), H.cols());
      const Vec direction = Eigen::LDLT<Mat>(stiffened).solve(left);
      for (double part = 1; part > shortest_part; part /= 2) {
        evaluate(from + part * direction);
        if (!(value_ <= before - least_decrease * part * left.dot(direction) || missed_.norm() <= 0.5 * left.norm()))
          continue;
        if (part == 1 && stiff == 1) go_on(from, direction);
        return true;
      }
    }
    evaluate(from);
    return false;
  }

  void go_on(const Vec& from, const Vec& direction) {
    double part = 1, lowest = value_;
    for (; part < longest_part; part *= 2, lowest = value_) {
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

  // Projects onto the contact's cone, or onto its disk if N is given.
  void project(const SharingContact& c) {
    const double T = tangential(c, pushed_);
    double bound = c.coefficient * c.given;
    if (c.normal >= 0) {
      const double a = pushed_[c.normal];
      const bool opposite = a <= -c.coefficient * T, inside = !opposite && T <= c.coefficient * a;
      const double on_side = (a + c.coefficient * T) / (1 + c.coefficient * c.coefficient);
      const double N = opposite ? 0 : inside || c.tangents.empty() ? a : on_side;
      F_[c.normal] = N;
      bound = c.coefficient * N;
    }
    shorten_tangents(c, bound, F_);
  }

  // max over the cones of F . x - |F|^2/2 at x = E^T y, without the terms of given normal forces.
  double conjugate() const { return F_.dot(pushed_) - 0.5 * F_.squaredNorm(); }

  // E dPi/dx E^T, where dPi/dx = L L^T, contact by contact.
  Mat curvature() const {
    Mat EL(E_.rows(), E_.cols());
    Eigen::Index used = 0;
    for (const SharingContact& c : contacts_) add_columns(c, EL, used);
    Mat H = Mat::Zero(E_.rows(), E_.rows());
    if (used == 0) return H;  // Eigen's rankUpdate fails for no columns
    H.selfadjointView<Eigen::Lower>().rankUpdate(EL.leftCols(used));
    H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
    return H;
  }

  // A force inside its cone moves freely; one on the boundary moves along the edge and turns with the force that pushes
  // it.
  void add_columns(const SharingContact& c, Mat& EL, Eigen::Index& used) const {
    const double T = tangential(c, pushed_), mu = c.coefficient;
    const double a = c.normal >= 0 ? pushed_[c.normal] : c.given;
    if (c.normal >= 0 && (c.tangents.empty() ? !(a > 0) : a <= -mu * T)) return;
    const bool inside = T <= mu * a;
    if (inside || c.tangents.empty()) {
      if (c.normal >= 0) EL.col(used++) = E_.col(c.normal);
      for (const Eigen::Index k : c.tangents) EL.col(used++) = E_.col(k);
      return;
    }
    if (c.normal >= 0) {
      EL.col(used) = E_.col(c.normal);
      for (const Eigen::Index k : c.tangents) EL.col(used) += mu * pushed_[k] / T * E_.col(k);
      EL.col(used++) /= std::sqrt(1 + mu * mu);
    }
    if (c.tangents.size() < 2) return;
    const double radius = c.normal >= 0 ? mu * F_[c.normal] : mu * c.given;
    const Eigen::Index k = c.tangents[0], l = c.tangents[1];
    EL.col(used++) = std::sqrt(radius / T) / T * (pushed_[k] * E_.col(l) - pushed_[l] * E_.col(k));
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

}  // namespace

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

double admissible_forces(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec& F,
                         Vec* nearby) {
  constexpr double solved = 1e-12;  // of lambda
  DualNewton newton(contacts, E, lambda);
  if (nearby && nearby->size() > 0) {
    newton.begin_at(*nearby);
    const double missed = newton.solve(F, first_iterations);
    if (missed <= solved * lambda.norm()) return *nearby = newton.y(), missed;
    newton.begin();
  }
  double missed = newton.solve(F, first_iterations);
  if (nearby) *nearby = newton.y();
  if (missed <= solved * lambda.norm()) return missed;
  ConeProgram program = sharing_program(contacts, E, lambda);
  const double size = program.r.lpNorm<Eigen::Infinity>();
  program.r /= size;
  const ConeSolution inside = solve_cone_program(program);
  const auto keep_if_better = [&](const Vec& other, double other_missed, const Vec& y) {
    if (!(other_missed < missed)) return;
    missed = other_missed, F = other;
    if (nearby) *nearby = y;
  };
  Vec other = forces_of(contacts, size * inside.x, E.cols());
  for (const SharingContact& c : contacts)  // the program has given normal forces only to its accuracy
    if (c.normal < 0) shorten_tangents(c, c.coefficient * c.given, other);
  const Vec y = size * inside.y.head(E.rows());
  const double missed_inside = (E * other - lambda).norm();
  keep_if_better(other, missed_inside, y);
  if (missed_inside > none * lambda.norm()) return missed;
  newton.begin_at(y);
  const double missed_at_end = newton.solve(other, most_iterations);
  keep_if_better(other, missed_at_end, newton.y());
  return missed;
}

}  // namespace trammel::complementarity
