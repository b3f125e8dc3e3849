// The flexible connecting rod of Simeon's slider-crank: a floating frame at its left end and four given modes.
//
//     r = o + R(phi) (x L + u, w),   u = 4x(1-x) q3 + x(2x-1) q4,   w = sin(pi x) q1 + sin(2 pi x) q2,   x in [0, 1]
//     z = (o, phi, q)    o [m] world axes, phi [rad], q [m]
//
// Kinetic energy, with E the turn by 90 degrees, s(q) = s_0 + S q the first moment and J(q) = J_0 + 2 c.q + q.M q:
//     T = m |o'|^2/2 + o' . R (phi' E s + S q') + J phi'^2/2 + phi' (b + B^T q) . q' + q' . M q'/2,      B = -B^T
// which gives the mass matrix below and the velocity terms of `force`; -K q are the elastic forces.
// The longitudinal block of M is 15 times the consistent one, as published: this is part of the benchmark.
// Source: B. Simeon, Modelling a flexible slider crank mechanism by a mixed system of DAEs and PDEs, Math. Modelling of
// Systems 2 (1996) 1-18; Test Set for IVP Solvers, slider crank.
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include <trammel/body.hpp>
#include <trammel/observed_units.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;
using std::numbers::pi;

struct SliderCrankRod : Body, Observed, ObservedUnits, Drawn {
  double length = 0.3, width = 0.008, height = 0.008, density = 7870, youngs_modulus = 2e11, inertia = 0.0045339259;
  Vec3 position = Vec3::Zero(2), velocity = Vec3::Zero(2);
  double angle = 0, angular_velocity = 0;
  std::vector<double> modes, mode_rates;

  void prepare(const World& world) override {
    if (world.space != Space::planar)
      throw ParameterError("type", "slider_crank_rod is planar; this scene is spatial. Set \"space\": \"planar\"");
    if (world.gravity.stableNorm() > 0)
      throw ParameterError("type", "the benchmark's rod knows no gravity; this scene has some");
    for (auto [name, values] : {std::pair{"modes", &modes}, std::pair{"mode_rates", &mode_rates}}) {
      if (values->empty()) values->assign(4, 0.0);
      if (values->size() != 4) throw ParameterError(name, "expected four numbers, q1 to q4");
    }
    m_ = density * width * height * length;
    const double k = youngs_modulus * width * height / length, slender = height / length, p2 = pi * pi, p3 = p2 * pi;
    M_ << 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 8, 1, 0, 0, 1, 2;
    K_ << p2 * p2 / 24 * slender * slender, 0, 0, 0, 0, p2 * p2 * 2 / 3 * slender * slender, 0, 0,  //
        0, 0, 16.0 / 3, -8.0 / 3, 0, 0, -8.0 / 3, 7.0 / 3;
    B_ << 0, 0, -16 / p3, 8 / p3 - 1 / pi, 0, 0, 0, 1 / (2 * pi), 16 / p3, 0, 0, 0, 1 / pi - 8 / p3, -1 / (2 * pi), 0,
        0;
    S_ << 0, 0, 2.0 / 3, 1.0 / 6, 2 / pi, 0, 0, 0;
    c_ << 0, 0, 1.0 / 3, 1.0 / 6;
    b_ << 1 / pi, -1 / (2 * pi), 0, 0;
    M_ *= m_, K_ *= k, B_ *= m_, S_ *= m_, c_ *= m_ * length, b_ *= m_ * length;
  }

  Coordinates coordinates() const override { return Coordinates::flat(7); }
  void initial(Out q, Out v) const override {
    q << position, angle, Vector4d(modes.data());
    v << velocity, angular_velocity, Vector4d(mode_rates.data());
  }

  void mass(double, In z, Matrix& target) const override {
    const At at(*this, z);
    Eigen::Matrix<double, 7, 7> full;
    full.topLeftCorner<2, 2>() = m_ * Matrix2d::Identity();
    full.block<2, 1>(0, 2) = at.R * turned(at.s);
    full.block<2, 4>(0, 3) = at.R * S_;
    full(2, 2) = inertia + 2 * c_.dot(at.q) + at.q.dot(M_ * at.q);
    full.block<1, 4>(2, 3) = (b_ + B_.transpose() * at.q).transpose();
    full.bottomRightCorner<4, 4>() = M_;
    full.triangularView<Eigen::StrictlyLower>() = full.transpose();
    target.add(0, 0, Mat(full));
  }

  void force(double, In z, In v, Out f) const override {
    const At at(*this, z);
    const double omega = v(2);
    const Vector4d q_dot = v.tail<4>(), pull = c_ + M_ * at.q;
    f.head<2>() += at.R * (omega * omega * at.s - 2 * omega * turned(S_ * q_dot));
    f(2) -= 2 * omega * pull.dot(q_dot);
    f.tail<4>() += 2 * omega * B_ * q_dot + omega * omega * pull - K_ * at.q;
  }

