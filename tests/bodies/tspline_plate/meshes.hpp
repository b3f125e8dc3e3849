// The T-meshes of the reference: 10 x 10 with crosses in some elements, and Wang et al.'s quarter ring.
#pragma once

#include <vector>

#include "tspline_plate/mesh/t_junction.hpp"

namespace trammel::plate::test {

// n x n elements, those named {column, row} crossed, then closed.
inline TMesh crossed(int n, const std::vector<Index2>& elements, Closure closure) {
  TMesh mesh = TMesh::uniform(n, n);
  std::vector<Box<double>> boxes;
  for (const auto& [i, j] : elements)
    boxes.push_back(mesh.parameters({{i + degree, j + degree}, {i + degree + 1, j + degree + 1}}));
  mesh.cross(boxes);
  close(mesh, closure);
  return mesh;
}

inline std::vector<Index2> block(int low, int high) {
  std::vector<Index2> result;
  for (int j = low; j < high; ++j)
    for (int i = low; i < high; ++i) result.push_back({i, j});
  return result;
}

inline const std::vector<Index2> diagonal = {{2, 2}, {3, 3}, {4, 4}, {5, 5}};

}  // namespace trammel::plate::test
