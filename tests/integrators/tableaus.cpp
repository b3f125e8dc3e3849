// The coefficients of the explicit methods, read off their steps: a particle whose force at its i-th evaluation is the
// i-th unit vector shows in its velocities which multiples of which slopes make them up. They satisfy every condition
// of the order that the methods claim, and so do their error estimates and interpolations on polynomials.
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <trammel/testing/archive.hpp>

#include "support.hpp"

namespace trammel::test {
namespace {

using Force = std::function<Vec(double t, const Vec& q, const Vec& v)>;

Problem pushed(Eigen::Index n, Force force) {
  Problem p;
  p.name = "pushed particle";
  p.closed_form = false;
  p.M = Mat::Identity(n, n);
  p.force = std::move(force);
  p.exact = [n](double, Vec& q, Vec& v) { q = v = Vec::Zero(n); };
  return p;
}

struct Coefficients {
  Mat A;  // stages x stages
  Vec b, c;
};

// Of a method with s stages, whose last evaluation is at the end of the step.
Coefficients coefficients_of(const std::string& name, int s) {
  std::vector<double> t;
  std::vector<Vec> v;  // at each evaluation
  Posed system(pushed(s + 1, [&](double at, const Vec&, const Vec& u) -> Vec {
    if (t.empty() || t.back() != at || v.back() != u) t.push_back(at), v.push_back(u);
    return Vec::Unit(s + 1, Eigen::Index(t.size()) - 1);
  }));
  const auto method = make(name);
  const State now{0, Vec::Zero(s + 1), Vec::Zero(s + 1), Vec::Unit(s + 1, 0), Vec(0)};
  State next;
  method->restart(system, now);
  EXPECT_TRUE(method->step(system, now, 1, next).accepted());
  EXPECT_EQ(t.size(), std::size_t(s) + 1);
  Coefficients read{Mat::Zero(s, s), next.v.head(s), Vec::Zero(s)};
  for (int i = 0; i < s; ++i) read.A.row(i) = v[std::size_t(i)].head(s), read.c[i] = t[std::size_t(i)];
  return read;
}

// A rooted tree by its subtrees (Butcher; Hairer, Norsett, Wanner, Solving ODEs I, II.2): a method is of order p if
// b . weights = 1/density for all trees of up to p nodes.
struct Tree {
  int nodes;
  Vec weights;
  double density;
};

// All sets of subtrees with `nodes` nodes, none larger than trees[largest].
void add_trees(const Mat& A, int nodes, std::size_t largest, const Tree& root, std::vector<Tree>& trees,
               std::vector<Tree>& found) {
  if (nodes == 0) {
    found.push_back(root), found.back().density *= root.nodes;
    return;
  }
  for (std::size_t k = 0; k <= largest && k < trees.size(); ++k) {
    const Tree& branch = trees[k];
    if (branch.nodes > nodes) continue;
    const Vec weights = root.weights.cwiseProduct(A * branch.weights);
    add_trees(A, nodes - branch.nodes, k, {root.nodes, weights, root.density * branch.density}, trees, found);
  }
}

std::vector<Tree> trees_of(const Mat& A, int order) {
  std::vector<Tree> trees;
  for (int nodes = 1; nodes <= order; ++nodes) {
    std::vector<Tree> found;
    add_trees(A, nodes - 1, trees.size(), {nodes, Vec::Ones(A.rows()), 1}, trees, found);
    trees.insert(trees.end(), found.begin(), found.end());
  }
  return trees;
}

struct Method {
  const char* name;
  int stages, order;
  std::size_t trees;
};
constexpr Method methods[] = {{"runge_kutta_4", 4, 4, 8}, {"dormand_prince", 6, 5, 17}, {"dop853", 12, 8, 200}};

TEST(Tableaus, SatisfyTheConditionsOfTheirOrderForEveryTree) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method.name);
    const Coefficients read = coefficients_of(method.name, method.stages);
    const double round_off = 1e-14 * (1 + read.A.cwiseAbs().maxCoeff());
    EXPECT_LE((read.A.rowwise().sum() - read.c).lpNorm<Eigen::Infinity>(), round_off);
    const std::vector<Tree> trees = trees_of(read.A, method.order);
    EXPECT_EQ(trees.size(), method.trees);
    for (std::size_t i = 0; i < trees.size(); ++i)
      EXPECT_NEAR(read.b.dot(trees[i].weights), 1 / trees[i].density, round_off) << i;
  }
}

