// A step asks for no memory once its scratch vectors have their sizes.
#include <cstdlib>

#include "support.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define TRAMMEL_COUNTS_ALLOCATIONS 0
#else
#define TRAMMEL_COUNTS_ALLOCATIONS 1
#endif

#if TRAMMEL_COUNTS_ALLOCATIONS
namespace {
thread_local long long allocations = 0;
}
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace trammel::test {
namespace {

// Three masses on springs of different stiffness, with the row g = q_0 if `row`; all results in closed form.
class Springs final : public System {
 public:
  explicit Springs(bool row) : nc_(row) {}
  Sizes sizes() const override { return {3, 3, nc_}; }
  void rate(const Vec&, const Vec& v, Vec& q_dot) const override { q_dot = v; }
  void normalise(Vec&) const override {}
  void retract(const Vec& q, const Vec& dq, Vec& q_new) const override { q_new = q + dq; }
  void difference(const Vec& q1, const Vec& q0, Vec& dq) const override { dq = q1 - q0; }
  void move_to(double, const Vec& q, const Vec& v) override {
    kinetic_ = 0.5 * v.squaredNorm();
    elastic_ = (k_.array() * q.array().square() * (0.5 + 0.25 * q.array().square())).sum();
    f_ = -(k_.array() * q.array() * (1 + q.array().square())).matrix();
    g_ = q.head(nc_);
    g_dot_ = v.head(nc_);
  }
  const Vec& f() override { return f_; }
  const Vec& g() override { return g_; }
  const Vec& g_dot() override { return g_dot_; }
  void add_mass_times(double c, const Vec& a, Vec& r) override { r += c * a; }
  void add_reaction(double c, const Vec& lambda, Vec& r) override { r.head(nc_) += c * lambda; }
  void add_rows_times(double c, const Vec& x, Vec& rc) override { rc += c * x.head(nc_); }
  void add_rows_force(double c, const Vec& mu, Vec& r) override { r.head(nc_) += c * mu; }
  Energy energy() override { return {.kinetic = kinetic_, .elastic = elastic_}; }
  void accelerate(Stabilisation s, Vec& a, Vec& lambda) override {
    a = f_;
    a.head(nc_) = -2 * s.alpha * g_dot_ - s.beta * s.beta * g_;
    lambda = f_.head(nc_) - a.head(nc_);
  }
  void factorise(Blend c, const Vec&, const Vec&, Factors) override { S_ = Vec::Constant(3, c.c_m) + c.c_k * k_; }
  bool correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors) override {
    da = -r.cwiseQuotient(S_);
    da.head(nc_) = -rc;
    dlambda = -r.head(nc_) - S_.head(nc_).cwiseProduct(da.head(nc_));
    return true;
  }

 private:
  int nc_;
  double kinetic_ = 0, elastic_ = 0;
  Vec k_ = Eigen::Vector3d(1, 4, 9), f_, g_, g_dot_, S_;
};

class Allocation : public testing::TestWithParam<Form> {};

TEST_P(Allocation, HappensInNoStepOnceWarm) {
#if TRAMMEL_COUNTS_ALLOCATIONS
  for (const bool row : {false, true}) {
    Springs s(row);
    auto method = make(GetParam().name, GetParam().settings);
    auto* estimate = dynamic_cast<ErrorEstimate*>(method.get());
    State now{0, Eigen::Vector3d(0, 1, 0.5), Eigen::Vector3d(0, 0, 1), Vec(3), Vec(int(row))}, next;
    s.move_to(0, now.q, now.v);
    s.accelerate({}, now.a, now.lambda);
    method->restart(s, now);
    long long before = 0;
    for (int i = 0; i < 30; ++i) {
      if (i == 10) before = allocations;
      ASSERT_TRUE(method->step(s, now, 1e-2, next));
      if (estimate) estimate->error(s, now, next, {});
      method->accept(s, now, next);
      std::swap(now, next);
    }
    EXPECT_EQ(allocations - before, 0) << (row ? "with" : "without") << " a row";
  }
#else
  GTEST_SKIP() << "the sanitizer owns malloc";
#endif
}

INSTANTIATE_TEST_SUITE_P(All, Allocation, testing::ValuesIn(all_forms()),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

}  // namespace
}  // namespace trammel::test
