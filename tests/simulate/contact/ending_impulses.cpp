// The drifts that contacts at rest end: rows that contradict each other by round-off must not stop a motion.
#include "simulate/contact/ending_impulses.hpp"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// Rows of unit length in 6 velocities of mass 1.
Mat random_rows(int n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Mat rows = Mat::NullaryExpr(n, 6, [&] { return normal(random); });
  rows.rowwise().normalize();
  return rows;
}

TEST(EndingImpulses, EndAllRatesOfIndependentRowsAndOfRowsThatAgree) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    Mat rows = random_rows(5, random);
    rows.row(4) = 0.5 * rows.row(0) - 2 * rows.row(1);
    const Vec v = 1e-8 * random_rows(1, random).transpose(), rates = rows * v;
    const Vec after = v + rows.transpose() * simulate::ending_impulses(rows * rows.transpose(), rates);
    EXPECT_LT((rows * after).norm(), 1e-9 * rates.norm()) << trial;
  }
}

// Two rows at an angle of 1e-7 have rates of 1e-8 that no motion smaller than 0.1 has.
TEST(EndingImpulses, LeaveARateThatOnlyAMotionManyTimesAsLargeEnds) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    Mat rows = random_rows(3, random);
    rows.row(2) = rows.row(0) + 1e-7 * random_rows(1, random);
    const Vec rates{{1e-8, 0, -1e-8}};
    const Vec P = simulate::ending_impulses(rows * rows.transpose(), rates), change = rows.transpose() * P;
    EXPECT_LT(change.norm(), 1e-5) << trial;  // rows that remain leave each other 1e-3
    const Vec left = rates + rows * change;
    EXPECT_LE(std::max(std::abs(left[0]), std::abs(left[2])), 2.001e-8) << trial;
    EXPECT_LT(std::abs(left[1]), 1e-12) << trial;
  }
}

// A triangle slides over a floor, strikes a wall with its rear foot and rocks about the front one, which sticks. As it
// falls back its rear foot moves straight down at the floor, and touches the wall a little before: at a turn of 6e-5,
// by the error of steps, 1e-9 m. It loses as large a part of its speed, and the work of friction over 1e-9 m.
std::string rocking_triangle(double record_every, double mu, double speed) {
  std::string contacts;
  for (const char* foot : {"p0", "p1"})
    for (const bool wall : {false, true})
      contacts += fmt::format(
          R"({}"{}{}": {{"type": "constraint_method", "restitution": 0,
                         "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}},
                         "between": ["b.{}", {{"plane": {{"point": [{}, 0], "normal": {}}}}}]}})",
          contacts.empty() ? "" : ", ", wall ? "wall" : "floor", foot[1], mu, mu, foot, wall ? -0.024 : 0.0,
          wall ? "[1, 0]" : "[0, 1]");
  return fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
           "bodies": {{"b": {{"type": "rigid_body", "mass": 6.938, "inertia": 0.7696, "position": [0.4462, 0.1896],
                              "velocity": [{}, 0],
                              "markers": {{"p0": [-0.4462, -0.1896], "p1": [0.1898, -0.1896]}}}}}},
           "contacts": {{{}}}, "simulate": {{"until": 0.6}},
           "record": {{"every": {}, "observe": {{"omega": "b.angular_velocity"}}}}}})",
      -speed, contacts, record_every);
}

TEST(TriangleThatRocksAtAWall, FallsBackAsFastAsItRoseWheneverItIsRecorded) {
  for (const double mu : {0.3, 0.4})
    for (const double speed : {1.2, 1.313, 1.5})
      for (const double every : {0.001, 0.00731, 0.01, 0.05, 0.1}) {
        const Finished run = run_text(rocking_triangle(every, mu, speed));
        ASSERT_TRUE(run.done()) << run.report.reason;
        EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
        double rose = 0;  // [m/s] of the rear foot, the last time
        int falls = 0;
        for (const Event& e : run.events) {
          if (e.contact != "contacts.floor0") continue;
          if (e.kind == "contact_open") rose = e.detail.at("separation");
          if (e.kind != "impact" || rose < 1e-3) continue;
          const double fell = e.detail.at("approach");
          EXPECT_NEAR(fell * fell, rose * rose, 2e-4 * rose * rose + 1e-7) << mu << ", " << speed << ", " << every;
          ++falls;
        }
        EXPECT_GE(falls, 1) << mu << ", " << speed << ", " << every;
        EXPECT_NEAR(run.result["energy_supplied"]["total"].get<double>(), 0, 1e-9)
            << mu << ", " << speed << ", " << every;
      }
}

}  // namespace
}  // namespace trammel::test