// A particle at rest under a force of time, over one step of size 1.
struct OneStep {
  OneStep(const std::string& name, std::function<double(double)> force)
      : system(pushed(1, [force](double t, const Vec&, const Vec&) { return Vec::Constant(1, force(t)); })),
        method(make(name)) {
    now = system.start();
    method->restart(system, now);
    EXPECT_TRUE(method->step(system, now, 1, next).accepted());
  }
  // Of positions and velocities together, or of positions alone.
  double error(bool of_positions = false) {
    const Tolerance one{.relative = 0, .absolute = 1, .absolute_rate = of_positions ? 1e30 : 0};
    return dynamic_cast<ErrorEstimate&>(*method).error(system, now, next, one) * std::sqrt(2);
  }
  State inside(double theta) {
    State at;
    dynamic_cast<DenseOutput&>(*method).interpolate(system, now, next, theta, at);
    return at;
  }

  Posed system;
  std::unique_ptr<Integrator> method;
  State now, next;
};

std::function<double(double)> power(int k, double of_others = 0) {
  return [=](double t) { return std::pow(t, k) + of_others * (3 - 2 * t); };
}

// The estimate compares with a method of a lower order: of third for the classical method (whose weight 1/6 of the last
// stage goes to the step's end), of fourth, and of fifth. Both are exact where positions are powers of time up to it.
TEST(ErrorsOfTableaus, VanishWhereTheMethodOfLowerOrderIsExact) {
  for (const auto& [name, order] :
       {std::pair("runge_kutta_4", 3), std::pair("dormand_prince", 4), std::pair("dop853", 5)})
    for (int k = 0; k + 2 <= order; ++k) {
      SCOPED_TRACE(testing::Message() << name << ", " << k);
      OneStep step(name, power(k));
      EXPECT_LE(step.error(), 1e-14);
      EXPECT_NEAR(step.next.v[0], 1.0 / (k + 1), 1e-14);
      EXPECT_NEAR(step.next.q[0], 1.0 / ((k + 1) * (k + 2)), 1e-14);
    }
}

TEST(ErrorsOfTableaus, OfTheClassicalMethodAreTheDifferenceOfItsLastTwoSlopes) {
  double last = 0;  // q' = v of the fourth stage
  Posed system(pushed(1, [&](double t, const Vec&, const Vec& v) -> Vec {
    if (t == 1 && last == 0) last = v[0];
    return Vec::Constant(1, std::cos(3 * v[0]));
  }));
  const auto method = make("runge_kutta_4");
  const State now = system.at(0, Vec::Zero(1), Vec::Zero(1));
  State next;
  method->restart(system, now);
  ASSERT_TRUE(method->step(system, now, 1, next).accepted());
  const double e_q = (last - next.v[0]) / 6, e_v = (std::cos(3 * last) - std::cos(3 * next.v[0])) / 6;
  const double error = dynamic_cast<ErrorEstimate&>(*method).error(system, now, next, {.relative = 0, .absolute = 1});
  EXPECT_NEAR(error, std::hypot(e_q, e_v) / std::sqrt(2), 1e-14);
  EXPECT_GT(error, 0.01);
}

// By the weights of the embedded method as printed (Hairer, Norsett, Wanner, Solving ODEs I, II.5, table 5.2).
TEST(ErrorsOfTableaus, OfDormandAndPrinceAreTheDifferenceToTheirFourthOrderMethod) {
  const Coefficients read = coefficients_of("dormand_prince", 6);
  constexpr double embedded[] = {5179.0 / 57600, 0,       7571.0 / 16695, 393.0 / 640, -92097.0 / 339200,
                                 187.0 / 2100,   1.0 / 40};
  for (int k = 4; k < 8; ++k) {
    OneStep step("dormand_prince", power(k));
    double e_v = step.next.v[0] - embedded[6], e_q = step.next.q[0] - embedded[6] * step.next.v[0];
    Vec slopes(6);
    for (int i = 0; i < 6; ++i) slopes[i] = std::pow(read.c[i], k);
    const Vec v = read.A * slopes;
    for (int i = 0; i < 6; ++i) e_v -= embedded[i] * slopes[i], e_q -= embedded[i] * v[i];
    EXPECT_NEAR(step.error(), std::hypot(e_q, e_v), 1e-14) << k;
    EXPECT_GT(step.error(), 1e-5) << k;
  }
}

