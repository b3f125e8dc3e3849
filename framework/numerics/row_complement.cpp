#include "numerics/row_complement.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "numerics/fetch.hpp"
#include "numerics/few_rows.hpp"
#include "numerics/packs.hpp"

namespace trammel::numerics {

namespace {

template <class Columns, class Rows>
void multiply(const double* Y, Columns n, Rows m, double* S) {
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = pack_of(j); i < m; i += pack) {
      Pack sum = Pack::Zero();
      for (Eigen::Index k = 0; k < n; ++k) sum += Y[k * m + j] * pack_at(Y + k * m + i);
      pack_at(S + j * m + i) = sum;
    }
}

// The lower triangle of Y Y^T, and what else is in its packs. Of known sizes it takes a hinged link half of the time.
void products_of_rows(const Mat& Y, double* S) {
  const Eigen::Index m = Y.rows();
  const bool done = with_few(Y.cols(), [&](auto n) {
    const auto of_packs = [&](auto packs) {
      multiply(Y.data(), n, std::integral_constant<Eigen::Index, packs * pack>(), S);
    };
    if (!with_few<4>(m / pack, of_packs)) multiply(Y.data(), n, m, S);
  });
  if (!done) Eigen::Map<Mat>(S, m, m).noalias() = Y * Y.transpose();
}

// f(rows eliminated, rows from column to column), known to the compiler for small fronts: so fronts of hinges take two thirds of the time.
template <class F>
void with_sizes(const ComplementLayout::Front& front, F&& f) {
  const bool known = front.stride() <= 4 * pack && with_few(front.eliminated, [&](auto eliminated) {
                       with_few<4>(front.stride() / pack, [&](auto packs) {
                         f(eliminated, std::integral_constant<Eigen::Index, packs * pack>());
                       });
                     });
  if (!known) f(Eigen::Index(front.eliminated), front.stride());
}

}  // namespace

void RowComplement::factorise(const std::vector<BodyBlock>& bodies, const std::vector<Cholesky>& masses, int nc,
                              double eps) {
  if (!layout_.holds(bodies, nc)) {
    layout_.find(bodies, nc);
    resize(nc);
  }
  diagonal_.setConstant(eps);
  Y_.resize(bodies.size());
  const std::vector<Front>& fronts = layout_.fronts();
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    look_ahead(i, fronts.size(), [&](std::size_t next) {
      for (const int k : fronts[next].bodies) {
        const Mat &Gt = bodies[std::size_t(k)].Gt, &Y = Y_[std::size_t(k)];
        fetch(Gt.data(), std::size_t(Gt.size()) * sizeof(double)),
            fetch(Y.data(), std::size_t(Y.size()) * sizeof(double));
      }
    });
    assemble(bodies, masses, fronts[i], eps);
    eliminate(fronts[i]);
  }
}

void RowComplement::resize(int nc) {
  const Eigen::Index largest = padded(layout_.largest());
  L_.setZero(Eigen::Index(layout_.numbers_L()));
  U_.setZero(Eigen::Index(layout_.numbers_U()));
  diagonal_.resize(nc), pivots_.resize(nc), inverse_pivots_.resize(nc), start_.resize(nc);
  work_.resize(largest), share_.resize(largest * largest);
}

void RowComplement::assemble(const std::vector<BodyBlock>& bodies, const std::vector<Cholesky>& masses,
                             const Front& front, double eps) {
  double* const S = L_.data() + front.L;
  std::fill_n(S, front.stride() * front.size, 0.0);
  for (int j = 0; j < front.eliminated; ++j) S[j * front.stride() + j] = eps;
  for (const int body : front.bodies) {
    const auto k = std::size_t(body);
    form_Y(bodies[k], masses[k], layout_.order(body), Y_[k]);
    products_of_rows(Y_[k], share_.data());
    add_share(body, front);
  }
  for (const int c : front.children) take(layout_.fronts()[std::size_t(c)], layout_.places(c), front);
}

void RowComplement::form_Y(const BodyBlock& body, const Cholesky& mass, const std::vector<int>& order, Mat& Y) {
  const auto m = Eigen::Index(order.size()), stride = padded(m);
  Y.resize(stride, body.Gt.rows());
  const auto copy = [&](auto n) {
    for (Eigen::Index i = 0; i < m; ++i) {
      const double* const row = body.Gt.data() + order[std::size_t(i)] * n;
      for (Eigen::Index j = 0; j < n; ++j) Y.data()[j * stride + i] = row[j];
    }
  };
  if (!with_few(body.Gt.rows(), copy)) copy(body.Gt.rows());
  Y.bottomRows(stride - m).setZero();
  mass.solve_lower_of_rows(Y);
}

