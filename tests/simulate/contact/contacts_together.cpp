// Several contacts at one instant: a bar of mass 1, length 1 and inertia 1/12 over a floor.
#include <cmath>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

const std::string bar = R"({
  "trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {"bar": {"type": "rigid_body", "mass": 1, "inertia": "=1/12", "position": [0, 0.2], "angle": 0,
                     "markers": {"left": [-0.5, 0], "right": [0.5, 0]}}},
  "contacts": {
    "left": {"type": "constraint_method", "restitution": 0, "between": ["bar.left", {"plane": {"point": [0, 0], "normal": [0, 1]}}]},
    "right": {"type": "constraint_method", "restitution": 0, "between": ["bar.right", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}
  },
  "integrator": {"type": "hht_alpha", "alpha": 0, "step": 1e-3},
  "simulate": {"until": 1},
  "record": {"every": 0.01, "observe": {"angle": "bar.angle", "y": "bar.com.y", "left": "contacts.left.force",
                                        "right": "contacts.right.force"}}
})";

TEST(TwoContacts, ShareAnImpactAndBothRebound) {
  const Finished run = run_text(
      bar, {{"contacts.left.restitution", "0.5"}, {"contacts.right.restitution", "0.5"}, {"simulate.until", "0.25"}});
  ASSERT_EQ(run.events.size(), 2u);  // at 0.2 s, one each
  for (const Event& impact : run.events) {
    EXPECT_EQ(impact.kind, "impact");
    EXPECT_NEAR(impact.t, 0.2, 1e-14);
    EXPECT_NEAR(impact.detail.at("impulse"), 0.5 * 1.5 * 2, 1e-12);
    EXPECT_NEAR(impact.detail.at("separation"), 1, 1e-12);
  }
  EXPECT_NE(run.events[0].contact, run.events[1].contact);
  EXPECT_NEAR(run.end("angle"), 0, 1e-13);
}

TEST(TwoContacts, CloseTogetherAndShareTheWeight) {
  const Finished run = run_text(bar);
  ASSERT_EQ(run.events.size(), 4u);
  EXPECT_EQ(run.of_kind("contact_close").size(), 2u);
  EXPECT_NEAR(run.end("left"), 5, 1e-10);
  EXPECT_NEAR(run.end("right"), 5, 1e-10);
  EXPECT_NEAR(run.end("y"), 0, 1e-14);
}

TEST(TwoContacts, TheSecondImpactHoldsTheFirstContactDown) {
  // Tilted by 0.1 rad the left end arrives first; hinged on it the bar falls flat with rate w. A blow on the right end
  // of the free bar, p = w/4, would turn the left end down with w/2: it is pressed too, so both stay and nothing moves.
  const Finished run = run_text(bar, {{"bodies.bar.angle", "0.1"}});
  const std::vector<Event> closed = run.of_kind("contact_close"), impacts = run.of_kind("impact");
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_FALSE(closed.empty());
  EXPECT_EQ(run.events[0].contact, "contacts.left");
  EXPECT_NEAR(run.end("y"), 0, 1e-13);
  EXPECT_NEAR(run.end("angle"), 0, 1e-12);
  EXPECT_NEAR(run.end("left") + run.end("right"), 10, 1e-9);
  // Everything it had over the floor went into impacts.
  EXPECT_NEAR(run.result["energy_dissipated"]["impact_total"], 2, 2e-5);  // second order: (h omega)^2 / 12 of 2 J
}

