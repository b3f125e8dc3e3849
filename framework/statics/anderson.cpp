#include "statics/anderson.hpp"

#include <algorithm>

#include <trammel/decompositions.hpp>

namespace trammel::numerics {

Vec Anderson::next(const Vec& s) {
  Vec change = s;
  if (last_s_.size() == s.size()) {
    const Eigen::Index kept = std::min(dX_.cols(), remembered - 1);
    Mat dX(s.size(), kept + 1), dS(s.size(), kept + 1);
    dX << dX_.rightCols(kept), last_x_;
    dS << dS_.rightCols(kept), s - last_s_;
    dX_ = dX, dS_ = dS;
    change -= (dX_ + dS_) * Eigen::ColPivHouseholderQR<Mat>(dS_).solve(s);
  } else {
    dX_.resize(s.size(), 0), dS_.resize(s.size(), 0);
  }
  last_x_ = change, last_s_ = s;
  return change;
}

}  // namespace trammel::numerics
