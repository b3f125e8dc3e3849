// The run cannot go on: diverged, step too small, event storm. What came before is kept; exit code 1.
#pragma once

#include <stdexcept>

namespace trammel::simulate {

class RunFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace trammel::simulate