TEST(TwoContacts, OfDifferentKindsActAtOnce) {
  const Finished run = run_text(
      bar, {{"contacts.right", R"({"type": "continuous_force", "stiffness": 1e4, "exponent": 1, "damping": "none",
            "between": ["bar.right", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> closed = run.of_kind("contact_close");
  ASSERT_GE(closed.size(), 2u);
  EXPECT_NEAR(closed[0].t, 0.2, 1e-13);
  EXPECT_NEAR(closed[1].t, 0.2, 1e-13);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-3);  // second order: (h omega)^2 = 0.03 at the buffer's 170 rad/s
}

TEST(ThreeContacts, OnOneStraightBarAreRedundantAndStillRest) {
  const Finished run =
      run_text(bar, {{"bodies.bar.markers", R"({"left": [-0.5, 0], "middle": [0.1, 0], "right": [0.5, 0]})"},
                     {"contacts.middle", R"({"type": "constraint_method", "restitution": 0,
            "between": ["bar.middle", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("y"), 0, 1e-13);
  EXPECT_NEAR(run.end("angle"), 0, 1e-12);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-12);
}

// Three points of one bar: the single forces mean nothing, and those of minimum norm may pull though nothing lifts.
const Overrides third_foot = {{"bodies.bar.position", "[0, 0]"},
                              {"bodies.bar.markers", R"({"left": [-0.5, 0], "middle": [0.4, 0], "right": [0.5, 0]})"},
                              {"contacts.middle", R"({"type": "constraint_method", "restitution": 0,
            "between": ["bar.middle", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"}};

Overrides with(Overrides overrides, const Overrides& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

TEST(ThreeContacts, StayClosedAndPushWhereForcesOfMinimumNormWouldPull) {
  // Weight 10 at 0 and a push of 90 at -0.5 have their resultant at -0.45: minimum norm pulls at one, two feet carry
  // it. Of all that push, N = (l, m, r) with l + m + r = 100 and -0.5 l + 0.4 m + 0.5 r = -45, the least is m = 5/0.9,
  // r = 0.
  const Finished run = run_text(
      bar,
      with(third_foot, {{"forces.push", R"({"type": "load", "on": "bar.left", "force": {"x": 0, "y": "=-90*t"}})"},
                        {"record.observe", R"({"angle": "bar.angle", "y": "bar.com.y", "left": "contacts.left.force",
                                          "middle": "contacts.middle.force", "right": "contacts.right.force"})"}}));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("contact_open").size(), 0u);
  EXPECT_NEAR(run.end("left"), 100 - 5 / 0.9, 1e-10);
  EXPECT_NEAR(run.end("middle"), 5 / 0.9, 1e-10);
  EXPECT_EQ(run.end("right"), 0);
  EXPECT_NEAR(run.end("y"), 0, 1e-13);
  EXPECT_NEAR(run.end("angle"), 0, 1e-13);
}

TEST(ThreeContacts, OpenWhenTheResultantLeavesTheirBase) {
  // Pulled up by 10 t at the left end, 1 m from the right one, against the weight at 0.5 m: 10 t = 5 at 0.5 s. It then
  // turns by (1/12 + cos^2/4) angle'' - sin cos angle'^2/4 = (10 t - 5) cos, here by Runge-Kutta steps of 1e-4 s.
  const Finished run = run_text(
      bar,
      with(third_foot, {{"forces.pull", R"({"type": "load", "on": "bar.left", "force": {"x": 0, "y": "=10*t"}})"}}));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> open = run.of_kind("contact_open");
  ASSERT_EQ(open.size(), 2u);
  for (const Event& event : open) {
    EXPECT_NE(event.contact, "contacts.right");
    EXPECT_NEAR(event.t, 0.5, 1e-9);  // decided by an acceleration of 1e-9 m/s^2
  }
  EXPECT_NEAR(run.end("angle"), -0.6561263764538, 3e-6);  // second order: h^2 times angle'' of 10/s^2
}

TEST(AContact, ThatIsPulledOffOpensWhenItsForceFallsThroughZero) {
  // Lifted by 2 m g t: free of the floor when that is m g, at 0.5 s; then y = 10 (tau^3/3) with tau = t - 0.5.
  const Finished run =
      run_text(bar, {{"bodies.bar.position", "[0, 0]"},
                     {"forces.lift", R"({"type": "load", "on": "bar.com", "force": {"x": 0, "y": "=20*t"}})"}});
  const std::vector<Event> opened = run.of_kind("contact_open");
  ASSERT_EQ(opened.size(), 2u);
  EXPECT_NEAR(opened[0].t, 0.5, 1e-12);
  EXPECT_NEAR(opened[1].t, 0.5, 1e-12);
  EXPECT_NEAR(run.end("y"), 20 * 0.125 / 6, 1e-6);  // second order: h^2 / 12 of 20
}

// A box under the lid of a base that turns, without gravity: it slides outwards at x with u, pressed to the lid at y by
// its own inertia, and N = m (omega^2 y - 2 omega u) falls through 0 at both corners at once.
struct BoxUnderLid {
  double omega, mu, x = 0.42, y = 0.26, u = 0.01;
  // x'' = omega^2 x - mu (omega^2 y - 2 omega x')
  double leaves() const {
    const double r = omega * (mu + std::hypot(1, mu)), s = omega * (mu - std::hypot(1, mu)), x_0 = x - mu * y;
    const double A = (u - s * x_0) / (r - s), B = x_0 - A;
    double low = 0, high = 1;
    while (high - low > 1e-14) {
      const double t = (low + high) / 2, speed = A * r * std::exp(r * t) + B * s * std::exp(s * t);
      (speed < omega * y / 2 ? low : high) = t;
    }
    return low;
  }
};

TEST(BoxUnderATurningLid, LeavesItWithBothCornersAtOnce) {
  for (const double omega : {0.7, 2.07, 3.3, 5.0})
    for (const double mu : {0.0, 0.2, 0.45}) {
      const BoxUnderLid b{omega, mu};
      const std::string friction =
          mu > 0 ? fmt::format(R"(, "friction": {{"type": "coulomb", "static": {0}, "kinetic": {0}}})", mu) : "";
      const auto corner = [&](const char* name) {
        return fmt::format(
            R"("{0}": {{"type": "constraint_method", "restitution": 0{1},
                        "between": ["box.{0}", {{"plane": {{"point": [0, {2}], "normal": [0, -1], "on": "base.origin"}}}}]}})",
            name, friction, b.y + 0.05);
      };
      const double t = b.leaves();
      const Finished run = run_text(fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
               "bodies": {{"base": {{"type": "moving_base", "angle": "={0}*t"}},
                           "box": {{"type": "rigid_body", "mass": 2, "inertia": 0.0033, "position": [{1}, {2}],
                                    "velocity": [{3}, {4}], "angular_velocity": {0},
                                    "markers": {{"a": [-0.05, 0.05], "b": [0.05, 0.05]}}}}}},
               "contacts": {{{5}, {6}}}, "simulate": {{"until": {7}}},
               "record": {{"every": 0.01, "observe": {{"x": "box.com.x"}}}}}})",
          omega, b.x, b.y, b.u - omega * b.y, omega * b.x, corner("a"), corner("b"), t + 0.05));
      ASSERT_TRUE(run.done()) << omega << ", " << mu << ": " << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
      const std::vector<Event> opened = run.of_kind("contact_open");
      ASSERT_EQ(opened.size(), 2) << omega << ", " << mu;
      for (const Event& e : opened) EXPECT_NEAR(e.t, t, 1e-8) << omega << ", " << mu;
    }
}

}  // namespace
}  // namespace trammel::test
