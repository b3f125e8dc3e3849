// A patch of surface: a T-mesh with a weighted control point at every anchor, and the shapes it can start from.
//
// Circular arcs are one rational cubic each (degree-elevated from the quadratic whose middle weight is cos(angle / 2)), so
// rings, cylinders and spheres are exact. They are made of one element and then refined, which keeps the surface.
// Piegl, Tiller, The NURBS Book, chapter 7.
#pragma once

#include <Eigen/Geometry>

#include "refinement_operator.hpp"

namespace trammel::plate {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // one row a control point, in the order of the anchors [m]

struct ControlNet {
  TMesh mesh;
  Eigen::VectorXd weights;
  Points points;
};

// Where a shape stands: columns are its x, y and z axis.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

inline constexpr double largest_arc = 2.6;  // [rad] of one rational cubic; beyond, its weights differ too much

// All on the unit square of parameters. Angles in rad, about the frame's z axis from its x axis, at most `largest_arc`.
ControlNet rectangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& along_u, const Eigen::Vector3d& along_v);
ControlNet ring(const Frame& frame, double inner, double outer, double from, double to);        // u radial, v angular
ControlNet cylinder(const Frame& frame, double radius, double length, double from, double to);  // u angular, v axial
ControlNet sphere(const Frame& frame, double radius, double from, double to, double south, double north);  // latitudes

// The same surface on a finer mesh of the same parameters.
ControlNet refined(const ControlNet& net, const TMesh& fine);

}  // namespace trammel::plate
