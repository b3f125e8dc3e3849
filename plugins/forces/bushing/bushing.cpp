// An elastic mounting: springs and dampers along and about A's axes connect B to A's frame.
//
//     s = R_A^T (x_B - x_A) [m],     F = -K s - C s'                          on B, in A's axes
//     phi = log(R_A^T R_B) [rad],    M = -J^-T K_r phi - C_r omega_r          planar phi = theta_B - theta_A, J = 1
//     U = (s . K s + phi . K_r phi)/2,    dissipated s' . C s' + omega_r . C_r omega_r
//
// K, C, K_r, C_r diagonal; omega_r = R_A^T (omega_B - omega_A) and phi' = J^-1 omega_r with J the left Jacobian of the
// exponential, so that M is exactly minus the gradient of U. A receives -F at B's position. phi is continued beyond
// half a turn up to a full turn, where its direction is undefined and the run ends; use a hinge with a torsional spring
// for larger angles. Source of J^-1: Barfoot, State Estimation for Robotics, 2017, section 7.1.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>

#include <trammel/counts_turns.hpp>
#include <trammel/force.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/outside_domain.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// J^-T x = x + phi x x / 2 + k phi x (phi x x),  k = 1/a^2 - 1/(2 a tan(a/2)), a = |phi|.
Vector3d inverse_transposed_jacobian(const Vector3d& phi, const Vector3d& x) {
  const double a = phi.norm();
  const double k = a < 1e-3 ? 1.0 / 12 + a * a / 720 : 1 / (a * a) - 1 / (2 * a * std::tan(a / 2));
  return x + phi.cross(x) / 2 + k * phi.cross(phi.cross(x));
}

struct Bushing : Force, NeedsOrientation, CountsTurns {
  Vec3 stiffness = Vec3::Zero(2), damping = Vec3::Zero(2);
  std::vector<double> torsional_stiffness, torsional_damping;

  void prepare(const World& world) override {
    K_r_ = about("torsional_stiffness", torsional_stiffness, world.space);
    C_r_ = about("torsional_damping", torsional_damping, world.space);
    if (stiffness.isZero(0) && damping.isZero(0) && K_r_.isZero(0) && C_r_.isZero(0))
      throw ParameterError("stiffness", "give stiffness, damping, torsional_stiffness or torsional_damping");
  }

  bool needs_orientation(int marker) const override { return marker == 0 || !K_r_.isZero(0) || !C_r_.isZero(0); }

  // Without a torsional spring the angle is not used.
  void follow(const Motion& A, const Motion& B) override {
    if (A.x.size() == 2 || K_r_.isZero(0)) return;
    last_phi_ = Offset(A, B, last_phi_).phi;
    if (last_phi_.norm() >= 2 * std::numbers::pi)
      throw OutsideDomain(
          "B has turned by a full turn against A, which is the limit of a bushing; a hinge with a torsional_spring "
          "counts turns");
  }
  void archive(Archive& a) override {
    Vec phi = last_phi_;
    a("phi", phi);
    last_phi_ = phi;
  }

  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const Offset o(A, B, last_phi_);
    const Vec3 F = A.R * Vec3(-stiffness.cwiseProduct(o.s) - damping.cwiseProduct(o.s_dot));
    const Vec3 M_A = -elastic_moment(o) - C_r_.cwiseProduct(o.omega);
    const Vec3 M = M_A.size() == 1 ? M_A : Vec3(A.R * M_A);
    const Vec3 d = B.x - A.x;
    on_A.head(F.size()) -= F;
    on_B.head(F.size()) += F;
    on_A.tail(M.size()) -= M + moment(d, F);
    on_B.tail(M.size()) += M;
  }

  double potential(double, const Motion& A, const Motion& B) const override {
    const Offset o(A, B, last_phi_);
    return 0.5 * (o.s.dot(stiffness.cwiseProduct(o.s)) + o.phi.dot(K_r_.cwiseProduct(o.phi)));
  }

  Power power(double, const Motion& A, const Motion& B) const override {
    const Offset o(A, B, last_phi_);
    return {.dissipated = o.s_dot.dot(damping.cwiseProduct(o.s_dot)) + o.omega.dot(C_r_.cwiseProduct(o.omega))};
  }

 private:
  // Pose and velocity of B in A's axes.
  struct Offset {
    Vec3 s, s_dot, phi, omega;

    Offset(const Motion& A, const Motion& B, const Vector3d& last_phi) {
      const auto dim = A.x.size(), turns = A.V.size() - dim;
      const Vec3 d = B.x - A.x, d_dot = B.V.head(dim) - A.V.head(dim), relative = B.V.tail(turns) - A.V.tail(turns);
      s = A.R.transpose() * d;
      if (dim == 2) {
        s_dot = A.R.transpose() * Vec3(d_dot - A.V(2) * Eigen::Vector2d(-d(1), d(0)));
        phi = Vec3::Constant(1, B.angle - A.angle);
        omega = relative;
      } else {
        s_dot = A.R.transpose() * Vec3(d_dot - Vec3(Vector3d(A.V.tail<3>()).cross(Vector3d(d))));
        const Eigen::AngleAxisd turn(Matrix3d(A.R.transpose() * B.R));
        phi = Vector3d(CountedAngle(last_phi.dot(turn.axis())).near_last(turn.angle()) * turn.axis());
        omega = A.R.transpose() * relative;
      }
    }
  };

  Vec3 elastic_moment(const Offset& o) const {
    const Vec3 by_phi = K_r_.cwiseProduct(o.phi);
    return by_phi.size() == 1 ? by_phi : Vec3(inverse_transposed_jacobian(o.phi, by_phi));
  }

  static Vec3 moment(const Vec3& d, const Vec3& F) {
    if (d.size() == 2) return Vec3::Constant(1, d(0) * F(1) - d(1) * F(0));
    return Vec3(Vector3d(d).cross(Vector3d(F)));
  }

  static Vec3 about(const char* name, const std::vector<double>& given, Space space) {
    const auto n = std::size_t(rotations(space));
    if (given.empty()) return Vec3::Zero(Eigen::Index(n));
    if (given.size() != n)
      throw ParameterError(name, space == Space::planar ? "expected one number: the scene is planar"
                                                        : "expected three numbers, about A's x, y and z");
    return Vec3(Eigen::Map<const Vec>(given.data(), Eigen::Index(n)));
  }

  Vec3 K_r_, C_r_;
  Vector3d last_phi_ = Vector3d::Zero();
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::force<Bushing>("bushing", "elastic mounting: springs and dampers along and about A's axes")
        .source("diagonal compliance; moment as the gradient of the rotation vector's energy")
        .parameter("stiffness", &Bushing::stiffness, {.unit = "N/m", .min = 0, .doc = "along A's axes"})
        .parameter("damping", &Bushing::damping, {.unit = "N s/m", .min = 0, .doc = "along A's axes"})
        .parameter("torsional_stiffness", &Bushing::torsional_stiffness,
                   {.unit = "N m/rad", .min = 0, .doc = "about A's axes: planar one number, spatial three"})
        .parameter("torsional_damping", &Bushing::torsional_damping,
                   {.unit = "N m s/rad", .min = 0, .doc = "about A's axes: planar one number, spatial three"}))
