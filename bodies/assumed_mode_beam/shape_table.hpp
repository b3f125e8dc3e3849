// The shape functions and foreshortening integrals at given stations x along the beam, in rows over the stations: the inner
// loops of the beam run over stations, contiguous and padded to full vectors with stations of zero weight.
//
//     H_ij(x) = int_0^x Phi_y,i' Phi_y,j' dxi
#pragma once

#include <vector>

#include <trammel/quadrature.hpp>

#include "modes.hpp"

namespace trammel::beam {

struct Shape {
  double L = 0, hub_radius = 0;
  std::vector<AxialMode> axial;
  std::vector<BendingMode> transverse;
};

class ShapeTable {
 public:
  // Without `foreshortening` no H is kept.
  ShapeTable(const Shape& shape, const Vec& x, const Vec& weight, bool foreshortening);

  int stations() const { return n_; }  // padded
  const double* weight() const { return weight_.data(); }
  const double* X0() const { return X0_.data(); }  // hub radius + x
  const double* phi_x(int i) const { return phi_x_.col(i).data(); }
  const double* phi_y(int i) const { return phi_y_.col(i).data(); }
  const double* slope_y(int i) const { return slope_y_.col(i).data(); }
  const double* H(int i, int j) const { return H_.col(i * transverse_ + j).data(); }

 private:
  int n_, transverse_;
  Vec weight_, X0_;
  Mat phi_x_, phi_y_, slope_y_, H_;
};

}  // namespace trammel::beam
