// A joint: constraint rows between two markers. It never sees bodies or coordinates; assembly forms
//     G = H_A J_A + H_B J_B      and moves the markers' bias into gamma.
// Planar and spatial scenes use the same joint; the twists' size tells (3 or 6).
#pragma once

#include <trammel/component.hpp>
#include <trammel/marker.hpp>

namespace trammel {

class Joint : public Component {
 public:
  virtual int row_count(Space) const = 0;
  // `rows` comes in with row_count rows, all zero.
  virtual void rows(double t, const Motion& A, const Motion& B, Rows& rows) const = 0;
};

}  // namespace trammel
