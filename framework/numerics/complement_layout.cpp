#include "numerics/complement_layout.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "numerics/elimination_tree.hpp"

namespace trammel::numerics {

namespace {

// Measured on chains of hinges and of balls.
constexpr EliminationTree::Costs costs{.along = 1, .front = 300, .entry = 1};

struct Nodes {
  std::vector<std::vector<int>> rows;       // of each
  std::vector<std::vector<int>> of_bodies;  // those that touch each
};

Nodes join_rows(const std::vector<std::vector<int>>& rows_of_bodies, int nc) {
  std::vector<std::vector<int>> bodies(static_cast<std::size_t>(nc));
  for (std::size_t k = 0; k < rows_of_bodies.size(); ++k)
    for (const int row : rows_of_bodies[k]) bodies[std::size_t(row)].push_back(int(k));
  Nodes nodes{.rows = {}, .of_bodies = std::vector<std::vector<int>>(rows_of_bodies.size())};
  std::map<std::vector<int>, int> known;
  for (int row = 0; row < nc; ++row) {
    const auto [node, fresh] = known.try_emplace(bodies[std::size_t(row)], int(nodes.rows.size()));
    if (fresh) {
      nodes.rows.emplace_back();
      for (const int k : node->first) nodes.of_bodies[std::size_t(k)].push_back(node->second);
    }
    nodes.rows[std::size_t(node->second)].push_back(row);
  }
  return nodes;
}

}  // namespace

bool ComplementLayout::holds(const std::vector<BodyBlock>& bodies, int nc) const {
  if (nc != nc_ || bodies.size() != rows_.size()) return false;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const std::vector<int>&known = rows_[k], &rows = bodies[k].rows;
    if (rows.size() < known.size() || !std::equal(known.begin(), known.end(), rows.begin())) return false;
    if (rows.size() > known.size() && rows[known.size()] < nc) return false;
  }
  return true;
}

void ComplementLayout::find(const std::vector<BodyBlock>& bodies, int nc) {
  nc_ = nc;
  rows_.clear();
  for (const BodyBlock& body : bodies)
    rows_.emplace_back(body.rows.begin(), std::lower_bound(body.rows.begin(), body.rows.end(), nc));
  const Nodes nodes = join_rows(rows_, nc);
  std::vector<int> weight;
  for (const std::vector<int>& rows : nodes.rows) weight.push_back(int(rows.size()));
  EliminationTree tree;
  tree.build(nodes.of_bodies, weight, costs);

  fronts_.clear();
  std::vector<int> front_of(static_cast<std::size_t>(nc));
  L_ = U_ = 0, largest_ = 0;
  for (const EliminationTree::Front& of : tree.fronts()) {
    Front front{.children = of.children, .L = L_, .U = U_};
    // In the order of elimination, which all fronts share.
    const auto add = [&](std::vector<int> members) {
      std::sort(members.begin(), members.end(), [&](int a, int b) { return tree.place(a) < tree.place(b); });
      for (const int node : members) {
        const std::vector<int>& rows = nodes.rows[std::size_t(node)];
        front.rows.insert(front.rows.end(), rows.begin(), rows.end());
      }
      return int(front.rows.size());
    };
    front.eliminated = add(of.eliminated);
    for (const int row : front.rows) front_of[std::size_t(row)] = int(fronts_.size());
    front.size = add(of.boundary);
    L_ += std::size_t(front.stride() * front.size), U_ += std::size_t(front.stride_above() * front.size);
    largest_ = std::max(largest_, front.size);
    fronts_.push_back(std::move(front));
  }
  place_shares(front_of);
  place_boundaries();
}

void ComplementLayout::place_shares(const std::vector<int>& front_of) {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].empty()) continue;
    int first = int(fronts_.size());
    for (const int row : rows_[k]) first = std::min(first, front_of[std::size_t(row)]);
    fronts_[std::size_t(first)].bodies.push_back(int(k));
  }
  order_.assign(rows_.size(), {}), ordered_rows_ = slots_ = order_, leads_.assign(rows_.size(), 0);
  std::vector<int> place(front_of.size());
  for (const Front& front : fronts_) {
    for (int i = 0; i < front.size; ++i) place[std::size_t(front.rows[std::size_t(i)])] = i;
    for (const int body : front.bodies) {
      const auto k = std::size_t(body);
      const auto place_of = [&](int i) { return place[std::size_t(rows_[k][std::size_t(i)])]; };
      std::vector<int>& order = order_[k];
      order.resize(rows_[k].size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](int i, int j) { return place_of(i) < place_of(j); });
      leads_[k] = place_of(order.back()) + 1 == int(order.size());
      for (std::size_t j = 0; j < order.size(); ++j) {
        ordered_rows_[k].push_back(rows_[k][std::size_t(order[j])]);
        for (std::size_t i = j; i < order.size(); ++i)
          slots_[k].push_back(place_of(order[j]) * int(front.stride()) + place_of(order[i]));
      }
    }
  }
}

void ComplementLayout::place_boundaries() {
  places_.assign(fronts_.size(), {});
  std::vector<int> place(static_cast<std::size_t>(nc_));
  for (const Front& front : fronts_) {
    for (int i = 0; i < front.size; ++i) place[std::size_t(front.rows[std::size_t(i)])] = i;
    for (const int c : front.children) {
      const Front& child = fronts_[std::size_t(c)];
      for (int i = child.eliminated; i < child.size; ++i)
        places_[std::size_t(c)].push_back(place[std::size_t(child.rows[std::size_t(i)])]);
    }
  }
}

}  // namespace trammel::numerics
