#include "linear/fronts/frontal_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr EliminationTree::Costs costs_of_entries{.along = 1, .front = 10000, .entry = 20};  // measured on plates

// Depth first, the children of a front directly before it.
std::vector<int> post_order(const EliminationTree& tree) {
  const std::vector<EliminationTree::Front>& fronts = tree.fronts();
  std::vector<char> has_parent(fronts.size(), 0);
  for (const EliminationTree::Front& front : fronts)
    for (const int child : front.children) has_parent[std::size_t(child)] = 1;
  std::vector<int> order, open;
  for (std::size_t root = 0; root < fronts.size(); ++root) {
    if (has_parent[root]) continue;
    const auto begin = std::ptrdiff_t(order.size());
    for (open = {int(root)}; !open.empty();) {
      order.push_back(open.back());
      open.pop_back();
      const std::vector<int>& children = fronts[std::size_t(order.back())].children;
      open.insert(open.end(), children.begin(), children.end());
    }
    std::reverse(order.begin() + begin, order.end());
  }
  return order;
}

std::pair<const int*, const int*> neighbours(const FrontalPattern::Sparse& A, int j) {
  return {A.innerIndexPtr() + A.outerIndexPtr()[j], A.innerIndexPtr() + A.outerIndexPtr()[j + 1]};
}

// The node of each unknown, named by one of its unknowns: unknowns with the same neighbours form a node.
std::vector<int> find_nodes(const FrontalPattern::Sparse& A) {
  const auto n = std::size_t(A.cols());
  std::vector<int> order(n), node(n);
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&](int i, int j) {
    const auto [a, a_end] = neighbours(A, i);
    const auto [b, b_end] = neighbours(A, j);
    return std::lexicographical_compare_three_way(a, a_end, b, b_end);
  };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return compare(i, j) < 0; });
  for (std::size_t k = 0; k < n; ++k) {
    const bool same = k > 0 && compare(order[k - 1], order[k]) == 0;
    node[std::size_t(order[k])] = same ? node[std::size_t(order[k - 1])] : order[k];
  }
  return node;
}

// The power of two below the size of a row's entries in a node. The limits between classes avoid the usual sizes, 1 and
// powers of two, so that round-off does not decide.
int size_class(double square) {
  return square > 0 ? std::ilogb(1.7 * square) : std::numeric_limits<int>::min();
}

}  // namespace

// For each unknown with a 0 on the diagonal, the node that it joins: one with room left in which its row is largest.
// -1: it stays by itself.
std::vector<int> FrontalPattern::find_partners(const Sparse& A) const {
  std::vector<char> has_diagonal(nodes_.size(), 0);
  std::vector<int> room(nodes_.size(), 0), partners;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    has_diagonal[i] = A.coeff(Index(i), Index(i)) != 0;
    if (has_diagonal[i]) ++room[std::size_t(nodes_[i])];
  }
  std::vector<std::pair<int, double>> sizes;  // of the row's entries in each node
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (has_diagonal[i]) continue;
    sizes.clear();
    for (auto k = A.outerIndexPtr()[i]; k < A.outerIndexPtr()[i + 1]; ++k) {
      const auto j = std::size_t(A.innerIndexPtr()[k]);
      if (!has_diagonal[j]) continue;
      const auto known =
          std::find_if(sizes.begin(), sizes.end(), [&](const auto& of) { return of.first == nodes_[j]; });
      const double square = A.valuePtr()[k] * A.valuePtr()[k];
      known == sizes.end() ? void(sizes.emplace_back(nodes_[j], square)) : void(known->second += square);
    }
    const auto is_worse = [&](const auto& one, const auto& other) {
      const bool one_full = room[std::size_t(one.first)] <= 0, other_full = room[std::size_t(other.first)] <= 0;
      return one_full != other_full ? one_full : size_class(one.second) < size_class(other.second);
    };
    const auto best = std::max_element(sizes.begin(), sizes.end(), is_worse);
    partners.push_back(best == sizes.end() ? -1 : best->first);
    if (best != sizes.end()) --room[std::size_t(best->first)];
  }
  return partners;
}

