// A sphere pressed against the points of a body's surface: the law is asked at every point that the sphere has reached.
//
//     d = x_A - x_p,  l = |d|,  n = d/l,  gap = l - R - h/2,  gap_rate = n . u,  u = v_A - v_p
//     s = u - (n . u) n - R omega_A x n                                       slip of the sphere's skin over the point
//     F = w (N n - ratio(|s|) N s/|s|),  M = -R n x F                         on the sphere, at its centre; -F on the point
//
// R radius, h/2 half the thickness of the plate, w the law's weight of the point, N its answer there. The tangent is exact:
//     dn = P dd/l,  dN = N_gap n . dd + N_rate (n . du + u . dn),  P = 1 - n n^T
//     ds = P du - (n . u) dn - n (u . dn) - R (domega x n + omega x dn)
// The moment of friction about the mid-surface, h/2 times F_t, is left out, as the points have no rotation.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "model/marker_chain.hpp"

namespace trammel::model {

class SurfaceContact {
 public:
  SurfaceContact(const Model& model, const ContactEntry& entry);

  // At one state of both bodies; everything below is there.
  void evaluate(const Motion& sphere, const Vec& q, const Vec& v, double approach_speed);

  const Wrench& on_sphere() const { return on_sphere_; }
  void add_force(Vec& f) const;                        // on the surface's body
  double normal_force() const { return normal_; }      // [N] sum over the points
  double potential() const;                            // [J]
  double damping_power() const { return damping_; }    // [W] lost along the normals
  double friction_power() const { return friction_; }  // [W] lost in sliding
  // S += c_k K + c_d D of minus these forces, but for what a fixed wrench on the sphere does with its marker.
  void add_tangent(MarkerChain& chain, int sphere_slot, double c_k, double c_d, Mat& S) const;

 private:
  using V3 = Eigen::Vector3d;
  using M3 = Eigen::Matrix3d;
  struct Touch {
    std::size_t patch;
    Eigen::Index point;
    double length, gap, rate, weight, N;
    V3 n, u, slip, F;
  };
  using M63 = Eigen::Matrix<double, 6, 3>;
  struct Derivatives {
    M63 by_d, by_u, by_omega;  // of (F, M)
  };

  const SurfacePatch& patch(std::size_t i);
  void touch(std::size_t patch, Eigen::Index point, const V3& d, const V3& u);
  Derivatives derivatives(const Touch& at) const;
  // Positions or velocities of the nodes, one a row.
  Mat of_nodes(const SurfacePatch& patch, const Vec& of_body) const;

  const ContactEntry& entry_;
  const BodyEntry& body_;
  double reach_;
  std::vector<std::optional<SurfacePatch>> patches_;
  std::vector<Touch> touches_;
  V3 omega_ = V3::Zero();
  double approach_ = 0, normal_ = 0, damping_ = 0, friction_ = 0;
  Wrench on_sphere_ = Wrench::Zero(6);
};

}  // namespace trammel::model
