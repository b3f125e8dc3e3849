// A hinge that keeps the angle between two neighbouring sides, A to B and B to C, of equal length.
//
//     g = (S_1 . S_2 - cos(angle) S_1 . S_1) / L = 0,   S_1 = x_B - x_A, S_2 = x_C - x_B      1 row
//
// In every corner of a hoop of n sides, with angle 2 pi/n, it makes the polygon regular for any length of the sides.
#include <cmath>

#include <trammel/plugin.hpp>

#include "../quadratic_row.hpp"

namespace {

using namespace trammel;

struct SynchronisingHinge final : QuadraticRow {
  double angle = 0, length = 1;

  SynchronisingHinge() { set(form(), length); }
  void prepare(const World&) override { set(form(), length); }

 private:
  Form form() const {
    const Eigen::Vector3d S_1(-1, 1, 0), S_2(0, -1, 1);
    return product(S_1, S_2) - std::cos(angle) * product(S_1, S_1);
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<SynchronisingHinge>(
        "synchronising_hinge", "three markers: side BC is turned from side AB by an angle, sides of equal length")
        .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77: natural coordinates of deployable trusses")
        .parameter("angle", &SynchronisingHinge::angle,
                   {.unit = "rad", .required = true, .doc = "between the sides; 0 straight"})
        .parameter("length", &SynchronisingHinge::length,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "usual length of a side: scales the row"}))
