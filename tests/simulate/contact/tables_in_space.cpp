// Coulomb's friction in space under bodies on several feet: they share a force, slide, spin, tip and stop.
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "contacts_in_space.hpp"

namespace trammel::test {
namespace {

// A body of 2 kg on `feet` feet at 0.3 m from its axis, its centre of mass 0.2 m high.
std::string table(int feet, const std::string& law, const std::string& start) {
  std::string markers, contacts;
  for (int i = 0; i < feet; ++i) {
    const double angle = 2 * pi * i / feet + 0.2;
    markers += fmt::format(R"({}"f{}": [{:.17g}, {:.17g}, -0.2])", i ? ", " : "", i, 0.3 * std::cos(angle),
                           0.3 * std::sin(angle));
    contacts += fmt::format(
        R"({}"f{}": {{{}, "between": ["table.f{}", {{"plane": {{"point": [0, 0, 0], "normal": [0, 0, 1]}}}}],
                              "friction": {{"type": "coulomb", "static": 0.4, "kinetic": 0.3}}}})",
        i ? ", " : "", i, law, i);
  }
  return fmt::format(R"({{
    "trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
    "bodies": {{"table": {{"type": "rigid_body", "mass": 2, "inertia": [0.05, 0.06, 0.08], "position": [0, 0, {:.17g}], {},
                          "markers": {{{}}}}}}},
    "contacts": {{{}}}, "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"x": "table.com.x", "y": "table.com.y", "vx": "table.com.vx", "spin": "table.omega_z",
                "T0": "contacts.f0.friction_x", "T1": "contacts.f1.friction_x", "T2": "contacts.f2.friction_x"}}}}
  }})",
                     0.2 + sunk(law, 2 * g / feet), start, markers, contacts, accurate);
}

TEST(Table, SlidesAndStopsAsAPointDoesWithoutTurning) {
  for (const int feet : {3, 4}) {  // redundant: of 9 or 12 forces at rest 6 are independent
    const Finished run = run_text(table(feet, rigid, R"("velocity": [1.2, 0.9, 0])"));
    ASSERT_TRUE(run.done()) << run.report.reason;
    const auto stops = run.of_kind("stick");
    ASSERT_EQ(stops.size(), std::size_t(feet));
    for (const Event& stop : stops) EXPECT_NEAR(stop.t, 1.5 / (0.3 * g), 1e-10);
    EXPECT_NEAR(run.end("x"), 0.8 * 1.5 * 1.5 / (2 * 0.3 * g), 1e-10);
    EXPECT_NEAR(run.end("y"), 0.6 * 1.5 * 1.5 / (2 * 0.3 * g), 1e-10);
    EXPECT_NEAR(run.end("spin"), 0, 1e-10);
    // Sliding without turning is unstable: the last of it turns by round-off, which the ledger's Simpson rule follows
    // less well.
    EXPECT_NEAR(run.result["energy_dissipated"]["friction_total"], 0.5 * 2 * 1.5 * 1.5, 1e-7);
  }
}

TEST(Table, SpinningSlowsDownByTheFrictionAtItsFeet) {
  for (const std::string& law : {rigid, compliant}) {
    const Finished run = run_text(table(3, law, R"("angular_velocity": [0, 0, 10])"));
    ASSERT_TRUE(run.done()) << law << run.report.reason;
    ASSERT_EQ(run.of_kind("stick").size(), 3u) << law;
    const auto stops = run.of_kind("stick");
    for (const Event& stop : stops) EXPECT_NEAR(stop.t, 0.08 * 10 / (0.3 * 2 * g * 0.3), 1e-9) << law;
    EXPECT_NEAR(run.end("x"), 0, 1e-9) << law;
    EXPECT_NEAR(run.end("spin"), 0, 1e-12) << law;
  }
}

