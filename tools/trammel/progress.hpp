// Progress where people wait, on standard error: a bar on a terminal, drawn anew at each call; elsewhere a line a
// minute.
#pragma once

#include <chrono>
#include <string>

#include "commands/simulation.hpp"

namespace trammel::tool {

class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  bool wanted() const { return wanted_; }
  // `done` in [0, 1]; `what` stands behind it: "12 of 40 runs". The time left follows from the share and the time since
  // the first call.
  void draw(double done, const std::string& what);
  void draw(const simulate::Progress& progress);
  void clear();  // for a line of text; the next call draws it again

 private:
  using Clock = std::chrono::steady_clock;
  std::string time_left(double done) const;
  bool wanted_, terminal_;
  bool begun_ = false, drawn_ = false;
  Clock::time_point began_, lined_;  // the first call; the last line
  double done_began_ = 0;            // of the first call; after a resume not 0
};

}  // namespace trammel::tool
