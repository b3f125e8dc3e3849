// The checks refuse methods that are wrong on purpose: each of these is explicit Euler with one defect.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include <trammel/testing/measurements.hpp>

namespace trammel {
namespace {

enum class Defect { none, trial_leaves_trace, forgets_archive, changes_with_next, claims_rows, takes_none };

class Euler final : public Integrator {
 public:
  explicit Euler(Defect defect) : defect_(defect) {}
  Traits traits() const override {
    Traits t;
    t.holds_position = t.holds_velocity = defect_ == Defect::claims_rows;
    t.rows = defect_ != Defect::takes_none;
    return t;
  }
  void restart(System&, const State&) override { count_ = 0; }
  Outcome step(System& s, const State& now, double h, State& next) override {
    if (defect_ == Defect::takes_none && s.sizes().nc > 0) throw std::logic_error("it was given rows");
    if (defect_ == Defect::trial_leaves_trace) count_ += 1;
    const double error = defect_ == Defect::changes_with_next && next.q.size() == 7 ? 1e-9 : 0;
    if (error > 0) count_ += 1;
    next.q = now.q + h * now.v;
    next.v = (now.v + h * now.a) * (1 + 1e-12 * count_);
    next.t = now.t + h;
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    return Outcome::accept();
  }
  void accept(System&, const State&, const State&) override {
    if (defect_ == Defect::forgets_archive) count_ += 1;
  }