void RowComplement::add_share(int body, const Front& front) {
  double* const S = L_.data() + front.L;
  const std::vector<int>& rows = layout_.rows(body);
  const auto m = Eigen::Index(rows.size()), stride = padded(m);
  for (Eigen::Index j = 0; j < m; ++j) diagonal_[rows[std::size_t(j)]] += share_[j * stride + j];
  if (layout_.leads(body)) {
    for (Eigen::Index j = 0; j < m; ++j)
      for (Eigen::Index i = pack_of(j); i < stride; i += pack)
        pack_at(S + j * front.stride() + i) += pack_at(share_.data() + j * stride + i);
    return;
  }
  const int* slot = layout_.slots(body).data();
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = j; i < m; ++i) S[*slot++] += share_[j * stride + i];
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
  with_sizes(front, [&](auto eliminated, auto stride) {
    const Eigen::Index above = padded(eliminated);
    double *const L = L_.data() + front.L, *const U = U_.data() + front.U;
    for (Eigen::Index j = 0; j < front.size; ++j) {
      double* const column = L + j * stride;
      const double* const shares = U + j * above;
      const Eigen::Index before = std::min<Eigen::Index>(j, eliminated);
      for (Eigen::Index i = pack_of(j); i < stride; i += pack) {
        Pack rest = pack_at(column + i);
        for (Eigen::Index k = 0; k < before; ++k) rest -= shares[k] * pack_at(L + k * stride + i);
        pack_at(column + i) = rest;
      }
      if (j >= eliminated) continue;
      const int row = front.rows[std::size_t(j)];
      pivots_[row] = column[j];
      const double inverse = inverse_pivots_[row] = 1 / column[j];
      for (Eigen::Index i = j + 1; i < front.size; ++i) U[i * above + j] = column[i];
      for (Eigen::Index i = pack_of(j); i < stride; i += pack) pack_at(column + i) *= inverse;
    }
  });
}

bool RowComplement::is_safe(double least_sine) const {
  return (pivots_.array() > least_sine * least_sine * diagonal_.array()).all();
}

// From a start of signs without any order (a hash's), which has a part of every direction.
double RowComplement::softest() {
  scale_ = diagonal_.cwiseSqrt();
  for (Eigen::Index i = 0; i < scale_.size(); ++i)
    start_[i] = std::uint32_t(i) * 2654435769U >> 31 ? scale_[i] : -scale_[i];
  solve(start_, end_);
  return start_.cwiseQuotient(scale_).norm() / end_.cwiseProduct(scale_).norm();
}

void RowComplement::solve(const Vec& r, Vec& y) {
  y = r;
  const std::vector<Front>& fronts = layout_.fronts();
  const auto ask_for = [&](const Front& front) { fetch(front.rows.data(), front.rows.size() * sizeof(int)); };
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    look_ahead(i, fronts.size(), [&](std::size_t next) { ask_for(fronts[next]); });
    solve_lower(fronts[i], y);
  }
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const auto from_end = [&](std::size_t k) -> const Front& { return fronts[fronts.size() - 1 - k]; };
    look_ahead(i, fronts.size(), [&](std::size_t next) {
      const Front& front = from_end(next);
      ask_for(front);
      fetch(U_.data() + front.U, std::size_t(front.stride_above() * front.size) * sizeof(double));
    });
    solve_upper(from_end(i), y);
  }
}

namespace {

// y -= c_0 x_0 + c_1 x_1 + ... of columns `stride` apart, in packs from that of row `first` on; sums in registers.
template <class Stride, class Factor>
void subtract_columns(const double* columns, Stride stride, Eigen::Index count, Eigen::Index first, Factor&& c,
                      double* y) {
  for (Eigen::Index i = pack_of(first); i < stride; i += pack) {
    Pack sum = Pack::Zero();
    for (Eigen::Index j = 0; j < count; ++j) sum += c(j) * pack_at(columns + j * stride + i);
    pack_at(y + i) -= sum;
  }
}

}  // namespace

// y_F := L_FF^-1 y_F,  y_B -= L_BF y_F. A known number is taken out of its pack, too, where it no longer counts.
void RowComplement::solve_lower(const Front& front, Vec& y) {
  with_sizes(front, [&](auto eliminated, auto stride) {
    const double* const L = L_.data() + front.L;
    const int* const rows = front.rows.data();
    double* const rest = work_.data();
    for (Eigen::Index i = 0; i < eliminated; ++i) rest[i] = y[rows[i]];
    for (Eigen::Index i = eliminated; i < stride; ++i) rest[i] = 0;
    for (Eigen::Index j = 0; j < eliminated; ++j) {
      const double known = y[rows[j]] = rest[j];
      subtract(known, L + j * stride, rest, j + 1, eliminated);
    }
    for (Eigen::Index i = eliminated; i < padded(eliminated); ++i) rest[i] = 0;
    subtract_columns(
        L, stride, eliminated, eliminated, [&](Eigen::Index j) { return y[rows[j]]; }, rest);
    for (Eigen::Index i = eliminated; i < front.size; ++i) y[rows[i]] += rest[i];
  });
}

// y_F := U_F^-1 (y_F - U_B y_B)
void RowComplement::solve_upper(const Front& front, Vec& y) {
  with_sizes(front, [&](auto eliminated, auto) {
    const auto above = padded(eliminated);
    const double* const U = U_.data() + front.U;
    const int* const rows = front.rows.data();
    double* const rest = work_.data();
    for (Eigen::Index i = 0; i < eliminated; ++i) rest[i] = y[rows[i]];
    const int* const boundary = rows + eliminated;
    subtract_columns(
        U + eliminated * above, above, front.size - eliminated, 0, [&](Eigen::Index j) { return y[boundary[j]]; },
        rest);
    for (Eigen::Index j = eliminated - 1; j >= 0; --j) {
      const double known = y[rows[j]] = rest[j] * inverse_pivots_[rows[j]];
      subtract(known, U + j * above, rest, 0, j);
    }
  });
}

}  // namespace trammel::numerics
