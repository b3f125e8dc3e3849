// Contacts that act on each other, directly or through others (a chain of non-zero entries of A), form an island. Each
// island is a problem of its own.
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"

namespace trammel::complementarity {

// For each contact: the number of its island, less than the number of contacts.
std::vector<std::size_t> island_of_each(const std::vector<ContactPoint>& points, const Mat& A);

struct Island {
  std::vector<ContactPoint> points;  // with rows of the island
  std::vector<Eigen::Index> rows;    // row of A for each row of the island
  std::vector<std::size_t> members;  // its contacts, by index, in the order of `points`
};
std::vector<Island> islands(const std::vector<ContactPoint>& points, const Mat& A);

}  // namespace trammel::complementarity
