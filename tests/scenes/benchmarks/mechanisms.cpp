// Benchmarks of closed loops and chains.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "benchmark.hpp"

namespace trammel::test {
namespace {

TEST(BenchmarkAndrews, MeetsItsReference) {
  const auto data = reference("andrews");
  const Finished run = run_benchmark("andrews");
  expect_accepted(data, "beta(0.03) rad", run.end("beta"));
  expect_accepted(data, "theta(0.03) rad", run.end("theta"));
  expect_accepted(data, "gamma(0.03) rad", run.end("gamma"));
  expect_accepted(data, "epsilon(0.03) rad", run.end("epsilon"));
  expect_accepted(data, "beta_dot(0.03) rad/s", run.end("beta_dot"));
  expect_accepted(data, "max |g| at end, m", run.end("constraint_position"));
}

TEST(BenchmarkSliderCrank, MeetsItsReference) {
  const auto data = reference("flexible_slider_crank");
  const Finished run = run_benchmark("slider_crank");
  expect_accepted(data, "phi2(0.1)", run.end("phi2"));
  expect_accepted(data, "x3(0.1) m", run.end("x3"));
  expect_accepted(data, "q1(0.1) m", run.end("q1"));
  expect_accepted(data, "q2(0.1) m", run.end("q2"));
  expect_accepted(data, "q3(0.1) m", run.end("q3"));
  expect_accepted(data, "q4(0.1) m", run.end("q4"));
}

// By steps of some radians of its fastest mode; what the motor supplies is integrated by their own points.
TEST(BenchmarkSliderCrank, HasSixDigitsAndItsEnergyByExponentialCollocation) {
  const auto data = reference("flexible_slider_crank");
  const auto exact = data["reference"]["position_projected_start_exact_pi_binary128"];
  for (const std::string tolerance : {"1e-5", "7e-6", "5e-6", "3e-6", "1e-6", "1e-7"}) {
    const Finished run = run_benchmark(
        "slider_crank",
        {{"integrator.type", "exponential_collocation"},
         {"integrator.step", R"({"tolerance": )" + tolerance + R"(, "absolute": "=)" + tolerance + R"(/100"})"}});
    int i = 0;
    for (const char* name : {"phi1", "phi2", "x3", "q1", "q2", "q3", "q4"}) {
      const double value = std::stod(exact[std::size_t(i++)].get<std::string>());
      EXPECT_NEAR(run.end(name), value, 1e-6 * std::abs(value)) << name << " at " << tolerance;
    }
    EXPECT_LT(std::abs(run.result["energy_drift"].get<double>()), 1e-7) << tolerance;
  }
}

TEST(BenchmarkA02, StaysOnItsBranchThroughTwentySingularPositions) {
  const auto data = reference("iftomm_a02_n_four_bar");
  const Finished run = run_benchmark("a02_n2");
  expect_accepted(data, "N=2 B0 x(10)", run.end("B0_x"));
  expect_accepted(data, "N=2 B0 y(10)", run.end("B0_y"));
}

// Errors of a few hundred tolerances at 10 s, as the upright positions multiply them; at loose ones less regularly.
TEST(BenchmarkA02, PassesItsSingularPositionsAtAnyTolerance) {
  const auto data = reference("iftomm_a02_n_four_bar");
  for (const char* tolerance : {"1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"}) {
    const Finished run = run_benchmark("a02_n2", {{"integrator.step.tolerance", tolerance}});
    const double x = std::stod(data["reference"]["by_N"]["2"]["t=10_B0_x_y_vx_vy"][0].get<std::string>());
    EXPECT_NEAR(run.end("B0_x"), x, 1e-6 + 100 * std::stod(tolerance)) << tolerance;
  }
}

// Round-off of the rows, over the square of the angle from a singular position, neither keeps Newton's iteration from
// its end nor steps from being taken. B0 is off by order 1 m on another branch.
TEST(BenchmarkA02, PassesItsSingularPositionsByNewmarksMethodsAtTightTolerances) {
  const auto data = reference("iftomm_a02_n_four_bar");
  const auto by_n = data["reference"]["by_N"]["2"]["t=10_B0_x_y_vx_vy"];
  for (const std::string method : {"newmark", "hht_alpha", "generalized_alpha"})
    for (const std::string tolerance : {"1e-6", "1e-7", "1e-8", "1e-9"}) {
      const Finished run = run_benchmark(
          "a02_n2", {{"integrator", R"({"type": ")" + method + R"(", "step": {"tolerance": )" + tolerance + "}}"}});
      ASSERT_TRUE(run.done()) << method << " at " << tolerance << ": " << run.report.reason;
      EXPECT_NEAR(run.end("B0_x"), std::stod(by_n[0].get<std::string>()), 5e-3) << method << " at " << tolerance;
      EXPECT_NEAR(run.end("B0_y"), std::stod(by_n[1].get<std::string>()), 5e-3) << method << " at " << tolerance;
    }
}

// In blocks of bodies, where nearly dependent rows are detected in another way.
TEST(BenchmarkA02, WithTenWindowsPassesItsSingularPositionsByGeneralizedAlpha) {
  const auto by_n = reference("iftomm_a02_n_four_bar")["reference"]["by_N"]["10"]["t=10_B0_x_y_vx_vy"];
  for (const std::string tolerance : {"1e-7", "1e-9"}) {
    const Finished run = run_benchmark(
        "a02_n10", {{"integrator", R"({"type": "generalized_alpha", "step": {"tolerance": )" + tolerance + "}}"}});
    ASSERT_TRUE(run.done()) << tolerance << ": " << run.report.reason;
    EXPECT_NEAR(run.end("B0_x"), std::stod(by_n[0].get<std::string>()), 5e-3) << tolerance;
  }
}

TEST(BenchmarkA02, PassesItsSingularPositionsInQuasiVelocities) {
  const auto data = reference("iftomm_a02_n_four_bar");
  const double x = std::stod(data["reference"]["by_N"]["2"]["t=10_B0_x_y_vx_vy"][0].get<std::string>());
  for (const char* tolerance : {"1e-3", "1e-5", "1e-7", "1e-9"}) {
    const Finished run =
        run_benchmark("a02_n2", {{"integrator.rows", "null_space"}, {"integrator.step.tolerance", tolerance}});
    EXPECT_NEAR(run.end("B0_x"), x, 1e-6 + 100 * std::stod(tolerance)) << tolerance;
    EXPECT_LT(run.result["constraint_maxima"]["velocity"].get<double>(), 1e-12)
        << tolerance;  // speeds of 7 m/s, round-off over angles of rows
  }
}

// Sweeps that change nothing but round-off across the rows have converged. Errors as above: the upright positions
// multiply them.
TEST(BenchmarkA02, PassesItsSingularPositionsByExponentialCollocation) {
  const auto by_n = reference("iftomm_a02_n_four_bar")["reference"]["by_N"];
  const auto x = [&](const char* n) { return std::stod(by_n[n]["t=10_B0_x_y_vx_vy"][0].get<std::string>()); };
  for (const std::string rows : {"projected", "null_space"})
    for (const std::string tolerance : {"1e-3", "1e-5", "1e-7", "1e-8", "1e-9"}) {
      const Overrides integrator = {{"integrator", R"({"type": "exponential_collocation", "rows": ")" + rows +
                                                       R"(", "step": {"tolerance": )" + tolerance + "}}"}};
      const Finished two = run_benchmark("a02_n2", integrator), ten = run_benchmark("a02_n10", integrator);
      EXPECT_NEAR(two.end("B0_x"), x("2"), 100 * std::stod(tolerance)) << rows << " at " << tolerance;
      EXPECT_NEAR(ten.end("B0_x"), x("10"), 100 * std::stod(tolerance)) << rows << " at " << tolerance;
      EXPECT_LT(ten.result["counts"]["steps"].get<int>(), 500) << rows << " at " << tolerance;
    }
}

// 40 windows have as many rows that fail together, at angles down to n^-2 of the mechanism's own. Steps follow
// tolerance^(-1/8): if rounding of the accelerations shortened them near the passages, they would be tens of thousands.
TEST(BenchmarkA02, WithFortyWindowsPassesItsSingularPositionsAtTightTolerances) {
  const double exact = 0.180512226686728587;  // sin psi(10), psi'' = kappa sin psi, in 30 digits
  for (const char* tolerance : {"1e-8", "1e-9", "1e-10"}) {
    const Finished run = run_benchmark("a02_n40", {{"integrator.step.tolerance", tolerance}});
    EXPECT_NEAR(run.end("B0_x"), exact, 100 * std::stod(tolerance)) << tolerance;
    EXPECT_LT(run.result["counts"]["steps"].get<int>(), 500) << tolerance;
  }
}

TEST(BenchmarkA02, WithTenWindowsMeetsItsReference) {
  const auto by_n = reference("iftomm_a02_n_four_bar")["reference"]["by_N"]["10"]["t=10_B0_x_y_vx_vy"];
  const Finished run = run_benchmark("a02_n10");
  EXPECT_NEAR(run.end("B0_x"), std::stod(by_n[0].get<std::string>()), 1e-5);
  EXPECT_NEAR(run.end("B0_y"), std::stod(by_n[1].get<std::string>()), 1e-5);
}

TEST(BenchmarkA04, MovesThoughItsRowsAreRedundant) {
  const auto data = reference("iftomm_a04_bricard");
  const Finished run = run_benchmark("a04");
  expect_accepted(data, "P2 x(10) m", run.end("P2_x"));
  expect_accepted(data, "P2 y(10) m", run.end("P2_y"));
  expect_accepted(data, "P2 z(10) m", run.end("P2_z"));
  expect_accepted(data, "P3 y(1.2) m", at(run, 1.2, "P3_y"));
  expect_accepted(data, "energy drift J", spread(run.series.at("energy_total")));
  expect_accepted(data, "closure error m", run.end("constraint_position"));
}

TEST(BenchmarkA04, KeepsToLooseTolerances) {
  const auto data = reference("iftomm_a04_bricard");
  const auto& moments = data.at("reference").at("t_P2xyz_P3xyz_every_0.1s");
  for (const auto& [text, tolerance] : {std::pair("1e-1", 1e-1), {"1e-2", 1e-2}, {"1e-3", 1e-3}}) {
    const Finished run = run_benchmark("a04", {{"integrator.step.tolerance", text}});
    double error = 0;
    for (const auto& moment : moments)
      for (int i = 0; const char* name : {"P2_x", "P2_y", "P2_z", "P3_x", "P3_y", "P3_z"})
        error = std::max(error, std::abs(at(run, moment.at(0), name) - moment.at(std::size_t(++i)).get<double>()));
    EXPECT_LT(error, 2 * tolerance);  // of steps of 0.5 s and 10 s in all
    EXPECT_LT(run.result["constraint_maxima"]["position"].get<double>(), 1e-14) << "stages are on the rows";
  }
}

TEST(BenchmarkA04, ExplainNamesItsRedundantRow) {
  const scene::Scene scene = scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/benchmarks/a04.json");
  EXPECT_NE(simulate::text_of(simulate::explain(scene, registry()))
                .find("joints.P5: row 5 of 5 follows from the rows before"),
            std::string::npos);
}

// Steps of 1e-3 s at rates omega up to 3.5 rad/s, in lengths of 1 m: the trapezoidal rule's (h omega)^2 / 12 for
// methods of second order, (h omega)^4 for the others.
struct Expected {
  const char* method;
  double within;
};
class RedundantRows : public testing::TestWithParam<Expected> {};

TEST_P(RedundantRows, AreOrdinaryToEveryMethod) {
  const auto data = reference("iftomm_a04_bricard");
  const Finished run =
      run_benchmark("a04", {{"integrator", R"({"type": ")" + std::string(GetParam().method) + R"(", "step": 1e-3})"},
                            {"simulate.until", "1"}});
  const auto& at_1s = data.at("reference").at("t_P2xyz_P3xyz_every_0.1s").at(9);
  EXPECT_NEAR(run.end("P2_x"), at_1s.at(1).get<double>(), GetParam().within);
  EXPECT_NEAR(run.end("P2_y"), at_1s.at(2).get<double>(), GetParam().within);
  EXPECT_NEAR(run.end("P2_z"), at_1s.at(3).get<double>(), GetParam().within);
}

INSTANTIATE_TEST_SUITE_P(Methods, RedundantRows,
                         testing::Values(Expected{"runge_kutta_4", 1.5e-10}, Expected{"dormand_prince", 1.5e-10},
                                         Expected{"dop853", 1.5e-10}, Expected{"adams_baumgarte", 1.5e-10},
                                         Expected{"newmark", 1e-6}, Expected{"hht_alpha", 1e-6},
                                         Expected{"generalized_alpha", 1e-6}),
                         [](const auto& method) { return std::string(method.param.method); });

// As above, with rows at round-off: 15 rows, some of them redundant, at speeds up to 3.5 m/s.
TEST(QuasiVelocities, FollowTheBricardMechanismWithEveryExplicitMethod) {
  const auto data = reference("iftomm_a04_bricard");
  const auto& at_1s = data.at("reference").at("t_P2xyz_P3xyz_every_0.1s").at(9);
  for (const char* method : {"runge_kutta_4", "dormand_prince", "dop853", "adams_baumgarte"}) {
    const Finished run = run_benchmark("a04", {{"integrator.type", method},
                                               {"integrator.rows", "null_space"},
                                               {"integrator.step", "1e-3"},
                                               {"simulate.until", "1"}});
    EXPECT_NEAR(run.end("P2_x"), at_1s.at(1).get<double>(), 1.5e-10) << method;
    EXPECT_NEAR(run.end("P2_y"), at_1s.at(2).get<double>(), 1.5e-10) << method;
    EXPECT_NEAR(run.end("P2_z"), at_1s.at(3).get<double>(), 1.5e-10) << method;
    EXPECT_LT(run.result["constraint_maxima"]["position"].get<double>(), 1e-14) << method;
    EXPECT_LT(run.result["constraint_maxima"]["velocity"].get<double>(), 1e-13) << method;
  }
}

// Stages lie off the rows, where redundant ones part: what is solved there must still be smooth in the state.
TEST(BenchmarkA04, LeavesRungeKuttaItsFourthOrder) {
  const double x = reference("iftomm_a04_bricard").at("reference").at("t_P2xyz_P3xyz_every_0.1s").at(9).at(1);
  const auto error = [x](const char* step) {
    return std::abs(run_benchmark("a04", {{"integrator.type", "runge_kutta_4"},
                                          {"integrator.rows", "baumgarte"},
                                          {"integrator.step", step},
                                          {"simulate.until", "1"}})
                        .end("P2_x") -
                    x);
  };
  EXPECT_NEAR(std::log2(error("4e-3") / error("2e-3")), 4, 0.1);  // 2.5e-12 m at the finer, above round-off
}

class ContradictoryRows : public testing::TestWithParam<const char*> {
 protected:
  Finished run(std::string scene) {
    const std::string here = "INTEGRATOR";
    scene.replace(scene.find(here), here.size(), GetParam());
    return run_text(scene);
  }
};

// Two rods between the same points; one begins to grow at 0.5 s.
TEST_P(ContradictoryRows, OfLengthsAreNamedWhereTheyPart) {
  const Finished run = this->run(R"({
    "trammel": 1, "gravity": [0, -9.81], "bodies": {"bob": {"type": "point_mass", "mass": 1, "position": [1, 0]}},
    "joints": {"rod": {"type": "distance", "between": ["ground", "bob.point"], "length": 1},
               "growing": {"type": "distance", "between": ["ground", "bob.point"], "length": "=1+max(0,t-0.5)^3"}},
    INTEGRATOR, "simulate": {"until": 2}, "record": {"every": 0.1}})");
  EXPECT_FALSE(run.done());
  EXPECT_NE(run.report.reason.find("joints.rod, joints.growing prescribe motions that contradict each other"),
            std::string::npos)
      << run.report.reason;
  EXPECT_GE(run.series.at("t").back(), 0.4);
}

