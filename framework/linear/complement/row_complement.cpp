#include "linear/complement/row_complement.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "linear/dense/fixed_sizes.hpp"
#include "linear/dense/prefetch.hpp"
#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

namespace {

template <class Columns, class Rows>
void multiply(const double* Y, Columns n, Rows m, double* S) {
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = pack_of(j); i < m; i += pack) {
      Pack sum{};
      for (Eigen::Index k = 0; k < n; ++k) sum += Y[k * m + j] * pack_at(Y + k * m + i);
      pack_at(S + j * m + i) = sum;
    }
}

// The lower triangle of Y Y^T, filled up to whole packs. Small sizes are compile-time constants.
void products_of_rows(const Eigen::Map<Mat>& Y, double* S) {
  const Eigen::Index m = Y.rows();
  const bool done = with_fixed_size(Y.cols(), [&](auto n) {
    const auto of_packs = [&](auto packs) {
      multiply(Y.data(), n, std::integral_constant<Eigen::Index, packs * pack>(), S);
    };
    if (!with_fixed_size<4>(m / pack, of_packs)) multiply(Y.data(), n, m, S);
  });
  if (!done) Eigen::Map<Mat>(S, m, m).noalias() = Y * Y.transpose();
}

// Calls f(rows eliminated, distance between columns), with compile-time constants for small fronts.
template <class F>
void with_sizes(const ComplementLayout::Front& front, F&& f) {
  const bool known = front.stride() <= 4 * pack && with_fixed_size(front.eliminated, [&](auto eliminated) {
                       with_fixed_size<4>(front.stride() / pack, [&](auto packs) {
                         f(eliminated, std::integral_constant<Eigen::Index, packs * pack>());
                       });
                     });
  if (!known) f(Eigen::Index(front.eliminated), front.stride());
}

}  // namespace

bool RowComplement::factorise(const std::vector<BodyBlock>& bodies, const BodyMasses& masses, int nc,
                              double least_sine) {
  if (!layout_.is_built_for(bodies, nc)) {
    layout_.find(bodies, nc);
    resize(nc);
  }
  diagonal_.setZero();
  least_square_sine_ = std::numeric_limits<double>::infinity();
  const std::vector<Front>& fronts = layout_.fronts();
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    look_ahead(i, fronts.size(), [&](std::size_t next) {
      for (const Share& share : layout_.bodies(fronts[next])) {
        const Mat& Gt = bodies[std::size_t(share.of)].Gt;
        prefetch(Gt.data(), std::size_t(Gt.size()) * sizeof(double));
      }
    });
    assemble(bodies, masses, fronts[i]);
    eliminate(fronts[i]);
    if (!(least_square_sine_ > least_sine * least_sine)) return false;
  }
  return true;
}

void RowComplement::resize(int nc) {
  const Eigen::Index largest = padded(layout_.largest());
  L_.setZero(Eigen::Index(layout_.numbers_L()));
  R_.setZero(Eigen::Index(layout_.numbers_R()));
  diagonal_.resize(nc);
  work_.resize(largest), product_.resize(largest * largest);
}

void RowComplement::assemble(const std::vector<BodyBlock>& bodies, const BodyMasses& masses, const Front& front) {
  std::fill_n(L_.data() + front.L, front.stride() * front.eliminated, 0.0);
  std::fill_n(R_.data() + front.R, front.stride() * (front.size - front.eliminated), 0.0);
  for (const Share& share : layout_.bodies(front)) {
    const std::span<const int> places = layout_.places(share), rows = layout_.rows(front);
    const Eigen::Map<Mat> Y = form_Y(bodies, masses, share);
    products_of_rows(Y, product_.data());
    for (std::size_t j = 0; j < places.size(); ++j)
      diagonal_[rows[std::size_t(places[j])]] += product_[Eigen::Index(j) * (Y.rows() + 1)];
    add_at(places, product_.data(), Y.rows(), front);
  }
  for (const Share& share : layout_.children(front)) {
    const Front& child = layout_.fronts()[std::size_t(share.of)];
    add_at(layout_.places(share), R_.data() + child.R + child.eliminated, child.stride(), front);
  }
}

