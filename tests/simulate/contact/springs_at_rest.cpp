// Contacts at rest that share forces hold what friction under springs would hold: they do not press against each other
// to hold more. So a clearance of 0 is the limit of small ones, and bodies let go at the instants of closed forms.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include "block.hpp"
#include "complementarity/shares/admissible_forces.hpp"
#include "support/between.hpp"
#include "support/run_in_pieces.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

constexpr double g = 10;
constexpr double let_go = 1e-8;  // of the bound: friction holds up to this below it (rule 6 of contact_mode.hpp)

json scene_of(const json& body) {
  return {{"trammel", 1},
          {"space", "planar"},
          {"gravity", {0, -g}},
          {"bodies", {{"b", body}}},
          {"simulate", {{"until", 1}}},
          {"record", {{"every", 0.1}, {"observe", {{"x", "b.com.x"}, {"y", "b.com.y"}}}}}};
}

json contact(const std::string& marker, const json& point, const json& normal, double mu) {
  return {{"type", "constraint_method"},
          {"restitution", 0},
          {"between", {marker, {{"plane", {{"point", point}, {"normal", normal}}}}}},
          {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}}};
}

void expect_slips(const Finished& run, std::size_t contacts, double t, const std::string& which) {
  ASSERT_TRUE(run.done()) << which << ": " << run.report.reason;
  EXPECT_TRUE(run.result["warnings"].empty()) << which << ": " << run.result["warnings"].dump();
  const auto slips = run.of_kind("slip");
  ASSERT_EQ(slips.size(), contacts) << which;
  for (const Event& slip : slips) EXPECT_NEAR(slip.t, t, 2 * let_go * t) << which;
}

// A force that grows pushes it along the channel: it slips as on the floor alone, where the force is mu m g.
TEST(BlockInAChannel, SlipsAsOnTheFloorHoweverSmallTheClearance) {
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i) {
    const double w = between(random, 0.5, 2), h = between(random, 0.1, 0.4), m = between(random, 0.1, 10);
    const double mu = between(random, 0.1, 0.6), t = between(random, 0.2, 0.8), rate = mu * m * g / t;
    for (const double clearance : {0.0, 1e-7, 1e-4}) {
      json s = scene_of(standing_block(-w / 2, w, h, m));
      s["contacts"]["l"] = contact("b.bl", {0, 0}, {0, 1}, mu),
      s["contacts"]["r"] = contact("b.br", {0, 0}, {0, 1}, mu);
      for (const char* corner : {"tl", "tr"})
        s["contacts"][corner] = contact(fmt::format("b.{}", corner), {0, h + clearance}, {0, -1}, mu);
      s["forces"]["push"] = {
          {"type", "load"}, {"on", "b.com"}, {"force", {{"x", fmt::format("={:.17g}*t", rate)}, {"y", 0}}}};
      const std::string which = fmt::format("block {}, clearance {} m", i, clearance);
      const Finished run = run_text(s.dump());
      expect_slips(run, clearance > 0 ? 2 : 4, t, which);
      EXPECT_NEAR(run.end("x"), rate * std::pow(1 - t, 3) / (6 * m), 1e-7) << which;
    }
  }
}

// It is pressed against one of two walls, less and less, and falls where mu times this force is its weight.
TEST(BlockBetweenWalls, FallsWhereOneWallNoLongerHoldsIt) {
  std::mt19937 random(2);
  for (int i = 0; i < 10; ++i) {
    const double w = between(random, 0.1, 0.3), h = between(random, 0.5, 2), m = between(random, 0.1, 10);
    const double mu = between(random, 0.3, 0.8), t = between(random, 0.1, 0.4), most = m * g / (mu * (1 - 2 * t));
    json s = scene_of(standing_block(0, w, h, m));
    s["simulate"]["until"] = 0.5;
    s["contacts"]["l"] = contact("b.bl", {0, 0}, {1, 0}, mu), s["contacts"]["tl"] = contact("b.tl", {0, 0}, {1, 0}, mu);
    s["contacts"]["r"] = contact("b.br", {w, 0}, {-1, 0}, mu),
    s["contacts"]["tr"] = contact("b.tr", {w, 0}, {-1, 0}, mu);
    s["forces"]["press"] = {
        {"type", "load"}, {"on", "b.com"}, {"force", {{"x", fmt::format("={:.17g}*(2*t-1)", most)}, {"y", 0}}}};
    const Finished run = run_text(s.dump());
    expect_slips(run, 4, t, fmt::format("block {}", i));
    // m y'' = 2 mu most (t_slip - t)
    EXPECT_NEAR(run.end("y"), h / 2 - mu * most * std::pow(0.5 - t, 3) / (3 * m), 1e-7) << i;
  }
}

