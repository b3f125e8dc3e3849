// A claim of my_friction beyond its contract: far above its transition speed it is Coulomb's.
#include <cmath>
#include <iostream>

#include <trammel/friction.hpp>
#include <trammel/testing/components.hpp>

int main(int, char** arguments) {
  const auto made = trammel::make_component(arguments[1], trammel::Kind::friction,
                                            R"({"type": "my_friction", "coefficient": 0.4})", {});
  const double ratio = dynamic_cast<const trammel::SmoothFriction&>(*made).ratio(1);
  std::cout << "F_t/F_n at 1 m/s: " << ratio << "\n";
  return std::abs(ratio - 0.4) < 1e-6 ? 0 : 1;
}
