// Checks in each accepted state whether bodies stay within their theory (TheoryLimit): warns if its error exceeds 1 %,
// and ends the run if no body could have that shape.
#pragma once

#include <string>
#include <vector>

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>
#include <trammel/theory_limit.hpp>

#include "model/model.hpp"

namespace trammel::simulate {

class TheoryWatch {
 public:
  explicit TheoryWatch(const model::Model& model);
  // Why no body could have this shape; empty: it is possible.
  [[nodiscard]] std::string look(double t, const Vec& q);
  std::vector<std::string> warnings() const;
  void archive(Archive& a);

 private:
  struct Watched {
    std::size_t body;  // of the model, whose layout may change
    const TheoryLimit* theory;
    TheoryLimit::Bounds bounds;
    double largest = 0, largest_at = 0;  // of the measure; [s]
    double passed_at = 0;                // [s] where it passed bounds.accurate
  };
  const model::Model& model_;
  std::vector<Watched> watched_;
};

}  // namespace trammel::simulate