 private:
  Defect defect_;
  double count_ = 0;
};

Maker euler(Defect defect) {
  return [defect] { return std::make_unique<Euler>(defect); };
}

TEST(CheckOrder, AcceptsEulerWithOrder1) {
  const Report r = check_order(euler(Defect::none), problems::pendulum(), 1, 256);
  EXPECT_TRUE(r) << r.table;
}
TEST(CheckOrder, RefusesEulerWithOrder2) {
  EXPECT_FALSE(check_order(euler(Defect::none), problems::pendulum(), 2, 256));
}
TEST(CheckOrder, RefusesRungeKutta4WithOrder3) {
  const auto rk4 = from_plugin(TRAMMEL_BUILD_DIR "/lib/trammel", "runge_kutta_4");
  EXPECT_FALSE(check_order(rk4, problems::pendulum(), 3, 32));
}
TEST(IntegratorChecks, AskAMethodThatTakesNoRowsForNone) {
  int asked = 0;
  for (const Check& check : integrator_checks(euler(Defect::takes_none), {.order = 1, .steps = 256, .energy = 0.1})) {
    const Report report = check();
    EXPECT_TRUE(report) << check.name << report.table;
    asked += report.table.find("not asked") == std::string::npos;
  }
  EXPECT_GE(asked, 6);
}
TEST(IntegratorChecks, RefuseRowsThatAMethodCannotTakeAndDoesNotSaySo) {
  // The same method without its trait throws in every check with rows.
  const Maker silent = [] {
    struct Silent final : Integrator {
      Euler euler{Defect::takes_none};
      Traits traits() const override { return {.order = 1}; }
      void restart(System& s, const State& now) override { euler.restart(s, now); }
      Outcome step(System& s, const State& now, double h, State& next) override { return euler.step(s, now, h, next); }
    };
    return std::make_unique<Silent>();
  };
  int refused = 0;
  for (const Check& check : integrator_checks(silent, {.order = 1, .steps = 256, .energy = 0.1})) refused += !check();
  EXPECT_EQ(refused, 5);  // three with rows, and the trial and the archive, asked on the pendulum with its rod
}
// Newmark's method whose estimate is factor h^bend times its own.
Maker misjudging(double factor, double bend = 0) {
  class Misjudging final : public Integrator, public ErrorEstimate {
   public:
    Misjudging(double times, double power)
        : factor_(times),
          bend_(power),
          method_(from_plugin(TRAMMEL_BUILD_DIR "/lib/trammel", "newmark")()),
          estimate_(dynamic_cast<ErrorEstimate&>(*method_)) {}
    Traits traits() const override { return method_->traits(); }
    void restart(System& s, const State& now) override { method_->restart(s, now); }
    Outcome step(System& s, const State& now, double h, State& next) override { return method_->step(s, now, h, next); }
    void accept(System& s, const State& now, const State& next) override { method_->accept(s, now, next); }
    double error(System& s, const State& now, const State& next, const Tolerance& t) override {
      return factor_ * std::pow(next.t - now.t, bend_) * estimate_.error(s, now, next, t);
    }
    int error_order() const override { return estimate_.error_order(); }

   private:
    double factor_, bend_;
    std::unique_ptr<Integrator> method_;
    ErrorEstimate& estimate_;
  };
  return [=] { return std::make_unique<Misjudging>(factor, bend); };
}
TEST(CheckEstimate, AcceptsNewmarks) {
  const Report r = check_estimate(misjudging(1), problems::pendulum(), 3.132, 5e-3);
  EXPECT_TRUE(r) << r.table;
}
TEST(CheckEstimate, RefusesOneThatIsAFifthTooSmallOrTooLarge) {
  for (const double factor : {0.8, 1.25})
    EXPECT_FALSE(check_estimate(misjudging(factor), problems::pendulum(), 3.132, 5e-3)) << factor;
}
TEST(CheckEstimate, RefusesOneOfAnotherOrder) {
  for (const double bend : {-1.0, 0.5}) {
    // As large as the error at the smallest step.
    const double factor = std::pow(5e-3 / 4, -bend);
    EXPECT_FALSE(check_estimate(misjudging(factor, bend), problems::pendulum(), 3.132, 5e-3)) << bend;
  }
}
TEST(CheckEstimate, AsksAMethodWithoutOneForNone) {
  const Report r = check_estimate(euler(Defect::none), problems::pendulum(), 3.132, 5e-3);
  EXPECT_TRUE(r);
  EXPECT_NE(r.table.find("not asked"), std::string::npos);
}
TEST(CheckStability, RefusesEulerOnTheImaginaryAxis) {
  EXPECT_FALSE(check_stability(euler(Defect::none), Axis::imaginary, 2));
}
TEST(CheckStability, AcceptsEulersLimitOnTheRealAxis) {
  const Report r = check_stability(euler(Defect::none), Axis::negative_real, 2);
  EXPECT_TRUE(r) << r.table;
}
TEST(CheckEnergy, RefusesEulersGrowth) {
  EXPECT_FALSE(check_energy(euler(Defect::none), problems::pendulum(), 64, 1e-2));
}
TEST(CheckConstraints, RefusesRowsThatAreClaimedAndNotHeld) {
  EXPECT_FALSE(check_constraints(euler(Defect::claims_rows), problems::pendulum_with_rod(), 256, 1));
}
TEST(TrialLeavesNoTrace, AcceptsEuler) {
  const Report r = trial_leaves_no_trace(euler(Defect::none), problems::pendulum_with_rod());
  EXPECT_TRUE(r) << r.table;
}
TEST(TrialLeavesNoTrace, RefusesATrialThatIsRemembered) {
  EXPECT_FALSE(trial_leaves_no_trace(euler(Defect::trial_leaves_trace), problems::pendulum_with_rod()));
}
TEST(TrialLeavesNoTrace, RefusesAMethodThatReadsNext) {
  EXPECT_FALSE(trial_leaves_no_trace(euler(Defect::changes_with_next), problems::pendulum_with_rod()));
}
TEST(ResumesBitwise, AcceptsEuler) {
  const Report r = resumes_bitwise(euler(Defect::none), problems::pendulum_with_rod());
  EXPECT_TRUE(r) << r.table;
}
TEST(ResumesBitwise, RefusesHistoryThatIsNotArchived) {
  EXPECT_FALSE(resumes_bitwise(euler(Defect::forgets_archive), problems::pendulum_with_rod()));
}

}  // namespace
}  // namespace trammel
