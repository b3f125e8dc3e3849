#include "linear/bodies/row_places.hpp"

#include <algorithm>
#include <cstddef>

namespace trammel::numerics {

namespace {

constexpr int border = -1;  // separator after the rows of each body

}  // namespace

void RowPlaces::take(const std::vector<BodyBlock>& bodies, int nc) {
  nc_ = nc;
  rows_.clear();
  for (const BodyBlock& body : bodies) {
    rows_.insert(rows_.end(), body.rows.begin(), body.rows.end());
    rows_.push_back(border);
  }
}

bool RowPlaces::are_of(const std::vector<BodyBlock>& bodies, int nc) const {
  if (nc != nc_) return false;
  auto at = rows_.begin();
  for (const BodyBlock& body : bodies) {
    const auto rows = std::ptrdiff_t(body.rows.size());
    if (rows >= rows_.end() - at || at[rows] != border || !std::equal(body.rows.begin(), body.rows.end(), at))
      return false;
    at += rows + 1;
  }
  return at == rows_.end();
}

}  // namespace trammel::numerics
