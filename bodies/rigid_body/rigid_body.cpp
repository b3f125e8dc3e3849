// The rigid body as a scene's component: parameters, names, and the equations of rigid_motion.hpp in the scene's space.
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include <trammel/body.hpp>
#include <trammel/observed_units.hpp>
#include <trammel/plugin.hpp>

#include "inertia.hpp"
#include "rigid_motion.hpp"

namespace {

using namespace trammel;
using namespace trammel::rigid_body;

template <int D>
struct Placed {
  RigidMotion<D> equations;
  std::vector<Eigen::Matrix<double, D, 1>> points;  // of the markers, body axes, in the order of the names
};

// Data that every evaluation reads, directly behind the interfaces' pointers in memory, before the parameters.
struct InItsSpace {
  std::variant<Placed<2>, Placed<3>> body_;
};

struct RigidBody : Body,
                   SharedMotion,
                   ExactTangent,
                   ReactionDerivative,
                   Observed,
                   ObservedUnits,
                   Drawn,
                   HasMomentum,
                   InItsSpace,
                   InertiaInput {
  Vec3 position_ = Vec3::Zero(2), velocity_ = Vec3::Zero(2);
  double angle_ = 0;
  std::optional<Vec3> axis_;
  std::optional<std::vector<double>> orientation_, angular_velocity_;
  Named<Vec3> markers_;

  void prepare(const World& world) override {
    space_ = world.space;
    names_ = {"com"};
    for (const auto& [name, point] : markers_) {
      if (name == "com") throw ParameterError("markers.com", "\"com\" is built in; give this marker another name");
      names_.push_back(name);
    }
    const Inertia given = inertia_of(*this, space_);
    if (space_ == Space::planar) {
      if (axis_) throw ParameterError("axis", "this scene is planar: a body turns by \"angle\" alone");
      if (orientation_) throw ParameterError("orientation", "this scene is planar: give \"angle\"");
      body_ = place<2>(given.mass, given.about_com.bottomRightCorner<1, 1>(), world.gravity);
      turn_ = Vec::Constant(1, angle_);
      observables_ = {"angle", "angular_velocity", "momentum_x", "momentum_y", "angular_momentum"};
    } else {
      body_ = place<3>(given.mass, given.about_com, world.gravity);
      turn_ = initial_quaternion();
      observables_ = {
          "omega_x",           "omega_y",    "omega_z",    "quaternion_w", "quaternion_x",       "quaternion_y",
          "quaternion_z",      "momentum_x", "momentum_y", "momentum_z",   "angular_momentum_x", "angular_momentum_y",
          "angular_momentum_z"};
    }
    const auto rates = std::size_t(rotations(space_));
    if (!angular_velocity_) angular_velocity_.emplace(rates, 0.0);
    if (angular_velocity_->size() != rates)
      throw ParameterError("angular_velocity",
                           fmt::format("found {} numbers, expected {}: the scene is {}", angular_velocity_->size(),
                                       rates, space_ == Space::planar ? "planar" : "spatial"));
  }

  Coordinates coordinates() const override {
    return space_ == Space::planar ? Coordinates::flat(3) : Coordinates::flat(3).then_rotation();
  }

  void initial(Out q, Out v) const override {
    q << position_, turn_;
    v << velocity_, Eigen::Map<const Vec>(angular_velocity_->data(), Eigen::Index(angular_velocity_->size()));
  }

  void mass(double, In, Matrix& M) const override {
    std::visit([&](const auto& b) { b.equations.add_mass(1, M); }, body_);
  }
  bool mass_is_constant() const override { return true; }
  void force(double, In, In v, Out f) const override {
    std::visit([&](const auto& b) { b.equations.add_force(v, f); }, body_);
  }
  Energy energy(double, In q, In v) const override {
    return std::visit([&](const auto& b) { return b.equations.energy(q, v); }, body_);
  }

  std::span<const std::string> markers() const override { return names_; }
  void motion(int marker, double, In q, In v, Motion& motion) const override {
    std::visit([&](const auto& b) { b.equations.motion(b.points[std::size_t(marker)], q, v, motion); }, body_);
  }

  void add_tangent(double, In, In v, In, Blend c, Matrix& S) const override {
    std::visit([&](const auto& b) { b.equations.add_tangent(v, c, S); }, body_);
  }
  void add_reaction_derivative(int marker, double, In q, const Wrench& F, double c, Matrix& S) const override {
    std::visit([&](const auto& b) { b.equations.add_reaction_derivative(b.points[std::size_t(marker)], q, F, c, S); },
               body_);
  }

  std::span<const std::string> observables() const override { return observables_; }
  double observe(int observable, double, In q, In v) const override {
    Vec all(Eigen::Index(observables_.size()));
    std::visit(
        [&](const auto& b) {
          const auto p = b.equations.momentum(v);
          const auto L = b.equations.angular_momentum(q, v);
          if (space_ == Space::planar)
            all << q(2), v(2), p, L;
          else
            all << v.tail<3>(), q.tail<4>(), p, L;
        },
        body_);
    return all(observable);
  }

  std::string_view unit(int observable) const override {
    const std::string& name = observables_[std::size_t(observable)];
    if (name == "angle") return "rad";
    if (name.starts_with("angular_momentum")) return "kg m^2/s";
    if (name.starts_with("momentum")) return "kg m/s";
    return name.starts_with("quaternion") ? "1" : "rad/s";
  }

  Momentum momentum(double, In q, In v) const override {
    return std::visit(
        [&](const auto& b) {
          Momentum all{.mass = b.equations.mass, .linear = b.equations.momentum(v), .angular = {}};
          all.angular.resize(rotations(space_));
          all.angular << b.equations.angular_momentum(q, v);
          return all;
        },
        body_);
  }

  void shape(double, In q, Mat& points) const override {
    std::visit([&](const auto& b) { b.equations.shape(b.points, q, points); }, body_);
  }

 private:
  template <int D, class I>
  Placed<D> place(double m, const I& about_com, const Vec3& gravity) const {
    Placed<D> placed{{m, about_com, gravity}, {Eigen::Matrix<double, D, 1>::Zero()}};
    for (const auto& [name, point] : markers_) placed.points.push_back(point);
    return placed;
  }

  Vec initial_quaternion() const {
    if (orientation_) {
      if (axis_ || angle_ != 0) throw ParameterError("orientation", "give either orientation, or axis and angle");
      if (orientation_->size() != 4)
        throw ParameterError("orientation",
                             fmt::format("found {} numbers, expected a quaternion [w, x, y, z]", orientation_->size()));
      const Eigen::Vector4d p(orientation_->data());  // stableNorm of a Vec would read a copy at a wrong alignment
      if (!(p.stableNorm() > 0)) throw ParameterError("orientation", "the quaternion is zero; expected [w, x, y, z]");
      return p.stableNormalized();
    }
    const Vector3d axis = axis_ ? Vector3d(*axis_) : Vector3d::UnitZ();
    if (!(axis.stableNorm() > 0))
      throw ParameterError("axis", "the axis is zero; expected a direction, e.g. [0, 0, 1]");
    Vec p(4);
    p << std::cos(angle_ / 2), std::sin(angle_ / 2) * axis.stableNormalized();
    return p;
  }

  Space space_ = Space::planar;
  Vec turn_;  // of the start: the angle, or the quaternion
  std::vector<std::string> names_, observables_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::body<RigidBody>("rigid_body", "rigid body, planar or spatial, in the coordinates of its centre of mass")
        .source("A. A. Shabana, Dynamics of Multibody Systems (plane); R. Featherstone, Rigid Body Dynamics Algorithms "
                "(space)")
        .markers("com, and those of \"markers\"")
        .observables(
            "angle, angular_velocity, momentum_x, momentum_y, angular_momentum; in space omega_x, omega_y, omega_z "
            "(body axes), quaternion_w, quaternion_x, quaternion_y, quaternion_z, momentum_x, momentum_y, "
            "momentum_z, angular_momentum_x, angular_momentum_y, angular_momentum_z (about the origin)")
        .parameter("mass", &RigidBody::mass_, {.unit = "kg", .min = 0, .above_min = true, .doc = "mass; or a density"})
        .parameter("density", &RigidBody::density_,
                   {.unit = "kg/m^3", .min = 0, .above_min = true, .doc = "of the shape, in place of the mass"})
        .parameter(
            "inertia", &RigidBody::inertia_,
            {.unit = "kg m^2",
             .doc = "about the centre of mass: planar one number; spatial [xx, yy, zz] or [xx, yy, zz, xy, xz, yz] "
                    "in body axes, the products as they stand in the tensor"})
        .parameter(
            "box", &RigidBody::box_,
            {.unit = "m", .min = 0, .above_min = true, .doc = "lengths along the body's x, y and z; gives the inertia"})
        .parameter("cylinder.radius", &RigidBody::cylinder_radius_,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "of a cylinder that gives the inertia"})
        .parameter("cylinder.length", &RigidBody::cylinder_length_,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "of that cylinder"})
        .choice("cylinder.axis", &RigidBody::cylinder_axis_,
                {{"x", InertiaInput::Axis::x}, {"y", InertiaInput::Axis::y}, {"z", InertiaInput::Axis::z}},
                {.doc = "its axis among the body's"})
        .parameter("sphere.radius", &RigidBody::sphere_radius_,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "of a ball that gives the inertia"})
        .parameter("position", &RigidBody::position_, {.unit = "m", .doc = "of the centre of mass at the start"})
        .parameter("angle", &RigidBody::angle_,
                   {.unit = "rad", .doc = "of the body's axes at the start; in space about \"axis\""})
        .parameter("axis", &RigidBody::axis_, {.doc = "spatial: what \"angle\" turns about; [0, 0, 1] if left out"})
        .parameter("orientation", &RigidBody::orientation_,
                   {.doc = "spatial, in place of axis and angle: quaternion [w, x, y, z], normalised here"})
        .parameter("velocity", &RigidBody::velocity_, {.unit = "m/s", .doc = "of the centre of mass at the start"})
        .parameter("angular_velocity", &RigidBody::angular_velocity_,
                   {.unit = "rad/s", .doc = "at the start: planar one number, spatial [x, y, z] in body axes"})
        .parameter("markers", &RigidBody::markers_,
                   {.unit = "m", .doc = "named points in body axes; \"com\" always exists"}))
