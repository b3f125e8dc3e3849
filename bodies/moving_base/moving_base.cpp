// A body that moves by a given law: a shaken table, a vehicle's frame, the ground in an earthquake. It has no
// coordinates and no mass; joints, forces and contacts at its markers transmit the motion.
//
//     x = r_0(t) + R(t) r,     V_t = (r_0' + omega x rho, omega)
//     bias = (r_0'' + alpha x rho + omega x (omega x rho), alpha)
//
// r_0 = (x, y[, z]) [m] and the angle phi [rad], counter-clockwise (in space: about the fixed axis e), are laws of t
// with exact first and second derivatives; r is a marker's place in the base's axes, rho = R r, omega = phi' e, alpha =
// phi'' e.
#include <cmath>

#include <Eigen/Geometry>

#include <trammel/body.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct MovingBase : Body, Drawn {
  TimeFunction x_, y_, angle_;
  std::optional<TimeFunction> z_;
  std::optional<Vec3> axis_;
  Named<Vec3> markers_;

  void prepare(const World& world) override {
    space_ = world.space;
    if (space_ == Space::planar && z_) throw ParameterError("z", "this scene is planar: a base moves in x and y");
    if (space_ == Space::planar && axis_)
      throw ParameterError("axis", "this scene is planar: a base turns in the plane");
    const bool turns = !angle_.is_constant() || angle_(0) != 0;
    if (space_ == Space::spatial && turns && !axis_)
      throw ParameterError("axis", "missing; in space the angle is about this axis, such as [0, 0, 1]");
    if (axis_) {
      if (!(axis_->norm() > 0)) throw ParameterError("axis", "found the length 0, expected a direction");
      e_ = axis_->normalized();
    }
    names_ = {"origin"};
    points_ = {Vector3d::Zero()};
    for (const auto& [name, point] : markers_) {
      if (name == "origin")
        throw ParameterError("markers.origin", "\"origin\" is built in; give this marker another name");
      names_.push_back(name);
      points_.push_back(in_space(point));
    }
  }

  Coordinates coordinates() const override { return Coordinates::flat(0); }
  void initial(Out, Out) const override {}
  void mass(double, In, Matrix&) const override {}
  bool mass_is_constant() const override { return true; }
  void force(double, In, In, Out) const override {}
  Energy energy(double, In, In) const override { return {}; }
  std::span<const std::string> markers() const override { return names_; }

  void motion(int marker, double t, In, In, Motion& motion) const override {
    const TimeFunction::Jet x = x_.jet(t), y = y_.jet(t), z = z_ ? z_->jet(t) : TimeFunction::Jet{},
                            phi = angle_.jet(t);
    const Matrix3d R = Eigen::AngleAxisd(phi.value, e_).toRotationMatrix();
    const Vector3d rho = R * points_[std::size_t(marker)], omega = phi.rate * e_, alpha = phi.second * e_;
    const Vector3d place = Vector3d(x.value, y.value, z.value) + rho;
    const Vector3d velocity = Vector3d(x.rate, y.rate, z.rate) + omega.cross(rho);
    const Vector3d acceleration =
        Vector3d(x.second, y.second, z.second) + alpha.cross(rho) + omega.cross(omega.cross(rho));
    motion.angle = phi.value;
    if (space_ == Space::planar)
      set_motion<2>(place, R, velocity, omega, acceleration, alpha, motion);
    else
      set_motion<3>(place, R, velocity, omega, acceleration, alpha, motion);
  }

  // Spokes from the origin to each marker.
  void shape(double t, In q, Mat& points) const override {
    points.resize(dimension(space_), Eigen::Index(2 * points_.size()) - 1);
    Motion m;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      motion(i % 2 == 1 ? int(i + 1) / 2 : 0, t, q, q, m);
      points.col(i) = m.x;
    }
  }

 private:
  // Its components in a scene of D dimensions; the plane turns about z.
  template <int D>
  static void set_motion(const Vector3d& place, const Matrix3d& R, const Vector3d& velocity, const Vector3d& omega,
                         const Vector3d& acceleration, const Vector3d& alpha, Motion& motion) {
    constexpr int turns = D == 2 ? 1 : 3, twist = D + turns;
    motion.x.resize(D), motion.R.resize(D, D), motion.V.resize(twist), motion.bias.resize(twist);
    motion.x.head<D>() = place.head<D>();
    motion.R.topLeftCorner<D, D>() = R.topLeftCorner<D, D>();
    motion.V.head<D>() = velocity.head<D>();
    motion.V.tail<turns>() = omega.tail<turns>();
    motion.bias.head<D>() = acceleration.head<D>();
    motion.bias.tail<turns>() = alpha.tail<turns>();
    motion.dofs.clear();
    motion.J.resize(twist, 0);
  }
  static Vector3d in_space(const Vec3& r) { return {r(0), r(1), r.size() == 3 ? r(2) : 0}; }

  Space space_ = Space::planar;
  Vector3d e_ = Vector3d::UnitZ();
  std::vector<std::string> names_;
  std::vector<Vector3d> points_;  // of the markers, base axes, in the order of names_
};

}  // namespace

TRAMMEL_PLUGIN(trammel::body<MovingBase>("moving_base",
                                         "a body that moves by given laws of time and has no coordinates")
                   .source("kinematics of a rigid frame")
                   .markers("origin, and those of \"markers\"")
                   .parameter("x", &MovingBase::x_, {.unit = "m", .doc = "of the origin, a law of t", .derivatives = 2})
                   .parameter("y", &MovingBase::y_, {.unit = "m", .doc = "of the origin, a law of t", .derivatives = 2})
                   .parameter("z", &MovingBase::z_,
                              {.unit = "m", .doc = "in spatial scenes; of the origin, a law of t", .derivatives = 2})
                   .parameter("angle", &MovingBase::angle_,
                              {.unit = "rad", .doc = "of the base's axes, a law of t", .derivatives = 2})
                   .parameter("axis", &MovingBase::axis_,
                              {.doc = "in spatial scenes: the fixed axis that \"angle\" turns about"})
                   .parameter("markers", &MovingBase::markers_,
                              {.unit = "m", .doc = "named points in the base's axes; \"origin\" always exists"}))
