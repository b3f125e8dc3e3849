#include "progress.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace trammel::tool {

namespace {

std::string duration(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5940) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

ProgressBar::ProgressBar(bool wanted) : visible_(wanted && isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::draw(const simulate::Progress& progress) {
  if (!visible_) return;
  if (!drawn_) {
    drawn_ = true;
    began_ = Clock::now();
    t_began_ = progress.t;
  }
  const double share = progress.until > 0 ? std::clamp(progress.t / progress.until, 0.0, 1.0) : 1.0;
  const double advanced = progress.t - t_began_;
  const double elapsed = std::chrono::duration<double>(Clock::now() - began_).count();
  std::string left;
  // An estimate from the first second would be erratic.
  if (elapsed > 1 && advanced > 0) left = ", " + duration(elapsed * (progress.until - progress.t) / advanced) + " left";

  constexpr int kWidth = 20;
  const int filled = static_cast<int>(share * kWidth);
  fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {:3.0f} %  t = {:.4g} s, {} steps, {} impacts{}", "", filled, "",
             kWidth - filled, 100 * share, progress.t, progress.steps, progress.impacts, left);
  std::fflush(stderr);
}

}  // namespace trammel::tool