  Energy energy(double t, In z, In v) const override {
    Mat full = Mat::Zero(7, 7);
    Matrix target = Matrix::onto(full);
    mass(t, z, target);
    const Vector4d q = z.tail<4>();
    return {.kinetic = 0.5 * v.dot(full * v), .elastic = 0.5 * q.dot(K_ * q)};
  }

  std::span<const std::string> markers() const override { return names_; }

  // The ends: w vanishes there, and u = 0 or q4.
  void motion(int marker, double, In z, In v, Motion& motion) const override {
    const At at(*this, z);
    const double u = marker == 0 ? 0 : length + z(6), u_dot = marker == 0 ? 0 : v(6), omega = v(2);
    const Vector2d along = at.R.col(0), across = at.R.col(1);
    motion.x = z.head<2>() + u * along;
    motion.R = at.R;
    motion.angle = z(2);
    motion.V.resize(3);
    motion.V << v.head<2>() + u_dot * along + omega * u * across, omega;
    motion.bias.resize(3);
    motion.bias << 2 * omega * u_dot * across - omega * omega * u * along, 0;
    motion.dofs.assign({0, 1, 2, 6});
    motion.J.setIdentity(3, 4);
    motion.J.col(2).head<2>() = u * across;
    motion.J.col(3) << (marker == 0 ? Vector2d(0, 0) : along), 0;
  }

  std::span<const std::string> observables() const override { return observables_; }
  double observe(int i, double, In z, In v) const override { return i < 5 ? z(2 + i) : v(i - 3); }
  std::string_view unit(int i) const override {
    if (i == 0) return "rad";
    if (i == 5) return "rad/s";
    return i < 5 ? "m" : "m/s";
  }

  void shape(double, In z, Mat& points) const override {
    constexpr int steps = 20;
    const At at(*this, z);
    points.resize(2, steps + 1);
    for (int k = 0; k <= steps; ++k) {
      const double x = double(k) / steps;
      const double u = 4 * x * (1 - x) * z(5) + x * (2 * x - 1) * z(6);
      const double w = std::sin(pi * x) * z(3) + std::sin(2 * pi * x) * z(4);
      points.col(k) = z.head<2>() + at.R * Vector2d(x * length + u, w);
    }
  }

 private:
  struct At {
    At(const SliderCrankRod& rod, In z) : q(z.tail<4>()), s(rod.S_ * q) {
      s.x() += rod.m_ * rod.length / 2;
      const double c = std::cos(z(2)), sine = std::sin(z(2));
      R << c, -sine, sine, c;
    }
    Vector4d q;
    Vector2d s;
    Matrix2d R;
  };
  static Vector2d turned(const Vector2d& r) { return {-r.y(), r.x()}; }

  double m_ = 0;
  Matrix4d M_, K_, B_;
  Eigen::Matrix<double, 2, 4> S_;
  Vector4d c_, b_;
  std::vector<std::string> names_ = {"pin", "tip"};
  std::vector<std::string> observables_ = {"angle",   "q1",      "q2",      "q3",     "q4", "angular_velocity",
                                           "q1_rate", "q2_rate", "q3_rate", "q4_rate"};
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::body<SliderCrankRod>("slider_crank_rod",
                                  "flexible rod of Simeon's slider-crank benchmark: frame and four modes")
        .source("B. Simeon, Math. Modelling of Systems 2 (1996) 1-18; Test Set for IVP Solvers, slider crank")
        .markers("pin, tip")
        .observables("angle, q1, q2, q3, q4, angular_velocity, q1_rate, q2_rate, q3_rate, q4_rate")
        .parameter("length", &SliderCrankRod::length, {.unit = "m", .min = 0, .above_min = true, .doc = "L"})
        .parameter("width", &SliderCrankRod::width, {.unit = "m", .min = 0, .above_min = true, .doc = "of the section"})
        .parameter("height", &SliderCrankRod::height,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "of the section, in the plane"})
        .parameter("density", &SliderCrankRod::density, {.unit = "kg/m^3", .min = 0, .above_min = true, .doc = "rho"})
        .parameter("youngs_modulus", &SliderCrankRod::youngs_modulus,
                   {.unit = "Pa", .min = 0, .above_min = true, .doc = "E"})
        .parameter("inertia", &SliderCrankRod::inertia,
                   {.unit = "kg m^2", .min = 0, .above_min = true, .doc = "J_0 about the left end"})
        .parameter("position", &SliderCrankRod::position, {.unit = "m", .doc = "of the left end at the start"})
        .parameter("velocity", &SliderCrankRod::velocity, {.unit = "m/s", .doc = "of the left end at the start"})
        .parameter("angle", &SliderCrankRod::angle, {.unit = "rad", .doc = "phi at the start"})
        .parameter("angular_velocity", &SliderCrankRod::angular_velocity, {.unit = "rad/s", .doc = "phi' at the start"})
        .parameter("modes", &SliderCrankRod::modes, {.unit = "m", .doc = "q1 to q4 at the start; 0 if left out"})
        .parameter("mode_rates", &SliderCrankRod::mode_rates,
                   {.unit = "m/s", .doc = "their rates at the start; 0 if left out"}))