// Both drives hold at the start, with their first and second derivatives; the other mechanism has nothing to do with
// it.
TEST_P(ContradictoryRows, OfDrivesAreNamedWithoutTheInnocent) {
  const Finished run = this->run(R"({
    "trammel": 1, "bodies": {"bar": {"type": "rigid_body", "mass": 1, "inertia": 1},
                             "other": {"type": "rigid_body", "mass": 1, "inertia": 1, "position": [3, 0]}},
    "joints": {"slow": {"type": "revolute", "between": ["ground", "bar.com"], "angle": "=t^3"},
               "apart": {"type": "revolute", "between": [{"point": [3, 0]}, "other.com"], "angle": "=t^3"},
               "fast": {"type": "revolute", "between": ["ground", "bar.com"], "angle": "=2*t^3"}},
    INTEGRATOR, "simulate": {"until": 1}, "record": {"every": 0.1}})");
  EXPECT_FALSE(run.done());
  EXPECT_NE(run.report.reason.find("joints.slow, joints.fast prescribe motions that contradict each other"),
            std::string::npos)
      << run.report.reason;
}

// A crank driven on where the rod is too short to follow: a method that only damps what is off would go on with open
// joints.
TEST_P(ContradictoryRows, OfACrankBeyondItsReachAreNamed) {
  const Finished run = this->run(R"({
    "trammel": 1, "gravity": [0, 0], "parameters": {"h": 0.56},
    "bodies": {"crank": {"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [0.5, 0], "markers": {"o": [-0.5, 0], "e": [0.5, 0]}},
               "rod": {"type": "bar", "mass": 1, "from": [1, 0], "to": [1.25, "=h"]}},
    "joints": {"drive": {"type": "revolute", "between": ["ground", "crank.o"], "angle": "=-t"},
               "knee": {"type": "revolute", "between": ["crank.e", "rod.from"]},
               "rail": {"type": "point_on_plane", "between": ["ground", "rod.to"], "normal": [0, 1], "height": "=h"}},
    "initial": "project", INTEGRATOR, "simulate": {"until": 3}, "record": {"every": 0.01}})");
  EXPECT_FALSE(run.done());
  EXPECT_NE(run.report.reason.find(
                "bodies.rod, joints.drive, joints.knee, joints.rail prescribe motions that contradict each other"),
            std::string::npos)
      << run.report.reason;
}

