// Halves of a graph with few edges between them are found on successively coarser graphs, whose vertices stand for
// pairs of vertices of the finer graph, and improved on the way back (Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998),
// 359). Nothing is random.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

#include "linear/order/elimination_order.hpp"

namespace trammel::numerics {

namespace {

using Sides = std::vector<char>;  // 0 or 1, of each vertex

constexpr int few_vertices = 60;      // graphs of so few are halved directly
constexpr double most_of_all = 0.56;  // largest part in one half, by weight

// A graph whose vertices and edges have weights: how many vertices and edges of the finest graph each stands for.
struct Ties {
  std::vector<int> weight, start = {0}, to, tie;
  int size() const { return int(weight.size()); }
  int total() const { return std::accumulate(weight.begin(), weight.end(), 0); }
  template <class F>
  void each_neighbour(int v, F&& f) const {
    for (int e = start[std::size_t(v)]; e < start[std::size_t(v) + 1]; ++e) f(to[std::size_t(e)], tie[std::size_t(e)]);
  }
};

// Unites each vertex with the neighbour of the heaviest edge. `into`: the coarse vertex of each vertex.
Ties coarsened(const Ties& fine, std::vector<int>& into) {
  into.assign(std::size_t(fine.size()), -1);
  std::vector<std::pair<int, int>> pairs;
  for (int v = 0; v < fine.size(); ++v) {
    if (into[std::size_t(v)] >= 0) continue;
    int partner = v;
    double closest = 0;
    fine.each_neighbour(v, [&](int u, int tie) {
      const double close = double(tie) / fine.weight[std::size_t(u)];
      if (into[std::size_t(u)] < 0 && close > closest) partner = u, closest = close;
    });
    into[std::size_t(v)] = into[std::size_t(partner)] = int(pairs.size());
    pairs.emplace_back(v, partner);
  }
  Ties coarse;
  std::vector<int> edge(pairs.size(), -1);
  for (const auto& [v, partner] : pairs) {
    const int begin = coarse.start.back();
    const auto take = [&](int u, int tie) {
      const int other = into[std::size_t(u)];
      int& e = edge[std::size_t(other)];
      if (other == coarse.size()) return;
      if (e < begin) e = int(coarse.to.size()), coarse.to.push_back(other), coarse.tie.push_back(0);
      coarse.tie[std::size_t(e)] += tie;
    };
    fine.each_neighbour(v, take);
    if (partner != v) fine.each_neighbour(partner, take);
    coarse.weight.push_back(fine.weight[std::size_t(v)] + (partner == v ? 0 : fine.weight[std::size_t(partner)]));
    coarse.start.push_back(int(coarse.to.size()));
  }
  return coarse;
}

int cut(const Ties& graph, const Sides& side) {
  int twice = 0;
  for (int v = 0; v < graph.size(); ++v)
    graph.each_neighbour(v, [&](int u, int tie) { twice += side[std::size_t(u)] != side[std::size_t(v)] ? tie : 0; });
  return twice / 2;
}

// Moves vertices to the other side one by one, best first, also if that is a loss at first; keeps the best state
// (Fiduccia, Mattheyses, Design Automation Conf. 1982). False: there was no gain.
bool improve(const Ties& graph, Sides& side) {
  constexpr std::size_t patience = 60;  // moves without a gain
  const auto n = std::size_t(graph.size());
  const double most = most_of_all * graph.total();
  double weight[2] = {0, 0};
  std::vector<int> gain(n, 0), moves;
  std::vector<char> moved(n, 0);
  std::priority_queue<std::pair<int, int>> next;
  for (int v = 0; v < graph.size(); ++v) {
    weight[int(side[std::size_t(v)])] += graph.weight[std::size_t(v)];
    bool at_cut = false;
    graph.each_neighbour(v, [&](int u, int tie) {
      const bool across = side[std::size_t(u)] != side[std::size_t(v)];
      gain[std::size_t(v)] += across ? tie : -tie;
      at_cut |= across;
    });
    if (at_cut) next.emplace(gain[std::size_t(v)], v);
  }
  int gained = 0, most_gained = 0;
  std::size_t kept = 0;
  while (!next.empty() && moves.size() < kept + patience) {
    const auto [expected, v] = next.top();
    next.pop();
    char& from = side[std::size_t(v)];
    const int w = graph.weight[std::size_t(v)];
    if (moved[std::size_t(v)] || expected != gain[std::size_t(v)] || weight[1 - from] + w > most) continue;
    weight[int(from)] -= w, weight[1 - from] += w;
    from = char(1 - from);
    moved[std::size_t(v)] = 1;
    moves.push_back(v);
    gained += expected;
    if (gained > most_gained) most_gained = gained, kept = moves.size();
    graph.each_neighbour(v, [&](int u, int tie) {
      gain[std::size_t(u)] += side[std::size_t(u)] == from ? -2 * tie : 2 * tie;
      if (!moved[std::size_t(u)]) next.emplace(gain[std::size_t(u)], u);
    });
  }
  for (std::size_t k = kept; k < moves.size(); ++k) side[std::size_t(moves[k])] ^= 1;
  return most_gained > 0;
}

// The half of all vertices that is nearest to `first`.
Sides grown(const Ties& graph, int first) {
  Sides side(std::size_t(graph.size()), 0);
  std::vector<int> front = {first};
  std::vector<char> seen(side.size(), 0);
  seen[std::size_t(first)] = 1;
  int left = graph.total() / 2;
  for (std::size_t k = 0; k < front.size() && left > 0; ++k) {
    const int v = front[k];
    side[std::size_t(v)] = 1;
    left -= graph.weight[std::size_t(v)];
    graph.each_neighbour(v, [&](int u, int) {
      if (!seen[std::size_t(u)]) seen[std::size_t(u)] = 1, front.push_back(u);
    });
  }
  return side;
}

Sides halved(const Ties& graph) {
  Sides side;
  std::vector<int> into;
  const Ties coarse = graph.size() > few_vertices ? coarsened(graph, into) : Ties();
  if (coarse.size() > 0 && coarse.size() < 0.9 * graph.size()) {
    const Sides of_coarse = halved(coarse);
    for (const int v : into) side.push_back(of_coarse[std::size_t(v)]);
    while (improve(graph, side)) {
    }
    return side;
  }
  int fewest = -1;
  for (int first = 0; first < graph.size(); first += std::max(1, graph.size() / 20)) {
    Sides other = grown(graph, first);
    while (improve(graph, other)) {
    }
    if (const int across = cut(graph, other); fewest < 0 || across < fewest) fewest = across, side = std::move(other);
  }
  return side;
}

class Dissection {
 public:
  Dissection(const Graph& graph, const std::vector<int>& weight)
      : graph_(graph), weight_(weight), place_(graph.size(), -1) {}

