// Four points stay in one plane, such as a folding edge, its hinge and the apex towards which it folds.
//
//     g = det(y_B, y_C, y_D) / L^2 = 0,   y_k = x_k - x_A        1 row; L: typical distance of the points
//
//     H_B = (y_C x y_D)^T / L^2 and cyclically, H_A = -(H_B + H_C + H_D)
//     gamma = -2 (det(u_B, u_C, y_D) + det(u_B, y_C, u_D) + det(y_B, u_C, u_D)) / L^2,   u = y'
#include <array>

#include <Eigen/Geometry>

#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector3d;

double det(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return a.dot(b.cross(c));
}

struct Coplanar final : Constraint {
  double length = 1;

  void prepare(const World& world) override {
    if (world.space == Space::planar) throw ParameterError("type", "in a planar scene all points are in one plane");
  }
  int row_count(Space) const override { return 1; }
  int marker_count() const override { return 4; }

  void rows_between(double, Motions at, Rows& rows) const override {
    std::array<Vector3d, 3> y, u;
    for (std::size_t k = 0; k < 3; ++k) {
      y[k] = at[k + 1]->x - at[0]->x;
      u[k] = at[k + 1]->V.head<3>() - at[0]->V.head<3>();
    }
    const double scale = 1 / (length * length);
    rows.g(0) = scale * det(y[0], y[1], y[2]);
    rows.gamma(0) = -2 * scale * (det(u[0], u[1], y[2]) + det(u[0], y[1], u[2]) + det(y[0], u[1], u[2]));
    Vector3d sum = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d H = scale * y[(k + 1) % 3].cross(y[(k + 2) % 3]);
      rows.H(int(k) + 1).row(0).head<3>() = H.transpose();
      sum += H;
    }
    rows.H_A.row(0).head<3>() = -sum.transpose();
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<Coplanar>("coplanar", "four markers stay in one plane; spatial")
        .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77: natural coordinates of deployable trusses")
        .parameter("length", &Coplanar::length,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "usual distance of the markers: scales the row"}))