Eigen::Map<Mat> RowComplement::form_Y(const std::vector<BodyBlock>& bodies, const BodyMasses& masses,
                                      const Share& share) {
  const BodyBlock& body = bodies[std::size_t(share.of)];
  const std::span<const int> order = layout_.order(share);
  const double* const inverse_roots = masses.inverse_roots(body);
  const auto m = Eigen::Index(order.size()), stride = padded(m);
  if (Y_.size() < stride * body.Gt.rows()) Y_.resize(stride * body.Gt.rows());
  Eigen::Map<Mat> Y(Y_.data(), stride, body.Gt.rows());
  const auto copy = [&](auto n) {
    for (Eigen::Index i = 0; i < m; ++i) {
      const double* const row = body.Gt.data() + order[std::size_t(i)] * n;
      for (Eigen::Index j = 0; j < n; ++j) Y.data()[j * stride + i] = inverse_roots[j] * row[j];
    }
  };
  if (!with_fixed_size(body.Gt.rows(), copy)) copy(body.Gt.rows());
  Y.bottomRows(stride - m).setZero();
  if (const Cholesky* factors = masses.dense(std::size_t(share.of))) factors->solve_lower_of_rows(Y);
  return Y;
}

// Adds the lower triangle of A, whose columns are `stride` apart, to the front.
void RowComplement::add_at(std::span<const int> places, const double* A, Eigen::Index stride, const Front& front) {
  for (std::size_t j = 0; j < places.size(); ++j, A += stride) {
    double* const sum = column(front, places[j]);
    for (std::size_t i = j; i < places.size(); ++i) sum[places[i]] += A[i];
  }
}

double* RowComplement::column(const Front& front, Eigen::Index j) {
  return j < front.eliminated ? L_.data() + front.L + j * front.stride()
                              : R_.data() + front.R + (j - front.eliminated) * front.stride();
}

// Subtracts the contributions of earlier columns from each column and divides it by its pivot; a pivot that is not a
// positive number counts as 0. U = D [L_FF^T L_BF^T] is needed only here.
void RowComplement::eliminate(const Front& front) {
  with_sizes(front, [&](auto eliminated, auto stride) {
    const Eigen::Index above = padded(Eigen::Index(eliminated));
    double *const L = L_.data() + front.L, *const R = R_.data() + front.R, *const U = product_.data();
    const std::span<const int> rows = layout_.rows(front);
    for (Eigen::Index j = 0; j < front.size; ++j) {
      double* const column = j < eliminated ? L + j * stride : R + (j - eliminated) * stride;
      const double* const shares = U + j * above;
      const Eigen::Index before = std::min<Eigen::Index>(j, eliminated);
      for (Eigen::Index i = pack_of(j); i < stride; i += pack) {
        Pack rest = pack_at(column + i);
        for (Eigen::Index k = 0; k < before; ++k) rest -= shares[k] * pack_at(L + k * stride + i);
        pack_at(column + i) = rest;
      }
      if (j >= eliminated) continue;
      const double square_sine = column[j] / diagonal_[rows[std::size_t(j)]], inverse = 1 / column[j];
      least_square_sine_ = std::min(least_square_sine_, square_sine > 0 ? square_sine : 0);
      for (Eigen::Index i = j + 1; i < front.size; ++i) U[i * above + j] = column[i];
      for (Eigen::Index i = pack_of(j); i < stride; i += pack) pack_at(column + i) *= inverse;
      work_[j] = inverse;
    }
    for (Eigen::Index j = 0; j < eliminated; ++j) L[j * stride + j] = work_[j];
  });
}

void RowComplement::solve(const Vec& r, Vec& y) {
  y = r;
  const std::vector<Front>& fronts = layout_.fronts();
  for (const Front& front : fronts) solve_lower(front, y);
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const auto from_end = [&](std::size_t k) -> const Front& { return fronts[fronts.size() - 1 - k]; };
    look_ahead(i, fronts.size(), [&](std::size_t next) {
      const Front& front = from_end(next);
      prefetch(L_.data() + front.L, std::size_t(front.stride() * front.eliminated) * sizeof(double));
    });
    solve_upper(from_end(i), y);
  }
}

