#pragma once

#include <stdexcept>

#include "plugin/guard.hpp"

namespace trammel::model {

// The equations of motion have no solution at a point: an error of the scene, not of the plugin that called.
class NotSolvable : public std::runtime_error, public plugin::PassesThroughPlugins {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace trammel::model