INSTANTIATE_TEST_SUITE_P(
    With, ContradictoryRows,
    testing::Values(
        R"("integrator": {"type": "runge_kutta_4", "step": 1e-2})",
        R"("integrator": {"type": "runge_kutta_4", "step": 1e-2}, "corrections": {"position": "minimum_norm", "velocity": "minimum_norm"})",
        R"("integrator": {"type": "dop853", "step": {"tolerance": 1e-6}})",
        R"("integrator": {"type": "dop853", "rows": "projected", "step": {"tolerance": 1e-6}})",
        R"("integrator": {"type": "dop853", "rows": "null_space", "step": {"tolerance": 1e-6}})",
        R"("integrator": {"type": "newmark", "step": 1e-2})", R"("integrator": {"type": "hht_alpha", "step": 1e-2})",
        R"("integrator": {"type": "generalized_alpha", "step": 1e-2})",
        R"("integrator": {"type": "adams_baumgarte", "step": 1e-2})"));

// A chain of 1,100 rods that hangs down, and `joints` beside.
Finished run_long_chain(const std::string& joints, const char* integrator) {
  return run_text(R"({
    "trammel": 1, "gravity": [0, -9.81],
    "bodies": {"m{i}": {"for": {"i": [1, 1100]}, "type": "point_mass", "mass": 1, "position": [0, "=-{i}"]}},
    "joints": {"hook": {"type": "distance", "between": ["ground", "m1.point"], "length": 1},
               "rod{i}": {"for": {"i": [2, 1100]}, "type": "distance", "between": ["m{i-1}.point", "m{i}.point"], "length": 1},
               )" + joints +
                      R"(},
    "integrator": {"type": "runge_kutta_4", "step": 1e-2}, "simulate": {"until": 0.6}, "record": {"every": 0.1}})",
                  {{"integrator.type", integrator}});
}

