// The distance of A and B equals that of C and D.
//
//     g = (|x_B - x_A|^2 - |x_D - x_C|^2) / (2 L) = 0        1 row; L: distance at which its gradient is 1
//
// It synchronises the folding edges around the hub of a truss. C may be A.
#include <trammel/plugin.hpp>

#include "../quadratic_row.hpp"

namespace {

using namespace trammel;

struct EqualDistance final : QuadraticRow {
  double length = 1;

  EqualDistance() { set(form(), length); }
  void prepare(const World&) override { set(form(), length); }

 private:
  static Form form() {
    const Eigen::Vector4d one(-1, 1, 0, 0), other(0, 0, -1, 1);
    return product(one, one) / 2 - product(other, other) / 2;
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<EqualDistance>("equal_distance", "four markers: A and B are as far apart as C and D")
        .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77: natural coordinates of deployable trusses")
        .parameter("length", &EqualDistance::length,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "usual distance: scales the row"}))