namespace {

// y -= c_0 x_0 + c_1 x_1 + ... of columns `stride` apart, from the pack that contains row `first` on; sums in
// registers.
template <class Stride, class Factor>
void subtract_columns(const double* columns, Stride stride, Eigen::Index count, Eigen::Index first, Factor&& c,
                      double* y) {
  for (Eigen::Index i = pack_of(first); i < stride; i += pack) {
    Pack sum{};
    for (Eigen::Index j = 0; j < count; ++j) sum += c(j) * pack_at(columns + j * stride + i);
    pack_at(y + i) -= sum;
  }
}

}  // namespace

// y_F := L_FF^-1 y_F,  y_B -= L_BF y_F. A solved entry is also subtracted in its own pack, where it is no longer
// needed.
void RowComplement::solve_lower(const Front& front, Vec& y) {
  with_sizes(front, [&](auto eliminated, auto stride) {
    const double* const L = L_.data() + front.L;
    const int* const rows = layout_.rows(front).data();
    double* const rest = work_.data();
    for (Eigen::Index i = 0; i < eliminated; ++i) rest[i] = y[rows[i]];
    for (Eigen::Index i = eliminated; i < stride; ++i) rest[i] = 0;
    for (Eigen::Index j = 0; j < eliminated; ++j) {
      const double known = y[rows[j]] = rest[j];
      subtract(known, L + j * stride, rest, j + 1, eliminated);
    }
    for (Eigen::Index i = eliminated; i < padded(Eigen::Index(eliminated)); ++i) rest[i] = 0;
    subtract_columns(
        L, stride, eliminated, eliminated, [&](Eigen::Index j) { return y[rows[j]]; }, rest);
    for (Eigen::Index i = eliminated; i < front.size; ++i) y[rows[i]] += rest[i];
  });
}

// y_F := L_FF^-T (D^-1 y_F - L_BF^T y_B)
void RowComplement::solve_upper(const Front& front, Vec& y) {
  if (front.eliminated > most_unrolled) return solve_upper_of_large_front(front, y);
  with_sizes(front, [&](auto eliminated, auto stride) {
    const double* const L = L_.data() + front.L;
    const int* const rows = layout_.rows(front).data();
    double* const rest = work_.data();
    for (Eigen::Index j = 0; j < eliminated; ++j) rest[j] = y[rows[j]] * L[j * stride + j];
    const auto take_out = [&](double known, Eigen::Index i, Eigen::Index from) {
      for (Eigen::Index j = 0; j < from; ++j) rest[j] -= L[j * stride + i] * known;
    };
    for (Eigen::Index i = eliminated; i < front.size; ++i) take_out(y[rows[i]], i, eliminated);
    for (Eigen::Index i = eliminated - 1; i >= 0; --i) take_out(y[rows[i]] = rest[i], i, i);
  });
}

void RowComplement::solve_upper_of_large_front(const Front& front, Vec& y) {
  const std::span<const int> rows = layout_.rows(front);
  const Eigen::Index eliminated = front.eliminated, boundary = front.size - eliminated;
  const Eigen::Map<const Mat, 0, Eigen::OuterStride<>> L(L_.data() + front.L, front.size, eliminated,
                                                         Eigen::OuterStride<>(front.stride()));
  for (Eigen::Index j = 0; j < front.size; ++j) {
    const int row = rows[std::size_t(j)];
    work_[j] = j < eliminated ? y[row] * L(j, j) : y[row];
  }
  auto of_front = work_.head(eliminated);
  of_front.noalias() -= L.bottomRows(boundary).transpose() * work_.segment(eliminated, boundary);
  L.topRows(eliminated).triangularView<Eigen::UnitLower>().transpose().solveInPlace(of_front);
  for (Eigen::Index j = 0; j < eliminated; ++j) y[rows[std::size_t(j)]] = of_front[j];
}

}  // namespace trammel::numerics
