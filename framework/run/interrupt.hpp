// A request to stop, set by a signal handler and obeyed between steps.
#pragma once

#include <atomic>

namespace trammel::simulate {

class Interrupt {
 public:
  // For a signal handler.
  void request() noexcept { requested_ = true; }
  bool requested() const noexcept { return requested_; }
  bool heeded() const noexcept { return heeded_; }  // the run stops by itself and writes its results

  // To be called by the run: true if it has to stop.
  bool heed() noexcept {
    if (!requested_.load(std::memory_order_relaxed)) return false;
    heeded_ = true;
    return true;
  }

 private:
  std::atomic<bool> requested_ = false, heeded_ = false;
  static_assert(std::atomic<bool>::is_always_lock_free);
};

}  // namespace trammel::simulate
