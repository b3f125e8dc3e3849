// The beam's markers, observables and outline: the motion of single points of its axis.
#include <cmath>

#include "beam.hpp"

namespace trammel::beam {

AssumedModeBeam::Point AssumedModeBeam::point(const PointShape& shape, In q) const {
  const int N = N_;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_;
  Point at{shape.X0, 0, 0, {}};
  for (int i = 0; i < n_axial_; ++i) at.X += shape.phi_x(i) * A[i];
  for (int i = 0; i < N; ++i) {
    at.Y += shape.phi_y(i) * B[i];
    at.slope += shape.slope_y(i) * B[i];
  }
  if (coupling != Coupling::full || N == 0) return at;
  combine(padded(N), N, Rows{shape.H.data(), padded(N)}, B, at.p);
  for (int i = 0; i < N; ++i) at.X -= 0.5 * B[i] * at.p[i];
  return at;
}

namespace {

// Gives the members of a motion their sizes at its first use.
void set_sizes(int n, Motion& motion) {
  if (int(motion.dofs.size()) == n) return;
  motion.dofs.resize(std::size_t(n));
  for (int i = 0; i < n; ++i) motion.dofs[std::size_t(i)] = i;
  motion.J.setZero(3, n);
  motion.x.resize(2), motion.R.resize(2, 2), motion.V.resize(3), motion.bias.resize(3);
}

}  // namespace

// With the coupling none the kinetic energy is that of the undeformed beam, but a marker follows the deformed one.
void AssumedModeBeam::motion(int marker, double, In q, In v, Motion& motion) const {
  const PointShape& shape = marker_shapes_[std::size_t(marker)];
  const int N = N_;
  const Point at = point(shape, q);
  const double *Ad = v.data() + i_A_, *Bd = v.data() + i_B_;
  const double w = omega(v), angle_now = theta(q), c = std::cos(angle_now), s = std::sin(angle_now);
  const Eigen::Vector2d o = origin(q);
  set_sizes(n_, motion);
  motion.x << o(0) + c * at.X - s * at.Y, o(1) + s * at.X + c * at.Y;
  motion.angle = angle_now + std::atan(at.slope);
  const double turned_c = std::cos(motion.angle), turned_s = std::sin(motion.angle);
  motion.R << turned_c, -turned_s, turned_s, turned_c;

  const double tilt = 1 / (1 + at.slope * at.slope);  // d(atan slope)/d slope
  double ud_x = 0, ud_y = 0, slope_rate = 0, bending = 0;
  const auto column = [&](int j, double J1, double J2, double turn) {
    motion.J(0, j) = c * J1 - s * J2;
    motion.J(1, j) = s * J1 + c * J2;
    motion.J(2, j) = turn;
  };
  if (i_o_ >= 0) motion.J(0, i_o_) = motion.J(1, i_o_ + 1) = 1;
  if (i_theta_ >= 0) column(i_theta_, -at.Y, at.X, 1);
  for (int i = 0; i < n_axial_; ++i) {
    column(i_A_ + i, shape.phi_x(i), 0, 0);
    ud_x += shape.phi_x(i) * Ad[i];
  }
  for (int i = 0; i < N; ++i) {
    const double phi = shape.phi_y(i), slope = shape.slope_y(i);
    column(i_B_ + i, -at.p[i], phi, tilt * slope);
    ud_x -= at.p[i] * Bd[i];
    ud_y += phi * Bd[i];
    slope_rate += slope * Bd[i];
    if (coupling != Coupling::full) continue;
    bending += shape.H(i, i) * Bd[i] * Bd[i];
    for (int j = 0; j < i; ++j) bending += 2 * shape.H(i, j) * Bd[i] * Bd[j];
  }
  const double V1 = ud_x - w * at.Y, V2 = ud_y + w * at.X;
  motion.V << c * V1 - s * V2, s * V1 + c * V2, w + tilt * slope_rate;
  if (i_o_ >= 0) motion.V.head<2>() += v.segment<2>(i_o_);
  const double b1 = -bending - 2 * w * ud_y - w * w * at.X, b2 = 2 * w * ud_x - w * w * at.Y;
  motion.bias << c * b1 - s * b2, s * b1 + c * b2, -2 * at.slope * tilt * tilt * slope_rate * slope_rate;
}

// The derivative of J^T F by q, with F = (force, moment) fixed in the world; the force in the beam's axes is b, with
// db/dtheta = (b_2, -b_1).
void AssumedModeBeam::add_reaction_derivative(int marker, double, In q, const Wrench& F, double c, Matrix& S) const {
  const PointShape& shape = marker_shapes_[std::size_t(marker)];
  const Point at = point(shape, q);
  const double angle_now = theta(q), cosine = std::cos(angle_now), sine = std::sin(angle_now);
  const double b1 = cosine * F(0) + sine * F(1), b2 = -sine * F(0) + cosine * F(1);
  const auto symmetric = [&](int i, int j, double value) {
    S.add(i, j, c * value);
    S.add(j, i, c * value);
  };
  if (i_theta_ >= 0) {
    S.add(i_theta_, i_theta_, c * (-at.Y * b2 - at.X * b1));
    for (int i = 0; i < n_axial_; ++i) symmetric(i_theta_, i_A_ + i, shape.phi_x(i) * b2);
    for (int i = 0; i < N_; ++i) symmetric(i_theta_, i_B_ + i, -at.p[i] * b2 - shape.phi_y(i) * b1);
  }
  const double tilt = 1 / (1 + at.slope * at.slope), turning = -2 * at.slope * tilt * tilt * F(2);
  for (int i = 0; i < N_; ++i)
    for (int j = 0; j < N_; ++j) {
      double value = turning * shape.slope_y(i) * shape.slope_y(j);
      if (coupling == Coupling::full) value -= shape.H(i, j) * b1;
      S.add(i_B_ + i, i_B_ + j, c * value);
    }
}

double AssumedModeBeam::observe(int observable, double, In q, In v) const {
  switch (observable) {
    case 0:
      return theta(q);
    case 1:
      return omega(v);
    case 2:
      return point(marker_shapes_[1], q).X - hub_radius - length;
    case 3:
      return point(marker_shapes_[1], q).Y;
    default:
      break;
  }
  const int i = observable - 4, modes = n_axial_ + N_;  // A and B follow each other in q, like their names
  return i < modes ? q(i_A_ + i) : v(i_A_ + i - modes);
}

std::string_view AssumedModeBeam::unit(int observable) const {
  const std::string& name = observable_names_[std::size_t(observable)];
  if (name == "angle") return "rad";
  if (name == "angular_velocity") return "rad/s";
  return name.find("rate") != name.npos ? "m/s" : "m";
}

void AssumedModeBeam::shape(double, In q, Mat& points) const {
  const Eigen::Vector2d o = origin(q);
  const double c = std::cos(theta(q)), s = std::sin(theta(q));
  points.resize(2, Eigen::Index(outline_shapes_.size()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Point at = point(outline_shapes_[std::size_t(k)], q);
    points.col(k) << o(0) + c * at.X - s * at.Y, o(1) + s * at.X + c * at.Y;
  }
}

}  // namespace trammel::beam