// Feet of different friction press as springs do, N_i = a + b x_i, and slip where these hold no more, although other
// forces would: those by which the foot with the most friction carries all.
TEST(TableOfUnequalFeet, SlipsWhereSpringsHoldItNoMore) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const int feet = 3 + i % 4;
    const double m = between(random, 0.5, 5), t = between(random, 0.2, 0.8);
    json s = scene_of(standing_block(-1, 2, 0.5, m));
    s["bodies"]["b"]["position"] = {0, 0};  // as low as its feet: what accelerates it does not tip it
    Eigen::VectorXd x(feet), mu(feet);
    for (int k = 0; k < feet; ++k) {
      x[k] = -1 + 2.0 * k / (feet - 1) + between(random, -0.1, 0.1), mu[k] = between(random, 0.1, 0.9);
      const std::string foot = fmt::format("f{}", k);
      s["bodies"]["b"]["markers"][foot] = {x[k], 0};
      s["contacts"][foot] = contact("b." + foot, {0, 0}, {0, 1}, mu[k]);
    }
    Eigen::MatrixXd E(2, feet);
    E << Eigen::RowVectorXd::Ones(feet), x.transpose();
    const Eigen::VectorXd N = E.transpose() * (E * E.transpose()).inverse() * Eigen::Vector2d(m * g, 0);
    const double rate = mu.dot(N) / t;
    s["forces"]["drag"] = {
        {"type", "load"}, {"on", "b.com"}, {"force", {{"x", fmt::format("={:.17g}*t", rate)}, {"y", 0}}}};
    const Finished run = run_text(s.dump());
    expect_slips(run, std::size_t(feet), t, fmt::format("table {}", i));
    EXPECT_NEAR(run.end("x"), rate * std::pow(1 - t, 3) / (6 * m), 1e-7) << i;
  }
}

// A box on three feet is pulled away from a wall. Linear programs for all sets of contacts that press as springs give
// the instant; other forces would hold the box until 0.1455.
TEST(BoxBesideAWall, SlipsAtTheSameInstantWhateverTheNamesOfItsContacts) {
  struct At {
    double x, y, mu;
  };
  const At feet[] = {{-0.354, -0.3565, 0.25}, {0.354, -0.3565, 0.25}, {-0.252756, -0.3565, 0.4}};
  const At wall[] = {{-0.354, -0.247411, 0.35}, {-0.354, 0.273079, 0.15}};
  std::vector<std::string> names = {"p", "q", "r", "s", "t"};
  do {
    json s = scene_of(standing_block(-0.354, 0.708, 0.713, 1.44));
    s["gravity"] = {0, -9.81};
    s["simulate"]["until"] = 0.2;
    s["bodies"]["b"]["markers"]["pulled"] = {0.209568, 0.339388};
    auto name = names.begin();
    const auto touch = [&](const At& at, const json& point, const json& normal) {
      s["bodies"]["b"]["markers"][*name] = {at.x, at.y};
      s["contacts"][*name] = contact("b." + *name, point, normal, at.mu);
      ++name;
    };
    for (const At& at : feet) touch(at, {0, 0}, {0, 1});
    for (const At& at : wall) touch(at, {-0.354, 0}, {1, 0});
    s["forces"]["pull"] = {{"type", "load"}, {"on", "b.pulled"}, {"force", {{"x", "=27.9561456*t"}, {"y", 0}}}};
    const Finished run = run_text(s.dump());
    const std::string which = fmt::format("{}", fmt::join(names, ""));
    ASSERT_TRUE(run.done()) << which << ": " << run.report.reason;
    const auto slips = run.of_kind("slip");
    ASSERT_FALSE(slips.empty()) << which;
    EXPECT_NEAR(slips.front().t, 0.13955096, 1e-8) << which;
  } while (std::next_permutation(names.begin(), names.begin() + 3) ||
           std::next_permutation(names.begin() + 3, names.end()));
}

