#include "linear/order/elimination_tree.hpp"

#include <algorithm>

#include "linear/order/elimination_order.hpp"

namespace trammel::numerics {

namespace {

// If the order along the graph takes at most this many times the work of minimum degree, dissection would save nothing;
// it is slow to compute for large graphs.
constexpr double wide = 3;

// The boundary that each node leaves, as ascending places in the order; its first node is the parent.
struct Elimination {
  std::vector<int> order, place;
  Graph boundary;
  std::vector<double> size;  // unknowns of each boundary
  double work = 0;
};

double work_of(double eliminated, double boundary) {
  return eliminated * (eliminated + boundary) * (eliminated + boundary);
}

Elimination eliminate(const Graph& graph, const std::vector<int>& weight, std::vector<int> order) {
  Elimination e{.order = std::move(order), .place = {}, .boundary = Graph(graph.size()), .size = {}};
  const std::size_t n = graph.size();
  e.place.resize(n), e.size.resize(n);
  for (std::size_t k = 0; k < n; ++k) e.place[std::size_t(e.order[k])] = int(k);
  std::vector<int> mark(n, -1);
  Graph children(n);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<int>& boundary = e.boundary[k];
    const auto take = [&](int place) {
      if (place <= int(k) || mark[std::size_t(place)] == int(k)) return;
      mark[std::size_t(place)] = int(k);
      boundary.push_back(place);
    };
    for (const int j : graph[std::size_t(e.order[k])]) take(e.place[std::size_t(j)]);
    for (const int child : children[k])
      for (const int place : e.boundary[std::size_t(child)]) take(place);
    std::sort(boundary.begin(), boundary.end());
    for (const int place : boundary) e.size[k] += weight[std::size_t(e.order[std::size_t(place)])];
    e.work += work_of(weight[std::size_t(e.order[k])], e.size[k]);
    if (!boundary.empty()) children[std::size_t(boundary[0])].push_back(int(k));
  }
  return e;
}

Elimination eliminate(const Graph& graph, const std::vector<int>& weight, const EliminationTree::Costs& costs) {
  Elimination on_the_way = eliminate(graph, weight, along(graph));
  Elimination by_degree = eliminate(graph, weight, of_minimum_degree(graph));
  if (on_the_way.work <= costs.along * by_degree.work) return on_the_way;
  if (on_the_way.work <= wide * by_degree.work) return by_degree;
  Elimination halves = eliminate(graph, weight, by_dissection(graph, weight));
  return halves.work < by_degree.work ? halves : by_degree;
}

}  // namespace

void EliminationTree::build(const std::vector<std::vector<int>>& cliques, const std::vector<int>& weight,
                            const Costs& costs) {
  const std::size_t n = weight.size();
  const Graph graph = graph_of(cliques, n);
  const Elimination e = eliminate(graph, weight, costs);
  const auto cost_of = [&costs](double eliminated, double boundary) {
    const double size = eliminated + boundary;
    return work_of(eliminated, boundary) + costs.entry * size * size + costs.front;
  };
  // The node at place k begins as a front of its own and is united with those of its children where that is cheaper.
  struct Open {
    std::vector<int> places, children;
    double eliminated = 0;
  };
  std::vector<Open> open(n);
  std::vector<char> gone(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    Open& front = open[k];
    front.eliminated += weight[std::size_t(e.order[k])];
    std::vector<int> kept;
    for (const int child : front.children) {
      Open& below = open[std::size_t(child)];
      const double both = below.eliminated + front.eliminated;
      if (cost_of(both, e.size[k]) >
          cost_of(below.eliminated, e.size[std::size_t(child)]) + cost_of(front.eliminated, e.size[k])) {
        kept.push_back(child);
        continue;
      }
      front.eliminated = both;
      front.places.insert(front.places.end(), below.places.begin(), below.places.end());
      kept.insert(kept.end(), below.children.begin(), below.children.end());
      gone[std::size_t(child)] = 1;
    }
    front.children = std::move(kept);
    front.places.push_back(int(k));
    if (!e.boundary[k].empty()) open[std::size_t(e.boundary[k][0])].children.push_back(int(k));
  }
  fronts_.clear();
  front_of_.assign(n, -1);
  place_ = e.place;
  std::vector<int> index(n, -1);
  for (std::size_t k = 0; k < n; ++k) {
    if (gone[k]) continue;
    index[k] = int(fronts_.size());
    Front& front = fronts_.emplace_back();
    for (const int place : open[k].places) {
      front.eliminated.push_back(e.order[std::size_t(place)]);
      front_of_[std::size_t(front.eliminated.back())] = index[k];
    }
    for (const int place : e.boundary[k]) front.boundary.push_back(e.order[std::size_t(place)]);
    for (const int child : open[k].children) front.children.push_back(index[std::size_t(child)]);
  }
}

}  // namespace trammel::numerics