// e_5^2 / sqrt(e_5^2 + e_3^2/100): with the third-order method, too, positions of degree 3 are exact, so such parts
// leave the error as it is.
TEST(ErrorsOfTableaus, OfTheEighthOrderAreLeftByWhatTheThirdOrderMethodIntegrates) {
  for (int k = 5; k < 9; ++k)
    for (const bool of_positions : {false, true}) {
      OneStep alone("dop853", power(k)), with_others("dop853", power(k, 1));
      const double error = alone.error(of_positions);
      EXPECT_NEAR(with_others.error(of_positions) / error, 1, 1e-8) << k;
      EXPECT_GT(error, 1e-6) << k;
    }
}

// The third-order method has three stages, at c = 0, 0.651 and 1, hence the weights that integrate parabolas. A force
// that the fifth-order method integrates changes e_3 alone: the same e_5 follows from errors with more and less of it.
TEST(ErrorsOfTableaus, OfTheEighthOrderWeighTheThirdOrderMethodByAHundredth) {
  const Coefficients read = coefficients_of("dop853", 12);
  const std::array<int, 3> stages{0, 8, 11};
  Eigen::Matrix3d powers;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) powers(k, i) = std::pow(read.c[stages[std::size_t(i)]], k);
  const Eigen::Vector3d weights = powers.partialPivLu().solve(Eigen::Vector3d(1, 1.0 / 2, 1.0 / 3));
  const auto fifth = [&](double more) {
    const auto force = [more](double t) { return std::pow(t, 5) + more * t * t * t; };
    OneStep step("dop853", force);
    const Vec v = read.A * Vec(read.c.unaryExpr(force));
    double third = step.next.q[0];
    for (int i = 0; i < 3; ++i) third -= weights[i] * v[stages[std::size_t(i)]];
    const double error = step.error(true), squared = error * error;
    return std::sqrt((squared + std::sqrt(squared * squared + 0.04 * squared * third * third)) / 2);
  };
  EXPECT_NEAR(fifth(1) / fifth(0), 1, 1e-8);
  EXPECT_NEAR(fifth(-3) / fifth(0), 1, 1e-8);
  OneStep free("dop853", [](double) { return 0.0; });
  EXPECT_EQ(free.error(), 0);
}

// Polynomials of the degree of the interpolation less one as forces: its velocities are exact, and so are positions as
// far as the stages' velocities are.
TEST(InterpolationsOfTableaus, AreExactForPolynomials) {
  for (const auto& [name, degree] : {std::pair("dormand_prince", 4), std::pair("dop853", 7)})
    for (int k = 0; k < degree; ++k)
      for (const double theta : {0.1, 0.3, 0.5, 0.7, 0.95}) {
        SCOPED_TRACE(testing::Message() << name << ", " << k << ", " << theta);
        OneStep step(name, power(k));
        const State at = step.inside(theta);
        EXPECT_NEAR(at.t, theta, 1e-16);
        EXPECT_NEAR(at.v[0], std::pow(theta, k + 1) / (k + 1), 1e-13);
        if (k + 1 < degree) {
          EXPECT_NEAR(at.q[0], std::pow(theta, k + 2) / ((k + 1) * (k + 2)), 1e-13);
        }
      }
}

// Wherever the step begins, and though a shorter one was tried since.
TEST(InterpolationsOfTableaus, BelongToTheStepThatIsAskedFor) {
  for (const char* name : {"dormand_prince", "dop853"})
    for (int k = 0; k < 3; ++k) {
      SCOPED_TRACE(testing::Message() << name << ", " << k);
      const auto integral = [k](int times, double t) {
        return std::pow(t, k + times) / (times == 1 ? k + 1 : (k + 1) * (k + 2));
      };
      Posed system(pushed(1, [k](double t, const Vec&, const Vec&) { return Vec::Constant(1, std::pow(t, k)); }));
      const double begin = 0.25, h = 0.5, theta = 0.3, t = begin + theta * h;
      const State now = system.at(begin, Vec::Constant(1, 1), Vec::Constant(1, 2));
      const auto method = make(name);
      auto& dense = dynamic_cast<DenseOutput&>(*method);
      State next, shorter, at;
      method->restart(system, now);
      for (const bool tried : {false, true}) {
        ASSERT_TRUE(method->step(system, now, h, next).accepted());
        if (tried) {
          ASSERT_TRUE(method->step(system, now, 0.4 * h, shorter).accepted());
        }
        dense.interpolate(system, now, next, theta, at);
        EXPECT_NEAR(at.t, t, 1e-16);
        EXPECT_NEAR(at.v[0], 2 + integral(1, t) - integral(1, begin), 1e-14);
        const double of_v = 2 - integral(1, begin);
        EXPECT_NEAR(at.q[0], 1 + of_v * theta * h + integral(2, t) - integral(2, begin), 1e-14);
      }
    }
}