void FrontalPattern::analyse(const Sparse& A) {
  nodes_ = find_nodes(A);
  partners_ = find_partners(A);
  std::vector<int> name = nodes_;
  auto partner = partners_.begin();
  for (std::size_t i = 0; i < name.size(); ++i)
    if (A.coeff(Index(i), Index(i)) == 0)
      if (const int with = *partner++; with >= 0) name[i] = with;
  std::vector<int> number(name.size(), -1), node(name.size());
  std::vector<std::vector<int>> members;
  for (std::size_t i = 0; i < name.size(); ++i) {
    int& of = number[std::size_t(name[i])];
    if (of < 0) of = int(members.size()), members.emplace_back();
    members[std::size_t(of)].push_back(int(i));
    node[i] = of;
  }
  std::vector<std::vector<int>> pairs;
  std::vector<int> weight, seen(members.size(), -1);
  for (std::size_t a = 0; a < members.size(); ++a) {
    weight.push_back(int(members[a].size()));
    seen[a] = int(a);
    for (const int j : members[a])
      for (auto k = A.outerIndexPtr()[j]; k < A.outerIndexPtr()[j + 1]; ++k) {
        const int b = node[std::size_t(A.innerIndexPtr()[k])];
        if (seen[std::size_t(b)] == int(a)) continue;
        seen[std::size_t(b)] = int(a);
        if (b > int(a)) pairs.push_back({int(a), b});
      }
  }
  EliminationTree tree;
  tree.build(pairs, weight, costs_of_entries);
  lay_out(tree, members, A.rows());
  place_entries(A);
}

void FrontalPattern::lay_out(const EliminationTree& tree, const std::vector<std::vector<int>>& members, Index n) {
  fronts_.clear(), unknowns_.clear(), maps_.clear();
  largest_ = 0, most_waiting_ = 0;
  std::size_t waiting = 0;
  const auto square = [](int m) { return std::size_t(m) * std::size_t(m); };
  std::vector<int> place(std::size_t(n), -1), index(tree.fronts().size());
  for (const int f : post_order(tree)) {
    const EliminationTree::Front& of = tree.fronts()[std::size_t(f)];
    Front front{.unknowns = unknowns_.size()};
    // In the order of elimination, the same in all fronts: the boundary of a child is then in order in its parent.
    const auto add = [&](std::vector<int> nodes) {
      std::sort(nodes.begin(), nodes.end(), [&](int a, int b) { return tree.place(a) < tree.place(b); });
      for (const int node : nodes)
        for (const int i : members[std::size_t(node)]) place[std::size_t(i)] = front.size++, unknowns_.push_back(i);
    };
    add(of.eliminated);
    front.eliminated = front.size;
    add(of.boundary);
    std::vector<int> children;
    for (const int child : of.children) children.push_back(index[std::size_t(child)]);
    std::sort(children.rbegin(), children.rend());
    for (const int c : children) {
      const Front& child = fronts_[std::size_t(c)];
      front.children.push_back({maps_.size(), child.boundary()});
      for (int i = child.eliminated; i < child.size; ++i)
        maps_.push_back(place[std::size_t(unknowns_[child.unknowns + std::size_t(i)])]);
      waiting -= square(child.boundary());
    }
    waiting += square(front.boundary());
    most_waiting_ = std::max(most_waiting_, waiting);
    largest_ = std::max(largest_, front.size);
    index[std::size_t(f)] = int(fronts_.size());
    fronts_.push_back(std::move(front));
  }
}

// An entry belongs to the first front that eliminates its row or column.
void FrontalPattern::place_entries(const Sparse& A) {
  entries_.clear();
  std::vector<int> place(std::size_t(A.rows()), -1);
  std::vector<char> done(std::size_t(A.rows()), 0);
  for (Front& front : fronts_) {
    const int* const unknowns = unknowns_.data() + front.unknowns;
    for (int i = 0; i < front.size; ++i) place[std::size_t(unknowns[i])] = i;
    front.entries = entries_.size();
    for (int j = 0; j < front.size; ++j)
      for (auto k = A.outerIndexPtr()[unknowns[j]]; k < A.outerIndexPtr()[unknowns[j] + 1]; ++k) {
        const auto i = std::size_t(A.innerIndexPtr()[k]);
        if (done[i] || place[i] < 0 || (place[i] >= front.eliminated && j >= front.eliminated)) continue;
        entries_.push_back({int(k), place[i], j});
      }
    front.entries_end = entries_.size();
    for (int i = 0; i < front.size; ++i) {
      place[std::size_t(unknowns[i])] = -1;
      if (i < front.eliminated) done[std::size_t(unknowns[i])] = 1;
    }
  }
}

}  // namespace trammel::numerics