// One foot stops first, and the table turns about it until all rest. Fixed steps of another method agree.
TEST(Table, ThatSlidesAndSpinsEndsOnOneFoot) {
  const std::string start = R"("velocity": [1, 0.3, 0], "angular_velocity": [0, 0, 6])";
  const Finished run = run_text(table(3, rigid, start));
  const Finished other = run_text(table(3, rigid, start), {{"integrator", R"({"type": "runge_kutta_4", "step": 1e-4})"},
                                                           {"simulate.until", "0.55"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_TRUE(other.done()) << other.report.reason;
  const auto stops = run.of_kind("stick"), others = other.of_kind("stick");
  ASSERT_EQ(stops.size(), 3u);
  ASSERT_EQ(others.size(), 3u);
  EXPECT_GT(stops[1].t, stops[0].t + 1e-3);
  EXPECT_EQ(stops[1].t, stops[2].t);
  EXPECT_EQ(others[0].contact, stops[0].contact);
  // What fixed steps miss of a slip that turns while it ends lasts some steps.
  EXPECT_NEAR(others[0].t, stops[0].t, 1e-3);
  EXPECT_NEAR(others[2].t, stops[2].t, 1e-5);
  EXPECT_NEAR(other.end("x"), run.end("x"), 1e-7);
  EXPECT_NEAR(run.result["energy_dissipated"]["friction_total"], 0.5 * 2 * 1.09 + 0.5 * 0.08 * 36,
              3e-4);  // by Simpson's rule
  // What fixed steps miss of a slip that turns while it ends depends on where they fall: 4e-7 to 1.1e-5 J for steps of
  // 2.5e-5 to 4e-4 s.
  EXPECT_NEAR(other.result["energy_dissipated"]["friction_total"], 0.5 * 2 * 1.09 + 0.5 * 0.08 * 36, 2e-5);
}

// A growing push through its feet's plane: all let go where it is mu_0 m g, whatever share each foot had.
TEST(Table, LetsGoUnderAPushWhereTheSumOfItsFeetIsUsedUp) {
  for (const int feet : {3, 4}) {
    const Finished run = run_text(
        table(feet, rigid, R"("velocity": [0, 0, 0])"),
        {{"bodies.table.markers.low", "[0, 0, -0.2]"}, {"forces.push", R"json({"type": "load", "on": "table.low",
                                          "force": {"x": "=0.6*9.81*t", "y": "=0.8*9.81*t"}})json"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    const auto slips = run.of_kind("slip");
    ASSERT_EQ(slips.size(), std::size_t(feet));
    for (const Event& slip : slips) {
      EXPECT_NEAR(slip.t, 0.8, 1e-9) << feet;
      EXPECT_NEAR(slip.detail.at("direction_x"), 0.6, 1e-9);
      EXPECT_NEAR(slip.detail.at("direction_y"), 0.8, 1e-9);
    }
  }
}

// The sum of what holds it is determined, and each foot's share is the one of least norm: equal.
// A push tips a table that stops, by 4e-4 m/s: it is back on all its feet within 1e-4 s, which the steps cannot follow.
// Were it at rest it would stay so, whatever its rows' accelerations omega^2 r while it rocks.
TEST(Table, ThatRocksTooLittleToFollowRestsAtOnceWhenItStrikes) {
  const double feet[4][2] = {{0.235, 0.374}, {-0.235, 0.374}, {-0.235, -0.374}, {-0.0694, -0.517}};
  std::string markers, contacts;
  for (int i = 0; i < 4; ++i) {
    markers += fmt::format(R"("f{}": [{}, {}, -0.44], )", i, feet[i][0], feet[i][1]);
    contacts += fmt::format(
        R"({}"f{}": {{"type": "constraint_method", "restitution": 0,
                      "between": ["table.f{}", {{"plane": {{"point": [0, 0, 0], "normal": [0, 0, 1]}}}}],
                      "friction": {{"type": "coulomb", "static": 0.492, "kinetic": {}}}}})",
        i ? ", " : "", i, i, i ? 0.393 : 0.492);
  }
  const Finished run = run_text(fmt::format(R"({{
    "trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
    "bodies": {{"table": {{"type": "rigid_body", "mass": 7.89, "inertia": [0.877, 0.654, 0.513], "position": [0, 0, 0.44],
                "velocity": [-0.495, -0.178, 0], "angular_velocity": [0, 0, -0.715],
                "markers": {{{} "top": [-0.105, 0.201, 0.44]}}}}}},
    "contacts": {{{}}},
    "forces": {{"push": {{"type": "load", "on": "table.top", "force": {{"x": "=-73.1*t", "y": "=72.1*t"}}}}}},
    "simulate": {{"until": 0.21}}, "record": {{"every": 0.01, "observe": {{"z": "table.com.z"}}}}
  }})",
                                            markers, contacts));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_THAT(run.report.summary, testing::Not(testing::HasSubstr("not to be trusted")));
  EXPECT_EQ(run.of_kind("contact_open").size(), 2u);
  const auto strikes = run.of_kind("impact");
  ASSERT_EQ(strikes.size(), 2u);
  EXPECT_EQ(strikes[0].t, strikes[1].t);
  EXPECT_NEAR(run.end("z"), 0.44, 1e-9);
}

