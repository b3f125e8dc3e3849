// A claim of my_correction beyond its contract: a pendulum off its rod returns along the rod.
#include <cmath>
#include <iostream>

#include <trammel/correction.hpp>
#include <trammel/testing/components.hpp>

int main(int, char** arguments) {
  const auto made =
      trammel::make_component(arguments[1], trammel::Kind::correction, R"({"type": "my_correction"})", {});
  const trammel::Problem problem = trammel::problems::pendulum_with_rod();
  const auto system = problem.system();
  const trammel::State exact = problem.solution(0);
  trammel::State off = exact;
  off.q *= 1.01;
  trammel::State corrected = off;
  const trammel::Outcome outcome = dynamic_cast<trammel::Correction&>(*made).apply(trammel::Correction::Level::position,
                                                                                   *system, {exact, off, 0}, corrected);
  const double error = (corrected.q - exact.q).norm();
  std::cout << "distance to the rod's end: " << error << " m\n";
  return outcome && error < 1e-12 ? 0 : 1;
}
