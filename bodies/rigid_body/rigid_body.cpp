// A planar rigid body in the coordinates of its centre of mass.
//
//     q = (x, y, theta)      m x'' = f_x,   m y'' = f_y,   I theta'' = m_z
//
// x, y [m] of the centre of mass and theta [rad] of the body's x axis, counter-clockwise and counting full turns; mass
// m [kg], inertia I [kg m^2] about the centre of mass. A marker at r in body axes sits at x + rho, rho = R(theta) r.
// Source: Shabana, Dynamics of Multibody Systems, planar Cartesian coordinates.
#include <cmath>

#include <trammel/body.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector2d;

// r turned by a quarter, counter-clockwise: omega x r in the plane is omega turned(r).
Vector2d turned(const Vector2d& r) {
  return {-r.y(), r.x()};
}

Eigen::Matrix2d rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return Eigen::Matrix2d{{c, -s}, {s, c}};
}

struct RigidBody : Body, ExactTangent, ReactionDerivative, Observed, Drawn {
  double mass_ = 0, inertia_ = 0;
  Vec3 position_ = Vec3::Zero(2), velocity_ = Vec3::Zero(2);
  double angle_ = 0, angular_velocity_ = 0;
  Named<Vec3> markers_;

  void prepare(const World& world) override {
    if (world.space != Space::planar)
      throw ParameterError("type", "rigid_body is planar; this scene is spatial. Set \"space\": \"planar\"");
    gravity_ = world.gravity;
    names_ = {"com"};
    points_ = {Vector2d::Zero()};
    for (const auto& [name, point] : markers_) {
      if (name == "com") throw ParameterError("markers.com", "\"com\" is built in; give this marker another name");
      names_.push_back(name);
      points_.push_back(point);
    }
  }

  Coordinates coordinates() const override { return Coordinates::flat(3); }

  void initial(Out q, Out v) const override {
    q << position_, angle_;
    v << velocity_, angular_velocity_;
  }

  void mass(double, In, Matrix& M) const override { add_mass(1, M); }
  bool mass_is_constant() const override { return true; }

  void force(double, In, In, Out f) const override { f.head<2>() += mass_ * gravity_; }

  Energy energy(double, In q, In v) const override {
    return {.kinetic = 0.5 * (mass_ * v.head<2>().squaredNorm() + inertia_ * v(2) * v(2)),
            .potential = -mass_ * gravity_.dot(q.head<2>())};
  }

  std::span<const std::string> markers() const override { return names_; }

  void motion(int marker, double, In q, In v, Motion& motion) const override {
    const Eigen::Matrix2d R = rotation(q(2));
    const Vector2d rho = R * points_[std::size_t(marker)];
    const Vector2d arm = turned(rho);
    const double omega = v(2);
    motion.x = q.head<2>() + rho;
    motion.R = R;
    motion.angle = q(2);
    motion.V.resize(3);
    motion.V << v.head<2>() + omega * arm, omega;
    motion.bias.resize(3);
    motion.bias << -omega * omega * rho, 0;
    motion.dofs.assign({0, 1, 2});
    motion.J.setIdentity(3, 3);
    motion.J.topRightCorner<2, 1>() = arm;
  }

  // Gravity is uniform, so only the mass is left.
  void add_tangent(double, In, In, In, Blend c, Matrix& S) const override { add_mass(c.c_m, S); }

  // The moment of F about the centre of mass is turned(rho) . F, and turned(rho)' = -rho.
  void add_reaction_derivative(int marker, double, In q, const Wrench& F, double c, Matrix& S) const override {
    const Vector2d rho = rotation(q(2)) * points_[std::size_t(marker)];
    S.add(2, 2, -c * rho.dot(F.head<2>()));
  }

  std::span<const std::string> observables() const override { return observables_; }
  double observe(int observable, double, In q, In v) const override { return observable == 0 ? q(2) : v(2); }

  // Spokes from the centre of mass to each marker.
  void shape(double, In q, Mat& points) const override {
    const Eigen::Matrix2d R = rotation(q(2));
    points.resize(2, Eigen::Index(2 * points_.size()) - 1);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      points.col(i) = q.head<2>();
      if (i % 2 == 1) points.col(i) += R * points_[std::size_t(i + 1) / 2];
    }
  }

 private:
  void add_mass(double c, Matrix& M) const {
    M.add(0, 0, c * mass_);
    M.add(1, 1, c * mass_);
    M.add(2, 2, c * inertia_);
  }

  Vector2d gravity_ = Vector2d::Zero();
  std::vector<std::string> names_;
  std::vector<Vector2d> points_;  // of the markers, body axes, in the order of names_
  std::vector<std::string> observables_ = {"angle", "angular_velocity"};
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::body<RigidBody>("rigid_body", "planar rigid body: position and angle of its centre of mass")
        .source("A. A. Shabana, Dynamics of Multibody Systems: planar Cartesian coordinates")
        .parameter("mass", &RigidBody::mass_,
                   {.unit = "kg", .min = 0, .above_min = true, .required = true, .doc = "mass"})
        .parameter("inertia", &RigidBody::inertia_,
                   {.unit = "kg m^2", .min = 0, .above_min = true, .required = true, .doc = "about the centre of mass"})
        .parameter("position", &RigidBody::position_, {.unit = "m", .doc = "of the centre of mass at the start"})
        .parameter("angle", &RigidBody::angle_, {.unit = "rad", .doc = "of the body's x axis at the start"})
        .parameter("velocity", &RigidBody::velocity_, {.unit = "m/s", .doc = "of the centre of mass at the start"})
        .parameter("angular_velocity", &RigidBody::angular_velocity_, {.unit = "rad/s", .doc = "at the start"})
        .parameter("markers", &RigidBody::markers_,
                   {.unit = "m", .doc = "named points in body axes; \"com\" always exists"}))
