// Motions without resistance, of points on springs whose frequencies are known.
#include "statics/mechanism.hpp"

#include <gmock/gmock.h>

namespace trammel::simulate {
namespace {

using model::AssembledSystem;
using testing::HasSubstr;

// A particle on a spring along each axis [N/m].
class Held final : public Body {
 public:
  Held(double mass, Eigen::Vector2d stiffness) : mass_(mass), k_(std::move(stiffness)) {}
  Coordinates coordinates() const override { return Coordinates::flat(2); }
  void initial(Out q, Out v) const override { q.setZero(), v.setZero(); }
  void mass(double, In, Matrix& M) const override { M.add(0, 0, mass_), M.add(1, 1, mass_); }
  bool mass_is_constant() const override { return true; }
  void force(double, In q, In, Out f) const override { f -= k_.cwiseProduct(Eigen::Vector2d(q)); }
  Energy energy(double, In q, In v) const override {
    return {.kinetic = mass_ * v.squaredNorm() / 2, .elastic = k_.dot(Eigen::Vector2d(q).cwiseAbs2()) / 2};
  }
  std::span<const std::string> markers() const override { return {}; }
  void motion(int, double, In, In, Motion&) const override {}

 private:
  double mass_;
  Eigen::Vector2d k_;
};

struct Point {
  const char* name;
  double mass;
  Eigen::Vector2d stiffness;
};

AssembledSystem system_of(const std::vector<Point>& points) {
  auto model = std::make_shared<model::Model>();
  for (const Point& p : points) {
    model->bodies.emplace_back();
    model->bodies.back().name = p.name;
    model->bodies.back().body = std::make_unique<Held>(p.mass, p.stiffness);
  }
  model->lay_out();
  return AssembledSystem(model);
}

TEST(Mechanism, ARandomMotionHasTheFrequencyThatAllMotionsHave) {
  for (const double mass : {1e-3, 1.0, 1e3})
    for (const double omega : {1e-2, 1.0, 1e4}) {
      const double k = mass * omega * omega;
      AssembledSystem system = system_of({{"one", mass, {k, k}}, {"two", 5 * mass, {5 * k, 5 * k}}});
      // Differences over 1e-6 m of forces that are linear: exact to their round-off.
      EXPECT_NEAR(stiffness_of_random_motion(system, 0, Vec::Zero(4)), omega * omega, 1e-9 * omega * omega)
          << mass << ", " << omega;
    }
}

TEST(Mechanism, ARandomMotionHasAFrequencyBetweenTheSoftestAndTheStiffest) {
  AssembledSystem system = system_of({{"soft", 1, {0, 1}}, {"stiff", 2, {50, 2e6}}});
  const double square = stiffness_of_random_motion(system, 0, Vec::Zero(4));
  EXPECT_GT(square, 1e4);
  EXPECT_LT(square, 1e6);
}

TEST(Mechanism, IsTheBodyThatMovesWithoutResistance) {
  const Vec rest = Vec::Zero(4);
  for (const double mass : {1e-3, 1.0, 1e3}) {
    AssembledSystem none = system_of({{"one", mass, {3, 4}}, {"two", 1, {5, 1e5}}});
    EXPECT_EQ(find_mechanism(none, 0, rest), std::nullopt);
    AssembledSystem first = system_of({{"one", mass, {3, 0}}, {"two", 1, {5, 1e5}}});
    EXPECT_THAT(find_mechanism(first, 0, rest).value_or(""), HasSubstr("bodies.one is a mechanism")) << mass;
    AssembledSystem second = system_of({{"one", 1, {3, 4}}, {"two", mass, {0, 1e5}}});
    EXPECT_THAT(find_mechanism(second, 0, rest).value_or(""), HasSubstr("bodies.two is a mechanism")) << mass;
  }
}

// The round-off of the stiffest motion hides the softest one below 1e-12 of its square.
TEST(Mechanism, IsWhatResistsLessThanTheRoundOffOfTheStiffest) {
  for (const double stiff : {1.0, 1e6}) {
    AssembledSystem soft = system_of({{"one", 1, {1e-14 * stiff, stiff}}, {"two", 1, {stiff, stiff}}});
    EXPECT_THAT(find_mechanism(soft, 0, Vec::Zero(4)).value_or(""), HasSubstr("bodies.one")) << stiff;
    AssembledSystem held = system_of({{"one", 1, {1e-9 * stiff, stiff}}, {"two", 1, {stiff, stiff}}});
    EXPECT_EQ(find_mechanism(held, 0, Vec::Zero(4)), std::nullopt) << stiff;
  }
}

}  // namespace
}  // namespace trammel::simulate
