// Random bodies that strike each other: the Delassus matrix of their contacts, joints held, and the rates before.
#pragma once

#include <random>
#include <vector>

#include <Eigen/Dense>

#include "simulate/impact/spring_impact.hpp"

namespace trammel::test {

struct StruckBodies {
  std::vector<simulate::SpringContact> contacts;
  Mat A;
  Vec u;
  int tangents = 1;
  double kinetic = 0;  // [J] before
};

struct Kinds {
  bool spatial = false, friction = true, joints = false, dependent = false;
  int contacts = 1;
  double mass_ratio = 1;
};

// Some bodies, each contact at a point of two of them, or of one and the ground; joints hold points of bodies together.
// `dependent`: the first contact is there again, and as many contacts as the bodies' velocities bear.
class RandomStrike {
 public:
  RandomStrike(std::mt19937& random, const Kinds& kinds)
      : random_(random), kinds_(kinds), d_(kinds.spatial ? 3 : 2), dofs_(kinds.spatial ? 6 : 3) {}

  StruckBodies make() {
    const int bodies = kinds_.joints ? 3 : 1 + int(random_() % 3);
    for (int i = 0; i < bodies; ++i) add_body();
    const Mat inverse_mass = weights();
    Mat hold = inverse_mass;
    if (kinds_.joints) {
      const Mat G = joint(0, 1);
      hold -= inverse_mass * G.transpose() * (G * inverse_mass * G.transpose()).inverse() * G * inverse_mass;
    }
    StruckBodies s;
    s.tangents = d_ - 1;
    Vec v(dofs_ * bodies);
    for (double& x : v) x = between(-1, 1);
    v = hold * inverse_mass.diagonal().cwiseInverse().asDiagonal() * v;  // obeys the joint
    Mat J(0, v.size());
    for (int i = 0; i < kinds_.contacts; ++i) add_contact(s, J, v, i == 1 && kinds_.dependent);
    s.A = J * hold * J.transpose();
    s.A = (0.5 * (s.A + s.A.transpose())).eval();
    s.u = J * v;
    s.kinetic = 0.5 * v.dot(inverse_mass.diagonal().cwiseInverse().cwiseProduct(v));
    return s;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Eigen::VectorXd some(int n) {
    Eigen::VectorXd x(n);
    for (double& each : x) each = between(-1, 1);
    return x;
  }

  void add_body() {
    centres_.push_back(some(d_));
    const double mass = std::pow(kinds_.mass_ratio, between(-0.5, 0.5));
    Eigen::VectorXd w(dofs_);
    for (int k = 0; k < dofs_; ++k) w[k] = 1 / (k < d_ ? mass : mass * between(0.05, 0.5));
    weights_.push_back(w);
  }
  Mat weights() const {
    Vec all(dofs_ * Eigen::Index(weights_.size()));
    for (std::size_t i = 0; i < weights_.size(); ++i) all.segment(Eigen::Index(i) * dofs_, dofs_) = weights_[i];
    return all.asDiagonal();
  }

  // Velocity of a body's point along e.
  void add_row(Eigen::RowVectorXd& row, int body, const Eigen::VectorXd& x, const Eigen::VectorXd& e,
               double sign) const {
    if (body < 0) return;
    const Eigen::VectorXd r = x - centres_[std::size_t(body)];
    row.segment(body * dofs_, d_) += sign * e.transpose();
    if (d_ == 2)
      row[body * dofs_ + 2] += sign * (r[0] * e[1] - r[1] * e[0]);
    else
      row.segment(body * dofs_ + 3, 3) += sign * Eigen::Vector3d(r).cross(Eigen::Vector3d(e)).transpose();
  }
  Eigen::RowVectorXd row(int A, int B, const Eigen::VectorXd& x, const Eigen::VectorXd& e) const {
    Eigen::RowVectorXd r = Eigen::RowVectorXd::Zero(dofs_ * Eigen::Index(centres_.size()));
    add_row(r, A, x, e, 1), add_row(r, B, x, e, -1);
    return r;
  }
  Mat joint(int A, int B) {
    const Eigen::VectorXd x = some(d_);
    Mat G(d_, dofs_ * Eigen::Index(centres_.size()));
    for (int k = 0; k < d_; ++k) G.row(k) = row(A, B, x, Eigen::VectorXd::Unit(d_, k));
    return G;
  }

  void add_contact(StruckBodies& s, Mat& J, const Vec& v, bool again) {
    simulate::SpringContact c;
    c.normal = int(J.rows());
    c.e = random_() % 4 == 0 ? double(random_() % 2) : between(0, 1);
    const bool rubs = kinds_.friction && random_() % 5 != 0;
    if (rubs)
      c.tangent = c.normal + 1, c.mu_0 = between(0, 1.5), c.mu = random_() % 2 ? c.mu_0 : between(0.3, 1) * c.mu_0;
    const int A = int(random_() % centres_.size());
    int B = int(random_() % (centres_.size() + 1)) - 1;
    if (B == A) B = -1;
    const Eigen::VectorXd x = some(d_);
    const int rows = rubs ? d_ : 1;
    Mat own(rows, v.size());
    if (again) {
      own.row(0) = J.row(0);
      for (int k = 1; k < rows; ++k) own.row(k) = row(A, B, x, some(d_).normalized());
    } else {
      Eigen::MatrixXd axes = Eigen::MatrixXd::Identity(d_, d_);
      axes.col(0) = some(d_).normalized();
      axes = Eigen::HouseholderQR<Eigen::MatrixXd>(axes).householderQ();
      for (int k = 0; k < rows; ++k) own.row(k) = row(A, B, x, axes.col(k));
      if (own.row(0).dot(v) > 0 && random_() % 4 != 0) own.row(0) *= -1;  // most approach
    }
    J.conservativeResize(J.rows() + rows, v.size());
    J.bottomRows(rows) = own;
    s.contacts.push_back(c);
  }

  std::mt19937& random_;
  Kinds kinds_;
  int d_, dofs_;
  std::vector<Eigen::VectorXd> centres_, weights_;
};

}  // namespace trammel::test
