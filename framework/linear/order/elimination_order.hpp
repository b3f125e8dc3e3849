// Orders in which the nodes of a graph can be eliminated from a sparse system.
#pragma once

#include <cstddef>
#include <vector>

namespace trammel::numerics {

using Graph = std::vector<std::vector<int>>;  // neighbours of each node, ascending

// `cliques`: sets of nodes that are all neighbours.
Graph graph_of(const std::vector<std::vector<int>>& cliques, std::size_t nodes);

// Reverse Cuthill-McKee: from end to end of chains and rings.
std::vector<int> along(const Graph& graph);
// Approximate minimum degree.
std::vector<int> of_minimum_degree(const Graph& graph);
// Nested dissection (George, SIAM J. Numer. Anal. 10 (1973), 345), for graphs that are wide in two directions: a few
// nodes that separate two halves come last, and so on within the halves. `weight`: unknowns of each node.
std::vector<int> by_dissection(const Graph& graph, const std::vector<int>& weight);

}  // namespace trammel::numerics
