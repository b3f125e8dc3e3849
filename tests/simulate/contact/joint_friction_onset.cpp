// Which dry joints of a mechanism that is let go begin to slide, against all modes of all joints.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/LU>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

constexpr double g = 9.81;  // [m/s^2]

// Sliders on a rail along x, side by side at the height 0, each joined to one bob by a rod, and pushed along the rail.
// The load of a rail then follows from the rods' forces, and these from what slides.
struct Slider {
  double mass, x, push, mu_0, mu;
};
struct Hung {
  std::vector<Slider> sliders;
  double bob, x, y;  // its mass and place, not below a slider
};

std::string scene(const Hung& hung, double until) {
  std::string bodies = fmt::format(
      R"("bob": {{"type": "point_mass", "mass": {:.17g}, "position": [{:.17g}, {:.17g}]}})", hung.bob, hung.x, hung.y);
  std::string joints, forces, observe;
  for (std::size_t i = 0; i < hung.sliders.size(); ++i) {
    const Slider& s = hung.sliders[i];
    bodies +=
        fmt::format(R"(, "s{}": {{"type": "rigid_body", "mass": {:.17g}, "inertia": 1, "position": [{:.17g}, 0]}})", i,
                    s.mass, s.x);
    joints += fmt::format(
        R"({}"rail{}": {{"type": "prismatic", "between": ["ground", "s{}.com"],
                         "friction": {{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}}}},
           "rod{}": {{"type": "distance", "between": ["s{}.com", "bob.point"], "length": {:.17g}}})",
        i > 0 ? ", " : "", i, i, s.mu_0, s.mu, i, i, std::hypot(hung.x - s.x, hung.y));
    forces += fmt::format(R"({}"f{}": {{"type": "load", "on": "s{}.com", "force": {{"x": {:.17g}}}}})",
                          i > 0 ? ", " : "", i, i, s.push);
    observe += fmt::format(R"({}"v{}": "s{}.com.vx")", i > 0 ? ", " : "", i, i);
  }
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {}], "bodies": {{{}}}, "joints": {{{}}},
  "forces": {{{}}}, "simulate": {{"until": {:.17g}}}, "record": {{"every": {:.17g}, "observe": {{{}}}}}}})",
                     -g, bodies, joints, forces, until, until, observe);
}

// The sliders' accelerations in each set of modes that agrees with its own loads.
class AllModes {
 public:
  explicit AllModes(const Hung& hung) : hung_(hung), n_(int(hung.sliders.size())) {
    modes_.resize(std::size_t(n_));
    visit(0);
  }
  const std::vector<Vec>& found() const { return found_; }

 private:
  struct Mode {
    int slides, presses;  // direction of sliding, or 0; side of the rail it presses on
  };
  void visit(int i) {
    if (i == n_) return look();
    for (const Mode mode : {Mode{0, 1}, Mode{1, 1}, Mode{1, -1}, Mode{-1, 1}, Mode{-1, -1}}) {
      modes_[std::size_t(i)] = mode;
      visit(i + 1);
    }
  }
  // Unknown: accelerations of the sliders and of the bob, forces of the rods (tension), friction on the sliders.
  void look() {
    const int size = 3 * n_ + 2, bob = n_, rods = n_ + 2, friction = 2 * n_ + 2;
    Mat A = Mat::Zero(size, size);
    Vec b = Vec::Zero(size);
    A(bob, bob) = A(bob + 1, bob + 1) = hung_.bob;
    b[bob + 1] = -hung_.bob * g;
    for (int i = 0; i < n_; ++i) {
      const Slider& s = hung_.sliders[std::size_t(i)];
      const auto [slides, presses] = modes_[std::size_t(i)];
      const Eigen::Vector2d e = Eigen::Vector2d(hung_.x - s.x, hung_.y).normalized();
      A(i, i) = s.mass, A(i, rods + i) = -e.x(), A(i, friction + i) = -1, b[i] = s.push;
      A.block<2, 1>(bob, rods + i) = e;
      A(rods + i, i) = -e.x(), A.block<1, 2>(rods + i, bob) = e.transpose();
      A(friction + i, slides ? friction + i : i) = 1;  // T + slides mu presses (m g - e_y S) = 0, or a = 0
      if (!slides) continue;
      A(friction + i, rods + i) = -slides * s.mu * presses * e.y();
      b[friction + i] = -slides * s.mu * presses * s.mass * g;
    }
    const Eigen::FullPivLU<Mat> lu(A);
    if (!lu.isInvertible()) return;
    const Vec x = lu.solve(b);
    for (int i = 0; i < n_; ++i) {
      const Slider& s = hung_.sliders[std::size_t(i)];
      const auto [slides, presses] = modes_[std::size_t(i)];
      const double load = s.mass * g - hung_.y / std::hypot(hung_.x - s.x, hung_.y) * x[rods + i];
      if (!slides && std::abs(x[friction + i]) > s.mu_0 * std::abs(load)) return;
      if (slides && (slides * x[i] <= 0 || presses * load < 0)) return;
    }
    found_.push_back(x.head(n_));
  }

