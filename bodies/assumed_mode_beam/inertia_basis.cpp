#include "inertia_basis.hpp"

#include <Eigen/QR>

namespace trammel::beam {

namespace {

// Orthonormal columns that span those of `columns` to this share of each one's length.
constexpr double round_off = 1e-14;

Mat orthonormal_span(Mat columns, const Vec& lengths) {
  columns *= lengths.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Mat> qr(columns);
  const Eigen::Index most = std::min(columns.rows(), columns.cols());
  Eigen::Index rank = 0;
  while (rank < most && std::abs(qr.matrixQR()(rank, rank)) > round_off) ++rank;
  return qr.householderQ() * Mat::Identity(columns.rows(), rank);
}

}  // namespace

InertiaBasis::InertiaBasis(const std::vector<PointShape>& at, const Vec& weight)
    : axial_(int(at.front().phi_x.size())), transverse_(int(at.front().phi_y.size())) {
  const Eigen::Index n = weight.size();
  const int N = transverse_;
  const bool foreshortening = N > 0 && at.front().H.size() > 0;

  // Values times the root of the weight: products of columns are integrals.
  Mat functions(n, 2 + axial_ + N), bending(n, foreshortening ? N * N : 0);
  for (Eigen::Index g = 0; g < n; ++g) {
    const PointShape& p = at[std::size_t(g)];
    const double root = std::sqrt(weight(g));
    functions(g, 0) = root;
    functions(g, 1) = root * p.X0;
    functions.row(g).segment(2, axial_) = root * p.phi_x;
    functions.row(g).tail(N) = root * p.phi_y;
    if (foreshortening) bending.row(g) = root * p.H.topRows(N).reshaped();
  }

  Mat psi_bending(n, 0);
  if (foreshortening) {
    Mat half(n, N * (N + 1) / 2);
    for (int i = 0, k = 0; i < N; ++i)
      for (int j = 0; j <= i; ++j) half.col(k++) = bending.col(i * N + j);
    psi_bending = orthonormal_span(half, half.colwise().norm());
  }
  const Mat in_bending = psi_bending.transpose() * functions;
  const Mat rest = functions - psi_bending * in_bending;
  const Mat psi_rest = orthonormal_span(rest, functions.colwise().norm());

  bending_size_ = padded(int(psi_bending.cols()));
  size_ = bending_size_ + padded(int(psi_rest.cols()));
  row_ = bending_size_ + padded(axial_);
  functions_ = Mat::Zero(size_, functions.cols());
  functions_.topRows(in_bending.rows()) = in_bending;
  // Of the rest alone: its last directions are short, and psi_bending is in them by round-off over their length.
  functions_.middleRows(bending_size_, psi_rest.cols()) = psi_rest.transpose() * rest;

  const auto axial = functions.middleCols(2, axial_);
  H_ = Mat::Zero(row_, bending.cols());
  H_.topRows(psi_bending.cols()) = psi_bending.transpose() * bending;
  H_.middleRows(bending_size_, axial_) = axial.transpose() * bending;
  phi_y_rows_ = Mat::Zero(row_, N);
  phi_y_rows_.topRows(bending_size_) = functions_.topRightCorner(bending_size_, N);
  phi_y_rows_.middleRows(bending_size_, axial_) = axial.transpose() * functions.rightCols(N);
}

}  // namespace trammel::beam
