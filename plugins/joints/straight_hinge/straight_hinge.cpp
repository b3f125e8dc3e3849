// The hinge B of two equal arms AB, BC lies on the line AC in the direction towards D.
//
//     g = (x_B - x_M) . (x_D - x_M) / L = 0,   x_M = (x_A + x_C)/2        1 row; L the distance of D from the line
//
// g > 0 if the hinge is bent towards D. In the straight position, the lengths of the two arms and of AC give three rows
// in the same direction and do not constrain B across it. This row does; it exerts no force on D there, and it changes
// its sign.
#include <trammel/plugin.hpp>

#include "../quadratic_row.hpp"

namespace {

using namespace trammel;

struct StraightHinge final : QuadraticRow {
  double length = 1;

  StraightHinge() { set(form(), length); }
  void prepare(const World&) override { set(form(), length); }

 private:
  static Form form() {
    const Eigen::Vector4d hinge(-0.5, 1, -0.5, 0), beyond(-0.5, 0, -0.5, 1);
    return product(hinge, beyond);
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<StraightHinge>("straight_hinge",
                                  "four markers: hinge B of the arms AB and BC is straight, bends towards D count")
        .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77: natural coordinates of deployable trusses")
        .parameter("length", &StraightHinge::length,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "distance of D from AC: scales the row"}))
