// Forces of contacts at rest whose normals press as springs do, and which springs follow as loads grow.
#include "complementarity/shares/springs_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "feasible_point.hpp"
#include "support/between.hpp"

namespace trammel::complementarity {
namespace {

using test::between;

constexpr double carried = 1e-9;

// Empty: none hold.
SpringSet set_found(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push, const Vec& lambda) {
  const auto found = find_springs(contacts, E, push, lambda, 1e-9);
  return found ? found->set : SpringSet{};
}

// A block of 2 by 1 in a channel: floor left and right, ceiling left and right. Columns: N and T of each, rows: force
// along the channel, force across it, moment about the middle.
struct Channel {
  std::vector<SharingContact> contacts;
  Mat E = Mat::Zero(3, 8);
  explicit Channel(double mu) {
    for (int i = 0; i < 4; ++i) {
      const double x = i % 2 == 0 ? -1 : 1, y = i < 2 ? -0.5 : 0.5, up = i < 2 ? 1 : -1;
      E.col(2 * i) << 0, up, x * up;
      E.col(2 * i + 1) << 1, 0, -y;
      contacts.push_back({2 * i, {2 * i + 1}, mu, 0});
    }
  }
};

TEST(SpringsAtRest, HoldABlockInAChannelAsTheFloorAloneDoes) {
  const Channel channel(0.4);
  for (const double push : {0.0, 1.0, 3.9, 3.9999}) {
    Vec F;
    ASSERT_TRUE(forces_as_springs(channel.contacts, channel.E, Vec{{push, 10, 0}}, carried, F)) << push;
    EXPECT_NEAR((channel.E * F - Vec{{push, 10, 0}}).norm(), 0, 1e-10) << push;
    for (int i = 0; i < 4; ++i) EXPECT_LE(std::abs(F[2 * i + 1]), 0.4 * F[2 * i] + 1e-9) << push;
    EXPECT_NEAR(F[0] + F[2], 10, 1e-9) << push;  // the ceiling does not press
    EXPECT_GE(spare_load_as_springs(channel.contacts, channel.E, Vec{{push, 10, 0}}), 0) << push;
  }
  for (const double push : {4.0001, 5.0, 50.0}) {
    Vec F;
    const Vec load{{push, 10, 0}};
    ASSERT_LT(admissible_forces(channel.contacts, channel.E, load, F), 1e-9) << push;  // by a self-stress
    EXPECT_FALSE(forces_as_springs(channel.contacts, channel.E, load, carried, F)) << push;
    EXPECT_LT(spare_load_as_springs(channel.contacts, channel.E, load), 0) << push;
  }
}

// Between inclined walls normal forces follow from the friction, which holds a wedge against any pull.
TEST(SpringsAtRest, HoldAWedgeThatLocksItself) {
  const double slope = 0.2, mu = 0.5;
  Mat E(2, 4);
  E << std::cos(slope), std::sin(slope), -std::cos(slope), -std::sin(slope),  // across
      std::sin(slope), -std::cos(slope), std::sin(slope), -std::cos(slope);   // along the axis
  const std::vector<SharingContact> contacts = {{0, {1}, mu, 0}, {2, {3}, mu, 0}};
  for (const double pull : {-10.0, 0.1, 10.0}) {
    Vec F;
    EXPECT_TRUE(forces_as_springs(contacts, E, Vec{{0, -pull}}, carried, F)) << pull;
  }
}

// A box on a floor between a wall and a slide with a given load on its guide: friction of the guide holds the slide
// against what it presses, and the box is wedged in between slide, floor and wall.
struct BoxBesideASlide {
  std::vector<SharingContact> contacts;
  Mat E = Mat::Zero(4, 11);
  explicit BoxBesideASlide(double guide) {
    const double w = 0.107, h = 0.111, axis_x = 0.9972, axis_y = 0.0751;
    const double at[][5] = {
        {-w, -h, 0, 1, 0}, {w, -h, 0, 1, 0}, {w, -0.03, -1, 0, 0}, {-w, -h, 1, 0, 1}, {-w, h, 1, 0, 1}};
    for (const auto& [x, y, n_x, n_y, slides] : at) {
      const Eigen::Index N = 2 * Eigen::Index(contacts.size());
      E.col(N) << n_x, n_y, x * n_y - y * n_x, -slides * (n_x * axis_x + n_y * axis_y);
      E.col(N + 1) << -n_y, n_x, x * n_x + y * n_y, -slides * (-n_y * axis_x + n_x * axis_y);
      contacts.push_back({N, {N + 1}, n_y > 0 ? 0.5 : 0.6, 0});
    }
    E(3, 10) = 1;
    contacts.push_back({-1, {10}, guide, 10});
  }
};

TEST(SpringsAtRest, AreWedgedInAlikeWhateverTheBasisOfTheirRows) {
  const BoxBesideASlide box(0.15);
  const std::vector<SharingContact> without_guide(box.contacts.begin(), box.contacts.end() - 1);
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    const Mat any = Mat::NullaryExpr(4, 4, [&] { return between(random, -1, 1); });
    const Mat E = Eigen::HouseholderQR<Mat>(any).householderQ() * box.E;
    EXPECT_TRUE(can_be_wedged_in(box.contacts, E)) << i;
    EXPECT_FALSE(can_be_wedged_in(without_guide, E.leftCols(10))) << i;
  }
}

// Feet in a row: their normal forces are the least ones with the same resultants, whatever the friction is.
TEST(SpringsAtRest, PressWithoutBalanceAmongThemselves) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1, 1);
  int held = 0;
  for (int i = 0; i < 200; ++i) {
    const int feet = 3 + i % 4;
    Mat E(3, 2 * feet);
    std::vector<SharingContact> contacts;
    for (int k = 0; k < feet; ++k) {
      const double x = part(random);
      E.col(2 * k) << 0, 1, x;
      E.col(2 * k + 1) << 1, 0, 0;
      contacts.push_back({2 * k, {2 * k + 1}, 0.5 + 0.5 * part(random), 0});
    }
    const Vec load{{0.5 * part(random), 1, 0.5 * part(random)}};
    Vec F;
    if (!forces_as_springs(contacts, E, load, carried, F)) continue;
    ++held;
    EXPECT_NEAR((E * F - load).norm(), 0, 1e-9) << i;
    std::vector<Eigen::Index> press;
    for (int k = 0; k < feet; ++k)
      if (F[2 * k] > 1e-9) press.push_back(2 * k);
    if (press.size() < 3) continue;
    const Mat E_n = E(Eigen::seq(1, 2), press), across = E_n * E_n.transpose();  // no normal drags
    const Vec N = F(press), least = E_n.transpose() * across.inverse() * (E_n * N);
    EXPECT_NEAR((N - least).norm(), 0, 1e-8) << i;
  }
  EXPECT_GT(held, 50);
}

