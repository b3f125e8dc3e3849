// In which order the nodes of a graph are eliminated from a sparse system, and in which fronts.
//
// A front eliminates some nodes and leaves a dense matrix on their neighbours, its boundary, to its parent
// (multifrontal method: Duff and Reid 1983). Three orders are tried (elimination_order.hpp): along the graph, where
// each front has the next unit's own equations to lean on and rounding grows with the distance alone; approximate
// minimum degree, which leaves less to do where the graph is wide; and dissection, which does where it is large both
// ways (and is tried only there). Fronts too small to be worth their overhead are united with their parents.
#pragma once

#include <vector>

namespace trammel::numerics {

class EliminationTree {
 public:
  struct Front {
    std::vector<int> eliminated, boundary;  // nodes, in the order of elimination
    std::vector<int> children;              // fronts, all of them earlier ones
  };
  // What decides between orders and sizes of fronts, in the unit of k (k + b)^2, k unknowns eliminated and b of the
  // boundary.
  struct Costs {
    double along = 3;     // how many times the other's work the order along the graph may take
    double front = 2000;  // of a front as such
    double entry = 0;     // of each of its (k + b)^2 entries: to be cleared, summed and passed on
  };
  // `cliques`: sets of nodes that are all neighbours. `weight`: unknowns of each node.
  void build(const std::vector<std::vector<int>>& cliques, const std::vector<int>& weight, const Costs& costs);
  void build(const std::vector<std::vector<int>>& cliques, const std::vector<int>& weight) {
    build(cliques, weight, Costs());
  }

  const std::vector<Front>& fronts() const { return fronts_; }  // children first
  std::size_t nodes() const { return place_.size(); }
  int place(int node) const { return place_[std::size_t(node)]; }        // in the order of elimination
  int front_of(int node) const { return front_of_[std::size_t(node)]; }  // that eliminates it

 private:
  std::vector<Front> fronts_;
  std::vector<int> place_, front_of_;
};

}  // namespace trammel::numerics
