#include "complementarity/programs/nonnegative_least_squares.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

constexpr double no_descent = 1e-13;         // slope along a column of length 1, of |d|: round-off
constexpr double dependent_columns = 1e-12;  // pivots of the columns of length 1

class ActiveSet {
 public:
  ActiveSet(const Mat& B, const Vec& d, Vec& x)
      : B_(B), d_(d), x_(x), state_(std::size_t(B.cols()), State::zero), size_(B.colwise().norm()) {
    x_.setZero(B.cols());
    for (std::size_t j = 0; j < state_.size(); ++j)
      if (!(size_[Eigen::Index(j)] > 0)) state_[j] = State::barred;
  }

  double solve() {
    const int most = 10 * int(B_.cols()) + 10;
    residual_ = d_;
    for (int i = 0; i < most; ++i) {
      const int j = entering();
      if (j < 0) break;
      state_[std::size_t(j)] = State::positive;
      if (!least_squares() || !(z_[position_of(j)] > 0)) {  // dependent on the others up to round-off
        state_[std::size_t(j)] = State::refused;
        continue;
      }
      while (!all_positive()) {
        back_to_feasible();
        if (least_squares()) continue;
        z_ = x_(positive_);  // dependent up to round-off: no improvement
        break;
      }
      take();
      for (State& state : state_)
        if (state == State::refused) state = State::zero;
    }
    return residual_.norm();
  }

 private:
  enum class State { zero, positive, refused, barred };

  // The column with the steepest descent, by its cosine with the residual; -1: none.
  int entering() const {
    int best = -1;
    double steepest = no_descent * d_.norm();
    for (std::size_t j = 0; j < state_.size(); ++j) {
      if (state_[j] != State::zero) continue;
      const auto column = Eigen::Index(j);
      const double slope = B_.col(column).dot(residual_) / size_[column];
      if (slope > steepest) best = int(j), steepest = slope;
    }
    return best;
  }

  bool least_squares() {
    positive_.clear();
    for (std::size_t j = 0; j < state_.size(); ++j)
      if (state_[j] == State::positive) positive_.push_back(Eigen::Index(j));
    if (positive_.empty()) return z_.resize(0), true;
    qr_.setThreshold(dependent_columns);
    const Vec scale = size_(positive_).cwiseInverse();
    const Mat columns = B_(Eigen::all, positive_) * scale.asDiagonal();
    qr_.compute(columns);
    if (qr_.rank() < Eigen::Index(positive_.size())) return false;
    z_ = scale.cwiseProduct(qr_.solve(d_));
    return z_.allFinite();
  }

  Eigen::Index position_of(int column) const {
    return std::lower_bound(positive_.begin(), positive_.end(), column) - positive_.begin();
  }
  bool all_positive() const { return z_.size() == 0 || z_.minCoeff() > 0; }

  // Moves towards z as far as x stays >= 0; the entry that reaches 0 first leaves the set.
  void back_to_feasible() {
    double part = 1;
    for (std::size_t k = 0; k < positive_.size(); ++k)
      if (const auto i = Eigen::Index(k); z_[i] <= 0)
        part = std::min(part, x_[positive_[k]] / (x_[positive_[k]] - z_[i]));
    for (std::size_t k = 0; k < positive_.size(); ++k) {
      const Eigen::Index j = positive_[k], i = Eigen::Index(k);
      const bool leaves = z_[i] <= 0 && x_[j] <= part * (x_[j] - z_[i]);
      x_[j] = leaves ? 0 : x_[j] + part * (z_[i] - x_[j]);
      if (leaves) state_[std::size_t(j)] = State::zero;
    }
  }

  void take() {
    x_.setZero();
    for (std::size_t k = 0; k < positive_.size(); ++k) x_[positive_[k]] = z_[Eigen::Index(k)];
    residual_ = d_ - B_ * x_;
  }

  const Mat& B_;
  const Vec& d_;
  Vec& x_;
  std::vector<State> state_;
  Vec size_;
  std::vector<Eigen::Index> positive_;
  Eigen::ColPivHouseholderQR<Mat> qr_;
  Vec z_, residual_;
};

}  // namespace

double nonnegative_least_squares(const Mat& B, const Vec& d, Vec& x) {
  if (!B.allFinite() || !d.allFinite()) {
    x.setZero(B.cols());
    return std::numeric_limits<double>::infinity();
  }
  return ActiveSet(B, d, x).solve();
}

}  // namespace trammel::complementarity
