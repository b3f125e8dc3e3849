// Deployable trusses, scenes/truss, against exact models of one degree of freedom (tests/data/truss.json).
#include <cmath>
#include <numbers>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;
using std::numbers::pi;

const json& reference() {
  static const json data = json::parse(std::ifstream(TRAMMEL_SOURCE_DIR "/tests/data/truss.json"));
  return data;
}
double number(const json& text) {
  return std::stod(text.get<std::string>());
}
std::string text(double x) {
  return fmt::format("{:.17g}", x);
}

Event lock_of(const Finished& run) {
  const std::vector<Event> locks = run.of_kind("latch");
  EXPECT_EQ(locks.size(), 1u);
  return locks.empty() ? Event() : locks[0];
}
double maximum(const Finished& run, const char* level) {
  return run.result["constraint_maxima"][level].get<double>();
}

// Errors of the method at h = 1 ms by the reference's own tables, 1e-13 to 1e-12 s, doubled for other metrics.
TEST(TrussScenes, MastLocksAtTheExactTime) {
  const Finished run = run_file("truss/S1c.json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const json& exact = reference()["exact"]["S1c"];
  EXPECT_NEAR(lock_of(run).t, number(exact["t_lock"]), 2e-12);
  EXPECT_NEAR(lock_of(run).detail.at("energy_lost"), number(exact["T_lock_lost_J"]), 1e-10);
  EXPECT_NEAR(run.end("theta"), 30 * pi / 180, 1e-14);
  EXPECT_EQ(run.result["counts"]["impacts"], 1);
}

TEST(TrussScenes, MastWithDampersAndAForceLocksAtTheExactTime) {
  const Finished run = run_file("truss/S1d.json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const json& exact = reference()["exact"]["S1d"];
  EXPECT_NEAR(lock_of(run).t, number(exact["t_lock"]), 3e-12);
  EXPECT_NEAR(lock_of(run).detail.at("energy_lost"), number(exact["T_lock_lost_J"]), 1e-9);
  // The ledger's rule is of fourth order, and its steps are short.
  EXPECT_NEAR(run.result["energy_dissipated"]["dampers"].get<double>(), number(exact["R_dissipated_J"]), 1e-9);
  EXPECT_NEAR(run.result["energy_supplied"]["drives"].get<double>(), number(exact["W_external_J"]), 1e-9);
}

// What the energy correction aims at has to be as accurate as the method: dampers' and the force's work by its dense
// output.
TEST(TrussScenes, EnergyCorrectionLeavesAMethodOfHighOrderItsLockTime) {
  for (const auto& [tolerance, within] : {std::pair("1e-8", 1e-9), {"1e-12", 3e-13}}) {
    const Finished run = run_file("truss/S1d.json", {{"integrator.type", "dop853"},
                                                     {"integrator.step", "null"},
                                                     {"integrator.step.tolerance", tolerance},
                                                     {"corrections.energy", "true"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(lock_of(run).t, number(reference()["exact"]["S1d"]["t_lock"]), within) << tolerance;
  }
}

TEST(TrussScenes, RedundantRowsDoNotChangeTheMast) {
  const Finished run = run_file("truss/S1R.json", {{"integrator.step", "2e-3"}, {"simulate.until", "1.85"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(lock_of(run).t, number(reference()["exact"]["S1c"]["t_lock"]), 1e-11);
}

// Each unit's four halves follow from the lengths of the others; 12 rows a unit, one of them redundant in three.
TEST(TrussScenes, ExplainNamesTheRedundantRowsOfAMastOfAnyLength) {
  for (const int units : {8, 300}) {
    const std::string text = simulate::text_of(simulate::explain(
        scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/truss/S1R.json", {{"parameters.n", std::to_string(units)}}),
        registry()));
    for (int k = 0; k < units; ++k)
      for (int half = 1; half <= 4; ++half)
        EXPECT_NE(text.find(fmt::format("joints.half_{}_{}: row 1 of 1 follows from the rows before", half, k)),
                  std::string::npos);
    std::size_t count = 0;
    for (auto at = text.find(" follow"); at != std::string::npos; at = text.find(" follow", at + 1)) ++count;
    EXPECT_EQ(count, 4 * units);
  }
}

// From the lock on no velocity is free.
TEST(TrussScenes, LockThoughTheirVelocitiesAreTurnedWithTheNullSpace) {
  for (const auto& [scene, until, t_lock] :
       {std::tuple{"S1c", "1.85", "S1c"}, {"S1d", "1.95", "S1d"}, {"S1R", "1.85", "S1c"}, {"S2c", "1.1", "S2c"}}) {
    const Finished run =
        run_file(fmt::format("truss/{}.json", scene), {{"corrections.velocity", "null_space_rotation"},
                                                       {"parameters.n", std::string(scene) == "S2c" ? "6" : "8"},
                                                       {"integrator.step", "8e-3"},
                                                       {"simulate.until", until}});
    ASSERT_TRUE(run.done()) << scene << ": " << run.report.reason;
    EXPECT_NEAR(lock_of(run).t, number(reference()["exact"][t_lock]["t_lock"]), 1e-8) << scene;
    EXPECT_LT(run.end("energy_kinetic"), 1e-20) << scene;
  }
}

TEST(TrussScenes, PrismaticMastLocksAtTheExactTime) {
  const Finished run = run_file("truss/S2c.json", {{"integrator.step", "4e-3"}, {"simulate.until", "1.1"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const json& exact = reference()["exact"]["S2c"];
  EXPECT_NEAR(lock_of(run).t, number(exact["t_lock"]), 4e-10);
  EXPECT_NEAR(lock_of(run).detail.at("energy_lost"), number(exact["T_lock_lost_J"]), 1e-7);
}

TEST(TrussScenes, HoopLocksAtTheExactTime) {
  const Finished run = run_file("truss/S3c.json", {{"integrator.step", "2e-3"}, {"simulate.until", "0.55"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const json& exact = reference()["S3c_lock"];
  EXPECT_NEAR(lock_of(run).t, number(exact["t_lock"]), 3e-9);  // 5e-11 at 1 ms, of fourth order
  EXPECT_NEAR(lock_of(run).detail.at("energy_lost"), number(exact["T_lock_lost_J"]), 1e-6);
}

// All three edges lock at one instant, in a singular position.
TEST(TrussScenes, CellLocksStraightAndLosesAllItsEnergy) {
  const Finished run = run_file("truss/S4c.json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const json& exact = reference()["exact"]["S4c"];
  const std::vector<Event> locks = run.of_kind("latch");
  ASSERT_EQ(locks.size(), 3u);
  double lost = 0;
  for (const Event& lock : locks) {
    EXPECT_NEAR(lock.t, number(exact["t_lock"]), 2e-11);
    lost += lock.detail.at("energy_lost");
  }
  EXPECT_NEAR(lost, number(exact["T_lock_lost_J"]), 1e-8);
  EXPECT_LT(run.end("energy_kinetic"), 1e-15);
}

// In the lock's singular position the rows that keep edges equal vanish, as double roots: no method may follow their
// round-off there.
TEST(TrussScenes, CellLocksByImplicitMethodsToo) {
  const json& exact = reference()["exact"]["S4c"];
  const auto locks = [&](const char* type, const char* step, double error) {
    const Finished run =
        run_file("truss/S4c.json",
                 {{"integrator", fmt::format(R"({{"type": "{}", "step": {}}})", type, step)}, {"corrections", "{}"}});
    ASSERT_TRUE(run.done()) << type << ", " << step << ": " << run.report.reason;
    const std::vector<Event> all = run.of_kind("latch");
    ASSERT_EQ(all.size(), 3u) << type << ", " << step;
    double lost = 0;
    for (const Event& lock : all) {
      EXPECT_NEAR(lock.t, number(exact["t_lock"]), error) << type << ", " << step;
      lost += lock.detail.at("energy_lost");
    }
    EXPECT_NEAR(lost, number(exact["T_lock_lost_J"]), 2e4 * error) << type << ", " << step;
  };
  // The methods' own errors: of second order in the step, about the tolerance.
  for (const char* type : {"newmark", "hht_alpha", "generalized_alpha"}) {
    locks(type, "1e-3", 2e-5);
    locks(type, "2.5e-4", 1.2e-6);
    for (const auto& [tolerance, error] : {std::pair{1e-2, 2e-5}, {1e-3, 2e-5}, {1e-4, 2e-5}, {1e-6, 4e-6}})
      locks(type, fmt::format(R"({{"tolerance": {}}})", tolerance).c_str(), error);
  }
  for (const double tolerance : {1e-3, 1e-6})
    locks("exponential_collocation", fmt::format(R"({{"tolerance": {}}})", tolerance).c_str(), 20 * tolerance * 1e-6);
}

TEST(TrussScenes, UnsynchronisedCellLocksOneEdgeAfterTheOther) {
  const Finished run = run_file("truss/S4u.json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> locks = run.of_kind("latch");
  ASSERT_EQ(locks.size(), 3u);
  // The stiffest spring first.
  EXPECT_EQ(locks[0].contact, "contacts.lock_2");
  EXPECT_EQ(locks[1].contact, "contacts.lock_1");
  EXPECT_EQ(locks[2].contact, "contacts.lock_0");
  // Nothing moves on: it started from rest, so without momentum.
  double lost = 0;
  for (const Event& lock : locks) lost += lock.detail.at("energy_lost");
  EXPECT_NEAR(lost, run.result["energy_start"].get<double>(), 1e-12 * lost);
}

// RK4 with coordinate and velocity correction, weighted by mass: 4.6e-10, 2.9e-11, 1.9e-12 s at h = 8, 4, 2 ms in the
// reference.
TEST(TrussScenes, LockTimeIsOfFourthOrder) {
  const double exact = number(reference()["exact"]["S1c"]["t_lock"]);
  std::vector<double> error;
  for (const char* step : {"8e-3", "4e-3", "2e-3"}) {
    // Records would shorten the steps.
    const Finished run =
        run_file("truss/S1c.json", {{"integrator.step", step}, {"corrections.energy", "false"}, {"record.every", "2"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    error.push_back(std::abs(lock_of(run).t - exact));
  }
  EXPECT_LT(error[0], 6e-10);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4, 0.15);
  // Corrections leave 1e-14 in the rows of each of 900 steps, which moves the lock by 1e-12.
  EXPECT_NEAR(error[2], error[1] / 16, 1.5e-12);
}

// Quasi-velocities alone, without corrections, and with redundant rows.
TEST(TrussScenes, LockTimeInQuasiVelocitiesIsOfFourthOrder) {
  const double exact = number(reference()["exact"]["S1c"]["t_lock"]);
  for (const char* scene : {"truss/S1c.json", "truss/S1R.json"}) {
    std::vector<double> error;
    for (const char* step : {"8e-3", "4e-3"}) {
      const Finished run = run_file(scene, {{"integrator.step", step},
                                            {"integrator.rows", "null_space"},
                                            {"corrections", "{}"},
                                            {"simulate.until", "1.85"},
                                            {"record.every", "2"}});
      ASSERT_TRUE(run.done()) << run.report.reason;
      error.push_back(std::abs(lock_of(run).t - exact));
      EXPECT_LT(maximum(run, "velocity"), 1e-11)
          << scene;  // of some m/s: a tenth of what the step itself leaves of the lock
    }
    EXPECT_LT(error[0], 6e-10) << scene;
    EXPECT_NEAR(std::log2(error[0] / error[1]), 4, 0.2) << scene;
  }
}

TEST(TrussScenes, LongMastOf100UnitsLocksAtTheExactTime) {
  const Finished run = run_file(
      "truss/S1c.json",
      {{"parameters.n", "100"}, {"integrator.step", "0.04"}, {"simulate.until", "18.5"}, {"record.every", "1"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  // The motion is as much slower as the step is longer than 4 ms for 8 units.
  EXPECT_NEAR(lock_of(run).t, number(reference()["exact_large_n_lock_times"]["S1 n=100"]), 1e-8);
}

TEST(TrussScenes, OscillatingMastHasItsPeriodAndKeepsRowsAndEnergy) {
  const json& exact = reference()["exact"]["S1o"];
  const double period = number(exact["period_s"]);
  const Finished run = run_file("truss/S1o.json", {{"simulate.until", text(4 * period)}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(maximum(run, "position"), 1e-14);
  EXPECT_LT(maximum(run, "velocity"), 1e-14);
  const auto &t = run.series.at("t"), &theta = run.series.at("theta"), &T = run.series.at("energy_kinetic"),
             &E = run.series.at("energy_total");
  const double E_0 = E[0];
  for (std::size_t i = 0; i < E.size(); ++i)
    if (T[i] > 0.05 * E_0) {
      EXPECT_LT(std::abs(E[i] - E_0), 1e-13 * E_0) << "t = " << t[i];
    }
  // Error of the phase, 5e-5 s after 388 periods in the reference: theta'' is 1.3 rad/s^2 there.
  EXPECT_NEAR(theta.back(), 70 * pi / 180, 1e-9);
  EXPECT_NEAR(*std::min_element(theta.begin(), theta.end()), number(exact["theta_min_rad"]), 1e-6);
}

TEST(TrussScenes, FreeMastKeepsItsMomentum) {
  const Finished run = run_file("truss/S1f.json", {{"integrator.step", "2e-3"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const Event lock = lock_of(run);
  EXPECT_NEAR(lock.t, 1.10909049471, 5e-10);  // converged: h = 1, 0.5, 0.25 ms agree
  EXPECT_NEAR(run.end("theta"), pi / 6, 1e-14);
  // Once locked it is one rigid body with the kinetic energy of its spin.
  EXPECT_NEAR(run.end("energy_kinetic"), 0.0201474059824, 1e-11);
}

}  // namespace
}  // namespace trammel::test
