// A claim of my_integrator beyond its contract: it is of second order on the pendulum.
#include <iostream>

#include <trammel/testing/measurements.hpp>

int main(int, char** arguments) {
  const auto make = trammel::from_plugin(arguments[1], "my_integrator");
  const trammel::Report report = trammel::check_order(make, trammel::problems::pendulum(), 2, 64);
  std::cout << report.table;
  return report ? 0 : 1;
}
