// A force element between two markers: springs, dampers, drives, loads.
#pragma once

#include <trammel/component.hpp>
#include <trammel/marker.hpp>

namespace trammel {

class Force : public Component {
 public:
  // Wrenches on A and B; zero on entry.
  virtual void wrench(double t, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const = 0;
  // Stored energy [J]; the conservative part of the wrench is minus its gradient.
  virtual double potential(double t, const Motion& A, const Motion& B) const = 0;
  // Power of the non-conservative part: d(potential)/dt + power of the wrenches = supplied - dissipated.
  virtual Power power(double t, const Motion& A, const Motion& B) const = 0;
};

}  // namespace trammel