// The ceiling touches it between its feet, but nothing moves it there: it slips where the feet alone hold it no more,
// m x'' = P t - mu (m g - Q t), although it could be wedged in.
TEST(BoxBelowACeiling, SlipsWhereItsFeetHoldItNoMore) {
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    const double w = between(random, 0.3, 0.9), h = between(random, 0.2, 0.8), m = between(random, 1, 8);
    const double mu = between(random, 0.3, 1), t = between(random, 0.2, 0.8), Q = between(random, -0.3, 0.3) * m * g;
    const double P = mu * (m * g / t - Q), x = between(random, -0.5, 0.5) * w;
    const double y = between(random, -0.5, 0.5) * h;
    const double turns = (x * Q - (y + h / 2) * P) * t;          // about the middle of the floor
    if (std::abs(turns) > 0.45 * w * (m * g - Q * t)) continue;  // it would tip
    json s = scene_of(standing_block(-w / 2, w, h, m));
    s["bodies"]["b"]["markers"]["pulled"] = {x, y};
    s["bodies"]["b"]["markers"]["top"] = {between(random, -0.49, 0.49) * w, h / 2};
    for (const char* foot : {"bl", "br"}) s["contacts"][foot] = contact(fmt::format("b.{}", foot), {0, 0}, {0, 1}, mu);
    s["contacts"]["top"] = contact("b.top", {0, h}, {0, -1}, mu);
    s["forces"]["pull"] = {{"type", "load"},
                           {"on", "b.pulled"},
                           {"force", {{"x", fmt::format("={:.17g}*t", P)}, {"y", fmt::format("={:.17g}*t", Q)}}}};
    s["simulate"]["until"] = 1.1 * t;
    const Finished run = run_text(s.dump());
    expect_slips(run, 3, t, fmt::format("box {}", i));
    EXPECT_NEAR(run.end("x"), (P + mu * Q) * std::pow(0.1 * t, 3) / (6 * m), 1e-7) << i;
  }
}

// Two of its springs pass from one set to another before it slips. Checkpoints keep which of them press. The instant is
// that of linear programs for the sets that are reached one from another.
TEST(BoxBelowACeiling, IsResumedToTheSameBytesWhileItsSpringsChange) {
  json s = scene_of(standing_block(-0.332, 0.664, 0.793, 4.46));
  s["gravity"] = {0, -9.81};
  json& markers = s["bodies"]["b"]["markers"];
  markers["f2"] = {-0.07636, -0.3965}, markers["f3"] = {0.189904, -0.3965}, markers["top"] = {-0.283528, 0.3965};
  markers["pulled"] = {0.17928, 0.022204};
  for (const char* foot : {"bl", "br", "f2", "f3"})
    s["contacts"][foot] = contact(fmt::format("b.{}", foot), {0, 0}, {0, 1}, 0.6);
  s["contacts"]["top"] = contact("b.top", {0, 0.793}, {0, -1}, 0.6);
  s["forces"]["pull"] = {{"type", "load"}, {"on", "b.pulled"}, {"force", {{"x", "=41.127444*t"}, {"y", 0}}}};
  const Finished run = run_text(s.dump());
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("slip").size(), 5u);
  EXPECT_NEAR(run.of_kind("slip").front().t, 0.7075787888, 1e-7);  // a part of 1e-9 of the forces may be missing
  const scene::Scene scene = scene::Scene::parse(s.dump(), "test.json", {});
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 1);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
}

