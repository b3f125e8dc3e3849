#include "complementarity/islands.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Index;

std::vector<Index> rows_of(const ContactPoint& p) {
  std::vector<Index> rows;
  if (p.normal >= 0) rows.push_back(p.normal);
  for (int k = 0; k < p.tangents && p.tangent >= 0; ++k) rows.push_back(p.tangent + k);
  return rows;
}

bool act_on_each_other(const ContactPoint& p, const ContactPoint& r, const Mat& A) {
  for (const Index i : rows_of(p))
    for (const Index j : rows_of(r))
      if (A(i, j) != 0 || A(j, i) != 0) return true;
  return false;
}

void add(const ContactPoint& p, Island& island) {
  ContactPoint& own = island.points.emplace_back(p);
  if (p.normal >= 0) own.normal = int(island.rows.size()), island.rows.push_back(p.normal);
  if (p.tangent < 0) return;
  own.tangent = int(island.rows.size());
  for (int k = 0; k < p.tangents; ++k) island.rows.push_back(p.tangent + k);
}

// The contacts of each island, by index.
std::vector<std::vector<std::size_t>> members_of_islands(const std::vector<ContactPoint>& points, const Mat& A) {
  std::vector<std::vector<std::size_t>> all;
  std::vector<bool> found(points.size(), false);
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (found[first]) continue;
    std::vector<std::size_t>& members = all.emplace_back(1, first);
    for (std::size_t k = 0; k < members.size(); ++k)
      for (std::size_t i = first + 1; i < points.size(); ++i)
        if (!found[i] && act_on_each_other(points[members[k]], points[i], A)) found[i] = true, members.push_back(i);
  }
  return all;
}

}  // namespace

std::vector<std::size_t> island_of_each(const std::vector<ContactPoint>& points, const Mat& A) {
  const std::vector<std::vector<std::size_t>> all = members_of_islands(points, A);
  std::vector<std::size_t> numbers(points.size());
  for (std::size_t island = 0; island < all.size(); ++island)
    for (const std::size_t i : all[island]) numbers[i] = island;
  return numbers;
}

std::vector<Island> islands(const std::vector<ContactPoint>& points, const Mat& A) {
  std::vector<Island> all;
  for (const std::vector<std::size_t>& members : members_of_islands(points, A)) {
    Island& island = all.emplace_back();
    island.members = members;
    for (const std::size_t i : members) add(points[i], island);
  }
  return all;
}

}  // namespace trammel::complementarity
