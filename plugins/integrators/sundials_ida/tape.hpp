// The solution between the last accepted state and the end of IDA's last internal step, segment by segment.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "solver.hpp"

namespace trammel::ida {

class Tape {
 public:
  void clear() { first_ = count_ = 0; }
  // Allocates segments for this number of coordinates, so that steps need not: 256 for small systems, 16 for large
  // ones.
  void reserve(Eigen::Index coordinates, int max_order) {
    constexpr std::size_t numbers = 1 << 17, fewest = 16, most = 256;
    const auto each = std::max<std::size_t>(1, std::size_t(coordinates) * std::size_t(max_order + 1));
    const std::size_t count = std::clamp(numbers / each, fewest, most);
    if (segments_.size() < count) segments_.resize(count);
    for (Segment& segment : segments_) segment.derivatives.resize(coordinates, max_order + 1);
  }
  bool empty() const { return count_ == 0; }
  double end() const { return segments_[first_ + count_ - 1].end; }  // not empty

  // The next segment, to be filled; `keep` makes it a part of the tape. Segments are reused: nothing is allocated
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