// Of its springs only one presses at an instant before, which carries the load there and nowhere else. Linear programs
// for all sets give the instant at which it moves.
TEST(BodyBetweenPlanes, MovesWhereItsSpringsHoldItNoMore) {
  struct At {
    Eigen::Vector2d point, normal;
  };
  const At touched[] = {{{0.215, -0.136}, {0.570814378645, -0.821079134513}},
                        {{0.049, 0.254}, {0, 1}},
                        {{-0.451, -0.096}, {0, 1}},
                        {{-0.142, 0.273}, {0, 1}},
                        {{0.444, -0.088}, {-0.529030049287, -0.848603091529}}};
  json body = {{"type", "rigid_body"}, {"mass", 2.4}, {"inertia", 0.24}, {"markers", {{"pulled", {-0.109, -0.295}}}}};
  json s = scene_of(body);
  s["gravity"] = {0, -9.81};
  for (int i = 0; i < 5; ++i) {
    const auto& [point, normal] = touched[i];
    const std::string name = fmt::format("p{}", i);
    s["bodies"]["b"]["markers"][name] = {point.x(), point.y()};
    s["contacts"][name] = contact("b." + name, {point.x(), point.y()}, {normal.x(), normal.y()}, 0.2);
  }
  s["forces"]["pull"] = {{"type", "load"},
                         {"on", "b.pulled"},
                         {"force", {{"x", "=-26.559320769987973*t"}, {"y", "=33.656353265472205*t"}}}};
  const Finished run = run_text(s.dump());
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
  ASSERT_FALSE(run.of_kind("contact_open").empty());
  EXPECT_NEAR(run.of_kind("contact_open").front().t, 0.175282, 1e-6);
}

// Friction holds it beyond the floor's, since it would turn against the ceiling; no step is short.
TEST(BlockInAChannel, RestsWhereItWouldJam) {
  json s = scene_of(standing_block(-0.399, 0.798, 0.685, 7));
  s["gravity"] = {0, -9.81};
  s["bodies"]["b"]["markers"]["pulled"] = {-0.399, -0.048635};
  s["bodies"]["b"]["markers"]["c0"] = {-0.308028, 0.3425}, s["bodies"]["b"]["markers"]["c1"] = {0.294462, 0.3425};
  for (const char* foot : {"bl", "br"}) s["contacts"][foot] = contact(fmt::format("b.{}", foot), {0, 0}, {0, 1}, 2);
  for (const char* top : {"c0", "c1"}) s["contacts"][top] = contact(fmt::format("b.{}", top), {0, 0.685}, {0, -1}, 2);
  s["forces"]["pull"] = {{"type", "load"}, {"on", "b.pulled"}, {"force", {{"x", "=-138.98808*t"}, {"y", 0}}}};
  const Finished run = run_text(s.dump());
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.of_kind("slip").empty());
  EXPECT_LT(run.result["counts"]["steps"], 100);
}

