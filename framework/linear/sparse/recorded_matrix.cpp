#include "linear/sparse/recorded_matrix.hpp"

#include <algorithm>

namespace trammel::numerics {

void RecordedMatrix::begin(int rows, int columns) {
  known_ = known_ && matrix_.rows() == rows && matrix_.cols() == columns;
  if (!known_) matrix_.resize(rows, columns);
  values_ = matrix_.valuePtr();
  std::fill_n(values_, known_ ? matrix_.nonZeros() : 0, 0.0);
  next_ = known_ ? 0 : places_.size() + 1;
  recording_ = false;
}

void RecordedMatrix::begin_recording() {
  recording_ = true;
  places_.clear();
  recorded_.clear();
}

void RecordedMatrix::finish_recording() {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k)
    entries.emplace_back(places_[k].first, places_[k].second, recorded_[k]);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  slots_.resize(places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[places_[k].second];
    const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[places_[k].second + 1];
    slots_[k] = std::lower_bound(first, last, places_[k].first) - matrix_.innerIndexPtr();
  }
  recorded_.clear();
  recording_ = false;
  known_ = true;
  next_ = places_.size();
}

}  // namespace trammel::numerics
