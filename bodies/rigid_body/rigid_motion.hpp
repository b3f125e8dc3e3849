// The equations of a rigid body in the coordinates of its centre of mass, in the plane (D = 2) and in space (D = 3).
//
//     q = (x, theta) or (x, p)     x [m] world axes; theta [rad] counting full turns; p unit quaternion (w, x, y, z)
//     v = (x', omega)              omega [rad/s]: theta', or the angular velocity in body axes
//
//     m x'' = f_x,      I omega' + omega x I omega = m_b          I [kg m^2] about the centre of mass, constant
//
// A marker at r in body axes is at x + rho, rho = R r. With a, the world axes of the rates omega (1, or the columns of
// R),
//     V = (x' + (a omega) x rho, a omega),    bias = ((a omega) x ((a omega) x rho), 0),    J = [I  a x rho; 0  a]
// since a' omega = 0. Sources: Shabana, Dynamics of Multibody Systems (plane); Featherstone, Rigid Body Dynamics
// Algorithms, section 2 (space).
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include <trammel/body.hpp>

namespace trammel::rigid_body {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Rotation in D dimensions: omega x r, r x F and the cross product as a matrix have the sizes of the dimension.
template <int D>
struct Turning;

template <>
struct Turning<2> {
  static constexpr int nq = 1, nv = 1;
  using Rate = Eigen::Matrix<double, 1, 1>;
  using Matrix = Eigen::Matrix<double, 1, 1>;
  static Matrix2d rotation(const double* q) {
    const double c = std::cos(*q), s = std::sin(*q);
    return Matrix2d{{c, -s}, {s, c}};
  }
  static Rate axes(const Matrix2d&) { return Rate::Ones(); }
  static Vector2d cross(const Rate& omega, const Vector2d& r) { return omega(0) * Vector2d(-r.y(), r.x()); }
  static Rate gyroscopic(const Matrix&, const Rate&) { return Rate::Zero(); }
  static Matrix gyroscopic_slope(const Matrix&, const Rate&) { return Matrix::Zero(); }
  // d(R^T (rho x F + M))/d(turn), with F in body axes.
  static Matrix moment_slope(const Vector2d& r, const Vector2d& F, const Rate&) { return Matrix(-r.dot(F)); }
};

template <>
struct Turning<3> {
  static constexpr int nq = 4, nv = 3;
  using Rate = Vector3d;
  using Matrix = Matrix3d;
  // The rotation of p / |p|: the p of a Runge-Kutta stage is off the unit sphere by the error of the stage.
  static Matrix3d rotation(const double* p) {
    return Eigen::Quaterniond(p[0], p[1], p[2], p[3]).normalized().toRotationMatrix();
  }
  static Matrix3d axes(const Matrix3d& R) { return R; }
  static Vector3d cross(const Vector3d& omega, const Vector3d& r) { return omega.cross(r); }
  static Vector3d gyroscopic(const Matrix3d& I, const Vector3d& omega) { return -omega.cross(I * omega); }
  // Its derivative by omega.
  static Matrix3d gyroscopic_slope(const Matrix3d& I, const Vector3d& omega) {
    return tilde(I * omega) - tilde(omega) * I;
  }
  static Matrix3d moment_slope(const Vector3d& r, const Vector3d& F, const Vector3d& M) {
    return tilde(r) * tilde(F) + tilde(M);
  }
  static Matrix3d tilde(const Vector3d& a) {  // tilde(a) b = a x b
    return Matrix3d{{0, -a.z(), a.y()}, {a.z(), 0, -a.x()}, {-a.y(), a.x(), 0}};
  }
};

template <int D>
struct RigidMotion {
  using Turn = Turning<D>;
  using Vector = Eigen::Matrix<double, D, 1>;
  static constexpr int nv = D + Turn::nv;

  double mass;
  typename Turn::Matrix inertia;
  Vector gravity;

  static Eigen::Matrix<double, D, D> rotation(In q) { return Turn::rotation(q.data() + D); }
  typename Turn::Rate omega(In v) const { return v.tail<Turn::nv>(); }

