// Tangents by differences, of components without an exact one, are the exact ones in any unit of length and far from
// the origin.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "simulate/start/setup.hpp"
#include "support/run_scene.hpp"
#include "system/assembled_system.hpp"

namespace trammel::test {
namespace {

// A body on a ball joint carries a second one on a bushing, which a spring and damper holds; all move. Lengths are in a
// unit, x from the origin.
std::string moving_pair(double unit, double x) {
  const auto at = [&](double u) { return fmt::format("{:.17g}", (x + u) * unit); };
  const auto m = [&](double u) { return fmt::format("{:.17g}", u * unit); };
  const auto in = [&](double u) { return fmt::format("{:.17g}", u * unit * unit); };
  const auto inertia = fmt::format("[{}, {}, {}]", in(0.1), in(0.12), in(0.15));
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, {g}],
    "bodies": {{
      "a": {{"type": "rigid_body", "mass": 1, "inertia": {i}, "position": [{ax}, 0, 0], "velocity": [0, {v}, 0],
            "angular_velocity": [0, 0, 0.5], "markers": {{"foot": [{foot}, 0, 0], "top": [{top}, 0, 0]}}}},
      "b": {{"type": "rigid_body", "mass": 2, "inertia": {i}, "position": [{bx}, {by}, 0], "velocity": [{v}, 0, {v}],
            "angular_velocity": [0.3, -0.2, 0.7], "markers": {{"m": [{foot}, {low}, 0], "n": [0, {top}, {low}]}}}}}},
    "joints": {{"j": {{"type": "spherical", "between": [{{"point": [{x0}, 0, 0]}}, "a.foot"]}}}},
    "forces": {{
      "u": {{"type": "bushing", "between": ["a.top", "b.m"], "stiffness": [30, 40, 50], "damping": [1, 2, 3],
            "torsional_stiffness": [{k}, {k}, {c}], "torsional_damping": [{c}, {c}, {k}]}},
      "s": {{"type": "spring_damper", "between": [{{"point": [{bx}, {v}, {top}]}}, "b.n"], "stiffness": 60, "damping": 2,
            "length": {top}}},
      "l": {{"type": "load", "on": "b.n", "frame": "body", "force": {{"x": {v}, "y": {top}, "z": 0}}}}}},
    "simulate": {{"until": 1}}}})",
                     fmt::arg("g", m(-9.81)), fmt::arg("i", inertia), fmt::arg("ax", at(0.5)), fmt::arg("v", m(0.25)),
                     fmt::arg("foot", m(-0.5)), fmt::arg("top", m(0.5)), fmt::arg("bx", at(1.625)),
                     fmt::arg("by", m(0.125)), fmt::arg("low", m(-0.25)), fmt::arg("x0", at(0)), fmt::arg("k", in(7)),
                     fmt::arg("c", in(0.5)));
}

// In the coordinates' sizes, by the size of the largest entry.
Mat tangent(const simulate::Setup& setup, Blend blend) {
  model::AssembledSystem system(setup.model);
  State s = setup.initial;
  system.move_to(s.t, s.q, s.v);
  system.accelerate({}, s.a, s.lambda);
  Mat S = Mat::Zero(s.v.size(), s.v.size());
  system.add_tangent(blend, s.a, s.lambda, S);
  const Vec sizes = system.coordinate_sizes().of;
  return sizes.asDiagonal() * S * sizes.asDiagonal();
}

void expect_differences_are_exact(double unit, double x) {
  const simulate::Setup setup =
      simulate::set_up(scene::Scene::parse(moving_pair(unit, x), "test.json"), registry(), simulate::Purpose::motion);
  // Of the place, where differences go by the motion of a body.
  const double off = 1e-8 + 30 * std::pow(2e-16 * x, 2.0 / 3);
  for (const Blend blend : {Blend{0, 0, 1}, Blend{0, 1, 0}}) {
    const Mat exact = tangent(setup, blend);
    const simulate::Setup other =
        simulate::set_up(scene::Scene::parse(moving_pair(unit, x), "test.json"), registry(), simulate::Purpose::motion);
    for (model::ForceEntry& force : other.model->forces) force.tangent = nullptr;
    for (model::JointEntry& joint : other.model->joints) joint.tangent = nullptr;
    for (model::BodyEntry& body : other.model->bodies) body.tangent = nullptr, body.reaction_derivative = nullptr;
    EXPECT_LE((tangent(other, blend) - exact).cwiseAbs().maxCoeff(), off * exact.cwiseAbs().maxCoeff())
        << "unit " << unit << ", x = " << x << (blend.c_k == 0 ? ", by velocities" : ", by places");
  }
}

TEST(TangentsAtScales, ByDifferencesAreExactInAnyUnit) {
  for (const double unit : {1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6}) expect_differences_are_exact(unit, 0);
}

TEST(TangentsAtScales, ByDifferencesAreExactFarFromTheOrigin) {
  for (const double x : {1e2, 1e4, 1e5, 1e6}) expect_differences_are_exact(1, x);
}

}  // namespace
}  // namespace trammel::test
