// The pattern of frontal_lu.hpp, its nodes, the fronts and where each of their numbers goes.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/elimination_tree.hpp"
#include "numerics/frontal_lu.hpp"

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr EliminationTree::Costs costs{.along = 1, .front = 10000, .entry = 20};  // measured on plates
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

}  // namespace

// The node of each unknown, which is one of its unknowns.
std::vector<int> FrontalLu::find_nodes(const Sparse& A) {
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

void FrontalLu::analyse(const Sparse& A) {
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
  tree.build(pairs, weight, costs);
  lay_out(tree, members, A.rows());
  place_entries(A);
}

void FrontalLu::lay_out(const EliminationTree& tree, const std::vector<std::vector<int>>& members, Index n_all) {
  fronts_.clear(), unknowns_.clear(), maps_.clear();
  std::vector<int> place(std::size_t(n_all), -1), index(tree.fronts().size());
  std::size_t stored = 0, largest = 0, waiting = 0, most_waiting = 0;
  for (const int f : post_order(tree)) {
    const EliminationTree::Front& of = tree.fronts()[std::size_t(f)];
    Front front{.eliminated = 0,
                .size = 0,
                .unknowns = unknowns_.size(),
                .factors = stored,
                .entries = {0, 0},
                .maps = {},
                .boundaries = {}};
    const auto add = [&](const std::vector<int>& nodes) {
      for (const int node : nodes)
        for (const int i : members[std::size_t(node)]) place[std::size_t(i)] = front.size++, unknowns_.push_back(i);
    };
    add(of.eliminated);
    front.eliminated = front.size;
    add(of.boundary);
    // The last child's is on top of the stack.
    std::vector<int> children;
    for (const int child : of.children) children.push_back(index[std::size_t(child)]);
    std::sort(children.rbegin(), children.rend());
    for (const int c : children) {
      const Front& child = fronts_[std::size_t(c)];
      front.maps.push_back(maps_.size());
      front.boundaries.push_back(child.boundary());
      for (int i = child.eliminated; i < child.size; ++i)
        maps_.push_back(place[std::size_t(unknowns_[child.unknowns + std::size_t(i)])]);
      waiting -= std::size_t(child.boundary()) * std::size_t(child.boundary());
    }
    const auto n = std::size_t(front.size), k = std::size_t(front.eliminated);
    stored += k * (2 * n - k);
    largest = std::max(largest, n * n);
    waiting += (n - k) * (n - k);
    most_waiting = std::max(most_waiting, waiting);
    index[std::size_t(f)] = int(fronts_.size());
    fronts_.push_back(std::move(front));
  }
  store_.resize(Eigen::Index(stored)), work_.resize(Eigen::Index(largest)), stack_.resize(Eigen::Index(most_waiting));
  exchanged_.resize(unknowns_.size());
  pivots_.resize(n_all);
}

// An entry belongs to the first front that eliminates its row or column.
void FrontalLu::place_entries(const Sparse& A) {
  entries_.clear();
  std::vector<int> place(std::size_t(A.rows()), -1);
  std::vector<char> done(std::size_t(A.rows()), 0);
  for (Front& front : fronts_) {
    const int* const unknowns = unknowns_.data() + front.unknowns;
    for (int i = 0; i < front.size; ++i) place[std::size_t(unknowns[i])] = i;
    front.entries.begin = entries_.size();
    for (int j = 0; j < front.size; ++j)
      for (auto k = A.outerIndexPtr()[unknowns[j]]; k < A.outerIndexPtr()[unknowns[j] + 1]; ++k) {
        const auto i = std::size_t(A.innerIndexPtr()[k]);
        if (done[i] || place[i] < 0 || (place[i] >= front.eliminated && j >= front.eliminated)) continue;
        entries_.push_back({int(k), j * front.size + place[i]});
      }
    front.entries.end = entries_.size();
    for (int i = 0; i < front.size; ++i) {
      place[std::size_t(unknowns[i])] = -1;
      if (i < front.eliminated) done[std::size_t(unknowns[i])] = 1;
    }
  }
}

}  // namespace trammel::numerics
