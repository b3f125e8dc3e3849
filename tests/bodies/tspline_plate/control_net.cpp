#include "tspline_plate/mesh/control_net.hpp"

#include <gtest/gtest.h>

#include "tspline_plate/conditions/edge.hpp"

namespace trammel::plate {
namespace {

Eigen::Vector3d at(const ControlNet& net, double u, double v) {
  const TsplineBasis basis(net.mesh, net.weights);
  ShapeValues s;
  const int cell = basis.cell_at(u, v);
  basis.evaluate(cell, u, v, s);
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  const auto& functions = basis.cells()[std::size_t(cell)].functions;
  for (std::size_t f = 0; f < functions.size(); ++f)
    r += s.R(Eigen::Index(f)) * net.points.row(functions[f]).transpose();
  return r;
}

template <class Claim>
void everywhere(Claim claim) {
  for (int i = 0; i <= 7; ++i)
    for (int j = 0; j <= 7; ++j) claim(i / 7.0, j / 7.0);
}

std::vector<double> fine_knots(int n) {
  std::vector<double> knots;
  for (int i = 0; i <= n; ++i) knots.push_back(double(i) / n);
  return knots;
}

Frame tilted() {
  return {Eigen::Vector3d(1, 2, 3), Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix()};
}

TEST(ControlNet, CurvedShapesAreExactBeforeAndAfterRefinement) {
  const TMesh fine = TMesh::uniform(3, 4);
  const Frame f = tilted();
  const auto local = [&](const Eigen::Vector3d& r) -> Eigen::Vector3d { return f.axes.transpose() * (r - f.origin); };
  for (bool refine : {false, true}) {
    const auto net = [&](const ControlNet& n) { return refine ? refined(n, fine) : n; };
    const ControlNet a = net(ring(f, 1, 2, 0.2, 1.9)), b = net(cylinder(f, 3, 5, 0, 2.5)),
                     c = net(sphere(f, 2, 0, 1.5, 0, 1.2));
    everywhere([&](double u, double v) {
      EXPECT_NEAR(local(at(a, u, v)).norm(), 1 + u, 1e-14);
      EXPECT_NEAR(local(at(b, u, v)).head<2>().norm(), 3, 1e-14);
      EXPECT_NEAR(local(at(b, u, v)).z(), 5 * v, 1e-14);
      EXPECT_NEAR(local(at(c, u, v)).norm(), 2, 1e-14);
    });
  }
}

// Spline interpolation of order 4: r^(4) h^4 / 384 at the middle of a piece, h = 2 pi / n.
TEST(ControlNet, FullCirclesAreSplinesOfFourthOrder) {
  for (int n : {12, 24, 48}) {
    const TMesh fine = TMesh::uniform(n, 2);
    const ControlNet net = refined(cylinder({}, 3, 5, 0, 2 * M_PI, fine_knots(n)), fine);
    double off = 0;
    for (int i = 0; i <= 4 * n; ++i)
      off = std::max(off, std::abs(at(net, i / (4.0 * n), 0.3).head<2>().norm() / 3 - 1));
    const double expected = std::pow(2 * M_PI / n, 4) / 384;
    EXPECT_LT(off, 1.2 * expected) << n;
    EXPECT_GT(off, 0.3 * expected) << n;
  }
}

TEST(ControlNet, FullCirclesOfTooFewPiecesAreRefused) {
  EXPECT_THROW(cylinder({}, 3, 5, 0, 2 * M_PI, fine_knots(3)), std::invalid_argument);
  EXPECT_NO_THROW(cylinder({}, 3, 5, 0, 2 * M_PI, fine_knots(4)));
}

TEST(ControlNet, RectanglesAreParametrisedEvenly) {
  const ControlNet net = refined(rectangle({1, 0, 0}, {2, 0, 0}, {0, 3, 1}), TMesh::uniform(5, 2));
  everywhere(
      [&](double u, double v) { EXPECT_LT((at(net, u, v) - Eigen::Vector3d(1 + 2 * u, 3 * v, v)).norm(), 1e-14); });
}

TEST(Elimination, HoldsDirectionsTiesAndNothingTwice) {
  Elimination e(6);
  e.hold(1);
  e.hold({{0, 1}, {2, -1}});     // u_2 = u_0
  e.hold({{2, 1}, {0, -1}});     // again
  e.hold({{3, 0.6}, {4, 0.8}});  // u_4 = -0.75 u_3
  e.hold({{1, 5}});              // again
  e.finish();
  EXPECT_EQ(e.kept(), (std::vector<int>{0, 3, 5}));
  Vec u(6);
  e.expand(Vec(Eigen::Vector3d(1, 2, 3)), u);
  EXPECT_LT((u - (Vec(6) << 1, 0, 1, 2, -1.5, 3).finished()).norm(), 1e-15);
}

TEST(Elimination, RestrictsForcesByTheTranspose) {
  Elimination e(4);
  e.hold({{0, 1}, {1, 1}, {3, 2}});
  e.finish();
  const Vec q = Vec(Eigen::Vector3d(0.3, -2, 5)), f = (Vec(4) << 1, 2, 3, 4).finished();
  Vec u(4), g = Vec::Zero(3);
  e.expand(q, u);
  e.restrict(f, g);
  EXPECT_NEAR(g.dot(q), f.dot(u), 1e-14);
}

TEST(Edge, RowsOfTheBorderAreTwoAndPaired) {
  TMesh mesh = TMesh::uniform(3, 4);
  mesh.cross(std::vector<Box<double>>{mesh.parameters(mesh.elements()[0])});
  const TsplineBasis basis(mesh);
  for (const Edge& edge : edges) {
    const EdgeRows r = rows(basis, edge);
    ASSERT_EQ(r.edge.size(), r.second.size());
    for (std::size_t k = 0; k < r.edge.size(); ++k)
      EXPECT_EQ(basis.anchors()[std::size_t(r.edge[k])].at[std::size_t(1 - edge.direction)],
                basis.anchors()[std::size_t(r.second[k])].at[std::size_t(1 - edge.direction)]);
  }
  EXPECT_EQ(rows(basis, edges[0]).edge.size(), 8u);  // 7 and the line that reaches the border
}

TEST(Edge, SymmetryKeepsTheSlopeAndThePlane) {
  const ControlNet net = refined(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), TMesh::uniform(2, 2));
  const TsplineBasis basis(net.mesh, net.weights);
  Elimination e(3 * basis.size());
  hold_edge({basis, net.points}, edges[0], "symmetric", e);
  e.finish();
  EXPECT_EQ(e.coordinates(), 3 * 25 - 5 - 2 * 5);
  const EdgeRows r = rows(basis, edges[0]);
  EXPECT_TRUE(e.terms(3 * r.edge[1]).empty());
  EXPECT_EQ(e.terms(3 * r.second[1] + 2).front().component, e.terms(3 * r.edge[1] + 2).front().component);
}

}  // namespace
}  // namespace trammel::plate
