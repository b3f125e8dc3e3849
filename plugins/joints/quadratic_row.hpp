// A row that is a quadratic form of the positions of three or four markers, planar or spatial.
//
//     g = (sum_kl Q_kl y_k . y_l) / (2 L),    y_k = x_k - x_A        Q symmetric; its rows sum to 0
//     H_k = (sum_l Q_kl y_l)^T / L,   gamma = -(sum_kl Q_kl y_k' . y_l') / L
//
// L [m] makes g a length; it is chosen such that the gradient is about 1.
#pragma once

#include <trammel/joint.hpp>

namespace trammel {

class QuadraticRow : public Constraint {
 public:
  int row_count(Space) const final { return 1; }
  int marker_count() const final { return int(Q_.rows()); }

  void rows_between(double, Motions at, Rows& rows) const final {
    const Motion& A = *at[0];
    const auto dim = A.x.size(), n = Eigen::Index(at.size());
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, Rows::most_markers> y(3, n), u(3, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      y.col(k).setZero(), u.col(k).setZero();
      y.col(k).head(dim) = at[std::size_t(k)]->x - A.x;
      u.col(k).head(dim) = at[std::size_t(k)]->V.head(dim) - A.V.head(dim);
    }
    const auto yQ = (y * Q_ / length_).eval(), uQ = (u * Q_ / length_).eval();
    rows.g(0) = y.cwiseProduct(yQ).sum() / 2;
    rows.gamma(0) = -u.cwiseProduct(uQ).sum();
    for (Eigen::Index k = 0; k < n; ++k) rows.H(int(k)).row(0).head(dim) = yQ.col(k).head(dim).transpose();
  }

 protected:
  using Form = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Rows::most_markers, Rows::most_markers>;
  // e_i . e_j of two combinations e = sum_k c_k x_k of the markers' positions.
  static Form product(const Eigen::VectorXd& e_i, const Eigen::VectorXd& e_j) {
    return e_i * e_j.transpose() + e_j * e_i.transpose();
  }
  void set(const Form& Q, double length) { Q_ = Q, length_ = length; }

 private:
  Form Q_;
  double length_ = 1;
};

}  // namespace trammel
