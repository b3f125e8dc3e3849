#include "numerics/row_complement.hpp"

#include <algorithm>
#include <numeric>

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

void RowComplement::assemble(const std::vector<BodyBlock>& bodies, const std::vector<Mat>& Y, double eps,
                             RecordedMatrix& S) {
  std::fill_n(diagonal_.data(), diagonal_.size(), eps);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const std::vector<int>& rows = bodies[k].rows;
    const auto m = std::size_t(std::lower_bound(rows.begin(), rows.end(), int(diagonal_.size())) - rows.begin());
    products_of_rows(Y[k], share_);
    for (std::size_t j = 0; j < m; ++j) {
      const int to = place_[std::size_t(rows[j])];
      const double* const column = share_.data() + Eigen::Index(j) * share_.rows();
      diagonal_[to] += column[j];
      for (std::size_t i = j; i < m; ++i) {
        const int from = place_[std::size_t(rows[i])];
        S.add(std::min(from, to), std::max(from, to), column[i]);
      }
    }
  }
  for (int i = 0; i < int(diagonal_.size()); ++i) S.add(i, i, eps);
}

// From the rows' own order, so that what a resumed run finds is what it was before.
void RowComplement::reorder() {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order, places;
  Eigen::AMDOrdering<int>()(S_.matrix().selfadjointView<Eigen::Upper>(), order);
  places = order.inverse();
  for (int& place : place_) place = places.indices()(place);
}

void RowComplement::factorise(const std::vector<BodyBlock>& bodies, const std::vector<Mat>& Y, int nc, double eps) {
  diagonal_.resize(nc);
  const auto fill = [&] { return S_.fill(nc, nc, [&](RecordedMatrix& S) { assemble(bodies, Y, eps, S); }); };
  if (int(place_.size()) != nc || fill()) {
    place_.resize(std::size_t(nc));
    std::iota(place_.begin(), place_.end(), 0);
    fill();
    reorder();
    fill();
    ldlt_.analyzePattern(S_.matrix());
  }
  ldlt_.factorize(S_.matrix());
}

bool RowComplement::is_safe(double least_sine) const {
  return ldlt_.info() == Eigen::Success &&
         (ldlt_.vectorD().array() > least_sine * least_sine * diagonal_.array()).all();
}

void RowComplement::solve(const Vec& r, Vec& y) {
  ordered_.resize(r.size());
  for (Eigen::Index i = 0; i < r.size(); ++i) ordered_[place_[std::size_t(i)]] = r[i];
  ordered_ = ldlt_.solve(ordered_);
  y.resize(r.size());
  for (Eigen::Index i = 0; i < r.size(); ++i) y[i] = ordered_[place_[std::size_t(i)]];
}

}  // namespace trammel::numerics
