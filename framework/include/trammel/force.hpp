// A force element between two markers: springs, dampers, drives, loads.
#pragma once

#include <trammel/component.hpp>
#include <trammel/marker.hpp>

namespace trammel {

class Force : public Component {
 public:
  // Wrenches on A and B; come in zero.
  virtual void wrench(double t, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const = 0;
  // Stored energy, whose gradient is minus the conservative part of the wrench [J].
  virtual double potential(double t, const Motion& A, const Motion& B) const = 0;
  // Power of the rest. d(potential)/dt + wrench power = supplied - dissipated.
  virtual Power power(double t, const Motion& A, const Motion& B) const = 0;
};

}  // namespace trammel
