#include "linear/fronts/frontal_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr EliminationTree::Costs costs_of_entries{.along = 1, .front = 10000, .entry = 20};  // measured on plates

// Children right before their parent, depth first.
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

// The node of each unknown, which is one of its unknowns.
std::vector<int> find_nodes(const FrontalPattern::Sparse& A) {
  const auto n = std::size_t(A.cols());
  const auto neighbours = [&](int j) {
    return std::pair(A.innerIndexPtr() + A.outerIndexPtr()[j], A.innerIndexPtr() + A.outerIndexPtr()[j + 1]);
  };
  std::vector<int> order(n), node(n);
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&](int i, int j) {
    const auto [a, a_end] = neighbours(i);
    const auto [b, b_end] = neighbours(j);
    return std::lexicographical_compare_three_way(a, a_end, b, b_end);
  };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return compare(i, j) < 0; });
  for (std::size_t k = 0; k < n; ++k) {
    const bool same = k > 0 && compare(order[k - 1], order[k]) == 0;
    node[std::size_t(order[k])] = same ? node[std::size_t(order[k - 1])] : order[k];
  }
  std::vector<char> taken(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (A.coeff(Index(i), Index(i)) != 0) continue;
    int partner = -1;
    const auto [first, last] = neighbours(int(i));
    for (const int* j = first; j != last; ++j) {
      if (A.coeff(*j, *j) == 0) continue;
      const auto is_better = [&](int one, int other) {
        if (taken[std::size_t(one)] != taken[std::size_t(other)]) return !taken[std::size_t(one)];
        return std::abs(A.coeff(Index(i), one)) > std::abs(A.coeff(Index(i), other));
      };
      if (partner < 0 || is_better(*j, partner)) partner = *j;
    }
    if (partner < 0) continue;
    taken[std::size_t(partner)] = 1;
    node[i] = node[std::size_t(partner)];
  }
  return node;
}

}  // namespace

void FrontalPattern::analyse(const Sparse& A) {
  const std::vector<int> name = find_nodes(A);
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
    // In the order of elimination, which all fronts share: what goes up from one then stays in order.
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
