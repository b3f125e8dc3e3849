#include "tspline_plate/shell/viscous_point.hpp"

namespace trammel::plate {

namespace {

using Rows = Eigen::Matrix<double, 3, 15>;  // of the three components, by y in the order 3 p + i

constexpr double shear_factor(int k) {
  return k == 2 ? 2 : 1;
}

Rows membrane_rows(const Vectors5& y) {
  Rows E = Rows::Zero();
  E.block<1, 3>(0, 0) = y.row(0);
  E.block<1, 3>(1, 3) = y.row(1);
  E.block<1, 3>(2, 0) = y.row(1);
  E.block<1, 3>(2, 3) = y.row(0);
  return E;
}

Rows bending_rows(const DeformedPoint& at) {
  Rows K = Rows::Zero();
  const Eigen::RowVector3d n = at.n;
  for (int k = 0; k < 3; ++k) {
    const double f = shear_factor(k);
    for (int a = 0; a < 2; ++a) K.block<1, 3>(k, 3 * a) = f * at.christoffel[a](k) * n;
    K.block<1, 3>(k, 6 + 3 * k) = -f * n;
  }
  return K;
}

// d kappa' / dy with the velocities held.
Rows bending_rate_rows(const DeformedPoint& at, const Vectors5& rate) {
  Rows result = Rows::Zero();
  const Eigen::RowVector3d n = at.n;
  const double n_rate[2] = {rate.row(0).dot(n), rate.row(1).dot(n)};
  const double metric[2][2] = {{at.metric[0], at.metric[2]}, {at.metric[2], at.metric[1]}};
  for (int k = 0; k < 3; ++k) {
    const double f = shear_factor(k), b = at.y.row(2 + k).dot(n);
    for (int turned = 0; turned < 2; ++turned) {
      Eigen::RowVector3d sum = -rate.row(2 + k).dot(at.dual[turned]) * n;
      for (int a = 0; a < 2; ++a) {
        sum += n_rate[a] * (at.christoffel[turned](k) * at.dual[a].transpose() - metric[a][turned] * b * n);
        sum += at.christoffel[a](k) * rate.row(a).dot(at.dual[turned]) * n;
      }
      result.block<1, 3>(k, 3 * turned) = -f * sum;
    }
    for (int a = 0; a < 2; ++a) result.block<1, 3>(k, 6 + 3 * k) += f * n_rate[a] * at.dual[a].transpose();
  }
  return result;
}

}  // namespace

StrainRate strain_rate(const DeformedPoint& at, const Vectors5& rate) {
  const auto a1 = at.y.row(0), a2 = at.y.row(1);
  StrainRate result;
  result.eps << a1.dot(rate.row(0)), a2.dot(rate.row(1)), a1.dot(rate.row(1)) + a2.dot(rate.row(0));
  const double n1 = rate.row(0).dot(at.n), n2 = rate.row(1).dot(at.n);
  for (int k = 0; k < 3; ++k)
    result.kappa(k) =
        -shear_factor(k) * (rate.row(2 + k).dot(at.n) - at.christoffel[0](k) * n1 - at.christoffel[1](k) * n2);
  return result;
}

void add_viscous(const ReferencePoint& reference, const DeformedPoint& at, const Vectors5& rate, double factor,
                 double c_d, double c_k, double (&H)[9][25]) {
  constexpr int plane_of[3][3] = {{0, 3, 4}, {6, 1, 5}, {7, 8, 2}};
  const Rows E = membrane_rows(at.y), K = bending_rows(at);
  const Eigen::Matrix<double, 15, 15> sum =
      factor * (E.transpose() * reference.membrane * (c_d * E + c_k * membrane_rows(rate)) +
                K.transpose() * reference.bending * (c_d * K + c_k * bending_rate_rows(at, rate)));
  for (int p = 0; p < 5; ++p)
    for (int q = 0; q < 5; ++q)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) H[plane_of[i][j]][5 * p + q] += sum(3 * p + i, 3 * q + j);
}

}  // namespace trammel::plate