// One of the rods beside begins to grow at 0.3 s.
TEST(ContradictoryRowsAmongMany, AreNamed) {
  const std::string two =
      R"json("stay": {"type": "distance", "between": [{"point": [3, -500]}, "m500.point"], "length": 3},
    "growing": {"type": "distance", "between": [{"point": [3, -500]}, "m500.point"], "length": "=3+max(0,t-0.3)^3"})json";
  const std::string three =
      R"json("a": {"type": "distance", "between": [{"point": [3, -700]}, "m700.point"], "length": 3},
    "b": {"type": "distance", "between": [{"point": [3, -703]}, "m700.point"], "length": "=sqrt(18)"},
    "c": {"type": "distance", "between": [{"point": [3, -697]}, "m700.point"], "length": "=sqrt(18)+max(0,t-0.3)^3"})json";
  for (const auto& [joints, names] :
       {std::pair(two, "joints.stay, joints.growing"), {three, "joints.a, joints.b, joints.c"}})
    for (const char* integrator : {"runge_kutta_4", "generalized_alpha", "adams_baumgarte"}) {
      const Finished run = run_long_chain(joints, integrator);
      EXPECT_FALSE(run.done());
      EXPECT_NE(
          run.report.reason.find(std::string(names) + " prescribe motions that contradict each other; without any"),
          std::string::npos)
          << integrator << ": " << run.report.reason;
    }
}

