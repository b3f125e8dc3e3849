// A patch of surface: a T-mesh with a weighted control point at every anchor, and the shapes it can start from.
//
// Rings, cylinders and spheres are exact up to the largest arc of one rational cubic; longer arcs are splines
// (planar_curve.hpp). They are made of as few elements as possible and then refined, which keeps the surface.
#pragma once

#include <Eigen/Geometry>

#include "tspline_plate/mesh/planar_curve.hpp"
#include "tspline_plate/mesh/refinement_operator.hpp"

namespace trammel::plate {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // one row a control point, in the order of the anchors [m]

struct ControlNet {
  TMesh mesh;
  Eigen::VectorXd weights;
  Points points;
};

// Position and orientation of a shape: columns are its x, y and z axis.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

// All on the unit square of parameters. Angles [rad] are about the frame's z axis, from its x axis; u (ring: v) runs
// along the arc. `knots` are those of the arc from - to, if it is longer than one rational cubic; latitudes span at
// most `largest_arc`.
using Knots = std::span<const double>;
ControlNet rectangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& along_u, const Eigen::Vector3d& along_v);
ControlNet ring(const Frame& frame, double inner, double outer, double from, double to, Knots knots = {});
ControlNet cylinder(const Frame& frame, double radius, double length, double from, double to, Knots knots = {});
ControlNet sphere(const Frame& frame, double radius, double from, double to, double south, double north,
                  Knots knots = {});

// The same surface on a finer mesh of the same parameters.
ControlNet refined(const ControlNet& net, const TMesh& fine);

}  // namespace trammel::plate
