// The material points of a body's surface for one contact, sampled patch by patch at first use, once per mesh.
//
//     x_p = X_p + R B q,    v_p = R B v,    Q = sum (R B)^T F_p
#pragma once

#include <optional>
#include <vector>

#include "model/model.hpp"

namespace trammel::model {

class SurfacePoints {
 public:
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;   // one per row
  using OnNodes = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // one per column
  using V3 = Eigen::Vector3d;

  // `sphere_radius`: infinite without a sphere.
  SurfacePoints(const BodyEntry& body, const ForceBySurfacePoints& law, double sphere_radius);

  double half_thickness() const { return body_.surface->half_thickness(); }
  std::size_t patches() const { return patches_.size(); }
  const SurfacePatch& patch(std::size_t i);
  const SurfacePatch& sampled(std::size_t i) const { return *patches_[i]; }
  void bounds(std::size_t i, const Vec& q, V3& low, V3& high) const;  // q of the system, here and below

  Points positions(const SurfacePatch& patch, const Vec& q) const;
  Points velocities(const SurfacePatch& patch, const Vec& v) const;
  // The point as a marker without rotation.
  void motion(const SurfacePatch& patch, Eigen::Index point, const Vec& q, const Vec& v, Motion& motion) const;

  // Adds to f the forces on a patch's nodes; adds to S a matrix between nodes, and one between nodes and `first` +
  // `dofs`.
  void add_force(const SurfacePatch& patch, const OnNodes& forces, Vec& f) const;
  void add_square(const SurfacePatch& patch, const Mat& nodes, Matrix& S) const;
  void add_rows(const SurfacePatch& patch, const Mat& nodes, int first, const std::vector<int>& dofs, Matrix& S) const;
  void add_columns(const SurfacePatch& patch, const Mat& nodes, int first, const std::vector<int>& dofs,
                   Matrix& S) const;

 private:
  Mat of_nodes(const SurfacePatch& patch, const Vec& of_body) const;

  const BodyEntry& body_;
  double spacing_;
  std::vector<std::optional<SurfacePatch>> patches_;
};

}  // namespace trammel::model
