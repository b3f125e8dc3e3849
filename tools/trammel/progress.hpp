// A progress bar on the terminal's standard error.
#pragma once

#include <chrono>

#include "commands/simulation.hpp"

namespace trammel::tool {

class ProgressBar {
 public:
  // Draws nothing unless `wanted` and standard error is a terminal.
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  bool visible() const { return visible_; }
  void draw(const simulate::Progress& progress);
  void clear();  // for a line of text; the next call draws it again

 private:
  using Clock = std::chrono::steady_clock;
  bool visible_;
  bool drawn_ = false;
  Clock::time_point began_;
  double t_began_ = 0;  // [s] simulated time of the first call; after a resume not 0
};

}  // namespace trammel::tool
