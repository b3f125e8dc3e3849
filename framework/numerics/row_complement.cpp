#include "numerics/row_complement.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/few_rows.hpp"
#include "numerics/packs.hpp"

namespace trammel::numerics {

namespace {

// The lower triangle of Y Y^T, and what else is in its packs.
void products_of_rows(const Mat& Y, Mat& S) {
  const Eigen::Index m = Y.rows();
  S.resize(m, m);
  const bool done = with_few(Y.cols(), [&](auto n) {
    for (Eigen::Index j = 0; j < m; ++j)
      for (Eigen::Index i = pack_of(j); i < m; i += pack) {
        Pack sum = Pack::Zero();
        for (Eigen::Index k = 0; k < n; ++k) sum += Y.data()[k * m + j] * pack_at(Y.data() + k * m + i);
        pack_at(S.data() + j * m + i) = sum;
      }
  });
  if (!done) S.noalias() = Y * Y.transpose();
}

}  // namespace

void RowComplement::factorise(const std::vector<BodyBlock>& bodies, const std::vector<Mat>& Y, int nc, double eps) {
  if (!layout_.holds(bodies, nc)) {
    layout_.find(bodies, nc);
    resize(nc);
  }
  diagonal_.setConstant(eps);
  for (const Front& front : layout_.fronts()) {
    assemble(front, Y, eps);
    eliminate(front);
  }
}

void RowComplement::resize(int nc) {
  L_.setZero(Eigen::Index(layout_.numbers_L()));
  U_.setZero(Eigen::Index(layout_.numbers_U()));
  diagonal_.resize(nc), pivots_.resize(nc), inverse_pivots_.resize(nc), start_.resize(nc);
  work_.resize(padded(layout_.largest()));
}

void RowComplement::assemble(const Front& front, const std::vector<Mat>& Y, double eps) {
  double* const S = L_.data() + front.L;
  std::fill_n(S, front.stride() * front.size, 0.0);
  for (int j = 0; j < front.eliminated; ++j) S[j * front.stride() + j] = eps;
  for (const int k : front.bodies) {
    products_of_rows(Y[std::size_t(k)], share_);
    const std::vector<int>& rows = layout_.rows(k);
    const int* slot = layout_.slots(k).data();
    const auto m = Eigen::Index(rows.size());
    for (Eigen::Index j = 0; j < m; ++j) {
      const double* const column = share_.data() + j * share_.rows();
      diagonal_[rows[std::size_t(j)]] += column[j];
      for (Eigen::Index i = j; i < m; ++i) S[*slot++] += column[i];
    }
  }
  for (const int c : front.children) take(layout_.fronts()[std::size_t(c)], layout_.places(c), front);
}

// R of a child.
void RowComplement::take(const Front& child, const std::vector<int>& places, const Front& front) {
  double* const S = L_.data() + front.L;
  for (int j = child.eliminated; j < child.size; ++j) {
    const double* const R = L_.data() + child.L + j * child.stride() + child.eliminated;
    double* const column = S + places[std::size_t(j - child.eliminated)] * front.stride();
    for (int i = j - child.eliminated; i < int(places.size()); ++i) column[places[std::size_t(i)]] += R[i];
  }
}

// Each column less what those before it contribute, then divided by its pivot.
void RowComplement::eliminate(const Front& front) {
  const Eigen::Index stride = front.stride(), above = front.stride_above();
  double *const L = L_.data() + front.L, *const U = U_.data() + front.U;
  for (int j = 0; j < front.size; ++j) {
    double* const column = L + j * stride;
    const double* const shares = U + j * above;
    const int before = std::min(j, front.eliminated);
    for (Eigen::Index i = pack_of(j); i < stride; i += pack) {
      Pack rest = pack_at(column + i);
      for (int k = 0; k < before; ++k) rest -= shares[k] * pack_at(L + k * stride + i);
      pack_at(column + i) = rest;
    }
    if (j >= front.eliminated) continue;
    const int row = front.rows[std::size_t(j)];
    pivots_[row] = column[j];
    const double inverse = inverse_pivots_[row] = 1 / column[j];
    for (int i = j + 1; i < front.size; ++i) U[i * above + j] = column[i];
    for (Eigen::Index i = pack_of(j); i < stride; i += pack) pack_at(column + i) *= inverse;
  }
}

bool RowComplement::is_safe(double least_sine) const {
  return (pivots_.array() > least_sine * least_sine * diagonal_.array()).all();
}

// From a start without any order, which has a part of every direction.
double RowComplement::softest() {
  scale_ = diagonal_.cwiseSqrt();
  for (Eigen::Index i = 0; i < scale_.size(); ++i) start_[i] = scale_[i] * std::cos(double(i) * double(i));
  solve(start_, end_);
  return start_.cwiseQuotient(scale_).norm() / end_.cwiseProduct(scale_).norm();
}

void RowComplement::solve(const Vec& r, Vec& y) {
  y = r;
  const std::vector<Front>& fronts = layout_.fronts();
  for (const Front& front : fronts) solve_lower(front, y);
  for (auto front = fronts.rbegin(); front != fronts.rend(); ++front) solve_upper(*front, y);
}

namespace {

// Of the packs from row `first` on: the sum of c_j times column j, in registers.
template <class Factor, class Sink>
void combine_columns(const double* columns, Eigen::Index stride, int count, Eigen::Index first, Factor&& c,
                     Sink&& sink) {
  for (Eigen::Index i = pack_of(first); i < stride; i += pack) {
    Pack sum = Pack::Zero();
    for (int j = 0; j < count; ++j) sum += c(j) * pack_at(columns + j * stride + i);
    sink(i, sum);
  }
}

}  // namespace

// y_F := L_FF^-1 y_F,  y_B -= L_BF y_F. A known number is taken out of its pack, too, where it no longer counts.
void RowComplement::solve_lower(const Front& front, Vec& y) {
  const double* const L = L_.data() + front.L;
  const int *const rows = front.rows.data(), eliminated = front.eliminated;
  double* const rest = work_.data();
  for (int i = 0; i < eliminated; ++i) rest[i] = y[rows[i]];
  for (int j = 0; j < eliminated; ++j) {
    const double known = y[rows[j]] = rest[j];
    subtract(known, L + j * front.stride(), rest, j + 1, eliminated);
  }
  combine_columns(
      L, front.stride(), eliminated, eliminated, [&](int j) { return y[rows[j]]; },
      [&](Eigen::Index i, const Pack& sum) { pack_at(rest + i) = sum; });
  for (int i = eliminated; i < front.size; ++i) y[rows[i]] -= rest[i];
}

// y_F := U_F^-1 (y_F - U_B y_B)
void RowComplement::solve_upper(const Front& front, Vec& y) {
  const Eigen::Index above = front.stride_above();
  const double* const U = U_.data() + front.U;
  const int *const rows = front.rows.data(), eliminated = front.eliminated;
  double* const rest = work_.data();
  for (int i = 0; i < eliminated; ++i) rest[i] = y[rows[i]];
  combine_columns(
      U + eliminated * above, above, front.size - eliminated, 0, [&](int j) { return y[rows[eliminated + j]]; },
      [&](Eigen::Index i, const Pack& sum) { pack_at(rest + i) -= sum; });
  for (int j = eliminated - 1; j >= 0; --j) {
    const double known = y[rows[j]] = rest[j] * inverse_pivots_[rows[j]];
    subtract(known, U + j * above, rest, 0, j);
  }
}

}  // namespace trammel::numerics
