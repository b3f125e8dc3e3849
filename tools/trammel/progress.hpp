// The progress of long commands on standard error: a bar that each call redraws on a terminal, otherwise one line per
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
  // `done` in [0, 1]; `what` is printed after it: "12 of 40 runs". The time left follows from the share and the time since
  // the first call.
  void draw(double done, const std::string& what);
  void draw(const simulate::Progress& progress);
  void clear();  // makes room for a line of text; the next call draws the bar again

 private:
  using Clock = std::chrono::steady_clock;
  std::string time_left(double done) const;
  bool wanted_, terminal_;
  bool begun_ = false, drawn_ = false;
  Clock::time_point began_, lined_;  // the first call; the last line
  double done_began_ = 0;            // `done` of the first call; not 0 after a resume
};

}  // namespace trammel::tool
