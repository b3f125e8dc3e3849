// A planar hinge: the two markers stay in one place and turn freely.
//
//     g = x_B - x_A = 0   (2 rows)        lambda [N]: the joint pushes B with -lambda and A with +lambda, world axes
#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Revolute : Joint {
  void prepare(const World& world) override {
    if (world.space != Space::planar)
      throw ParameterError("type", "revolute is planar; this scene is spatial, where a hinge needs an axis");
  }
  int row_count(Space) const override { return 2; }

  void rows(double, const Motion& A, const Motion& B, Rows& rows) const override {
    rows.g = B.x - A.x;
    rows.H_A.leftCols<2>() = -Eigen::Matrix2d::Identity();
    rows.H_B.leftCols<2>().setIdentity();
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<Revolute>("revolute", "planar hinge: two markers share one point")
                   .source("A. A. Shabana, Dynamics of Multibody Systems: revolute joint"))