struct Foot {
  double x, y, mu_0, mu;
};
struct HighTable {
  double mass, height;  // of its centre of mass
  std::array<double, 3> inertia;
  std::vector<Foot> feet;
  std::array<double, 3> start;  // vx, vy, spin
  std::array<double, 4> push;   // at its top, at x, y: Fx t, Fy t
  double until;
};

Finished run(const HighTable& t) {
  std::string markers, contacts;
  for (std::size_t i = 0; i < t.feet.size(); ++i) {
    const Foot& foot = t.feet[i];
    markers += fmt::format(R"("f{}": [{}, {}, {}], )", i, foot.x, foot.y, -t.height);
    contacts += fmt::format(
        R"({}"f{}": {{"type": "constraint_method", "restitution": 0,
                      "between": ["table.f{}", {{"plane": {{"point": [0, 0, 0], "normal": [0, 0, 1]}}}}],
                      "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}})",
        i ? ", " : "", i, i, foot.mu_0, foot.mu);
  }
  return run_text(fmt::format(R"({{
    "trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
    "bodies": {{"table": {{"type": "rigid_body", "mass": {}, "inertia": [{}, {}, {}], "position": [0, 0, {}],
                "velocity": [{}, {}, 0], "angular_velocity": [0, 0, {}],
                "markers": {{{} "top": [{}, {}, {}]}}}}}},
    "contacts": {{{}}},
    "forces": {{"push": {{"type": "load", "on": "table.top", "force": {{"x": "={}*t", "y": "={}*t"}}}}}},
    "simulate": {{"until": {}}}, "record": {{"every": 0.01, "observe": {{"spin": "table.omega_z"}}}}
  }})",
                              t.mass, t.inertia[0], t.inertia[1], t.inertia[2], t.height, t.start[0], t.start[1],
                              t.start[2], markers, t.push[0], t.push[1], t.height, contacts, t.push[2], t.push[3],
                              t.until));
}

// Feet that are unloaded are idle; which ones, changes as the slip turns, within the last microseconds of it too.
TEST(Table, OfManyFeetSlidesSpinsTipsAndStopsByForcesThatContactsHave) {
  const std::vector<HighTable> tables = {
      // What its feet carry would grow beyond all bounds as its slip turns: others carry from there on.
      {4.3,
       0.42,
       {0.32, 0.55, 0.37},
       {{0.45, 0.0082, 0.54, 0.54},
        {0.18, 0.21, 0.54, 0.54},
        {-0.34, 0.15, 0.54, 0.54},
        {-0.4, -0.11, 0.54, 0.54},
        {0.096, -0.22, 0.54, 0.54}},
       {-0.32, -0.027, -2.7},
       {0, 0, 0, 0},
       0.5},
      {5.2,
       0.36,
       {0.31, 0.28, 0.14},
       {{0.25, -0.039, 0.72, 0.72}, {-0.18, 0.22, 0.72, 0.57}, {-0.18, -0.22, 0.72, 0.57}, {-0.017, -0.31, 0.72, 0.72}},
       {0, 0, 2.1},
       {0.075, 0.086, 46, 10},
       0.5},
      // It would come to rest within the time after which a later state decides which feet carry (rule 11).
      {2.1,
       0.35,
       {0.12, 0.12, 0.065},
       {{0.22, -0.029, 0.26, 0.26},
        {0.081, 0.2, 0.22, 0.22},
        {-0.2, 0.097, 0.2, 0.16},
        {-0.15, -0.15, 0.68, 0.55},
        {0.06, -0.2, 0.64, 0.51}},
       {0, 0, -1.5},
       {-0.033, 0.025, -20, -16},
       0.5},
      // One foot lets go, two are idle.
      {5.07,
       0.192,
       {0.165, 0.185, 0.225},
       {{0.262, 0.0549, 0.511, 0.511},
        {0.0783, 0.236, 0.511, 0.511},
        {-0.172, 0.189, 0.511, 0.409},
        {-0.185, -0.179, 0.511, 0.511},
        {0.121, -0.221, 0.511, 0.409}},
       {0.263, -0.807, 0},
       {-0.0655, -0.0976, 41.5, 21.2},
       1}};
  for (const HighTable& table : tables) {
    const Finished end = run(table);
    ASSERT_TRUE(end.done()) << table.mass << ": " << end.report.reason;
    EXPECT_THAT(end.report.summary, testing::Not(testing::HasSubstr("not to be trusted"))) << table.mass;
  }
}

