// Impacts with closed forms, as scenes for the Simulator.
//
//     ball:  t_n = sqrt(2 h/g) + (2 v/g) (e + ... + e^(n-1)),  speed e^(n-1) v,  v = sqrt(2 g h)
//     bar:   its end has the effective mass 1/(1/m + (l/2)^2/I) = m/4, so L = (1 + e) speed m/4
//
// Source: Brach, Mechanical Impact Dynamics, chapter 3.
#include <fmt/format.h>

#include <cmath>

#include <trammel/testing/problems.hpp>

namespace trammel::problems {

namespace {
constexpr double gravity = 9.81;
constexpr double mass = 3, half = 1, inertia = mass * 4 * half * half / 12;
}  // namespace

double BouncingBall::speed_before(int n) const {
  return std::sqrt(2 * gravity * height) * std::pow(e, n - 1);
}
double BouncingBall::impact_time(int n) const {
  double t = std::sqrt(2 * height / gravity);
  for (int i = 2; i <= n; ++i) t += 2 * speed_before(i) / gravity;
  return t;
}
std::string BouncingBall::scene(const std::string& integrator, double until) const {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"ball": {{"type": "point_mass", "mass": 0.1, "position": [0, {:.17g}]}}}},
  "contacts": {{"floor": {{"type": "constraint_method", "restitution": {:.17g},
               "between": ["ball.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "integrator": {}, "simulate": {{"until": {:.17g}}},
  "record": {{"every": 0.01, "observe": {{"y": "ball.point.y"}}}}}})",
                     height, e, integrator, until);
}

double StrikingBar::impulse() const {
  return (1 + e) * speed * mass / 4;
}
double StrikingBar::centre_velocity() const {
  return -speed + impulse() / mass;
}
double StrikingBar::angular_velocity() const {
  return impulse() * half / inertia;
}
std::string StrikingBar::scene(const std::string& integrator) const {
  // Only the end has a contact: the rest of the bar is over the edge.
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {{"bar": {{"type": "rigid_body", "mass": {}, "inertia": {:.17g}, "position": [0, 0.1],
             "velocity": [0, {:.17g}], "markers": {{"centre": [0, 0], "end": [{}, 0]}}}}}},
  "contacts": {{"edge": {{"type": "constraint_method", "restitution": {:.17g},
               "between": ["bar.end", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "integrator": {}, "simulate": {{"until": {:.17g}}},
  "record": {{"every": 0.01, "observe": {{"vy": "bar.centre.vy", "y": "bar.centre.y"}}}}}})",
                     mass, inertia, -speed, half, e, integrator, 0.1 / speed + 0.05);
}

}  // namespace trammel::problems
