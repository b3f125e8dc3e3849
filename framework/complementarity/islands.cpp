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

}  // namespace

std::vector<Island> islands(const std::vector<ContactPoint>& points, const Mat& A) {
  std::vector<Island> all;
  std::vector<bool> found(points.size(), false);
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (found[first]) continue;
    found[first] = true;
    std::vector<std::size_t> members = {first};
    for (std::size_t k = 0; k < members.size(); ++k)
      for (std::size_t i = first + 1; i < points.size(); ++i)
        if (!found[i] && act_on_each_other(points[members[k]], points[i], A)) found[i] = true, members.push_back(i);
    Island& island = all.emplace_back();
    for (const std::size_t i : members) add(points[i], island);
  }
  return all;
}

}  // namespace trammel::complementarity
