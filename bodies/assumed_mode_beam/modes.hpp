// The shape functions of the beam, on 0 <= x <= L.
//
// Transverse: the bending modes of a cantilever, cosh bx - cos bx - sigma (sinh bx - sin bx) with cos(bL) cosh(bL) =
// -1, scaled so that their square integrates to L; at the tip they are 2, -2, 2, ...
// Axial: those of a rod fixed at x = 0, sin((2i - 1) pi x / 2L).
//
// Written with decaying exponentials: the textbook form cosh - sigma sinh loses five digits at the ninth mode.
#pragma once

namespace trammel::beam {

class BendingMode {
 public:
  BendingMode(int i, double L);              // i from 1
  double wave_number() const { return b_; }  // [1/m]
  double value(double x) const;
  double slope(double x) const;
  double curvature(double x) const;

 private:
  double b_, L_;
  double sigma_;
  double growing_;  // 2 (1 - sigma) sinh(bL) e^-bL: the share of the part that grows towards the tip
};

class AxialMode {
 public:
  AxialMode(int i, double L);
  double wave_number() const { return l_; }
  double value(double x) const;
  double slope(double x) const;

 private:
  double l_;
};

}  // namespace trammel::beam