TEST(InterpolationsOfTableaus, AreUnitQuaternions) {
  for (const char* name : {"dormand_prince", "dop853"}) {
    Posed top(problems::heavy_top());
    const auto method = make(name);
    const State now = top.start();
    State next, at;
    method->restart(top, now);
    ASSERT_TRUE(method->step(top, now, 0.05, next).accepted());
    for (const double theta : {0.2, 0.5, 0.8}) {
      dynamic_cast<DenseOutput&>(*method).interpolate(top, now, next, theta, at);
      EXPECT_NEAR(at.q.norm(), 1, 1e-15) << name;
    }
  }
}

// PECE of fourth order as published, once it has the slopes of steps of the classical method of this size: predicted
// and corrected velocities, from the forces met on the way, which depend on the predicted velocities.
void expect_published_steps(bool ab4, double begin) {
  const auto force = [](double t, double v) { return std::cos(t) - 0.3 * v - 0.1 * std::sin(3 * v); };
  double met = 0;  // the velocity of the first evaluation in a step
  bool first = false;
  Posed system(pushed(1, [&](double t, const Vec&, const Vec& v) -> Vec {
    if (first) met = v[0], first = false;
    return Vec::Constant(1, force(t, v[0]));
  }));
  const auto method = make("adams_baumgarte", {{"predictor", std::string(ab4 ? "ab4" : "ab3")}});
  auto& estimate = dynamic_cast<ErrorEstimate&>(*method);
  const Tolerance tolerance{.relative = 0, .absolute = 1};
  State now = system.at(begin, Vec::Zero(1), Vec::Zero(1)), next;
  method->restart(system, now);
  std::vector<State> past;  // one step of this size after the other
  const std::size_t wanted = ab4 ? 4 : 3;
  for (int step = 0; step < 14; ++step) {
    const double h = step < 7 ? 0.5 : 0.3;
    if (step == 7) past.clear();
    past.push_back(now);
    first = true;
    ASSERT_TRUE(method->step(system, now, h, next).accepted());
    const double error = estimate.error(system, now, next, tolerance);
    EXPECT_EQ(estimate.error_order(), past.size() >= wanted && ab4 ? 5 : 4) << step;
    if (past.size() < wanted) {
      const auto starter = make("runge_kutta_4");
      State expected;
      starter->restart(system, now);
      ASSERT_TRUE(starter->step(system, now, h, expected).accepted());
      EXPECT_NEAR(next.q[0], expected.q[0], 1e-14);
      EXPECT_NEAR(next.v[0], expected.v[0], 1e-14);
      const double of_starter = dynamic_cast<ErrorEstimate&>(*starter).error(system, now, expected, tolerance);
      EXPECT_NEAR(error, of_starter, 1e-14);
    } else {
      const std::size_t n = past.size() - 1;
      const auto F = [&](std::size_t i) { return std::array{past[n - i].v[0], past[n - i].a[0]}; };
      std::array<double, 2> predicted{now.q[0], now.v[0]}, corrected = predicted;
      for (std::size_t k = 0; k < 2; ++k)
        predicted[k] += ab4 ? h / 24 * (55 * F(0)[k] - 59 * F(1)[k] + 37 * F(2)[k] - 9 * F(3)[k])
                            : h / 12 * (23 * F(0)[k] - 16 * F(1)[k] + 5 * F(2)[k]);
      const std::array slope{predicted[1], force(now.t + h, predicted[1])};
      for (std::size_t k = 0; k < 2; ++k)
        corrected[k] += h / 24 * (9 * slope[k] + 19 * F(0)[k] - 5 * F(1)[k] + F(2)[k]);
      EXPECT_NEAR(met, predicted[1], 1e-14) << step;
      EXPECT_NEAR(next.q[0], corrected[0], 1e-14) << step;
      EXPECT_NEAR(next.v[0], corrected[1], 1e-14) << step;
      const double milne = ab4 ? 19.0 / 270 : 1;
      EXPECT_NEAR(error * std::sqrt(2), milne * std::hypot(predicted[0] - corrected[0], predicted[1] - corrected[1]),
                  1e-14);
    }
    method->accept(system, now, next);
    now = next;
  }
}

