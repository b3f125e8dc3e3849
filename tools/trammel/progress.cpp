#include "progress.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace trammel::tool {

namespace {

constexpr double between_lines = 60;  // [s]

std::string duration(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5940) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

ProgressBar::ProgressBar(bool wanted) : wanted_(wanted), terminal_(isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K"), std::fflush(stderr);
}

// Empty in the first second: an estimate from it would be erratic.
std::string ProgressBar::time_left(double done) const {
  const double elapsed = seconds(Clock::now() - began_), advanced = done - done_began_;
  if (elapsed <= 1 || advanced <= 0) return "";
  return ", " + duration(elapsed * (1 - done) / advanced) + " left";
}

void ProgressBar::draw(double done, const std::string& what) {
  if (!wanted_) return;
  done = std::clamp(done, 0.0, 1.0);
  if (!begun_) {
    begun_ = true;
    began_ = lined_ = Clock::now();
    done_began_ = done;
  }
  if (!terminal_) {
    if (seconds(Clock::now() - lined_) < between_lines) return;
    lined_ = Clock::now();
    fmt::print(stderr, "{:3.0f} %  {}{}\n", 100 * done, what, time_left(done));
    return;
  }
  drawn_ = true;
  constexpr int width = 20;
  const int filled = static_cast<int>(done * width);
  fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {:3.0f} %  {}{}", "", filled, "", width - filled, 100 * done, what,
             time_left(done));
  std::fflush(stderr);
}

void ProgressBar::draw(const simulate::Progress& progress) {
  std::string what = fmt::format("t = {:.4g} s, {} steps", progress.t, progress.steps);
  if (progress.step > 0) what += fmt::format(" of {:.2g} s", progress.step);
  what += fmt::format(", {} impacts", progress.impacts);
  if (progress.events > progress.impacts) what += fmt::format(", {} events", progress.events);
  draw(progress.until > 0 ? progress.t / progress.until : 1.0, what);
}

}  // namespace trammel::tool