// Ten feet of a table, whose normal forces do not depend on their friction: N_i = a + b x_i + c y_i balances the load,
// and the table slips where no friction |T_i| <= mu N_i has its resultants any more.
TEST(TableOfTenFeet, SlipsWhereFrictionUnderItsSpringsEnds) {
  const double m = 8.1, height = 0.5, mu = 0.2;
  const Eigen::Vector3d pulled(0.008, 0.453, 0.375), rate(-131.61084830575868, -20.55015454834551, 48.49460311458865);
  std::vector<Eigen::Vector2d> feet = {{0, -0.77}};
  for (const double x : {-0.31, 0.0, 0.31})
    for (const double y : {-0.77 / 3, 0.77 / 3}) feet.push_back({x, y});
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0.31, -0.77), {-0.31, 0.77}, {0.31, 0.77}})
    feet.push_back(corner);
  const auto count = Eigen::Index(feet.size());
  json s = {{"trammel", 1}, {"space", "spatial"}, {"gravity", {0, 0, -g}}, {"simulate", {{"until", 0.09}}}};
  s["record"]["every"] = 0.03;
  json markers = {{"p", {pulled.x(), pulled.y(), pulled.z() - height}}};
  Eigen::MatrixXd E_n(3, count), E_t(3, 2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [x, y] = std::pair(feet[std::size_t(i)][0], feet[std::size_t(i)][1]);
    const std::string foot = fmt::format("f{}", i);
    markers[foot] = {x, y, -height};
    s["contacts"][foot] = contact("t." + foot, {0, 0, 0}, {0, 0, 1}, mu);
    E_n.col(i) << 1, x, y;
    E_t.middleCols(2 * i, 2) << 1, 0, 0, 1, -y, x;
  }
  s["bodies"]["t"] = {{"type", "rigid_body"},
                      {"mass", m},
                      {"inertia", {1.6, 0.26, 1.86}},
                      {"position", {0, 0, height}},
                      {"markers", markers}};
  s["record"]["observe"] = {{"x", "t.com.x"}};
  const auto law = [](double by) { return fmt::format("={:.17g}*t", by); };
  s["forces"]["pull"] = {
      {"type", "load"}, {"on", "t.p"}, {"force", {{"x", law(rate.x())}, {"y", law(rate.y())}, {"z", law(rate.z())}}}};
  const auto holds = [&](double t) {
    const Eigen::Vector3d P = t * rate;
    const Eigen::Vector3d M = pulled.cross(P), up(m * g - P.z(), M.y(), -M.x());  // M: about the middle of the floor
    const Eigen::VectorXd N = E_n.transpose() * (E_n * E_n.transpose()).inverse() * up;
    std::vector<complementarity::SharingContact> given;
    for (int i = 0; i < int(count); ++i) given.push_back({-1, {2 * i, 2 * i + 1}, mu, N[i]});
    Eigen::VectorXd T;
    const Eigen::VectorXd wanted = Eigen::Vector3d(-P.x(), -P.y(), -M.z());
    return complementarity::admissible_forces(given, E_t, wanted, T) < 1e-9 * wanted.norm();
  };
  double held = 0, slips = 0.09;
  while (slips - held > 1e-12) (holds((held + slips) / 2) ? held : slips) = (held + slips) / 2;
  const Finished run = run_text(s.dump());
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto events = run.of_kind("slip");
  ASSERT_FALSE(events.empty());
  EXPECT_NEAR(events.front().t, held, 2 * let_go * held);
}

// A box between floor and ceiling that turns a little, slips against its friction and is wedged in. Its loads turn
// back:
// other forces would hold it, but stiff springs do not come to have them.
TEST(BoxBetweenFloorAndCeiling, LetsGoAsOnStiffSpringsWhereItsLoadsTurnBack) {
  const double w = 0.28118530919, h = 0.75412142073, mu_floor = 0.8, mu_ceiling = 0.5;
  json s = scene_of(
      {{"type", "rigid_body"},
       {"mass", 2.59537},
       {"inertia", 0.560397},
       {"position", {0, 0}},
       {"markers",
        {{"p0", {-w, -h}}, {"p1", {w, -h}}, {"p2", {-w, h}}, {"p3", {w, h}}, {"hand", {-0.231589, -0.607856}}}}});
  s["gravity"] = {0, -9.81};
  s["simulate"]["until"] = 0.83;
  s["record"]["every"] = 0.02;
  s["forces"]["hand"] = {
      {"type", "load"},
      {"on", "b.hand"},
      {"force",
       {{"x", "=-12.6011*sin(6.463*t)+21.1819*sin(16.288*t)"}, {"y", "=2.24326*min(1,3*t)-48.9577*sin(4.4901*t)"}}}};
  for (const auto& [name, y] : {std::pair{"p0", -h}, {"p1", -h}, {"p2", h}, {"p3", h}})
    s["contacts"][name] =
        contact(fmt::format("b.{}", name), {0, y}, {0, y < 0 ? 1 : -1}, y < 0 ? mu_floor : mu_ceiling);
  const scene::Scene scene = scene::Scene::parse(s.dump(), "test.json", {});
  const Finished rigid = run_text(s.dump());
  ASSERT_TRUE(rigid.done()) << rigid.report.reason;
  EXPECT_TRUE(rigid.result["warnings"].empty()) << rigid.result["warnings"].dump();
  for (auto& [name, c] : s["contacts"].items()) {
    c.erase("restitution");
    c.update({{"type", "continuous_force"},
              {"stiffness", 1e7},
              {"exponent", 1},
              {"damping", "hunt_crossley"},
              {"restitution", 0}});
  }
  const Finished stiff = run_text(s.dump());
  ASSERT_TRUE(stiff.done()) << stiff.report.reason;
  // About a hundred newtons on springs of 1e7 N/m, at either end of a box that is three times as high as wide.
  EXPECT_NEAR(rigid.end("x"), stiff.end("x"), 3e-5);
  EXPECT_GT(rigid.end("x"), 6e-3);
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 1);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
}