  void order(const std::vector<int>& nodes, std::vector<int>& order) {
    constexpr std::size_t few_nodes = 40;  // so few are ordered by minimum degree
    const Ties ties = within(nodes);
    std::vector<int> parts[3];  // the third separates the other two
    if (nodes.size() > few_nodes) part(nodes, ties, parts);
    if (parts[0].empty() || parts[1].empty()) return order_by_degree(nodes, ties, order);
    this->order(parts[0], order);
    this->order(parts[1], order);
    order.insert(order.end(), parts[2].begin(), parts[2].end());
  }

 private:
  Ties within(const std::vector<int>& nodes) {
    Ties ties;
    for (std::size_t i = 0; i < nodes.size(); ++i) place_[std::size_t(nodes[i])] = int(i);
    for (const int node : nodes) {
      for (const int j : graph_[std::size_t(node)])
        if (place_[std::size_t(j)] >= 0) ties.to.push_back(place_[std::size_t(j)]), ties.tie.push_back(1);
      ties.start.push_back(int(ties.to.size()));
      ties.weight.push_back(weight_[std::size_t(node)]);
    }
    for (const int node : nodes) place_[std::size_t(node)] = -1;
    return ties;
  }

  // Nodes of one half that have neighbours in the other half separate the rest.
  static void part(const std::vector<int>& nodes, const Ties& ties, std::vector<int>* parts) {
    const Sides side = halved(ties);
    std::vector<char> at_cut(nodes.size(), 0);
    int weight[2] = {0, 0};
    for (int v = 0; v < ties.size(); ++v) {
      const char own = side[std::size_t(v)];
      ties.each_neighbour(v, [&](int u, int) { at_cut[std::size_t(v)] |= side[std::size_t(u)] != own; });
      if (at_cut[std::size_t(v)]) weight[int(own)] += ties.weight[std::size_t(v)];
    }
    const char lighter = weight[1] < weight[0];
    for (std::size_t v = 0; v < nodes.size(); ++v)
      parts[at_cut[v] && side[v] == lighter ? 2 : int(side[v])].push_back(nodes[v]);
  }

  static void order_by_degree(const std::vector<int>& nodes, const Ties& ties, std::vector<int>& order) {
    Graph inner(nodes.size());
    for (int v = 0; v < ties.size(); ++v)
      ties.each_neighbour(v, [&](int u, int) { inner[std::size_t(v)].push_back(u); });
    for (const int v : of_minimum_degree(inner)) order.push_back(nodes[std::size_t(v)]);
  }

  const Graph& graph_;
  const std::vector<int>& weight_;
  std::vector<int> place_;  // scratch
};

}  // namespace

std::vector<int> by_dissection(const Graph& graph, const std::vector<int>& weight) {
  // Nodes with very many neighbours separate nothing; they come last.
  const double many = 10 * std::sqrt(double(graph.size())) + 16;
  std::vector<int> nodes, last, order;
  for (int i = 0; i < int(graph.size()); ++i) (double(graph[std::size_t(i)].size()) > many ? last : nodes).push_back(i);
  Dissection(graph, weight).order(nodes, order);
  order.insert(order.end(), last.begin(), last.end());
  return order;
}

}  // namespace trammel::numerics
