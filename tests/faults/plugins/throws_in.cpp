// Components of each kind that throw in the call that "in" names, from a given time on: whom does the error name?
#include <array>
#include <stdexcept>
#include <string>

#include <trammel/body.hpp>
#include <trammel/contact.hpp>
#include <trammel/force.hpp>
#include <trammel/friction.hpp>
#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Fault {
  std::string in;  // a method of the component's interfaces
  void call(const char* name) const {
    if (in == name) throw std::runtime_error("thrown on purpose");
  }
};

// A point mass in the plane, with every ability that the equations of motion use.
struct ThrowingBody : Fault, Body, ExactTangent, ReactionDerivative {
  void prepare(const World& world) override { gravity_ = world.gravity; }
  Coordinates coordinates() const override { return Coordinates::flat(2); }
  void initial(Out q, Out v) const override { q.setZero(), v.setZero(); }
  void mass(double, In, Matrix& M) const override {
    call("mass");
    for (int i = 0; i < 2; ++i) M.add(i, i, 1.0);
  }
  void force(double, In, In, Out f) const override {
    call("force");
    f += gravity_;
  }
  Energy energy(double, In q, In v) const override {
    call("energy");
    return {0.5 * v.squaredNorm(), -gravity_.dot(q), 0};
  }
  Power power(double, In, In) const override {
    call("power");
    return {};
  }
  std::span<const std::string> markers() const override { return markers_; }
  void motion(int, double, In q, In v, Motion& motion) const override {
    call("motion");
    motion.x = q;
    motion.R = Mat3::Identity(2, 2);
    motion.angle = 0;
    motion.V = Vec6::Zero(3);
    motion.V.head(2) = v;
    motion.bias = Vec6::Zero(3);
    motion.dofs = {0, 1};
    motion.J = Jac::Identity(3, 2);
  }
  void add_tangent(double, In, In, In, Blend c, Matrix& S) const override {
    call("add_tangent");
    for (int i = 0; i < 2; ++i) S.add(i, i, c.c_m);
  }
  void add_reaction_derivative(int, double, In, const Wrench&, double, Matrix&) const override {
    call("add_reaction_derivative");
  }

 private:
  Vec3 gravity_;
  std::array<std::string, 1> markers_ = {"point"};
};

// B stays at the height of A.
struct ThrowingJoint : Fault, Joint {
  int row_count(Space) const override { return 1; }
  void rows(double, const Motion& A, const Motion& B, Rows& rows) const override {
    call("rows");
    rows.g(0) = B.x(1) - A.x(1);
    rows.H_A(0, 1) = -1, rows.H_B(0, 1) = 1;
  }
};

struct ThrowingForce : Fault, Force {
  void wrench(double, const Motion&, const Motion&, Wrench&, Wrench&) const override { call("wrench"); }
  double potential(double, const Motion&, const Motion&) const override {
    call("potential");
    return 0;
  }
  Power power(double, const Motion&, const Motion&) const override {
    call("power");
    return {};
  }
};

struct ThrowingContact : Fault, ContactForce {
  double normal(double gap, double rate, double) const override {
    call("normal");
    if (rate == 0) call("normal at rest");  // which only the balance of energy asks for
    return gap < 0 ? -1e4 * gap : 0;
  }
  double potential(double gap) const override {
    call("potential");
    return gap < 0 ? 5e3 * gap * gap : 0;
  }
  Slope slope(double gap, double, double) const override {
    call("slope");
    return {.by_gap = gap < 0 ? -1e4 : 0.0, .by_rate = 0};
  }
};

struct ThrowingFriction : Fault, SmoothFriction {
  double ratio(double slip) const override {
    call("ratio");
    return 0.1 * slip;
  }
  double slope(double) const override {
    call("slope");
    return 0.1;
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::body<ThrowingBody>("throwing_body", "point mass that throws")
                   .source("none")
                   .parameter("in", &ThrowingBody::in, {.doc = "the call"}),
               trammel::joint<ThrowingJoint>("throwing_joint", "row that throws")
                   .source("none")
                   .parameter("in", &ThrowingJoint::in, {.doc = "the call"}),
               trammel::force<ThrowingForce>("throwing_force", "force that throws")
                   .source("none")
                   .parameter("in", &ThrowingForce::in, {.doc = "the call"}),
               trammel::contact<ThrowingContact>("throwing_contact", "contact law that throws")
                   .source("none")
                   .parameter("in", &ThrowingContact::in, {.doc = "the call"}),
               trammel::friction<ThrowingFriction>("throwing_friction", "friction law that throws")
                   .source("none")
                   .parameter("in", &ThrowingFriction::in, {.doc = "the call"}))