// A moment presses opposite ends of a box against floor and ceiling while it slides, N_floor + N_ceiling = S, N_floor -
// N_ceiling = W. It comes to rest, the moment ends, and friction holds the box as wedged in as it was: with friction
// -F/2 -+ a S/(2 b) at the ends, that of the floor is at its bound where the box is pushed by F = mu (S + W) - a S/b.
TEST(BoxBetweenFloorAndCeiling, StaysWedgedInAsItWasWhereItsSlipEnds) {
  std::mt19937 random(7);
  for (int i = 0; i < 8; ++i) {
    const double mu = between(random, 0.5, 0.9), b = between(random, 0.5, 1), a = b * mu * between(random, 0.3, 0.7);
    const double m = between(random, 0.5, 3), W = m * g, S = between(random, 2.5, 6) * W;
    const double moment = a * S - mu * b * W, lets_go = mu * (S + W) - a * S / b;
    json s = scene_of({{"type", "rigid_body"},
                       {"mass", m},
                       {"inertia", m * (a * a + b * b) / 3},
                       {"position", {0, 0}},
                       {"velocity", {mu * S / m * between(random, 0.15, 0.3), 0}},
                       {"markers", {{"bl", {-a, -b}}, {"br", {a, -b}}, {"tl", {-a, b}}, {"tr", {a, b}}}}});
    for (const char* corner : {"bl", "br", "tl", "tr"}) {
      const double y = corner[0] == 'b' ? -b : b;
      s["contacts"][corner] = contact(fmt::format("b.{}", corner), {0, y}, {0, y < 0 ? 1 : -1}, mu);
    }
    const double pulled = between(random, 0, 0.3) * mu * S;  // while it slides
    const std::string push =
        fmt::format("={:.17g}*max(0,t-0.8)+{:.17g}*max(0,min(1,(0.6-t)*5))", lets_go / 0.5, pulled);
    s["forces"]["hand"] = {{"type", "load"},
                           {"on", "b.com"},
                           {"force", {{"x", push}, {"y", 0}}},
                           {"moment", fmt::format("={:.17g}*max(0,min(1,(0.75-t)*4))", -moment)}};
    s["simulate"]["until"] = 1.31;
    s["record"] = {{"every", 0.02}, {"observe", {{"N_br", "contacts.br.force"}, {"N_tl", "contacts.tl.force"}}}};
    const std::string which = fmt::format("box {}", i);
    const Finished run = run_text(s.dump());
    ASSERT_TRUE(run.done()) << which << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << which << ": " << run.result["warnings"].dump();
    const auto slips = run.of_kind("slip");  // at the start, and where it lets go
    ASSERT_FALSE(slips.empty()) << which;
    EXPECT_NEAR(slips.back().t, 1.3, 1e-6) << which;
    const auto sticks = run.of_kind("stick");
    ASSERT_EQ(sticks.size(), 4) << which;
    EXPECT_LT(sticks.back().t, 0.6) << which;
    const auto later = [&](const Event& e) { return e.t > sticks.back().t && e.t < 1.3 - 1e-6; };
    EXPECT_TRUE(std::none_of(slips.begin(), slips.end(), later)) << which;
    for (std::size_t k = 0; k < run.series.at("t").size(); ++k) {
      if (const double t = run.series.at("t")[k]; t < sticks.back().t || t > 1.3 - 1e-6) continue;
      EXPECT_NEAR(run.series.at("N_br")[k], (S + W) / 2, 1e-6 * S) << which << ", " << run.series.at("t")[k] << " s";
      EXPECT_NEAR(run.series.at("N_tl")[k], (S - W) / 2, 1e-6 * S) << which << ", " << run.series.at("t")[k] << " s";
    }
    if (i > 0) continue;
    const scene::Scene scene = scene::Scene::parse(s.dump(), "test.json", {});
    const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 1);
    EXPECT_EQ(whole.series, pieces.series);
    EXPECT_EQ(whole.events, pieces.events);
  }
}

