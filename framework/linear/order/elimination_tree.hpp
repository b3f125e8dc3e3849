// The order in which the nodes of a graph are eliminated from a sparse system, and the fronts.
//
// A front eliminates some nodes and leaves a dense matrix on their neighbours, its boundary, to its parent
// (multifrontal method: Duff and Reid 1983). Three orders are tried (elimination_order.hpp): along the graph, in which
// each front follows its neighbour and rounding grows only with the distance; approximate minimum degree, which takes
// less work if the graph is wide; and dissection, which does if it is large in two directions (tried only then). Fronts
// too small for their overhead are united with their parents.
#pragma once

#include <vector>

namespace trammel::numerics {

class EliminationTree {
 public:
  struct Front {
    std::vector<int> eliminated, boundary;  // nodes, in the order of elimination
    std::vector<int> children;              // fronts, all of them earlier ones
  };
  // Costs that decide between orders and sizes of fronts, in units of k (k + b)^2, where k unknowns are eliminated and
  // b are in the boundary.
  struct Costs {
    double along = 3;     // the order along the graph may take this many times the work of the other one
    double front = 2000;  // of each front
    double entry = 0;     // of each of its (k + b)^2 entries: clearing, summing, passing on
  };
  // `cliques`: sets of nodes that are all neighbours. `weight`: unknowns of each node.
  void build(const std::vector<std::vector<int>>& cliques, const std::vector<int>& weight, const Costs& costs);
  void build(const std::vector<std::vector<int>>& cliques, const std::vector<int>& weight) {
    build(cliques, weight, Costs());
  }

  const std::vector<Front>& fronts() const { return fronts_; }  // children first
  std::size_t nodes() const { return place_.size(); }
  int place(int node) const { return place_[std::size_t(node)]; }        // of a node in the order of elimination
  int front_of(int node) const { return front_of_[std::size_t(node)]; }  // the front that eliminates the node

 private:
  std::vector<Front> fronts_;
  std::vector<int> place_, front_of_;
};

}  // namespace trammel::numerics
