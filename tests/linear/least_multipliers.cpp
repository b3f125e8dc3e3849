// Multipliers of redundant rows have one meaning at every size: of all with the same forces those of least norm.
#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "linear/fronts/least_multipliers.hpp"
#include "linear/kkt.hpp"
#include "linear/sparse_mass_kkt.hpp"
#include "trusses.hpp"

namespace trammel::numerics {
namespace {

using test::Truss;

Mat dense_rows(const Truss& truss) {
  Mat G = Mat::Zero(truss.rows, truss.b.size());
  for (const BodyBlock& body : truss.bodies)
    for (std::size_t i = 0; i < body.rows.size(); ++i)
      G.row(body.rows[i]).segment(body.v0, body.M.rows()) = body.Gt.col(Eigen::Index(i)).transpose();
  return G;
}

// (G^T)^+ f, by an orthogonal decomposition of the whole.
Vec least_by_the_whole(const Mat& G, const Vec& f) {
  Eigen::CompleteOrthogonalDecomposition<Mat> cod;
  cod.setThreshold(1e-9);
  cod.compute(G.transpose());
  return cod.solve(f);
}

Vec some_multipliers(int rows) {
  return Vec::NullaryExpr(rows, [](Eigen::Index i) { return std::sin(1.0 + 2.3 * double(i)); });
}

void scale_rows(Truss& truss) {
  for (BodyBlock& body : truss.bodies)
    for (std::size_t i = 0; i < body.rows.size(); ++i)
      body.Gt.col(Eigen::Index(i)) *= std::pow(10.0, body.rows[i] % 7 - 3);
}

TEST(LeastMultipliers, AreThePseudoInverseTimesTheForces) {
  for (const bool unlike : {false, true})
    for (Truss truss : {Truss::mast(5, 1, 0.3), Truss::prismatic_mast(2, 1, 0.3), Truss::prismatic_mast(6, 0.6, 0),
                        Truss::hoop(8, 1, 0.3), Truss::hoop(14, 0.5, 0)}) {
      if (unlike) scale_rows(truss);
      const Mat G = dense_rows(truss);
      LeastMultipliers least;
      least.factorise(truss.bodies, truss.rows, rank_tolerance_at(0));
      EXPECT_EQ(least.dependent(), truss.redundant);
      const Vec any = some_multipliers(truss.rows), wanted = least_by_the_whole(G, G.transpose() * any);
      Vec y = any;
      least.minimise(y);
      EXPECT_LE((y - wanted).norm(), (unlike ? 1e-9 : 1e-12) * any.norm());
      EXPECT_LE((G.transpose() * (y - any)).norm(), 1e-13 * G.norm() * any.norm()) << "the forces stay";
      Vec again = y;
      least.minimise(again);
      EXPECT_LE((again - y).norm(), 1e-13 * y.norm());
    }
}

// Rows of one mechanism from 963 to 1005: by the fronts beside the dense solution of the whole.
TEST(LeastMultipliers, AreTheSameByEveryRouteOnBothSidesOf1000Rows) {
  for (const int units : {23, 24}) {
    const Truss truss = Truss::prismatic_mast(units, 1, 0.3);
    SparseMassKkt kkt;
    ASSERT_TRUE(kkt.factorise(truss.bodies, truss.rows, SparseMassKkt::Metric::mass));
    Vec x, y;
    ASSERT_TRUE(kkt.solve(truss.bodies, truss.b, truss.c, x, y));
    kkt.minimise_norm(truss.bodies, y);
    const Mat G = dense_rows(truss);
    Vec f = truss.b;
    add_mass_times(truss.bodies, -1, x, f);
    EXPECT_LE((y - least_by_the_whole(G, f)).norm(), 1e-9 * y.norm()) << truss.rows << " rows";
  }
}

}  // namespace
}  // namespace trammel::numerics