  const Hung& hung_;
  int n_;
  std::vector<Mode> modes_;
  std::vector<Vec> found_;
};

Hung random_hung(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  Hung hung{{}, std::pow(10.0, draw(-1, 1)), draw(-1, 1), draw(0.2, 1) * (seed % 3 ? -1 : 1)};
  for (std::size_t i = 0; i < 1 + seed % 2; ++i) {
    const double mu = draw(0, 0.6);
    hung.sliders.push_back({std::pow(10.0, draw(-1, 1)), i == 0 ? -1.2 : 1.2, draw(-1, 1), mu * (1 + draw(0, 10)), mu});
    hung.sliders.back().push *= 3 * g * (hung.bob + hung.sliders.back().mass);
  }
  return hung;
}

TEST(DryJoints, LetGoFromRestMoveAsOneOfAllModes) {
  constexpr double until = 1e-6;
  for (unsigned seed = 0; seed < 120; ++seed) {
    const Hung hung = random_hung(seed);
    const std::vector<Vec> modes = AllModes(hung).found();
    const Finished run = run_text(scene(hung, until));
    ASSERT_FALSE(modes.empty()) << seed;
    ASSERT_TRUE(run.done()) << seed << ": " << run.report.reason << "\n" << scene(hung, until);
    double least = 1e300;
    Vec a(Eigen::Index(hung.sliders.size()));
    for (Eigen::Index i = 0; i < a.size(); ++i) a[i] = run.end(fmt::format("v{}", i)) / until;
    for (const Vec& mode : modes) least = std::min(least, (a - mode).norm() / (g + mode.norm()));
    EXPECT_LT(least, 1e-4) << seed << "\n" << scene(hung, until);  // a changes by some a / s^2 t^2
  }
}

// A box on two feet carries a chain of three rods, of which two journals rub. Its swing takes the feet's friction
// beyond their bound for 0.02 s; where the feet reach the bound they still hold, up to the round-off of the journals'
// loads.
TEST(DryJoints, AboveFeetLetThemSlipForAsLongAsTheirBoundIsExceeded) {
  for (const double mu : {0.69, 0.698, 0.704, 0.71, 0.72}) {
    const auto foot = [mu](const std::string& marker) {
      return fmt::format(R"({{"type": "constraint_method", "restitution": 0,
                              "friction": {{"type": "coulomb", "static": {0}, "kinetic": {0}}},
                              "between": ["box.{1}", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                         mu, marker);
    };
    std::string bodies = R"("box": {"type": "rigid_body", "mass": 1.08, "inertia": 0.056, "position": [0, 0.11],
                                    "markers": {"l": [-0.38, -0.11], "r": [0.38, -0.11], "end": [0.27, 0.1]}})";
    struct Rod {
      double mass, length, angle, radius, mu_0, mu;  // the last three of the journal at its upper end
    };
    std::string joints, above = "box";
    double x = 0.27, y = 0.21;
    for (const Rod& rod : {Rod{0.93, 0.417, -2.609, 0.067, 0, 0}, Rod{0.61, 0.274, 1.817, 0.0415, 0.5, 0.5},
                           Rod{1.58, 0.444, -0.776, 0.0348, 1.08, 0.9}}) {
      const double dx = rod.length * std::sin(rod.angle), dy = -rod.length * std::cos(rod.angle);
      bodies += fmt::format(R"(, "under_{}": {{"type": "rigid_body", "mass": {}, "inertia": {:.17g}, "angle": {},
                                 "position": [{:.17g}, {:.17g}], "markers": {{"a": [0, {}], "end": [0, {}]}}}})",
                            above, rod.mass, rod.mass * rod.length * rod.length / 12, rod.angle, x + dx / 2, y + dy / 2,
                            rod.length / 2, -rod.length / 2);
      joints += fmt::format(
          R"({}"{}": {{"type": "revolute", "between": ["{}.end", "under_{}.a"], "radius": {},
                       "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}})",
          joints.empty() ? "" : ", ", above, above, above, rod.radius, rod.mu_0, rod.mu);
      x += dx, y += dy, above = "under_" + above;
    }
    const Finished run = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, {}], "bodies": {{{}}}, "joints": {{{}}},
             "contacts": {{"l": {}, "r": {}}}, "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-6}}}},
             "simulate": {{"until": 0.35}}, "record": {{"every": 0.0125, "observe": {{"N": "contacts.l.force"}}}}}})",
        -g, bodies, joints, foot("l"), foot("r")));
    ASSERT_TRUE(run.done()) << mu << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << mu << run.result["warnings"].dump();
    const auto in_swing = [](const std::vector<Event>& events) {
      return std::count_if(events.begin(), events.end(),
                           [](const Event& e) { return e.contact == "contacts.l" && e.t > 0.28 && e.t < 0.33; });
    };
    EXPECT_EQ(in_swing(run.of_kind("slip")), 1) << mu;
    EXPECT_EQ(in_swing(run.of_kind("stick")), 1) << mu;
  }
}

