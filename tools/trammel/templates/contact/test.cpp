// A claim of my_contact beyond its contract: without damping a penetration of 1 cm gives K d^(3/2).
#include <cmath>
#include <iostream>

#include <trammel/testing/components.hpp>

int main(int, char** arguments) {
  const auto law = trammel::from_entry<trammel::ContactForce>(
      arguments[1], R"({"type": "my_contact", "stiffness": 2e6, "damping": 0})")();
  const double F = law->normal(-0.01, 1, 1);
  std::cout << "force at 1 cm: " << F << " N\n";
  return std::abs(F - 2000) < 1e-9 ? 0 : 1;
}
