// The result of a step or a correction. An expected failure is a value, not an exception.
#pragma once

namespace trammel {

class [[nodiscard]] Outcome {
 public:
  static Outcome accept() { return Outcome(nullptr); }
  // `reason` must outlive the run: pass a string literal, e.g. "Newton's iteration did not converge".
  static Outcome reject(const char* reason) { return Outcome(reason); }

  bool accepted() const { return !reason_; }
  explicit operator bool() const { return accepted(); }
  const char* reason() const { return reason_ ? reason_ : ""; }

 private:
  explicit Outcome(const char* reason) : reason_(reason) {}
  const char* reason_;
};

}  // namespace trammel
