// A sparse matrix that is filled again and again by the same sequence of additions.
//
// The first filling records the places in the order of the calls and builds the pattern; later ones replay the sequence into
// the slots found, without searching. Another sequence only costs a new recording.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/SparseCore>

#include <trammel/types.hpp>

namespace trammel::numerics {

class RecordedMatrix {
 public:
  // `additions(matrix)` calls add(i, j, value); it may be run twice. True: the pattern is another than before.
  template <class Additions>
  bool fill(int rows, int columns, Additions&& additions) {
    begin(rows, columns);
    additions(*this);
    if (replayed()) return false;
    begin_recording();
    additions(*this);
    finish_recording();
    return true;
  }

  void add(int i, int j, double value) {
    if (recording_) {
      places_.emplace_back(i, j);
      recorded_.push_back(value);
    } else if (next_ < places_.size() && places_[next_].first == i && places_[next_].second == j) {
      values_[slots_[next_++]] += value;
    } else {
      next_ = places_.size() + 1;  // another sequence
    }
  }

  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  void begin(int rows, int columns);
  bool replayed() const { return next_ == places_.size() && known_; }
  void begin_recording();
  void finish_recording();

  Eigen::SparseMatrix<double> matrix_;
  double* values_ = nullptr;
  std::vector<std::pair<int, int>> places_;
  std::vector<Eigen::Index> slots_;
  std::vector<double> recorded_;
  std::size_t next_ = 0;
  bool known_ = false, recording_ = false;
};

}  // namespace trammel::numerics
