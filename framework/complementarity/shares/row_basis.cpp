#include "complementarity/shares/row_basis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

constexpr double no_share = 1e-9;  // of K, for rows of length one

// Cholesky factorisation with diagonal pivoting of the rows in `order`.
class PivotedCholesky {
 public:
  explicit PivotedCholesky(const Mat& A, double least_share = round_off_of_shares)
      : left_(A.diagonal()), size_(A.diagonal()), A_(A), least_share_(least_share) {
    L_.setZero(A.rows(), 0);
  }

  void take(std::vector<Eigen::Index> rows, RowBasis& result) {
    while (!rows.empty()) {
      std::size_t best = 0;
      for (std::size_t k = 1; k < rows.size(); ++k)
        if (share(rows[k]) > share(rows[best])) best = k;
      const Eigen::Index row = rows[best];
      if (!(share(row) > least_share_)) break;
      eliminate(row);
      result.basis.push_back(row);
      rows.erase(rows.begin() + std::ptrdiff_t(best));
    }
    result.implied.insert(result.implied.end(), rows.begin(), rows.end());
  }

 private:
  double share(Eigen::Index i) const { return size_[i] > 0 ? left_[i] / size_[i] : 0; }

  void eliminate(Eigen::Index row) {
    const Vec column = (A_.col(row) - L_ * L_.row(row).transpose()) / std::sqrt(left_[row]);
    L_.conservativeResize(Eigen::NoChange, L_.cols() + 1);
    L_.rightCols(1) = column;
    left_ -= column.cwiseAbs2();
  }

  Vec left_, size_;
  Mat L_;
  const Mat& A_;
  double least_share_;
};

void neglect_round_off(const Mat& A, RowBasis& rows) {
  const Vec length = A.diagonal().cwiseSqrt();
  for (std::size_t i = 0; i < rows.implied.size(); ++i)
    for (std::size_t j = 0; j < rows.basis.size(); ++j) {
      double& share = rows.K(Eigen::Index(i), Eigen::Index(j));
      if (std::abs(share) * length[rows.basis[j]] <= no_share * length[rows.implied[i]]) share = 0;
    }
}

}  // namespace

Mat RowBasis::resultants() const {
  Mat E(Eigen::Index(basis.size()), Eigen::Index(basis.size() + implied.size()));
  E << Mat::Identity(E.rows(), E.rows()), K.transpose();
  return E;
}

RowBasis find_basis(const Mat& A, const std::vector<Eigen::Index>& first, const std::vector<Eigen::Index>& others) {
  RowBasis result;
  PivotedCholesky cholesky(A);
  cholesky.take(first, result);
  cholesky.take(others, result);
  result.K = implied_by(A, result.basis, result.implied);
  neglect_round_off(A, result);
  return result;
}

std::vector<Eigen::Index> well_conditioned_rows(const Mat& A, const std::vector<Eigen::Index>& rows,
                                                double least_share) {
  RowBasis result;
  PivotedCholesky(A, least_share).take(rows, result);
  return result.basis;
}

Mat implied_by(const Mat& A, const std::vector<Eigen::Index>& basis, const std::vector<Eigen::Index>& implied) {
  const Eigen::Index n = Eigen::Index(basis.size()), m = Eigen::Index(implied.size());
  if (n == 0 || m == 0) return Mat::Zero(m, n);
  const Vec scale = A.diagonal()(basis).cwiseSqrt().cwiseInverse();
  const Mat of_basis = scale.asDiagonal() * A(basis, basis) * scale.asDiagonal();
  const Mat of_implied = scale.asDiagonal() * A(basis, implied);
  const Mat found = Eigen::LLT<Mat>(of_basis).solve(of_implied);
  return (scale.asDiagonal() * found).transpose();
}

Vec beside_basis(const Mat& A, const std::vector<Eigen::Index>& basis, const std::vector<Eigen::Index>& others,
                 const Vec& rates) {
  Vec beside = rates(others);
  if (basis.empty() || others.empty()) return beside.setConstant(std::numeric_limits<double>::infinity()), beside;
  const Vec scale = A.diagonal()(basis).cwiseSqrt().cwiseInverse();
  const Mat of_basis = scale.asDiagonal() * A(basis, basis) * scale.asDiagonal();
  const Mat of_others = scale.asDiagonal() * A(basis, others);
  const Mat K = Eigen::LLT<Mat>(of_basis).solve(of_others);
  beside -= K.transpose() * scale.cwiseProduct(rates(basis));
  for (Eigen::Index i = 0; i < beside.size(); ++i) {
    const double own = A(others[std::size_t(i)], others[std::size_t(i)]);
    if (own - K.col(i).dot(of_others.col(i)) > round_off_of_shares * own)
      beside[i] = std::numeric_limits<double>::infinity();
  }
  return beside;
}

bool follows(const Mat& A, const std::vector<Eigen::Index>& rows, Eigen::Index row) {
  const RowBasis found = find_basis(A, rows, {row});
  return std::find(found.implied.begin(), found.implied.end(), row) != found.implied.end();
}

}  // namespace trammel::complementarity