// How far normal forces are from those of springs that a push y displaces, N = max(0, E_n^T y); at least three press.
double off_springs(const Mat& E_n, const Vec& N) {
  std::vector<Eigen::Index> press;
  for (Eigen::Index k = 0; k < N.size(); ++k)
    if (N[k] > 1e-9 * N.maxCoeff()) press.push_back(k);
  const Mat pressing = E_n(Eigen::all, press).transpose();
  const Vec y = pressing.colPivHouseholderQr().solve(N(press));
  return (N - (E_n.transpose() * y).cwiseMax(0)).lpNorm<Eigen::Infinity>();
}

// A body in a groove, some contacts on each of its sides, which a random load pushes.
TEST(SpringsAtRest, PressInAGrooveAsTheLeastForcesBesideTheirFriction) {
  std::mt19937 random(8);
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  int held = 0, only_by_other_forces = 0;
  for (int i = 0; i < 400; ++i) {
    const int contacts = 4 + i % 3;
    Mat E(3, 2 * contacts), E_n(3, contacts);
    std::vector<SharingContact> groove;
    const double slopes[] = {any(0.3, 1.2), any(0.3, 1.2)};
    for (int k = 0; k < contacts; ++k) {
      const double side = k % 2 == 0 ? 1 : -1, slope = slopes[k % 2], along = any(0.5, 2);
      const Eigen::Vector2d at = along * Eigen::Vector2d(-side * std::cos(slope), std::sin(slope)),
                            n(side * std::sin(slope), std::cos(slope)), t(n[1], -n[0]);
      E.col(2 * k) << n, at[0] * n[1] - at[1] * n[0];
      E.col(2 * k + 1) << t, at[0] * t[1] - at[1] * t[0];
      E_n.col(k) = E.col(2 * k);
      groove.push_back({2 * k, {2 * k + 1}, any(0.05, 1.5), 0});
    }
    const Vec load{{any(-2, 2), any(-1, 2), any(-1, 1)}};
    Vec F;
    if (!forces_as_springs(groove, E, load, carried, F)) {
      only_by_other_forces += admissible_forces(groove, E, load, F) < 1e-9;
      continue;
    }
    ++held;
    const Vec N = F(Eigen::seqN(0, contacts, 2));
    if ((N.array() > 1e-9 * N.maxCoeff()).count() >= 3) {
      EXPECT_NEAR(off_springs(E_n, N), 0, 1e-8 * F.norm()) << i;
    }
    const double spare = spare_load_as_springs(groove, E, load);
    EXPECT_GE(spare, -1e-9) << i;
    const Vec other{{load[0], load[1] * (1 + 1e-12), load[2]}};
    EXPECT_NEAR(spare_load_as_springs(groove, E, other), spare, 1e-6) << i;  // it is continuous
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(only_by_other_forces, 10);
}

// A box of 2 by 1 that touches floor, ceiling and walls at random points.
struct Box {
  std::vector<SharingContact> contacts;
  Mat E;
  Box(std::mt19937& random, int count) : E(3, 2 * count) {
    for (int k = 0; k < count; ++k) {
      const int side = k < 2 ? 0 : int(between(random, 0, 4));  // floor, ceiling, left, right
      const double along = between(random, -1, 1), sign = side % 2 == 0 ? 1 : -1;
      const Eigen::Vector2d n = side < 2 ? Eigen::Vector2d(0, sign) : Eigen::Vector2d(sign, 0), t(n[1], -n[0]),
                            at = side < 2 ? Eigen::Vector2d(along, -sign / 2) : Eigen::Vector2d(-sign, along / 2);
      E.col(2 * k) << n, at[0] * n[1] - at[1] * n[0];
      E.col(2 * k + 1) << t, at[0] * t[1] - at[1] * t[0];
      contacts.push_back({2 * k, {2 * k + 1}, between(random, 0.05, 1.2), 0});
    }
  }
  // Contacts in another order.
  Box(const Box& box, const std::vector<int>& order) : E(3, box.E.cols()) {
    for (const int i : order) {
      const int k = 2 * int(contacts.size());
      contacts.push_back({k, {k + 1}, box.contacts[std::size_t(i)].coefficient, 0});
      E.middleCols(k, 2) = box.E.middleCols(2 * i, 2);
    }
  }
};

Vec random_load(std::mt19937& random) {
  return Vec{{between(random, -1.5, 1.5), 1, between(random, -1, 1)}};
}

// By linear programs for all sets of contacts that press: N = E_n^T y of these, and E_n^T y <= 0 of the others.
bool some_set_holds(const Box& box, const Vec& load) {
  const int n = int(box.contacts.size());
  for (int set = 0; set < 1 << n; ++set) {
    Mat B = Mat::Zero(3 + n, 2 * n + 6);  // columns: forces along both edges of a cone, or a slack; y and -y
    Vec d = Vec::Zero(3 + n), x;
    d.head(3) = load;
    for (int i = 0; i < n; ++i) {
      const Vec normal = box.E.col(2 * i), edge = box.contacts[std::size_t(i)].coefficient * box.E.col(2 * i + 1);
      const bool presses = set >> i & 1;
      if (presses) B.col(2 * i).head(3) = normal + edge, B.col(2 * i + 1).head(3) = normal - edge;
      B(3 + i, 2 * i) = presses ? 1 : -1;
      B(3 + i, 2 * i + 1) = presses ? 1 : 0;
      B.row(3 + i).segment(2 * n, 3) = -normal.transpose(), B.row(3 + i).tail(3) = normal.transpose();
    }
    if (feasible_point(B, d, x) < 1e-9) return true;
  }
  return false;
}

TEST(SpringsAtRest, HoldABoxWhereverSomeSetOfItsContactsDoes) {
  std::mt19937 random(3);
  int held = 0, only_by_other_forces = 0;
  for (int i = 0; i < 400; ++i) {
    const Box box(random, 4 + i % 3);
    const Vec load = random_load(random);
    Vec F;
    const bool holds = forces_as_springs(box.contacts, box.E, load, carried, F);
    EXPECT_EQ(holds, some_set_holds(box, load)) << i;
    held += holds;
    only_by_other_forces += !holds && admissible_forces(box.contacts, box.E, load, F) < 1e-9;
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(only_by_other_forces, 10);
}

TEST(SpringsAtRest, HoldABoxInEveryOrderOfItsContacts) {
  std::mt19937 random(5);
  int held = 0, let_go = 0;
  for (int i = 0; i < 200; ++i) {
    const Box box(random, 4 + i % 3);
    const Vec load = random_load(random);
    Vec F;
    const bool holds = forces_as_springs(box.contacts, box.E, load, carried, F);
    const double spare = spare_load_as_springs(box.contacts, box.E, load);
    ++(holds ? held : let_go);
    std::vector<int> order(box.contacts.size());
    std::iota(order.begin(), order.end(), 0);
    for (int again = 0; again < 3; ++again) {
      std::shuffle(order.begin(), order.end(), random);
      const Box other(box, order);
      Vec F_other;
      ASSERT_EQ(forces_as_springs(other.contacts, other.E, load, carried, F_other), holds) << i;
      EXPECT_NEAR(spare_load_as_springs(other.contacts, other.E, load), spare, 1e-8 * (1 + std::abs(spare))) << i;
      if (!holds) continue;
      for (std::size_t k = 0; k < order.size(); ++k)
        EXPECT_NEAR(F_other[Eigen::Index(2 * k)], F[2 * order[k]], 1e-7 * F.norm()) << i;
    }
  }
  EXPECT_GT(held, 50);
  EXPECT_GT(let_go, 20);
}

// The load is that of springs which a random push displaces, with a part of the friction that these allow.
TEST(SpringsAtRest, HoldManyContactsUnderALoadThatSpringsCarry) {
  std::mt19937 random(6);
  int held = 0;
  for (int i = 0; i < 200; ++i) {
    const Box box(random, 9 + i % 8);
    const Vec push{{between(random, -1, 1), between(random, 0, 1), between(random, -1, 1)}};
    Vec F = Vec::Zero(box.E.cols());
    for (const SharingContact& c : box.contacts) {
      F[c.normal] = std::max(0.0, box.E.col(c.normal).dot(push));
      F[c.tangents[0]] = between(random, -0.95, 0.95) * c.coefficient * F[c.normal];
    }
    held += forces_as_springs(box.contacts, box.E, box.E * F, carried, F);
  }
  EXPECT_EQ(held, 200);
}

// Two feet rest with coefficients 0.1 and 0.8, the third slides and is dragged by 0.1 N. Springs press by 10 N each, so
// the belt drags by 1 N and the others hold 9 N; if the second foot carried all, it would hold 24 N.
TEST(SpringsAtRest, HoldFeetBesideOneThatSlidesByTheLoadsThatSpringsHave) {
  const std::vector<SharingContact> feet = {
      {0, {1}, 0.1}, {2, {3}, 0.8}, {.normal = 4, .tangents = {}, .carries = false}};
  Mat E(3, 5);  // rows: force across, moment, force along
  E << 1, 0, 1, 0, 1, -1, 0, 0, 0, 1, 0, 1, 0, 1, 0.1;
  const Mat push{{1, 1, 1}, {-1, 0, 1}};
  for (const double held : {-8.999, 0.0, 4.0, 8.999}) {
    Vec F;
    EXPECT_GE(spare_load_as_springs(feet, E, push, Vec{{30, 0, 1 + held}}, &F), 0) << held;
    for (const int normal : {0, 2, 4}) EXPECT_NEAR(F[normal], 10, 1e-8) << held;
  }
  for (const double held : {-9.001, 9.001, 20.0})
    EXPECT_LT(spare_load_as_springs(feet, E, push, Vec{{30, 0, 1 + held}}), 0) << held;
}

// A block between floor and ceiling turns about its lower right corner where its weight no longer holds the left one
// down: the ceiling presses above that.
TEST(SpringsAtRest, PassToOthersWhereOneHasLostItsForce) {
  const Channel channel(0.4);
  std::vector<SharingContact> block = channel.contacts;
  const Mat push = channel.E(Eigen::all, {0, 2, 4, 6});
  const auto presses = Spring::presses, parts = Spring::parts;
  const std::vector<Spring> floor = {presses, presses, parts, parts}, turned = {parts, presses, presses, parts};
  for (std::size_t i = 0; i < 4; ++i) block[i].spring = floor[i];
  const auto found = [&](double moment) { return set_found(block, channel.E, push, Vec{{0, 10, moment}}); };
  EXPECT_EQ(found(9), floor);
  EXPECT_EQ(found(10 + 1e-7), turned);
  EXPECT_EQ(found(11), turned);  // the load has jumped
}

// A box on two feet, the ceiling close beside the line of one of them. Its feet slip where their friction is used up,
// although forces between floor and ceiling, which no displacement makes, would hold it.
TEST(SpringsAtRest, AreNotWedgedInByALoadThatGrowsLittleByLittle) {
  const double mu = 0.6, weight = 32.4711, end = mu * weight / (39.06853686773193 + mu * 8.899507103750704);
  Mat E(3, 6);
  E << 0, 1, 0, 1, 0, 1,  // along the floor
      1, 0, 1, 0, -1, 0,  // up
      -0.386, 0.263, 0.386, 0.263, -0.380596, -0.263;
  const Mat push = E(Eigen::all, {0, 2, 4});
  std::vector<SharingContact> box = {{0, {1}, mu, 0}, {2, {3}, mu, 0}, {4, {5}, mu, 0}};
  const std::vector<Spring> feet = {Spring::presses, Spring::presses, Spring::parts};
  const auto load = [weight](double t) {
    return Vec{{39.06853686773193 * t, weight - 8.899507103750704 * t, 2.5515561 * t}};
  };
  for (const double t : {0.5 * end, (1 + 1e-8) * end}) {
    const SpringSet any = set_found(box, E, push, load(t));
    ASSERT_FALSE(any.empty()) << t;
    EXPECT_EQ(any == feet, t < end) << t;
  }
  for (std::size_t i = 0; i < 3; ++i) box[i].spring = feet[i];
  EXPECT_EQ(set_found(box, E, push, load((1 - 1e-8) * end)), feet);
  EXPECT_TRUE(set_found(box, E, push, load((1 + 1e-8) * end)).empty());
}

// Two corners of a block, each between two contacts whose normals differ by the angle by which the blocks have turned.
// Friction is ample, so the load decides what the least loaded contact can spare.
TEST(SpringsAtRest, SpareWhatTheLeastLoadedOfNearlyCoincidentContactsHas) {
  constexpr double angle = 4.7e-8;
  std::vector<SharingContact> corners;
  Mat E = Mat::Zero(3, 8);
  for (int i = 0; i < 4; ++i) {
    E.col(2 * i) = i % 2 == 0 ? Vec{{-angle * (i == 0), 0, 1}} : Vec{{1, 0, angle * (i == 1)}};
    E(1, 2 * i + 1) = 1;
    corners.push_back({2 * i, {2 * i + 1}, 3, 0});
  }
  const Mat push = E(Eigen::all, {0, 2, 4, 6});
  std::mt19937 random(7);
  for (int i = 0; i < 400; ++i) {
    const Vec load{{between(random, 1, 5), between(random, -5, 5), between(random, 20, 30)}};
    const Vec N = push.completeOrthogonalDecomposition().solve(Vec{{load[0], 0, load[2]}});
    EXPECT_NEAR(spare_load_as_springs(corners, E, load), N.minCoeff(), 1e-6) << i;
  }
}

// Feet that rest beside feet that slide.
struct FeetBesideSlidingOnes {
  std::vector<SharingContact> contacts;
  Mat E, push;
  FeetBesideSlidingOnes(std::mt19937& random, int rest, int slide)
      : E(Mat::Zero(3, 2 * rest + slide)), push(2, rest + slide) {  // rows of E: force across, moment, force along
    for (int k = 0; k < rest + slide; ++k) {
      const bool rests = k < rest;
      const int normal = rests ? 2 * k : rest + k;
      push.col(k) << 1, between(random, -1, 1);
      E.col(normal) << push.col(k), rests ? 0 : between(random, -0.5, 0.5);
      if (rests) E(2, normal + 1) = 1;
      contacts.push_back(rests ? SharingContact{normal, {normal + 1}, between(random, 0.05, 1), 0}
                               : SharingContact{.normal = normal, .tangents = {}, .carries = false});
    }
  }
};

Vec load_of_feet(std::mt19937& random) {
  return Vec{{10, between(random, -4, 4), between(random, -8, 8)}};
}

// Rows of the normals that are round-off say nothing about what springs press.
TEST(SpringsAtRest, SpareAsMuchWhateverTheRoundOffOfTheRows) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const FeetBesideSlidingOnes feet(random, 2 + i % 2, 2 + i % 3);
    const Vec load = load_of_feet(random);
    Mat noisy = Mat::Zero(4, feet.push.cols());
    noisy.topRows(2) = feet.push;
    for (Eigen::Index k = 0; k < noisy.cols(); ++k)
      noisy.col(k).tail(2) << between(random, -1e-13, 1e-13), between(random, -1e-13, 1e-13);
    EXPECT_NEAR(spare_load_as_springs(feet.contacts, feet.E, noisy, load),
                spare_load_as_springs(feet.contacts, feet.E, feet.push, load), 1e-6)
        << i;
  }
}

}  // namespace
}  // namespace trammel::complementarity
