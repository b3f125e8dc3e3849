// Orders of elimination and the fronts that they give, on graphs whose best orders are known.
#include "linear/order/elimination_order.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "linear/order/elimination_tree.hpp"

namespace trammel::numerics {
namespace {

using Cliques = std::vector<std::vector<int>>;

// Nodes are numbered across the graph, so that neighbours in the numbers say nothing.
int scattered(int i, int n) {
  return int((7919LL * i + 13) % n);  // 7919 is prime and divides none of the sizes used
}
Cliques path(int n) {
  Cliques edges;
  for (int i = 0; i + 1 < n; ++i) edges.push_back({scattered(i, n), scattered(i + 1, n)});
  return edges;
}
Cliques binary_tree(int n) {
  Cliques edges;
  for (int i = 1; i < n; ++i) edges.push_back({scattered(i, n), scattered((i - 1) / 2, n)});
  return edges;
}
Cliques grid(int width, int height) {
  Cliques cells;
  const auto at = [&](int x, int y) { return scattered(y * width + x, width * height); };
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y) {
      if (x + 1 < width) cells.push_back({at(x, y), at(x + 1, y)});
      if (y + 1 < height) cells.push_back({at(x, y), at(x, y + 1)});
    }
  return cells;
}

struct Fill {
  std::size_t largest = 0;  // boundary
  double work = 0;
};
// Each node leaves its boundary to the first node of it.
Fill fill_of(const Graph& graph, const std::vector<int>& order) {
  std::vector<int> place(graph.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[std::size_t(order[k])] = int(k);
  std::vector<std::set<int>> boundary(graph.size());
  Fill fill;
  for (int k = 0; k < int(order.size()); ++k) {
    std::set<int>& here = boundary[std::size_t(k)];
    for (const int j : graph[std::size_t(order[std::size_t(k)])])
      if (place[std::size_t(j)] > k) here.insert(place[std::size_t(j)]);
    const double size = 1 + double(here.size());
    fill.work += size * size;
    fill.largest = std::max(fill.largest, here.size());
    if (!here.empty()) boundary[std::size_t(*here.begin())].insert(std::next(here.begin()), here.end());
  }
  return fill;
}
std::vector<int> ones(std::size_t n) {
  return std::vector<int>(n, 1);
}

TEST(EliminationOrder, ContainsEveryNodeOnce) {
  Cliques two_parts = path(50);
  for (const std::vector<int>& edge : grid(8, 8)) two_parts.push_back({50 + edge[0], 50 + edge[1]});
  const Graph graph = graph_of(two_parts, 116);  // and two nodes alone
  for (std::vector<int> order : {along(graph), of_minimum_degree(graph), by_dissection(graph, ones(116))}) {
    std::sort(order.begin(), order.end());
    std::vector<int> all(116);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(order, all);
  }
}

TEST(EliminationOrder, AlongAPathOrUpATreeFillsNothing) {
  for (const Cliques& edges : {path(101), binary_tree(127)}) {
    const Graph graph = graph_of(edges, edges.size() + 1);
    EXPECT_EQ(fill_of(graph, along(graph)).largest, 1u);
    EXPECT_LE(fill_of(graph, of_minimum_degree(graph)).largest, 2u);  // degrees are approximate
  }
}

// A strip of width 4 is eliminated from one end: each boundary is a line across it, and a node.
TEST(EliminationOrder, AlongAStripLeavesLinesAcross) {
  const Graph graph = graph_of(grid(4, 60), 240);
  EXPECT_LE(fill_of(graph, along(graph)).largest, 5u);
}

// A square of 24 by 24 is cut in halves by 24 nodes, and those again: boundaries are of two sides at most. A band of 24
// costs 24^2 for each of the 576 nodes.
TEST(EliminationOrder, ByDissectionCutsASquareInHalves) {
  const Graph graph = graph_of(grid(24, 24), 576);
  const Fill halves = fill_of(graph, by_dissection(graph, ones(576)));
  EXPECT_LE(halves.largest, 48u);
  EXPECT_LE(halves.work, 0.5 * 576 * 24 * 24);
}

TEST(EliminationOrder, ByDissectionTakesNodesThatManyMeetLast) {
  Cliques cells = grid(30, 30);
  for (int i = 0; i < 900; ++i) cells.push_back({i, 900});
  const std::vector<int> order = by_dissection(graph_of(cells, 901), ones(901));
  EXPECT_EQ(order.back(), 900);
}

// --- Fronts ---

double work(double k, double b) {
  return k * (k + b) * (k + b);
}
double cost_of(const EliminationTree& tree, const EliminationTree::Costs& costs) {
  double sum = 0;
  for (const EliminationTree::Front& front : tree.fronts()) {
    const auto k = double(front.eliminated.size()), b = double(front.boundary.size());
    sum += work(k, b) + costs.entry * (k + b) * (k + b) + costs.front;
  }
  return sum;
}
constexpr EliminationTree::Costs work_only{.along = 1, .front = 0, .entry = 0};

TEST(EliminationTree, EliminatesEachNodeOnceAndPassesItsBoundaryOn) {
  for (const EliminationTree::Costs& costs : {EliminationTree::Costs(), work_only}) {
    for (const auto& [edges, nodes] : {std::pair(grid(20, 20), 400), {path(101), 101}, {binary_tree(127), 127}}) {
      EliminationTree tree;
      tree.build(edges, ones(std::size_t(nodes)), costs);
      std::vector<int> eliminated, parents(tree.fronts().size(), 0);
      for (std::size_t f = 0; f < tree.fronts().size(); ++f) {
        const EliminationTree::Front& front = tree.fronts()[f];
        std::set<int> all(front.eliminated.begin(), front.eliminated.end());
        eliminated.insert(eliminated.end(), front.eliminated.begin(), front.eliminated.end());
        for (const int node : front.eliminated) EXPECT_EQ(tree.front_of(node), int(f));
        all.insert(front.boundary.begin(), front.boundary.end());
        EXPECT_EQ(all.size(), front.eliminated.size() + front.boundary.size());
        for (const int child : front.children) {
          ASSERT_LT(child, int(f));
          ++parents[std::size_t(child)];
          for (const int node : tree.fronts()[std::size_t(child)].boundary) EXPECT_TRUE(all.contains(node));
        }
      }
      for (std::size_t f = 0; f < parents.size(); ++f) EXPECT_EQ(parents[f], tree.fronts()[f].boundary.empty() ? 0 : 1);
      std::sort(eliminated.begin(), eliminated.end());
      std::vector<int> every(std::size_t(nodes), 0);
      std::iota(every.begin(), every.end(), 0);
      EXPECT_EQ(eliminated, every);
      // Neighbours meet in the front that eliminates the first of them.
      for (const std::vector<int>& edge : edges) {
        const int first = tree.place(edge[0]) < tree.place(edge[1]) ? edge[0] : edge[1],
                  other = edge[0] + edge[1] - first;
        const EliminationTree::Front& front = tree.fronts()[std::size_t(tree.front_of(first))];
        EXPECT_TRUE(std::count(front.boundary.begin(), front.boundary.end(), other) ||
                    std::count(front.eliminated.begin(), front.eliminated.end(), other));
      }
    }
  }
}

TEST(EliminationTree, TakesTheOrderOfLeastWork) {
  for (const auto& [edges, nodes] :
       {std::pair(grid(40, 40), 1600), {grid(24, 24), 576}, {grid(4, 60), 240}, {binary_tree(127), 127}}) {
    const Graph graph = graph_of(edges, std::size_t(nodes));
    EliminationTree tree;
    tree.build(edges, ones(std::size_t(nodes)), work_only);
    for (const auto& order : {along(graph), of_minimum_degree(graph), by_dissection(graph, ones(std::size_t(nodes)))})
      EXPECT_LE(cost_of(tree, work_only), fill_of(graph, order).work);
  }
}

// A square of side x side nodes, of which the four corners of each cell are neighbours.
struct Works {
  double along, degree, halves, taken;  // of its orders and of the tree's
};
Works works_of(int side) {
  Cliques cells;
  for (int i = 0; i + side < side * side; ++i)
    if ((i + 1) % side != 0) cells.push_back({i, i + 1, i + side, i + side + 1});
  const auto n = std::size_t(side) * std::size_t(side);
  const Graph graph = graph_of(cells, n);
  EliminationTree tree;
  tree.build(cells, ones(n), work_only);
  std::vector<int> taken(n);
  for (std::size_t node = 0; node < n; ++node) taken[std::size_t(tree.place(int(node)))] = int(node);
  const auto work_of = [&](const std::vector<int>& order) { return fill_of(graph, order).work; };
  return {work_of(along(graph)), work_of(of_minimum_degree(graph)), work_of(by_dissection(graph, ones(n))),
          work_of(taken)};
}

TEST(EliminationTree, TakesHalvesOrMinimumDegreeWhereTheOrderAlongTheGraphTakesThreeTimesTheWork) {
  const Works of_28 = works_of(28), of_40 = works_of(40);
  EXPECT_GT(of_28.along, 3 * of_28.degree);
  EXPECT_LT(of_28.halves, of_28.degree);
  EXPECT_EQ(of_28.taken, of_28.halves);
  EXPECT_GT(of_40.along, 3 * of_40.degree);
  EXPECT_LT(of_40.degree, of_40.halves);
  EXPECT_EQ(of_40.taken, of_40.degree);
}

TEST(EliminationTree, TakesTheOrderAlongTheGraphWhereThatIsWorthItsWork) {
  const Graph graph = graph_of(grid(4, 60), 240);
  EliminationTree tree;
  tree.build(grid(4, 60), ones(240), {.along = 3});
  const std::vector<int> order = along(graph);
  for (int k = 0; k < 240; ++k) EXPECT_EQ(tree.place(order[std::size_t(k)]), k);
}

// Fronts of single nodes are united only where that is cheaper, and then they are.
TEST(EliminationTree, UnitesFrontsThatAreTooSmallForTheirOverhead) {
  const auto build = [](const EliminationTree::Costs& costs) {
    EliminationTree tree;
    tree.build(grid(4, 60), ones(240), costs);
    return tree;
  };
  const EliminationTree::Costs dear{.along = 1, .front = 300, .entry = 2}, dearest{.along = 1, .front = 1e9};
  EXPECT_LE(cost_of(build(dear), dear), 0.6 * cost_of(build(work_only), dear));
  EXPECT_LE(cost_of(build(work_only), work_only), cost_of(build(dear), work_only));
  EXPECT_EQ(build(dearest).fronts().size(), 1u);
}

}  // namespace
}  // namespace trammel::numerics
