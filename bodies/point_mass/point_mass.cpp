// A point with mass, in the plane or in space.
//
//     q = x,   m x'' = f        x [m] world axes, m [kg]
//
// It has no orientation: moments on it, and joints and forces that hold or measure axes of its marker, are refused
// (NeedsOrientation). Point masses tied by `distance` joints are a body in natural coordinates (Garcia de Jalon, Bayo
// 1994).
#include <array>

#include <trammel/body.hpp>
#include <trammel/linear_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct PointMass : Body, ExactTangent, ReactionDerivative, LinearMarkers, Drawn, HasMomentum {
  double mass_ = 0;
  Vec3 position_ = Vec3::Zero(2), velocity_ = Vec3::Zero(2);

  void prepare(const World& world) override {
    space_ = world.space;
    gravity_ = world.gravity;
  }

  Coordinates coordinates() const override { return Coordinates::flat(dim()); }

  void initial(Out q, Out v) const override {
    q = position_;
    v = velocity_;
  }

  void mass(double, In, Matrix& M) const override { add_mass(1, M); }
  bool mass_is_constant() const override { return true; }
  void force(double, In, In, Out f) const override { f += mass_ * gravity_; }

  Energy energy(double, In q, In v) const override {
    return {.kinetic = 0.5 * mass_ * v.squaredNorm(), .potential = -mass_ * gravity_.dot(q)};
  }

  std::span<const std::string> markers() const override { return names_; }

  void motion(int, double, In q, In v, Motion& motion) const override {
    motion.x = q;
    motion.R = Mat3::Identity(dim(), dim());
    motion.angle = 0;
    motion.V = Vec6::Zero(twist_size(space_));
    motion.V.head(dim()) = v;
    motion.bias = Vec6::Zero(twist_size(space_));
    motion.dofs.resize(std::size_t(dim()));
    for (int i = 0; i < dim(); ++i) motion.dofs[std::size_t(i)] = i;
    motion.J.setIdentity(twist_size(space_), dim());
  }

  // Gravity is uniform and nothing turns: the tangent is the mass alone; the generalised force of a wrench is
  // independent of q.
  void add_tangent(double, In, In, In, Blend c, Matrix& S) const override { add_mass(c.c_m, S); }
  void add_reaction_derivative(int, double, In, const Wrench&, double, Matrix&) const override {}

  void shape(double, In q, Mat& points) const override { points = q; }

  Momentum momentum(double, In q, In v) const override {
    Momentum all{.mass = mass_, .linear = mass_ * v, .angular = {}};
    const Vec3& p = all.linear;
    if (space_ == Space::planar)
      all.angular = Vec3::Constant(1, q(0) * p(1) - q(1) * p(0));
    else
      all.angular = Eigen::Vector3d(q).cross(Eigen::Vector3d(p));
    return all;
  }

 private:
  int dim() const { return dimension(space_); }
  void add_mass(double c, Matrix& M) const {
    for (int i = 0; i < dim(); ++i) M.add(i, i, c * mass_);
  }

  Space space_ = Space::planar;
  Vec3 gravity_;
  std::array<std::string, 2> names_ = {"point", "com"};  // two names of one marker
};

}  // namespace

TRAMMEL_PLUGIN(trammel::body<PointMass>("point_mass", "point with mass, planar or spatial")
                   .source("J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994")
                   .markers("point, com: two names of the same point")
                   .parameter("mass", &PointMass::mass_,
                              {.unit = "kg", .min = 0, .above_min = true, .required = true, .doc = "mass"})
                   .parameter("position", &PointMass::position_, {.unit = "m", .doc = "at the start"})
                   .parameter("velocity", &PointMass::velocity_, {.unit = "m/s", .doc = "at the start"}))
