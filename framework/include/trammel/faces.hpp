// Faces of a body for pictures: a surface of quadrilaterals with one scalar at its points, such as a plate's stress.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <trammel/types.hpp>

namespace trammel {

struct FaceMesh {
  // A quadrilateral by four points in order. Bit k of `outline`: the line from the k-th point to the next lies on the
  // outline of an element and is drawn.
  struct Quad {
    std::array<int, 4> points;
    int outline = 0;
  };
  Mat points;  // 3 x points, world axes [m]
  Vec values;  // at each point
  std::vector<Quad> quads;
};

// Ability of a body; called at the times of the records. A body with faces is Drawn, too, for pictures of lines only.
class HasFaces {
 public:
  virtual ~HasFaces();
  virtual std::string face_values() const = 0;  // what the values are, with unit: "von Mises stress [Pa]"
  // A refinement changes the number of points and quadrilaterals.
  virtual void faces(double t, In q, FaceMesh& mesh) const = 0;
};

}  // namespace trammel
