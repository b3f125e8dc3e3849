// A claim of my_body beyond its contract: it hangs at rest where the spring carries its weight.
#include <iostream>

#include <trammel/testing/components.hpp>

int main(int, char** arguments) {
  trammel::World world;
  world.gravity << 0, -9.81;
  const auto body =
      trammel::from_entry<trammel::Body>(arguments[1], R"({"type": "my_body", "mass": 2, "stiffness": 100})", world)();
  trammel::Vec f = trammel::Vec::Zero(2), rest(2);
  rest << 0, -2 * 9.81 / 100;
  body->force(0, rest, trammel::Vec::Zero(2), f);
  std::cout << "force at rest: " << f.norm() << " N\n";
  return f.norm() < 1e-12 ? 0 : 1;
}