// Much friction leaves most feet without a load, and the last microseconds before they stop turn all slips.
TEST(Table, OnARingOfFeetWithMuchFrictionIsPushedByForcesThatContactsHave) {
  for (const unsigned seed : {2u, 5u, 21u, 39u, 64u, 77u, 103u, 111u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    HighTable table{1, any(0.3, 0.6), {0.1, 0.12, 0.15}, {}, {any(0.5, 3), 0, any(-5, 5)}, {0, 0, 0, 0}, 1};
    const double mu = any(0.5, 1);
    const int feet = 4 + int(seed % 5);
    for (int i = 0; i < feet; ++i)
      table.feet.push_back({std::cos(2 * pi * i / feet), std::sin(2 * pi * i / feet), mu, mu});
    const Finished end = run(table);
    ASSERT_TRUE(end.done()) << end.report.reason;
    EXPECT_THAT(end.report.summary, testing::Not(testing::HasSubstr("not to be trusted")));
  }
}

TEST(Table, AtRestSharesTheForceThatHoldsIt) {
  const Finished run =
      run_text(table(3, rigid, R"("velocity": [0, 0, 0])"),
               {{"bodies.table.markers.low", "[0, 0, -0.2]"},
                {"forces.push", R"json({"type": "load", "on": "table.low", "force": {"x": 3, "y": 0, "z": 0}})json"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (const char* foot : {"T0", "T1", "T2"}) EXPECT_NEAR(run.end(foot), -1, 1e-10);
}

// Their friction is in no row: nothing of it is shared, and each evaluation finds the forces of least norm.
TEST(EveryStep, SharesTheForceThatHoldsATableAmongItsFeet) {
  for (const int feet : {3, 4}) {
    Overrides on_its_feet = {
        {"integrator", R"({"type": "runge_kutta_4", "step": 1e-4})"},
        {"simulate.until", "0.01"},
        {"bodies.table.markers.low", "[0, 0, -0.2]"},
        {"forces.push", R"json({"type": "load", "on": "table.low", "force": {"x": 3, "y": 0}})json"}};
    for (int i = 0; i < feet; ++i)
      on_its_feet.push_back({fmt::format("contacts.f{}.friction.method", i), "lcp_every_step"});
    const Finished run = run_text(table(feet, compliant, R"("velocity": [0, 0, 0])"), on_its_feet);
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_EQ(run.result["sizes"].back()["nc"], 0);
    EXPECT_EQ(run.of_kind("slip").size(), 0u);
    for (const char* foot : {"T0", "T1", "T2"}) EXPECT_NEAR(run.end(foot), -3.0 / feet, 1e-10) << feet;
  }
}

// A block of lengths L on feet at its lower corners, as many as `feet`, slides and spins; `load` [N] pushes it at `at`.
struct SlidingBlock {
  double mass = 1, mu = 0.5, omega = 0;
  Eigen::Vector3d L = {1, 1, 1}, inertia = {1, 1, 1}, velocity = {0, 0, 0}, load = {0, 0, 0}, at = {0, 0, 0};
  std::vector<Eigen::Vector2d> feet = {};
  double until = 0.3;
};

nlohmann::json row(const Eigen::VectorXd& x) {
  return std::vector<double>(x.begin(), x.end());
}

nlohmann::json scene(const SlidingBlock& b) {
  nlohmann::json s = {{"trammel", 1}, {"space", "spatial"}, {"gravity", {0, 0, -g}}};
  s["simulate"] = {{"until", b.until}},
  s["record"] = {{"every", b.until / 10},
                 {"observe", {{"vx", "b.com.vx"}, {"vy", "b.com.vy"}, {"wz", "b.com.omega_z"}}}};
  s["bodies"]["b"] = {{"type", "rigid_body"},
                      {"mass", b.mass},
                      {"inertia", row(b.inertia)},
                      {"position", {0, 0, b.L.z() / 2}},
                      {"velocity", row(b.velocity)},
                      {"angular_velocity", {0, 0, b.omega}},
                      {"markers", {{"load", row(b.at)}}}};
  if (!b.load.isZero())
    s["forces"]["load"] = {
        {"type", "load"}, {"on", "b.load"}, {"force", {{"x", b.load.x()}, {"y", b.load.y()}, {"z", b.load.z()}}}};
  for (std::size_t k = 0; k < b.feet.size(); ++k) {
    const std::string foot = fmt::format("f{}", k);
    s["bodies"]["b"]["markers"][foot] = {b.feet[k].x(), b.feet[k].y(), -b.L.z() / 2};
    s["contacts"][foot] = {{"type", "constraint_method"},
                           {"between", {"b." + foot, {{"plane", {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}}}}}},
                           {"friction", {{"type", "coulomb"}, {"static", b.mu}, {"kinetic", b.mu}}}};
  }
  return s;
}

void expect_trusted_and_quick(const Finished& run) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
  EXPECT_LT(run.result["counts"]["steps"], 20000);
}

// Friction couples both motions so that they end at one instant (Farkas et al., Phys. Rev. Lett. 90, 248302 (2003)),
// unless it turns about one foot in the end, or one foot is passed by the centre of its turn.
TEST(SlidingBlock, ComesToRestOnAllFeetButOneAtOnce) {
  std::mt19937 random(27);
  const auto u = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 8; ++i) {
    SlidingBlock b;
    b.mass = std::exp(u(-3, 3)), b.mu = u(0.3, 1);
    b.L = {u(0.5, 2), u(0.5, 2), 0.1};
    b.inertia =
        b.mass / 12 * Eigen::Vector3d(b.L.y() * b.L.y() + 0.01, b.L.x() * b.L.x() + 0.01, b.L.head<2>().squaredNorm());
    b.velocity = {u(-0.4, 0.4), u(-0.4, 0.4), 0}, b.omega = u(-1, 1);
    for (int k = 0; k < 3 + i % 3; ++k) {  // around the centre, so that it stands
      const double turn = 2 * pi * k / (3 + i % 3) + u(-0.2, 0.2);
      b.feet.emplace_back(0.5 * b.L.x() * std::cos(turn), 0.5 * b.L.y() * std::sin(turn));
    }
    b.until = 0.6;
    const Finished run = run_text(scene(b).dump());
    expect_trusted_and_quick(run);
    EXPECT_NEAR(run.end("vx"), 0, 1e-12) << i;
    EXPECT_NEAR(run.end("vy"), 0, 1e-12) << i;
    EXPECT_NEAR(run.end("wz"), 0, 1e-12) << i;
    const std::vector<Event> sticks = run.of_kind("stick");
    ASSERT_GE(sticks.size(), b.feet.size()) << i;
    for (std::size_t k = 1; k + 1 < b.feet.size(); ++k)
      EXPECT_NEAR(sticks[sticks.size() - 1 - k].t, sticks.back().t, 1e-7) << i;
  }
}

// Of two feet left of a block that tips the first that stops leaves the other one way to slip, across its former
// direction, and friction without a direction holds it there.
TEST(SlidingBlock, ThatTipsSticksOnBothFeetOfItsEdge) {
  SlidingBlock b{0.20913593732469815, 1, -1.740548519981664};
  b.L = {0.80959400472623296, 1.6105185531375256, 0.9606665440362001};
  b.inertia = {0.061288161646521, 0.02750699909798212, 0.05662725782580801};
  b.velocity = {-0.3515592351946222, -0.1809941925796974, 0};
  b.load = {1.6330356477886805, 0.7340888739114869, 0.21095889980133006};
  b.at = {0.1629601494821411, 0.057365069663296825, 0.3812101530875279};
  for (const double x : {1, -1})
    for (const double y : {-1, 1}) b.feet.emplace_back(x * b.L.x() / 2, y * b.L.y() / 2);
  expect_trusted_and_quick(run_text(scene(b).dump()));
}

// It tips while it slides and spins, and rocks on feet of different friction. The force of a foot that is about to
// press is round-off, which may change its sign from one step to the next: this must not be an event each time.
TEST(SlidingBlock, RocksOnFeetOfUnequalFrictionAtAnyTolerance) {
  SlidingBlock b{9.3, 0, 2.2};
  b.L.z() = 0.4;
  b.inertia = {0.496, 0.29791, 0.79391};
  b.velocity = {0.47115710605522615, -0.3714982926120447, 0};
  b.load = {-20.707198015807027, -42.639082059768306, -30.021015959516234};
  b.at = {0.182, 0.149, 0.077};
  b.feet = {{0.067, -0.178}, {0.249, -0.024}, {-0.062, -0.251}, {0.007, -0.31}, {-0.113, -0.044}, {-0.11, 0.01}};
  b.until = 0.6;
  nlohmann::json s = scene(b);
  const double mu[] = {0.5, 0.1, 0.3, 0.05, 0.7, 0.3};
  for (std::size_t k = 0; k < b.feet.size(); ++k)
    s["contacts"][fmt::format("f{}", k)]["friction"] = {{"type", "coulomb"}, {"static", mu[k]}, {"kinetic", mu[k]}};
  for (auto& component : s["forces"]["load"]["force"]) component = fmt::format("={}*t", component.get<double>());
  for (const double tolerance : {1e-7, 1e-11}) {
    s["integrator"] = {{"type", "dop853"}, {"step", {{"tolerance", tolerance}}}};
    SCOPED_TRACE(s["integrator"].dump());
    expect_trusted_and_quick(run_text(s.dump()));
  }
}

// A block that tips over an edge while it spins: the slips of its two feet turn until their forces, 1/sqrt of the time
// that is left, grow beyond all bounds. There it stops in an impact without collision, and goes on.
TEST(SlidingBlock, PassesPainlevesCriticalStateInAnImpactWithoutCollision) {
  SlidingBlock b{61.74530821382734, 3, -0.5193688397786898};
  b.L = {1.769179049572956, 0.2313661736663839, 0.37414534188668492};
  b.inertia = {0.9957204987732714, 16.82548970131838, 16.380643413029212};
  b.load = {490.88199177518476, -428.89097048287306, -22.048685835984514};
  b.at = {0.5146054630771991, -0.032164208350491254, -0.04077604586742846};
  b.feet = {{0.514615681939192, 0.017502572572224123},   {0.884589524786478, 0.11568308684333195},
            {-0.884589524786478, 0.11568308684333195},   {0.884589524786478, -0.11568308684333195},
            {-0.6837700671322304, 0.017078407774089657}, {-0.884589524786478, -0.11568308684333195}};
  const Finished run = run_text(scene(b).dump());
  expect_trusted_and_quick(run);
  const std::vector<Event> impacts = run.of_kind("impact");
  ASSERT_GE(impacts.size(), 2u);
  for (const Event& impact : {impacts[0], impacts[1]}) {
    EXPECT_NEAR(impact.t, 0.00602312745, 1e-10);
    EXPECT_NEAR(impact.detail.at("approach"), 0, 1e-12);
    EXPECT_GT(impact.detail.at("impulse"), 0.01);
    EXPECT_GT(impact.detail.at("energy_lost"), 0);
  }
}

}  // namespace
}  // namespace trammel::test
