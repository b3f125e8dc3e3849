// A claim of my_force beyond its contract: at rest it pulls by k times the distance.
#include <cmath>
#include <iostream>

#include <trammel/testing/components.hpp>
#include <trammel/testing/markers.hpp>

int main(int, char** arguments) {
  const auto force = trammel::from_entry<trammel::Force>(arguments[1], R"({"type": "my_force", "stiffness": 3})")();
  const trammel::Vec rest = trammel::Vec::Zero(3);
  const trammel::Motion A = trammel::marker_at(rest, rest), B = trammel::marker_at(Eigen::Vector3d(2, 0, 0), rest);
  trammel::Wrench on_A = trammel::Wrench::Zero(3), on_B = on_A;
  force->wrench(0, A, B, on_A, on_B);
  std::cout << "force on A at 2 m: " << on_A(0) << " N\n";
  return std::abs(on_A(0) - 6) < 1e-12 ? 0 : 1;
}
