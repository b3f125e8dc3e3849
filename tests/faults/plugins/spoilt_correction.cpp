// A correction that, the third time, changes what is not its own: the size of a part of the state, the time, or the
// arithmetic of the process.
#include <cfenv>
#include <cmath>
#include <string>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct SpoiltCorrection final : Correction {
  std::string how = "nothing";
  int applied = 0;

  bool corrects(Level level) const override { return level == Level::position; }
  Outcome apply(Level, System&, const Step&, State& state) override {
    if (++applied == 3) spoil(state);
    return Outcome::accept();
  }

 private:
  void spoil(State& state) const {
    if (how == "q") state.q.resize(1);
    if (how == "v") state.v.setZero(5);
    if (how == "memory") state.v.resize(Eigen::Index(1) << 45);
    if (how == "a") state.a.setZero(0);
    if (how == "lambda") state.lambda.setZero(100);
    if (how == "t") state.t = 1e9;
    if (how == "nan_in_q") state.q[0] = std::nan("");
    if (how == "nan_in_v") state.v[0] = std::nan("");
    if (how == "rounding") std::fesetround(FE_UPWARD);
#if defined(__SSE2__)
    if (how == "denormals") _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero
#endif
#if defined(__GLIBC__)
    if (how == "traps") ::feenableexcept(FE_ALL_EXCEPT);
#endif
  }
};

}  // namespace

TRAMMEL_PLUGIN(correction<SpoiltCorrection>("spoilt_correction", "changes what is not its own")
                   .source("none")
                   .parameter("how", &SpoiltCorrection::how,
                              {.doc = "nothing, q, v, a, lambda, t, nan_in_q, nan_in_v, memory, rounding, denormals, traps"}))
