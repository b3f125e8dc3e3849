#include "plugin/guard.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace trammel::plugin {
namespace {

const Origin origin{"/x/my_method.so", "integrator my_method", "integrator"};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class Call>
std::string error(Call call) {
  try {
    call();
    return "no error";
  } catch (const PluginError& e) {
    return e.what();
  }
}

TEST(Guard, ReturnsWhatTheCallReturns) {
  EXPECT_EQ(guard(origin, "step", 0.0, [] { return 42; }), 42);
}

TEST(Guard, PassesAReferenceThrough) {
  int x = 0;
  guard(origin, "step", 0.0, [&]() -> int& { return x; }) = 3;
  EXPECT_EQ(x, 3);
}

TEST(Guard, NamesFileComponentCallTimeAndCause) {
  EXPECT_EQ(error([] { guard(origin, "step", 0.25, [] { throw std::runtime_error("out of luck"); }); }),
            "plugin /x/my_method.so: integrator my_method (integrator): step at t = 0.25 s: it threw: out of luck");
}

TEST(Guard, CatchesWhatIsNoException) {
  EXPECT_EQ(error([] { guard(origin, "prepare", {}, [] { throw 42; }); }),
            "plugin /x/my_method.so: integrator my_method (integrator): prepare: it threw something that is no "
            "std::exception");
}

TEST(Guard, BlamesTheInnermostPlugin) {
  const Origin body{"/x/rod.so", "body rod", "bodies.rod"};
  EXPECT_EQ(error([&] {
              guard(origin, "step", 0.5, [&] { guard(body, "force", 0.75, [] { throw std::logic_error("no"); }); });
            }),
            "plugin /x/rod.so: body rod (bodies.rod): force at t = 0.75 s: it threw: no");
}

TEST(Guard, LetsErrorsOfTheFrameworkPass) {
  struct Singular : std::runtime_error, PassesThroughPlugins {
    using std::runtime_error::runtime_error;
  };
  EXPECT_THROW(guard(origin, "step", 0.5, [] { throw Singular("mass matrix"); }), Singular);
}

TEST(PluginError, NamesTheStepOnceItIsKnown) {
  const PluginError e = PluginError(origin, "step", "it threw: no", 0.1).in_step(1000);
  EXPECT_STREQ(e.what(),
               "plugin /x/my_method.so: integrator my_method (integrator): step at t = 0.1 s, step 1000: it threw: no");
  EXPECT_EQ(e.step(), 1000);
}

TEST(RequireFinite, LetsFiniteNumbersPass) {
  Vec x(3);
  x << 1e308, -1e308, std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(error([&] { require_finite(origin, "force", 0, "f", x); }), "no error");
}

TEST(RequireFinite, NamesTheFirstEntryThatIsNot) {
  const Vec x = Vec::LinSpaced(9, 0, 8);
  for (Eigen::Index i = 0; i < x.size(); ++i)
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
      Vec y = x;
      y[i] = bad;
      EXPECT_EQ(error([&] { require_finite(origin, "force", 0.5, "f", y); }),
                "plugin /x/my_method.so: integrator my_method (integrator): force at t = 0.5 s: it returned f[" +
                    std::to_string(i) + "] = " + (bad != bad ? "nan" : "inf") + "; expected a finite number");
    }
}

TEST(RequireFinite, TakesAnEmptyVector) {
  EXPECT_EQ(error([] { require_finite(origin, "force", 0, "f", Vec()); }), "no error");
}

}  // namespace
}  // namespace trammel::plugin