// On a belt that brakes and stands again, at instants of records. While it brakes, friction makes the box press the
// ceiling, too. Then a hand pushes it back, and it presses with the other ends, N_floor - N_ceiling = W: both are at
// their bounds where a (N_floor + N_ceiling) = mu b W.
TEST(BoxBetweenFloorAndCeiling, LetsGoAtItsBoundAfterItsLoadsHaveJumpedAtARecord) {
  std::mt19937 random(12);
  for (int i = 0; i < 8; ++i) {
    const double mu = between(random, 0.5, 0.8), b = between(random, 0.3, 1), a = mu * b * between(random, 0.55, 0.8);
    const double m = between(random, 0.5, 3), W = m * g, braked = between(random, 0.6, 0.8) * mu * g;
    const double lets_go = mu * mu * W * b / a, last = 0.14, speed = braked * last;
    json s = scene_of({{"type", "rigid_body"},
                       {"mass", m},
                       {"inertia", m * (a * a + b * b) / 3},
                       {"position", {0, 0}},
                       {"velocity", {speed, 0}},
                       {"markers", {{"bl", {-a, -b}}, {"br", {a, -b}}, {"tl", {-a, b}}, {"tr", {a, b}}}}});
    const std::string while_braked = fmt::format("min(max(0,t-0.2),{:.17g})", last);
    s["bodies"]["belt"] = {
        {"type", "moving_base"},
        {"x", fmt::format("={0:.17g}*(min(t,0.2)+{1}-{1}^2/{2:.17g})", speed, while_braked, 2 * last)},
        {"markers", {{"at", {0, 0}}}}};
    for (const char* corner : {"bl", "br", "tl", "tr"}) {
      const double y = corner[0] == 'b' ? -b : b;
      s["contacts"][corner] = contact(fmt::format("b.{}", corner), {0, y}, {0, y < 0 ? 1 : -1}, mu);
      s["contacts"][corner]["between"][1]["plane"]["on"] = "belt.at";
    }
    const double moment = between(random, 0.2, 0.5) * a * W;
    s["forces"]["hand"] = {{"type", "load"},
                           {"on", "b.com"},
                           {"force", {{"x", fmt::format("={:.17g}*max(0,t-0.9)", -lets_go / 0.3)}, {"y", 0}}},
                           {"moment", fmt::format("={:.17g}*max(0,min(1,(0.85-t)*4))", -moment)}};
    s["simulate"]["until"] = 1.3;
    for (const double every : {0.005, 0.0033}) {
      s["record"]["every"] = every;
      const std::string which = fmt::format("box {}, records every {} s", i, every);
      const Finished run = run_text(s.dump());
      ASSERT_TRUE(run.done()) << which << ": " << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << which << ": " << run.result["warnings"].dump();
      const auto slips = run.of_kind("slip");
      ASSERT_FALSE(slips.empty()) << which;
      EXPECT_NEAR(slips.front().t, 1.2, 1e-6) << which;
    }
  }
}

