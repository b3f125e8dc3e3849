#include "linear/bodies/merged_unknowns.hpp"

#include <algorithm>
#include <numeric>

namespace trammel::numerics {

namespace {

int root_of(std::vector<int>& parent, int i) {
  for (; parent[std::size_t(i)] != i; i = parent[std::size_t(i)])
    parent[std::size_t(i)] = parent[std::size_t(parent[std::size_t(i)])];
  return i;
}

}  // namespace

void MergedUnknowns::Difference::add(const Place& place, double value) {
  if (value == 0) return;
  if (entries < 2) places[std::size_t(entries)] = place, a[entries] = value;
  ++entries;
}

std::vector<MergedUnknowns::Difference> MergedUnknowns::differences(const std::vector<BodyBlock>& bodies, int nc) {
  std::vector<Difference> rows(static_cast<std::size_t>(nc));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t i = 0; i < bodies[b].rows.size() && bodies[b].rows[i] < nc; ++i) {
      Difference& row = rows[std::size_t(bodies[b].rows[i])];
      row.constant = row.constant && i < bodies[b].constant.size() && bodies[b].constant[i];
      for (Eigen::Index k = 0; k < bodies[b].Gt.rows(); ++k)
        row.add({b, Eigen::Index(i), k}, bodies[b].Gt(k, Eigen::Index(i)));
    }
  return rows;
}

void MergedUnknowns::find(const std::vector<BodyBlock>& bodies, int nv, int nc) {
  merged_.assign(std::size_t(nv), -1);
  join(bodies, differences(bodies, nc));
}

int MergedUnknowns::count_constant_rows(const std::vector<BodyBlock>& bodies, int nc) {
  const std::vector<Difference> rows = differences(bodies, nc);
  return int(
      std::count_if(rows.begin(), rows.end(), [](const Difference& row) { return row.constant && row.merges(); }));
}

void MergedUnknowns::take_none(int nv, int nc) {
  merged_.resize(std::size_t(nv));
  std::iota(merged_.begin(), merged_.end(), 0);
  takes_.assign(std::size_t(nc), 0);
  links_.clear(), places_.clear();
  count_ = nv, idle_ = 0;
}

// Builds a forest of merging rows; a row that would close a cycle is idle.
void MergedUnknowns::join(const std::vector<BodyBlock>& bodies, const std::vector<Difference>& rows) {
  std::vector<int> parent(merged_.size());
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<std::vector<Link>> at(merged_.size());
  takes_.assign(rows.size(), 0);
  places_.clear();
  idle_ = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (!rows[row].merges()) continue;
    takes_[row] = 1;
    if (!rows[row].constant) places_.push_back(rows[row].places);
    const auto unknown = [&](const Place& place) { return bodies[place.body].v0 + int(place.at); };
    const int i = unknown(rows[row].places[0]), j = unknown(rows[row].places[1]);
    if (root_of(parent, i) == root_of(parent, j)) {
      ++idle_;
      continue;
    }
    parent[std::size_t(root_of(parent, j))] = root_of(parent, i);
    at[std::size_t(i)].push_back({i, j, int(row), rows[row].a[1]});
    at[std::size_t(j)].push_back({j, i, int(row), rows[row].a[0]});
  }
  number(at);
}

// Numbers the trees, each from its root.
void MergedUnknowns::number(const std::vector<std::vector<Link>>& at) {
  links_.clear();
  count_ = 0;
  std::vector<int> open;
  for (int first = 0; first < int(merged_.size()); ++first) {
    if (merged_[std::size_t(first)] >= 0) continue;
    const int unknown = merged_[std::size_t(first)] = count_++;
    for (open = {first}; !open.empty();) {
      const int from = open.back();
      open.pop_back();
      for (const Link& link : at[std::size_t(from)]) {
        if (merged_[std::size_t(link.to)] >= 0) continue;
        merged_[std::size_t(link.to)] = unknown;
        links_.push_back(link);
        open.push_back(link.to);
      }
    }
  }
}

bool MergedUnknowns::still_hold(const std::vector<BodyBlock>& bodies) const {
  for (const std::array<Place, 2>& row : places_) {
    double sum = 0;
    for (const Place& place : row) {
      const auto column = bodies[place.body].Gt.col(place.column);
      for (Eigen::Index k = 0; k < column.size(); ++k)
        if ((column(k) != 0) != (k == place.at)) return false;
      sum += column(place.at);
    }
    if (sum != 0) return false;
  }
  return true;
}

void MergedUnknowns::offsets(const Vec& c, Vec& o) const {
  o.setZero(Eigen::Index(merged_.size()));
  for (const Link& link : links_) o(link.to) = o(link.from) + c(link.row) / link.a;
}

void MergedUnknowns::multipliers(Vec& r, Vec& y) const {
  for (auto link = links_.rbegin(); link != links_.rend(); ++link) {
    const double force = r(link->to);
    y(link->row) = force / link->a;
    r(link->from) += force;
  }
}

}  // namespace trammel::numerics
