// Scalar fields over a body for pictures, such as the stresses of a plate, at a grid of points on each element.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <trammel/types.hpp>

namespace trammel {

// One element: its points, row by row, and the fields' values there. The outermost points lie on the element's outline.
struct FieldPatch {
  int along = 0;  // points per row
  Mat points;     // 3 x points, world axes [m]
  Mat values;     // fields x points
};

// Ability of a body; called at the times that "record": {"fields": [...]} lists.
class HasFields {
 public:
  virtual ~HasFields();
  virtual std::span<const std::string> fields() const = 0;  // names; constant
  // Gives one patch per element; a refinement changes their number.
  virtual void fields_at(double t, In q, In v, std::vector<FieldPatch>& patches) const = 0;
};

}  // namespace trammel