// Wedged in by a moment and then pushed back, it presses with the other ends, as on the belt. One of them slips on its
// springs before both do: what following leaves of the conditions must not add up there.
TEST(BoxBetweenFloorAndCeiling, LetsGoAtItsBoundInWhateverOrderItsContactsAre) {
  const double a = 0.28836759490330627, b = 0.6375313954222492, mu = 0.7833132703881849, m = 0.9813295818313434;
  const double lets_go = 0.9 + mu * mu * m * 9.81 * b / a / 132.40088853645878;  // [s]
  json s = scene_of({{"type", "rigid_body"},
                     {"mass", m},
                     {"inertia", m * (a * a + b * b) / 3},
                     {"position", {0, 0}},
                     {"velocity", {7.90141513680031, 0}},
                     {"markers", {{"bl", {-a, -b}}, {"br", {a, -b}}, {"tl", {-a, b}}, {"tr", {a, b}}}}});
  s["gravity"] = {0, -9.81};
  const std::string push = "=-132.40088853645878*max(0,t-.9)+2.9454020453250056*max(0,min(1,(.45-t)*5))";
  const std::string turn =
      "=-11.163271364297433*(min(1,max(0,(.75-t)*4))*min(1,t*20)-.0975755*max(0,1-abs(t-.72)/.06))";
  s["forces"]["hand"] = {{"type", "load"}, {"on", "b.com"}, {"force", {{"x", push}, {"y", 0}}}, {"moment", turn}};
  s["simulate"]["until"] = 1.2, s["record"] = {{"every", 0.01}, {"observe", {{"x", "b.com.x"}}}};
  std::vector<std::string> corners = {"bl", "br", "tl", "tr"};
  do {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const double y = corners[k][0] == 'b' ? -b : b;
      s["contacts"][fmt::format("c{}", k)] = contact("b." + corners[k], {0, y}, {0, y < 0 ? 1 : -1}, mu);
    }
    const Finished run = run_text(s.dump());
    ASSERT_TRUE(run.done() && !run.of_kind("slip").empty()) << run.report.reason;
    EXPECT_NEAR(run.of_kind("slip").back().t, lets_go, 1e-6) << corners[0] << corners[1];
  } while (std::next_permutation(corners.begin(), corners.end()));
}

// Springs of a box that is wedged in move while a push grows. Within a step they are those of its begin.
TEST(BoxBetweenFloorAndCeiling, HasForcesInsideStepsThatGrowAsItsLoadsDo) {
  const double a = 0.2, b = 0.5, mu = 0.6, m = 1;
  json s =
      scene_of({{"type", "rigid_body"},
                {"mass", m},
                {"inertia", m * (a * a + b * b) / 3},
                {"position", {0, 0}},
                {"markers", {{"bl", {-a, -b}}, {"br", {a, -b}}, {"tl", {-a, b}}, {"tr", {a, b}}, {"w", {a, 0.1}}}}});
  for (const char* corner : {"bl", "br", "tl", "tr"}) {
    const double y = corner[0] == 'b' ? -b : b;
    s["contacts"][corner] = contact(fmt::format("b.{}", corner), {0, y}, {0, y < 0 ? 1 : -1}, mu);
  }
  s["contacts"]["w"] = contact("b.w", {a, 0}, {-1, 0}, 0.3);
  s["forces"]["hand"] = {
      {"type", "load"}, {"on", "b.com"}, {"force", {{"x", "=120*t"}, {"y", 0}}}, {"moment", "=-4*min(1,3*t)"}};
  s["record"] = {{"every", 0.005},
                 {"observe", {{"bl", "contacts.bl.force"}, {"br", "contacts.br.force"}, {"w", "contacts.w.force"}}}};
  const Finished run = run_text(s.dump());
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double grows = (120 + 12 / a) * 0.005;  // [N] between records, at most
  for (const char* name : {"bl", "br", "w"}) {
    const auto& N = run.series.at(name);
    for (std::size_t i = 1; i < N.size(); ++i)
      EXPECT_LE(std::abs(N[i] - N[i - 1]), grows) << name << ", " << run.series.at("t")[i] << " s";
  }
  EXPECT_GT(run.series.at("w").back(), 50);
}

}  // namespace
}  // namespace trammel::test
