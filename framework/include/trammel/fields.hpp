// Pictures of a body: scalars over it, such as the stresses of a plate, at a grid of points on each of its elements.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <trammel/types.hpp>

namespace trammel {

// One element: its points by rows of `along`, the outline included, and the fields' values there.
struct FieldPatch {
  int along = 0;
  Mat points;  // 3 x points, world axes [m]
  Mat values;  // fields x points
};

// Ability of a body; asked at the few times that "record": {"fields": [...]} names.
class HasFields {
 public:
  virtual ~HasFields();
  virtual std::span<const std::string> fields() const = 0;  // names, constant
  // One patch for each element there is: a refinement changes their number.
  virtual void fields_at(double t, In q, In v, std::vector<FieldPatch>& patches) const = 0;
};

}  // namespace trammel
