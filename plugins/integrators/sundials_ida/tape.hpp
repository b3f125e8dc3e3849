// The solution between the last accepted state and the end of IDA's last internal step, segment by segment.
#pragma once

#include <utility>
#include <vector>

#include "solver.hpp"

namespace trammel::ida {

class Tape {
 public:
  void clear() { first_ = count_ = 0; }
  bool empty() const { return count_ == 0; }
  double end() const { return segments_[first_ + count_ - 1].end; }  // not empty

  // The next segment, to be filled; `keep` makes it a part of the tape. Segments are used again: no memory is asked for
  // once there are enough.
  Segment& next() {
    if (first_ + count_ == segments_.size()) segments_.emplace_back();
    return segments_[first_ + count_];
  }
  void keep() { ++count_; }

  // The one that contains t, or the last; not empty.
  const Segment& at(double t) const {
    std::size_t i = first_;
    while (i + 1 < first_ + count_ && segments_[i].end < t) ++i;
    return segments_[i];
  }

  // Forgets segments that end before t, except the last.
  void forget_before(double t) {
    while (count_ > 1 && segments_[first_].end < t) ++first_, --count_;
    if (first_ == 0 || first_ < count_) return;
    for (std::size_t i = 0; i < count_; ++i) std::swap(segments_[i], segments_[first_ + i]);
    first_ = 0;
  }

 private:
  std::vector<Segment> segments_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace trammel::ida
