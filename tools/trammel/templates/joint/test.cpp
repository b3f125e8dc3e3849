// A claim of my_joint beyond its contract: its row vanishes at its length, along any direction.
#include <cmath>
#include <iostream>

#include <trammel/testing/components.hpp>
#include <trammel/testing/markers.hpp>

int main(int, char** arguments) {
  const auto joint = trammel::from_entry<trammel::Constraint>(arguments[1], R"({"type": "my_joint", "length": 5})")();
  const trammel::Vec rest = trammel::Vec::Zero(3);
  const trammel::Motion A = trammel::marker_at(rest, rest), B = trammel::marker_at(Eigen::Vector3d(3, -4, 0.2), rest);
  const trammel::Motion* markers[] = {&A, &B};
  trammel::Rows rows;
  rows.resize(1, trammel::Space::planar);
  joint->rows_between(0, markers, rows);
  std::cout << "g at a distance of 5 m: " << rows.g(0) << "\n";
  return std::abs(rows.g(0)) < 1e-12 ? 0 : 1;
}
