#include "inertia_basis.hpp"

#include <trammel/decompositions.hpp>

namespace trammel::beam {

namespace {

// The orthonormal columns span those of `columns` up to errors of this fraction of each column's length.
constexpr double round_off = 1e-14;

Mat orthonormal_span(Mat columns, const Vec& lengths) {
  columns *= lengths.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Mat> qr(columns);
  const Eigen::Index most = std::min(columns.rows(), columns.cols());
  Eigen::Index rank = 0;
  while (rank < most && std::abs(qr.matrixQR()(rank, rank)) > round_off) ++rank;
  return first_columns_of_q(qr, rank);
}

}  // namespace

InertiaBasis::InertiaBasis(const std::vector<PointShape>& at, const Vec& weight)
    : axial_(int(at.front().phi_x.size())), transverse_(int(at.front().phi_y.size())) {
  const Eigen::Index n = weight.size();
  const int N = transverse_;
  const bool foreshortening = N > 0 && at.front().H.size() > 0;

  // Values times the root of the weight: products of columns are integrals.
  Mat functions(n, 2 + axial_ + N), bending(n, foreshortening ? N * (N + 1) / 2 : 0);
  for (Eigen::Index g = 0; g < n; ++g) {
    const PointShape& p = at[std::size_t(g)];
    const double root = std::sqrt(weight(g));
    functions(g, 0) = root;
    functions(g, 1) = root * p.X0;
    functions.row(g).segment(2, axial_) = root * p.phi_x;
    functions.row(g).tail(N) = root * p.phi_y;
    for (int i = 0, k = 0; foreshortening && i < N; ++i)
      for (int j = 0; j <= i; ++j) bending(g, k++) = root * p.H(i, j);
  }
  integrals_ = functions.transpose() * functions;

  const Mat psi = foreshortening ? orthonormal_span(bending, bending.colwise().norm()) : Mat(n, 0);
  size_ = padded(int(psi.cols()));
  row_ = size_ + padded(axial_);
  functions_ = Mat::Zero(size_, functions.cols());
  functions_.topRows(psi.cols()) = psi.transpose() * functions;
  half_H_ = Mat::Zero(row_, bending.cols());
  half_H_.topRows(psi.cols()) = psi.transpose() * bending;
  half_H_.middleRows(size_, axial_) = functions.middleCols(2, axial_).transpose() * bending;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      const std::ptrdiff_t low = std::min(i, j), high = std::max(i, j);
      H_offsets_.push_back((high * (high + 1) / 2 + low) * row_);
    }
}

}  // namespace trammel::beam