// Late, differences of times are off by 1e-9: steps are of one size all the same.
TEST(AdamsBaumgarte, PredictsAndCorrectsByThePublishedWeights) {
  for (const bool ab4 : {true, false})
    for (const double begin : {0.0, 1e7}) {
      SCOPED_TRACE(testing::Message() << ab4 << " " << begin);
      expect_published_steps(ab4, begin);
    }
}

// The last accepted point is the first; those before a restart are left out.
TEST(AdamsBaumgarte, ArchivesTheSlopesOfItsLastSteps) {
  Posed s(problems::pendulum_with_rod());
  const auto method = make("adams_baumgarte");
  std::vector<State> states{s.start()};
  method->restart(s, states[0]);
  for (int i = 0; i < 6; ++i) states.push_back(advance(*method, s, states.back(), 1e-3, 1));
  const auto archived = [&] {
    MemoryArchive memory;
    method->archive(memory);
    return memory.vectors;
  };
  auto vectors = archived();
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string name = "past_" + std::to_string(k);
    const State& state = states[states.size() - 1 - k];
    EXPECT_EQ(vectors.at(name + "_v"), state.a) << k;
    EXPECT_EQ(vectors.at(name + "_lambda"), state.lambda) << k;
  }
  method->restart(s, states.back());
  vectors = archived();
  EXPECT_EQ(vectors.at("past_0_v"), states.back().a);
  for (const char* name : {"past_1_q", "past_1_v", "past_2_v", "past_3_lambda"}) EXPECT_EQ(vectors.at(name).size(), 0);
}

// An archive that says how many slopes are known, and holds these of the last point.
class GivenHistory final : public Archive {
 public:
  using Archive::operator();
  GivenHistory(int filled, Vec q, Vec v) : filled_(filled), q_(std::move(q)), v_(std::move(v)) {}
  void operator()(std::string_view, bool&) override {}
  void operator()(std::string_view name, int& x) override { x = name == "filled" ? filled_ : x; }
  void operator()(std::string_view, long long&) override {}
  void operator()(std::string_view, double&) override {}
  void operator()(std::string_view, std::string&) override {}
  void operator()(std::string_view name, Vec& x) override {
    if (name == "past_0_q") x = q_;
    if (name == "past_0_v") x = v_;
  }

 private:
  int filled_;
  Vec q_, v_;
};

TEST(AdamsBaumgarte, RefusesAnArchiveThatLacksItsSlopes) {
  const Vec none, one = Vec::Ones(1);
  const auto read = [](int filled, const Vec& q, const Vec& v) {
    GivenHistory history(filled, q, v);
    make("adams_baumgarte")->archive(history);
  };
  EXPECT_THROW(read(-1, one, one), std::out_of_range);
  EXPECT_THROW(read(5, one, one), std::out_of_range);
  EXPECT_THROW(read(1, none, one), std::length_error);
  EXPECT_THROW(read(1, one, none), std::length_error);
  EXPECT_THROW(read(2, one, one), std::length_error);
  EXPECT_NO_THROW(read(1, one, one));
  EXPECT_NO_THROW(read(0, none, none));
}

TEST(RungeKuttaMethods, ArchiveTheSlopeOfTheirLastPoint) {
  for (const char* name : {"runge_kutta_4", "dormand_prince", "dop853"}) {
    Posed s(problems::pendulum_with_rod());
    const auto method = make(name);
    const State start = s.start();
    method->restart(s, start);
    const State end = advance(*method, s, start, 1e-3, 3);
    MemoryArchive memory;
    method->archive(memory);
    EXPECT_EQ(memory.vectors.at("now_slope_q"), end.v) << name;
    EXPECT_EQ(memory.vectors.at("now_slope_v"), end.a) << name;
    EXPECT_EQ(memory.vectors.at("now_slope_lambda"), end.lambda) << name;
  }
}

}  // namespace
}  // namespace trammel::test
