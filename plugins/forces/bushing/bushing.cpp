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

// [rad] Angles below which k and its slope are summed as series: closed forms are differences of large numbers there.
constexpr double series_of_factor = 1e-3, series_of_slope = 0.5;

// J^-T x = x + phi x x / 2 + k phi x (phi x x),  k = 1/a^2 - 1/(2 a tan(a/2)), a = |phi|.
double factor(double a) {
  return a < series_of_factor ? 1.0 / 12 + a * a / 720 : 1 / (a * a) - 1 / (2 * a * std::tan(a / 2));
}
Vector3d inverse_transposed_jacobian(const Vector3d& phi, const Vector3d& x) {
  return x + phi.cross(x) / 2 + factor(phi.norm()) * phi.cross(phi.cross(x));
}
Vector3d inverse_jacobian(const Vector3d& phi, const Vector3d& x) {
  return x - phi.cross(x) / 2 + factor(phi.norm()) * phi.cross(phi.cross(x));
}

// (dk/da)/a
double slope_of_factor(double a) {
  if (const double s = a * a; a < series_of_slope)
    return 1.0 / 360 +
           s * (1.0 / 7560 +
                s * (1.0 / 201600 + s * (1.0 / 5987520 + s * (691.0 / 130767436800 + s * (1.0 / 6227020800)))));
  const double sine = std::sin(a / 2), over_tangent = std::cos(a / 2) / sine;
  return (-2 / (a * a) + over_tangent / (2 * a) + 1 / (4 * sine * sine)) / (a * a);
}
// The change of J^-T x with phi and x.
Vector3d change_of_inverse(const Vector3d& phi, const Vector3d& x, const Vector3d& d_phi, const Vector3d& d_x) {
  const double a = phi.norm();
  const Vector3d twice = d_phi.cross(phi.cross(x)) + phi.cross(d_phi.cross(x));
  return inverse_transposed_jacobian(phi, d_x) + d_phi.cross(x) / 2 + factor(a) * twice +
         slope_of_factor(a) * phi.dot(d_phi) * phi.cross(phi.cross(x));
}

struct Bushing : Force, WrenchTangent, NeedsOrientation, CountsTurns {
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

  void add_wrench_tangent(double, const Motion& A, const Motion& B, PairTangent& K, PairTangent& D) const override {
    const Offset o(A, B, last_phi_);
    const auto n = A.V.size();
    const Vec6 none = Vec6::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vec6 e = Vec6::Unit(n, i);
      add_column(i, A, B, o, {e, none, none, none}, K.AA, K.BA);
      add_column(i, A, B, o, {none, e, none, none}, K.AB, K.BB);
      add_column(i, A, B, o, {none, none, e, none}, D.AA, D.BA);
      add_column(i, A, B, o, {none, none, none, e}, D.AB, D.BB);
    }
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

  // Small twists of the markers' poses and changes of their velocities.
  struct Change {
    Vec6 pose_A, pose_B, V_A, V_B;
  };

  // With F = -R_A (K s + C s') on B:
  //     dF = theta_A x F - R_A (K ds + C ds'),   R_A ds = dd - theta_A x d,  R_A ds' = dw - theta_A x w,  w = R_A s'
  //     dM = theta_A x M - R_A (d(J^-T K_r phi) + C_r domega_r),   dphi = J^-1 R_A^T (theta_B - theta_A)
  void add_column(Eigen::Index i, const Motion& A, const Motion& B, const Offset& o, const Change& by, Mat6& on_A,
                  Mat6& on_B) const {
    const auto dim = A.x.size(), turns = A.V.size() - dim;
    const auto place = [&](const Vec6& twist) { return Vec3(twist.head(dim)); };
    const auto turn = [&](const Vec6& twist) { return Vec3(twist.tail(turns)); };
    const auto in_A = [&](const Vec3& x) { return Vec3(A.R.transpose() * x); };
    const auto from_A = [&](const Vec3& x) { return Vec3(A.R * x); };
    const Vec3 d = B.x - A.x, w = from_A(o.s_dot), theta = turn(by.pose_A);
    const Vec3 F = from_A(-stiffness.cwiseProduct(o.s) - damping.cwiseProduct(o.s_dot));
    const Vec3 dd = place(by.pose_B) - place(by.pose_A);
    const Vec3 dw = place(by.V_B) - place(by.V_A) - turned(turn(A.V), dd) - turned(turn(by.V_A), d);
    const Vec3 ds = in_A(dd - turned(theta, d)), ds_dot = in_A(dw - turned(theta, w));
    const Vec3 dF = turned(theta, F) - from_A(stiffness.cwiseProduct(ds) + damping.cwiseProduct(ds_dot));
    const Vec3 dM = change_of_moment(A, o, turn(by.pose_B) - theta, turn(by.V_B) - turn(by.V_A), theta);
    on_A.col(i).head(dim) -= dF;
    on_B.col(i).head(dim) += dF;
    on_A.col(i).tail(turns) -= dM + moment(dd, F) + moment(d, dF);
    on_B.col(i).tail(turns) += dM;
  }

  Vec3 change_of_moment(const Motion& A, const Offset& o, const Vec3& turn, const Vec3& d_omega,
                        const Vec3& theta) const {
    if (turn.size() == 1) return -K_r_.cwiseProduct(turn) - C_r_.cwiseProduct(d_omega);
    const auto in_A = [&](const Vec3& x) { return Vector3d(A.R.transpose() * x); };
    const Vector3d M = -elastic_moment(o) - C_r_.cwiseProduct(o.omega), d_phi = inverse_jacobian(o.phi, in_A(turn));
    const Vector3d of_rate = in_A(d_omega) - in_A(theta).cross(Vector3d(o.omega));
    const Vector3d K_phi = K_r_.cwiseProduct(o.phi), K_d_phi = K_r_.cwiseProduct(Vec3(d_phi));
    const Vector3d dM_A = -change_of_inverse(o.phi, K_phi, d_phi, K_d_phi) - Vector3d(C_r_).cwiseProduct(of_rate);
    return Vec3(A.R * Vec3(in_A(theta).cross(M) + dM_A));
  }

  static Vec3 turned(const Vec3& turn, const Vec3& x) {
    if (x.size() == 2) return turn(0) * Eigen::Vector2d(-x(1), x(0));
    return Vec3(Vector3d(turn).cross(Vector3d(x)));
  }

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
