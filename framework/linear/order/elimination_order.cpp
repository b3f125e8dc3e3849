#include "linear/order/elimination_order.hpp"

#include <algorithm>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace trammel::numerics {

Graph graph_of(const std::vector<std::vector<int>>& cliques, std::size_t nodes) {
  Graph graph(nodes);
  for (const std::vector<int>& clique : cliques)
    for (const int i : clique)
      for (const int j : clique)
        if (i != j) graph[std::size_t(i)].push_back(j);
  for (std::vector<int>& neighbours : graph) {
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  }
  return graph;
}

namespace {

// Breadth first from `first`, neighbours of low degree first; appends to `order`.
void walk(const Graph& graph, int first, std::vector<char>& seen, std::vector<int>& order) {
  std::size_t next = order.size();
  order.push_back(first);
  seen[std::size_t(first)] = 1;
  for (; next < order.size(); ++next) {
    const std::size_t begin = order.size();
    for (const int j : graph[std::size_t(order[next])])
      if (!seen[std::size_t(j)]) seen[std::size_t(j)] = 1, order.push_back(j);
    std::stable_sort(order.begin() + std::ptrdiff_t(begin), order.end(),
                     [&](int a, int b) { return graph[std::size_t(a)].size() < graph[std::size_t(b)].size(); });
  }
}

}  // namespace

// From an end of each connected part, which two walks find, each from the last node of the one before.
std::vector<int> along(const Graph& graph) {
  std::vector<int> order;
  std::vector<char> seen(graph.size(), 0), tried(graph.size(), 0);
  for (int i = 0; i < int(graph.size()); ++i) {
    if (seen[std::size_t(i)]) continue;
    int end = i;
    for (int twice = 0; twice < 2; ++twice) {
      std::vector<int> part;
      walk(graph, end, tried, part);
      for (const int node : part) tried[std::size_t(node)] = 0;
      end = part.back();
    }
    walk(graph, end, seen, order);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

std::vector<int> of_minimum_degree(const Graph& graph) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < int(graph.size()); ++i) {
    entries.emplace_back(i, i, 1.0);
    for (const int j : graph[std::size_t(i)]) entries.emplace_back(j, i, 1.0);
  }
  Eigen::SparseMatrix<double> pattern(Eigen::Index(graph.size()), Eigen::Index(graph.size()));
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  return {permutation.indices().data(), permutation.indices().data() + graph.size()};
}

}  // namespace trammel::numerics