  void add_mass(double c, Matrix& M) const {
    for (int i = 0; i < D; ++i) M.add(i, i, c * mass);
    for (int j = 0; j < Turn::nv; ++j)
      for (int i = 0; i < Turn::nv; ++i) M.add(D + i, D + j, c * inertia(i, j));
  }

  void add_force(In v, Out f) const {
    f.head<D>() += mass * gravity;
    f.tail<Turn::nv>() += Turn::gyroscopic(inertia, omega(v));
  }

  // Gravity is uniform and the inertia constant in body axes: nothing depends on q.
  void add_tangent(In v, Blend c, Matrix& S) const {
    add_mass(c.c_m, S);
    if (D == 2 || c.c_d == 0) return;
    const typename Turn::Matrix slope = Turn::gyroscopic_slope(inertia, omega(v));
    for (int j = 0; j < Turn::nv; ++j)
      for (int i = 0; i < Turn::nv; ++i) S.add(D + i, D + j, -c.c_d * slope(i, j));
  }

  Energy energy(In q, In v) const {
    return {.kinetic = 0.5 * (mass * v.head<D>().squaredNorm() + omega(v).dot(inertia * omega(v))),
            .potential = -mass * gravity.dot(q.head<D>())};
  }

  static void lay_out(Motion& motion) {
    motion.x.resize(D), motion.R.resize(D, D), motion.V.resize(nv), motion.bias.resize(nv);
    motion.dofs.resize(nv);
    for (int i = 0; i < nv; ++i) motion.dofs[std::size_t(i)] = i;
    motion.J.setIdentity(nv, nv);
  }

  void motion(const Vector& r, In q, In v, Motion& motion) const {
    const auto R = rotation(q);
    const auto a = Turn::axes(R);
    const Vector rho = R * r;
    const typename Turn::Rate w = a * omega(v);
    if (motion.J.cols() != nv || motion.x.size() != D) lay_out(motion);
    const Vector swept = Turn::cross(w, rho);
    motion.x.template head<D>() = q.head<D>() + rho;
    motion.R.template topLeftCorner<D, D>() = R;
    if constexpr (D == 2) motion.angle = q(2);
    motion.V.template head<D>() = v.head<D>() + swept;
    motion.V.template segment<Turn::nv>(D) = w;
    motion.bias.template head<D>() = Turn::cross(w, swept);
    motion.bias.template segment<Turn::nv>(D).setZero();
    for (int j = 0; j < Turn::nv; ++j) motion.J.template block<D, 1>(0, D + j) = Turn::cross(a.col(j), rho);
    if constexpr (D == 3) motion.J.template bottomRightCorner<3, 3>() = a;
  }

  void add_reaction_derivative(const Vector& r, In q, const Wrench& F, double c, Matrix& S) const {
    const auto R = rotation(q);
    const Vector force = R.transpose() * F.head<D>();
    const typename Turn::Rate moment = Turn::axes(R).transpose() * F.tail<Turn::nv>();
    const typename Turn::Matrix slope = Turn::moment_slope(r, force, moment);
    for (int j = 0; j < Turn::nv; ++j)
      for (int i = 0; i < Turn::nv; ++i) S.add(D + i, D + j, c * slope(i, j));
  }

  Vector momentum(In v) const { return mass * v.head<D>(); }
  // About the world's origin.
  typename Turn::Rate angular_momentum(In q, In v) const {
    const typename Turn::Rate spin = Turn::axes(rotation(q)) * (inertia * omega(v));
    const Vector x = q.head<D>(), p = momentum(v);
    if constexpr (D == 2)
      return spin + typename Turn::Rate(x(0) * p(1) - x(1) * p(0));
    else
      return spin + x.cross(p);
  }

  // Spokes from the centre of mass to each marker.
  void shape(const std::vector<Vector>& markers, In q, Mat& points) const {
    const auto R = rotation(q);
    points.resize(D, Eigen::Index(2 * markers.size()) - 1);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      points.col(i) = q.head<D>();
      if (i % 2 == 1) points.col(i) += R * markers[std::size_t(i + 1) / 2];
    }
  }
};

}  // namespace trammel::rigid_body
