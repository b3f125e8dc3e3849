// What a peer's program tells tools/bench/peers: one JSON object on standard output.
#pragma once

#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

namespace peers {

/// CPU time of this process [s].
inline double cpu_seconds() {
  std::timespec now;
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

struct Measured {
  std::string peer;  // name and version
  double cpu = 0;    // [s] from the first step to the last, without the set-up
  long steps = 0;
  long evaluations = 0;  // of the accelerations, or of the residual
  std::string failure;   // why it did not come to the end; no quotation marks in it
  std::vector<std::pair<double, std::vector<double>>> series;  // a time and what is observed at it
};

inline void print(const Measured& m) {
  std::printf(
      "{\"peer\": \"%s\", \"cpu_time_s\": %.9g, \"steps\": %ld, \"evaluations\": %ld, \"failure\": \"%s\", \"series\": "
      "[",
      m.peer.c_str(), m.cpu, m.steps, m.evaluations, m.failure.c_str());
  const char* between = "";
  for (const auto& [t, values] : m.series) {
    std::printf("%s[%.17g", between, t);
    for (double x : values) std::printf(", %.17g", x);
    std::printf("]");
    between = ", ";
  }
  std::printf("]}\n");
}

}  // namespace peers
