// Contacts that can be wedged in follow their loads as stiff springs do.
#include "complementarity/spring_motion.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/between.hpp"

namespace trammel::complementarity {
namespace {

using test::between;

// A box of 2 by 2 a between floor and ceiling that touch its corners. Columns: N and T of floor left and right, ceiling
// left and right; rows: force along the floor, force up, moment about the middle.
struct Box {
  std::vector<SharingContact> contacts;
  Mat E = Mat::Zero(3, 8);
  Box(double a, double mu_floor, double mu_ceiling) {
    for (int i = 0; i < 4; ++i) {
      const double x = i % 2 == 0 ? -1 : 1, y = i < 2 ? -a : a, up = i < 2 ? 1 : -1;
      E.col(2 * i) << 0, up, x * up;
      E.col(2 * i + 1) << 1, 0, -y;
      contacts.push_back({2 * i, {2 * i + 1}, i < 2 ? mu_floor : mu_ceiling});
      contacts.back().push = i < 2 ? 5 : 0;
    }
  }
  void take(const SpringMotion& motion) {
    for (std::size_t i = 0; i < 4; ++i) contacts[i].push = motion.push[i];
  }
};

// Up to a part of the forces: what the rounds leave.
constexpr double accurate = 1e-7;

TEST(SpringMotion, GivesForcesOfSpringsInBalanceAndInTheirCones) {
  std::mt19937 random(1);
  int steps = 0, pressed_by_both = 0;
  for (int i = 0; i < 100; ++i) {
    Box box(between(random, 0.3, 1), between(random, 0.2, 0.8), between(random, 0.2, 0.8));
    const Vec first{{0, 10, 0}}, swing{{between(random, -6, 6), between(random, -4, 0), between(random, -12, 12)}};
    for (double t = 0.05; t < 6; t += 0.05, ++steps) {
      const Vec lambda = first + std::sin(t) * swing;
      const auto motion = follow_loads(box.contacts, box.E, lambda);
      if (!motion || !motion->carries(lambda)) break;  // it has let go
      EXPECT_LE((box.E * motion->F - lambda).norm(), accurate * lambda.norm());
      for (std::size_t k = 0; k < 4; ++k) {
        const double N = motion->F[Eigen::Index(2 * k)], T = motion->F[Eigen::Index(2 * k + 1)];
        EXPECT_NEAR(N, std::max(0.0, *motion->push[k]), accurate * 20);
        EXPECT_LE(std::abs(T), box.contacts[k].coefficient * N + accurate * 20);
      }
      pressed_by_both += *motion->push[0] + *motion->push[1] > 0.1 && *motion->push[2] + *motion->push[3] > 0.1;
      box.take(*motion);
    }
  }
  EXPECT_GT(steps, 1000);
  EXPECT_GT(pressed_by_both, 100);
}

// Its ends press on opposite sides once a moment exceeds that of its weight; friction then holds what springs gave, and
// a load that turns back finds the box wedged in: the way back is not the way there.
TEST(SpringMotion, DependsOnTheWayOfTheLoads) {
  Box box(0.5, 0.6, 0.6);
  const auto follow = [&box](double moment) {
    const auto motion = follow_loads(box.contacts, box.E, Vec{{0, 10, moment}});
    ASSERT_TRUE(motion);
    ASSERT_LE(motion->missed, accurate * 10);
    box.take(*motion);
  };
  for (double moment = 1; moment <= 20; moment += 1) follow(moment);
  const double pressed_by = *box.contacts[2].push;
  for (double moment = 19; moment >= 12; moment -= 1) follow(moment);
  Box straight(0.5, 0.6, 0.6);
  const auto there = follow_loads(straight.contacts, straight.E, Vec{{0, 10, 12}});
  ASSERT_TRUE(there);
  EXPECT_GT(pressed_by, 1);
  EXPECT_GT(*box.contacts[2].push, *there->push[2] + 0.1);
}

// It is pushed along the floor, from where no spring pulls it back.
TEST(SpringMotion, EndsWhereFrictionIsUsedUp) {
  const Box box(0.5, 0.4, 0.4);
  const auto carries = [&box](double push) {
    const Vec lambda{{push, 10, 0.5 * push}};  // at the floor's height
    const auto motion = follow_loads(box.contacts, box.E, lambda);
    return motion && motion->carries(lambda);
  };
  EXPECT_TRUE(carries(4 * (1 - 1e-6)));
  EXPECT_FALSE(carries(4 * (1 + 1e-6)));
}

TEST(SpringMotion, SaysNothingOfSpringsThatAreNotKnown) {
  Box box(0.5, 0.4, 0.4);
  box.contacts[1].push.reset();
  EXPECT_FALSE(follow_loads(box.contacts, box.E, Vec{{0, 10, 0}}));
}

TEST(SpringMotion, IsNoneOfContactsWhoseNormalForcesAreGiven) {
  const std::vector<SharingContact> compliant = {{-1, {0}, 0.5, 10}, {-1, {1}, 0.5, 10}};
  EXPECT_FALSE(follow_loads(compliant, Mat::Ones(1, 2), Vec{{4}}));
}

// A strut from the floor's right to the ceiling's left corner: the other springs are slack by as much.
TEST(PushesOf, AreTheForcesWithTheSlacksThatTheyLeave) {
  const Box box(0.9, 0.6, 0.6);
  const auto push = pushes_of(box.contacts, box.E, Vec{{0, 12, 7, 0}});
  for (const auto& each : push) ASSERT_TRUE(each);
  EXPECT_NEAR(*push[0], -7, accurate * 12);
  EXPECT_NEAR(*push[1], 12, accurate * 12);
  EXPECT_NEAR(*push[2], 7, accurate * 12);
  EXPECT_NEAR(*push[3], -12, accurate * 12);
}

TEST(PushesOf, AreNotKnownWhereNothingCanBeWedgedIn) {
  Box box(0.5, 0.6, 0.6);
  box.contacts.resize(2);  // the floor alone
  const Mat E = box.E.leftCols(4);
  for (const auto& each : pushes_of(box.contacts, E, Vec{{5, 5}})) EXPECT_FALSE(each);
}

// Its ends could also slip until nothing presses but the weight. Springs that friction holds do not move.
TEST(SpringMotion, IsNoneWhereFrictionHoldsTheForcesThatSpringsHave) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    Box box(between(random, 1.5, 3), 0.8, 0.8);
    const double N_ceiling = between(random, 5, 20), N_floor = N_ceiling + 1;
    const auto push = pushes_of(box.contacts, box.E, Vec{{0, N_floor, N_ceiling, 0}});
    for (std::size_t k = 0; k < 4; ++k) box.contacts[k].push = push[k];
    const double T_floor = between(random, -0.7, 0.7) * N_floor, T_ceiling = between(random, -0.7, 0.7) * N_ceiling;
    const Vec lambda = box.E * Vec{{0, 0, N_floor, T_floor, N_ceiling, T_ceiling, 0, 0}};
    const auto motion = follow_loads(box.contacts, box.E, lambda);
    ASSERT_TRUE(motion && motion->carries(lambda));
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(*motion->push[k], *push[k], accurate * N_floor);
  }
}

