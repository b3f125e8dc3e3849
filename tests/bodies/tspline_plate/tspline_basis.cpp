#include "tspline_plate/mesh/tspline_basis.hpp"

#include <random>

#include <gtest/gtest.h>

#include "meshes.hpp"
#include "tspline_plate/mesh/refinement_operator.hpp"

namespace trammel::plate {
namespace {

using test::block;
using test::crossed;

double largest_sum_error(const TsplineBasis& basis) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(0, 1);
  Eigen::VectorXd B;
  double error = 0;
  for (int k = 0; k < 2000; ++k) {
    const double u = in(random), v = in(random);
    basis.blending(basis.cell_at(u, v), u, v, B);
    error = std::max(error, std::abs(B.sum() - 1));
  }
  return error;
}

TEST(TsplineBasis, SumsToOneOnAnalysisSuitableMeshes) {
  for (Closure closure : {Closure::both, Closure::greedy})
    for (const auto& elements : {block(4, 6), test::diagonal})
      EXPECT_LT(largest_sum_error(TsplineBasis(crossed(10, elements, closure))), 4e-15);  // 16 terms of round-off
}

TEST(TsplineBasis, UnitWeightsDoNotSumToOneOnThePapersMesh) {
  const double error = largest_sum_error(TsplineBasis(crossed(10, block(4, 6), Closure::none)));
  EXPECT_GT(error, 1.11e-2);  // found by the reference on its own sample
  EXPECT_LT(error, 1.3e-2);
}

TEST(TsplineBasis, SixteenFunctionsACellOnAnalysisSuitableMeshes) {
  const TsplineBasis basis(crossed(10, test::diagonal, Closure::both));
  for (const BezierCell& cell : basis.cells()) EXPECT_EQ(cell.functions.size(), 16u);
}

TEST(TsplineBasis, DerivativesAgreeWithDifferences) {
  TMesh mesh = crossed(4, {{1, 1}, {1, 2}}, Closure::both);
  Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(int(anchors(mesh).size()), 0.6, 1.7);
  const TsplineBasis basis(mesh, weights);
  const double u = 0.37, v = 0.55, h = 1e-5;
  const int cell = basis.cell_at(u, v);
  const auto at = [&](double x, double y) {
    ShapeValues s;
    basis.evaluate(cell, x, y, s);
    return s;
  };
  const ShapeValues s = at(u, v), east = at(u + h, v), west = at(u - h, v), north = at(u, v + h), south = at(u, v - h);
  const double tolerance = 1e-7;  // differences of step h, third derivatives of order 1e3
  EXPECT_LT((s.R_u - (east.R - west.R) / (2 * h)).norm(), tolerance);
  EXPECT_LT((s.R_v - (north.R - south.R) / (2 * h)).norm(), tolerance);
  EXPECT_LT((s.R_uu - (east.R_u - west.R_u) / (2 * h)).norm(), 10 * tolerance);
  EXPECT_LT((s.R_vv - (north.R_v - south.R_v) / (2 * h)).norm(), 10 * tolerance);
  EXPECT_LT((s.R_uv - (north.R_u - south.R_u) / (2 * h)).norm(), 10 * tolerance);
}

TEST(TsplineBasis, IsTwiceContinuousAcrossLinesAndOnceAcrossDoubleOnes) {
  const std::vector<double> k = {0, 1, 2, 2, 3};
  const TsplineBasis basis(TMesh::tensor(k, k));
  const auto jump = [&](double u) {
    ShapeValues before, behind;
    const double v = 0.4;
    const int left = basis.cell_at(u - 0.1, v), right = basis.cell_at(u, v);
    basis.evaluate(left, u, v, before);
    basis.evaluate(right, u, v, behind);
    std::array<double, 2> result{};
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(basis.size(), 6);
    const auto put = [&](int cell, const ShapeValues& s, int column) {
      const auto& f = basis.cells()[std::size_t(cell)].functions;
      for (std::size_t i = 0; i < f.size(); ++i)
        values.row(f[i]).segment(column, 3) << s.R(Eigen::Index(i)), s.R_u(Eigen::Index(i)), s.R_uu(Eigen::Index(i));
    };
    put(left, before, 0), put(right, behind, 3);
    result[0] = (values.leftCols(2) - values.middleCols(3, 2)).norm();
    result[1] = (values.col(2) - values.col(5)).norm();
    return result;
  };
  EXPECT_LT(jump(1)[0], 1e-14);
  EXPECT_LT(jump(1)[1], 1e-13);
  EXPECT_LT(jump(2)[0], 1e-14);
  EXPECT_GT(jump(2)[1], 1);
}

// Of the Gram matrix; the reference found full rank by collocation on the same meshes.
TEST(TsplineBasis, IsIndependentOnTheMeshesOfTheReference) {
  for (Closure closure : {Closure::none, Closure::both, Closure::greedy})
    for (const auto& elements : {block(4, 6), block(3, 7), test::diagonal})
      EXPECT_GT(independence(TsplineBasis(crossed(10, elements, closure))), 1e-6);
}

TEST(TsplineBasis, RefusesWeightsThatAreNotPositive) {
  EXPECT_THROW(TsplineBasis(TMesh::uniform(1, 1), Eigen::VectorXd::Zero(16)), std::invalid_argument);
  EXPECT_THROW(TsplineBasis(TMesh::uniform(1, 1), Eigen::VectorXd::Ones(15)), std::invalid_argument);
}

}  // namespace
}  // namespace trammel::plate