// Three rods on dry journals above a box on a rough floor, let go. Large loads would hold every journal, so there are
// forces, though on the way to them some modes of the journals lock themselves.
TEST(DryJoints, LetGoFromRestOnAFloorHaveForcesAlways) {
  for (const unsigned seed : {3u, 64u, 78u, 80u, 94u, 101u, 185u, 187u, 190u, 193u, 199u, 207u, 209u, 222u, 246u}) {
    std::uint64_t at = seed;
    const auto draw = [&at](double least, double most) {  // the same on all machines
      at = (1103515245 * at + 12345) % 2147483648;
      return least + (most - least) * double(at) / 2147483648;
    };
    std::string bodies = R"("box": {"type": "rigid_body", "mass": 2.6, "inertia": 0.2, "position": [0, 0.15],
                                    "markers": {"l": [-0.6, -0.15], "r": [0.6, -0.15], "end": [0, 0.1]}})";
    std::string joints, observe, above = "box";
    std::vector<double> mu;
    draw(0, 1);
    double x = 0, y = 0.25;
    for (int i = 0; i < 3; ++i) {
      const double mass = draw(0.5, 2), length = draw(0.15, 0.5), tilt = draw(1.2, 3);
      const double angle = std::copysign(tilt, draw(-1, 1)), radius = draw(0.04, 0.1);
      mu.push_back(draw(0.5, 1.2));
      const double dx = length * std::sin(angle), dy = -length * std::cos(angle);
      bodies +=
          fmt::format(R"(, "p{}": {{"type": "rigid_body", "mass": {:.17g}, "inertia": {:.17g}, "angle": {:.17g},
                                 "position": [{:.17g}, {:.17g}],
                                 "markers": {{"a": [0, {:.17g}], "end": [0, {:.17g}]}}}})",
                      i, mass, mass * length * length / 12, angle, x + dx / 2, y + dy / 2, length / 2, -length / 2);
      joints += fmt::format(R"({}"j{}": {{"type": "revolute", "between": ["{}.end", "p{}.a"], "radius": {:.17g},
                                 "friction": {{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}}}})",
                            i > 0 ? ", " : "", i, above, i, radius, 1.2 * mu.back(), mu.back());
      observe +=
          fmt::format(R"({}"sticks{}": "joints.j{}.sticks", "T{}": "joints.j{}.friction", "N{}": "joints.j{}.load")",
                      i > 0 ? ", " : "", i, i, i, i, i, i);
      x += dx, y += dy, above = fmt::format("p{}", i);
    }
    const auto foot = [](const char* marker) {
      return fmt::format(R"({{"type": "constraint_method", "restitution": 0,
                              "friction": {{"type": "coulomb", "static": 0.7, "kinetic": 0.7}},
                              "between": ["box.{}", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                         marker);
    };
    const Finished run = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, {}], "bodies": {{{}}}, "joints": {{{}}},
             "contacts": {{"l": {}, "r": {}}}, "simulate": {{"until": 1e-3}},
             "record": {{"every": 1e-3, "observe": {{{}}}}}}})",
        -g, bodies, joints, foot("l"), foot("r"), observe));
    ASSERT_TRUE(run.done()) << seed << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << seed << run.result["warnings"].dump();
    for (std::size_t i = 0; i < mu.size(); ++i) {
      const double T = std::abs(run.end(fmt::format("T{}", i))), N = run.end(fmt::format("N{}", i));
      if (run.end(fmt::format("sticks{}", i)) != 0)
        EXPECT_LE(T, 1.2 * mu[i] * N * (1 + 1e-9)) << seed << " " << i;
      else
        EXPECT_NEAR(T, mu[i] * N, 1e-6 * N) << seed << " " << i;
    }
  }
}

}  // namespace
}  // namespace trammel::test