// Two boxes in a channel, each wedged in, of which the left one pushes the right one with its side. Columns: N and T of
// floor left and right, ceiling left and right, for each; the upper and the lower contact between them. Rows: force
// along the channel, force up and moment of each box.
struct TwoBoxes {
  static constexpr double b = 0.4, weight = 15;  // half of the channel's height [m], [N]
  std::vector<SharingContact> contacts;
  Mat E = Mat::Zero(6, 20);
  explicit TwoBoxes(std::mt19937& random) {
    const double mu = between(random, 0.6, 0.9), mu_between = between(random, 0.1, 0.4);
    double a[2];
    for (const int box : {0, 1}) {
      a[box] = mu * b * between(random, 0.4, 0.7);
      const double N_ceiling = between(random, 15, 30), N_floor = N_ceiling + weight;
      const double push[] = {-N_ceiling, N_floor, N_ceiling, -N_floor};
      for (int i = 0; i < 4; ++i) {
        const double x = i % 2 == 0 ? -a[box] : a[box], y = i < 2 ? -b : b, up = i < 2 ? 1 : -1;
        E.col(8 * box + 2 * i).segment<3>(3 * box) << 0, up, x * up;
        E.col(8 * box + 2 * i + 1).segment<3>(3 * box) << 1, 0, -y;
        contacts.push_back({8 * box + 2 * i, {8 * box + 2 * i + 1}, mu});
        contacts.back().push = push[i];
      }
    }
    for (const int i : {0, 1}) {
      const double y = i == 0 ? b / 2 : -b / 2;
      E.col(16 + 2 * i) << -1, 0, y, 1, 0, -y;
      E.col(17 + 2 * i) << 0, 1, a[0], 0, -1, a[1];
      contacts.push_back({16 + 2 * i, {17 + 2 * i}, mu_between});
      contacts.back().push = i == 0 ? -15 : 1.5;
    }
  }
  std::optional<SpringMotion> pushed(double F) const {
    const Vec lambda{{-F, weight, 0, 0, weight, 0}};
    auto motion = follow_loads(contacts, E, lambda);
    return motion && motion->carries(lambda) ? motion : std::nullopt;
  }
};

// As where the instant of an event is sought.
TEST(SpringMotion, FollowsAnyPartOfAStepThatItFollows) {
  std::mt19937 random(6);
  int steps = 0, both_press = 0;
  for (int i = 0; i < 30; ++i) {
    TwoBoxes boxes(random);
    for (double F = 0; F < 300; F += 1) {
      const auto whole = boxes.pushed(F + 1);
      if (!whole) break;
      for (const double part : {1e-9, 1e-7, 1e-5, 1e-3, 0.1, 1.0}) {
        const auto motion = boxes.pushed(F + part);
        ASSERT_TRUE(motion) << i << ", from " << F << ", " << part;
        EXPECT_LE(motion->violated, 1e-8 * motion->F.norm()) << i << ", from " << F << ", " << part;
        for (std::size_t k = 0; k < boxes.contacts.size(); ++k) boxes.contacts[k].push = motion->push[k];
      }
      ++steps, both_press += *boxes.contacts[8].push > 0 && *boxes.contacts[9].push > 0;
    }
  }
  EXPECT_GT(steps, 500);
  EXPECT_GT(both_press, 50);
}

}  // namespace
}  // namespace trammel::complementarity
