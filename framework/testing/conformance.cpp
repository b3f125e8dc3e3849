// Properties that the Simulator needs when it repeats steps to locate events or resumes a run: equal bit for bit.
#include <fmt/format.h>

#include <cmath>

#include <trammel/testing/measurements.hpp>
#include <trammel/testing/archive.hpp>

namespace trammel {
namespace {

constexpr double h = 5e-3;  // [s]
constexpr int steps = 12;

bool advance(Integrator& method, System& s, State& now, State& next) {
  if (!method.step(s, now, h, next)) return false;
  method.accept(s, now, next);
  std::swap(now, next);
  return true;
}

}  // namespace

bool same_bits(const Vec& a, const Vec& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}
bool same_bits(const State& a, const State& b) {
  return a.t == b.t && same_bits(a.q, b.q) && same_bits(a.v, b.v) && same_bits(a.a, b.a) &&
         same_bits(a.lambda, b.lambda);
}

void Report::claim(const std::string& sentence, bool true_, const std::string& found) {
  holds = holds && true_;
  table += fmt::format("{} {}{}{}\n", true_ ? "holds:" : "FAILS:", sentence, found.empty() ? "" : ": ", found);
}

Report Check::operator()() const {
  try {
    return find_out();
  } catch (const std::exception& e) {
    Report report;
    report.claim("nothing is thrown", false, e.what());
    return report;
  }
}

Report trial_leaves_no_trace(const Maker& make, const Problem& problem) {
  const auto plain = make(), tried = make();
  const auto s = problem.system(), t = problem.system();
  State a = problem.solution(0), b = a, next, other, wild;
  plain->restart(*s, a);
  tried->restart(*t, b);
  bool stepped = true, now_kept = true, equal = true;
  int where = 0;
  for (int i = 0; i < steps && stepped && now_kept && equal; ++i) {
    where = i + 1;
    const State before = b;
    for (const double trial : {1e-3, 3e-4, 0.2, 1e-7}) {
      wild = {std::nan(""), Vec::Constant(7, std::nan("")), Vec(0), Vec::Constant(1, 1e300), Vec::Constant(3, 2)};
      static_cast<void>(tried->step(*t, b, trial, wild));  // may well be rejected
    }
    now_kept = same_bits(before, b);
    stepped = advance(*plain, *s, a, next) && advance(*tried, *t, b, other);
    equal = same_bits(a, b);
  }
  Report report;
  const std::string at = fmt::format("in step {}", where);
  report.claim("steps of 5 ms are accepted", stepped, stepped ? "" : at);
  report.claim("a trial leaves `now` as it was", now_kept, now_kept ? "" : at);
  report.claim("trials change no bit of the run", equal, equal ? "" : at);
  return report;
}

Report resumes_bitwise(const Maker& make, const Problem& problem) {
  const auto method = make(), resumed = make();
  const auto s = problem.system(), t = problem.system();
  State now = problem.solution(0), next;
  method->restart(*s, now);
  bool stepped = true;
  for (int i = 0; i < steps; ++i) stepped = stepped && advance(*method, *s, now, next);
  MemoryArchive memory;
  method->archive(memory);
  memory.reading = true;
  resumed->archive(memory);
  State again = now;
  for (int i = 0; i < steps; ++i)
    stepped = stepped && advance(*method, *s, now, next) && advance(*resumed, *t, again, next);
  Report report;
  report.claim("steps of 5 ms are accepted", stepped);
  report.claim("resumes from its archive bit for bit", same_bits(now, again));
  return report;
}

}  // namespace trammel
