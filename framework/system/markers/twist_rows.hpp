// Products of the rows of joints and contacts with twists. The numbers of rows (1 to 6) and of a twist's entries (3 or
// 6) are compile-time constants, because the overhead of variable sizes exceeds the cost of the products.
#pragma once

#include <type_traits>

#include <trammel/marker.hpp>

#include "linear/dense/fixed_sizes.hpp"

namespace trammel::model {

// Calls f(3) in the plane, f(6) in space, as compile-time constants.
template <class F>
void with_twist(Eigen::Index size, F&& f) {
  if (size == 3)
    f(std::integral_constant<int, 3>());
  else
    f(std::integral_constant<int, 6>());
}

// Rows [first, first + n) of H.
struct RowsOf {
  const Mat6& H;
  Eigen::Index first, n;
};

// The wrench on a marker by forces along the rows H: `normal` along the first, `friction` along the following ones.
inline Wrench pressed_by(const Mat6& H, double normal, const Eigen::Vector2d& friction) {
  Wrench wrench(H.cols());
  with_twist(H.cols(), [&](auto twist) {
    for (int j = 0; j < twist; ++j) {
      wrench(j) = normal * H(0, j);
      for (Eigen::Index k = 0; k + 1 < H.rows(); ++k) wrench(j) += friction[k] * H(k + 1, j);
    }
  });
  return wrench;
}

// rate_i += (H V)_i and free_i -= (H bias)_i
inline void add_motion(const RowsOf& rows, const Motion& marker, double* rate, double* free) {
  const double *const H = rows.H.data() + rows.first, *const V = marker.V.data(), *const bias = marker.bias.data();
  const Eigen::Index stride = rows.H.rows();
  with_twist(marker.V.size(), [=](auto twist) {
    numerics::with_fixed_size<6>(rows.n, [=](auto n) {
      double along_V[n] = {}, along_bias[n] = {};
      for (int k = 0; k < twist; ++k)
        for (int i = 0; i < n; ++i) {
          along_V[i] += H[k * stride + i] * V[k];
          along_bias[i] += H[k * stride + i] * bias[k];
        }
      for (int i = 0; i < n; ++i) rate[i] += along_V[i], free[i] -= along_bias[i];
    });
  });
}

// add(j, (H J)_0j ... (H J)_n-1,j, n) for all columns j of J
template <class Add>
void for_each_column(const RowsOf& rows, const Jac& J, Add&& add) {
  const double* const H = rows.H.data() + rows.first;
  const Eigen::Index stride = rows.H.rows(), columns = J.cols();
  with_twist(J.rows(), [&](auto twist) {
    numerics::with_fixed_size<6>(rows.n, [&](auto n) {
      double h[n * twist];
      for (int k = 0; k < twist; ++k)
        for (int i = 0; i < n; ++i) h[k * n + i] = H[k * stride + i];
      for (Eigen::Index j = 0; j < columns; ++j) {
        double sum[n] = {};
        for (int k = 0; k < twist; ++k)
          for (int i = 0; i < n; ++i) sum[i] += h[k * n + i] * J.data()[k * columns + j];
        add(j, sum, n);
      }
    });
  });
}

}  // namespace trammel::model
