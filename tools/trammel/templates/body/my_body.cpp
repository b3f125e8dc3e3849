// A particle on a spring and damper to where it started, planar or spatial, to change:
//
//     m x'' = m g - k (x - x_0) - c x'        x [m], world axes
//
//     T = m v^2/2,  U = k |x - x_0|^2/2 - m g . x,  dissipated power c v^2
//
// Its one marker is the particle: x = q, V = v.
#include <trammel/body.hpp>
#include <trammel/linear_rows.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct MyBody final : Body, ExactTangent, ReactionDerivative, LinearMarkers {
  double mass_ = 1, stiffness = 10, damping = 0.5;
  Vec3 position = Vec3::Zero(2), velocity = Vec3::Zero(2);

  void prepare(const World& w) override { world_ = w; }

  Coordinates coordinates() const override { return Coordinates::flat(n()); }
  void initial(Out q, Out v) const override { q = position, v = velocity; }

  void mass(double, In, Matrix& M) const override { add_identity(mass_, M); }
  bool mass_is_constant() const override { return true; }
  void force(double, In q, In v, Out f) const override {
    f += mass_ * world_.gravity - stiffness * (q - position) - damping * v;
  }
  Energy energy(double, In q, In v) const override {
    return {.kinetic = mass_ * v.squaredNorm() / 2,
            .potential = -mass_ * world_.gravity.dot(q),
            .elastic = stiffness * (q - position).squaredNorm() / 2};
  }
  Power power(double, In, In v) const override { return {.dissipated = damping * v.squaredNorm()}; }

  std::span<const std::string> markers() const override { return {&name_, 1}; }
  void motion(int, double, In q, In v, Motion& m) const override {
    m.x = q, m.R = Mat3::Identity(n(), n()), m.angle = 0;
    m.V = m.bias = Vec6::Zero(twist_size(world_.space));
    m.V.head(n()) = v;
    m.J.setIdentity(twist_size(world_.space), n());
    m.dofs.resize(std::size_t(n()));
    for (int i = 0; i < n(); ++i) m.dofs[std::size_t(i)] = i;
  }

  // Optional: without them the framework takes differences.
  void add_tangent(double, In, In, In, Blend c, Matrix& S) const override {
    add_identity(c.c_m * mass_ + c.c_d * damping + c.c_k * stiffness, S);
  }
  void add_reaction_derivative(int, double, In, const Wrench&, double, Matrix&) const override {}  // J is constant

 private:
  int n() const { return dimension(world_.space); }
  void add_identity(double c, Matrix& M) const {
    for (int i = 0; i < n(); ++i) M.add(i, i, c);
  }

  World world_;
  std::string name_ = "point";
};

}  // namespace

TRAMMEL_PLUGIN(trammel::body<MyBody>("my_body", "particle on a spring and damper, to change")
                   .source("Newton's second law")
                   .markers("point")
                   .parameter("mass", &MyBody::mass_, {.unit = "kg", .min = 0, .above_min = true})
                   .parameter("stiffness", &MyBody::stiffness, {.unit = "N/m", .min = 0})
                   .parameter("damping", &MyBody::damping, {.unit = "N s/m", .min = 0})
                   .parameter("position", &MyBody::position, {.unit = "m", .doc = "at the start"})
                   .parameter("velocity", &MyBody::velocity, {.unit = "m/s", .doc = "at the start"}))