TEST(ContradictoryRowsAmongMany, AreNamedFirstAndLastWhereALongLoopOfThemContradicts) {
  const Finished run = run_long_chain(
      R"json("span": {"type": "distance", "between": ["m400.point", "m440.point"], "length": "=40+max(0,t-0.3)^3"})json",
      "runge_kutta_4");
  EXPECT_FALSE(run.done());
  EXPECT_NE(run.report.reason.find("joints.rod401, joints.rod402, joints.rod403, joints.rod404, ... (33 more) ..., "
                                   "joints.rod438, joints.rod439, joints.rod440, joints.span prescribe motions"),
            std::string::npos)
      << run.report.reason;
}

TEST(ContradictoryRowsAmongMany, EndTheRunAlsoWhereALoopIsTooLongToSearch) {
  const Finished run = run_long_chain(
      R"json("span": {"type": "distance", "between": ["m20.point", "m1080.point"], "length": "=1060+max(0,t-0.3)^3"})json",
      "runge_kutta_4");
  EXPECT_FALSE(run.done());
  EXPECT_NE(run.report.reason.find("the rows ask for accelerations that no motion has; joints.span is missed most"),
            std::string::npos)
      << run.report.reason;
}

TEST(BenchmarkA05, MeetsItsReference) {
  const auto data = reference("iftomm_a05_flyball");
  const Finished run = run_benchmark("a05");
  expect_accepted(data, "s(10) m", run.end("s"));
  expect_accepted(data, "s(1) m", at(run, 1, "s"));
  expect_accepted(data, "Omega(10) rad/s", run.end("Omega"));
  const auto& s = run.series.at("s");
  expect_accepted(data, "max s m", *std::max_element(s.begin(), s.end()));
}

TEST(BenchmarkChain10, MeetsItsReference) {
  const auto data = reference("chain_pendulum_3d");
  const Finished run = run_benchmark("chain_10");
  expect_accepted(data, "n=10 tip x(1)", run.end("tip_x"));
  expect_accepted(data, "n=10 tip y(1)", run.end("tip_y"));
  expect_accepted(data, "n=10 tip z(1)", run.end("tip_z"));
}

}  // namespace
}  // namespace trammel::test
