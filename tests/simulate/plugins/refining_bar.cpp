// An elastic bar along x that halves its elements during the run: the smallest body whose coordinates are replaced.
//
//     M x'' = -K (x - X),   M, K of linear elements with consistent mass;  x_i [m] node positions, X_i unstressed ones
//
// Linear elements nest: the middle of an element lies on the straight line between its nodes, so the transfer changes
// neither the shape nor the velocity field, and mass, momentum and energies stay to round-off.
#include <array>
#include <limits>
#include <string>

#include <trammel/body.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

// Old nodes keep their values, new ones between them take the mean.
struct Halving : Transfer {
  explicit Halving(const std::string& what) : spoils(what) {}
  std::string spoils;

  void q(In old, Out fresh) const override { halve(old, fresh, spoils == "q"); }
  void v(In old, Out fresh) const override { halve(old, fresh, spoils == "v"); }
  static void halve(In old, Out fresh, bool spoilt) {
    for (Eigen::Index i = 0; i < old.size(); ++i) fresh(2 * i) = old(i);
    for (Eigen::Index i = 0; i + 1 < old.size(); ++i) fresh(2 * i + 1) = 0.5 * (old(i) + old(i + 1));
    if (spoilt) fresh(1) = std::numeric_limits<double>::quiet_NaN();
  }
};

struct RefiningBar : Body, Refinable, HasMomentum {
  int elements = 4;
  double length = 1, mass_ = 1, stiffness = 100, speed = 0, stretch = 0;
  double at_time = std::numeric_limits<double>::infinity();
  std::string at_contact, spoils;

  Coordinates coordinates() const override { return Coordinates::flat(elements + 1); }
  void initial(Out q, Out v) const override {
    for (int i = 0; i <= elements; ++i) q(i) = 1 + (1 + stretch) * length * i / elements;
    v.setConstant(speed);
  }

  void mass(double, In, Matrix& M) const override {
    const double m = mass_ / elements / 6;
    for (int e = 0; e < elements; ++e)
      M.add(e, e, 2 * m), M.add(e, e + 1, m), M.add(e + 1, e, m), M.add(e + 1, e + 1, 2 * m);
  }
  bool mass_is_constant() const override { return true; }
  void force(double, In q, In, Out f) const override {
    for (int e = 0; e < elements; ++e) {
      const double pull = stiffness * (q(e + 1) - q(e) - length / elements) * elements / length;
      f(e) += pull, f(e + 1) -= pull;
    }
  }
  Energy energy(double, In q, In v) const override {
    Energy energy;
    for (int e = 0; e < elements; ++e) {
      const double strain = (q(e + 1) - q(e)) * elements / length - 1;
      energy.elastic += 0.5 * stiffness * strain * strain * length / elements;
      energy.kinetic += mass_ / elements / 6 * (v(e) * v(e) + v(e) * v(e + 1) + v(e + 1) * v(e + 1));
    }
    return energy;
  }
  Momentum momentum(double, In, In v) const override {
    Momentum sum{mass_, Eigen::Vector2d::Zero(), Eigen::Matrix<double, 1, 1>::Zero()};
    for (int e = 0; e < elements; ++e) sum.linear(0) += mass_ / elements * 0.5 * (v(e) + v(e + 1));
    return sum;
  }

  std::span<const std::string> markers() const override { return names_; }
  void motion(int marker, double, In q, In v, Motion& motion) const override {
    const int node = marker == 0 ? 0 : elements;
    motion.x = Eigen::Vector2d(q(node), 0);
    motion.R = Mat3::Identity(2, 2);
    motion.V = Eigen::Vector3d(v(node), 0, 0);
    motion.bias = Vec6::Zero(3);
    motion.dofs = {node};
    motion.J = Eigen::Vector3d(1, 0, 0);
  }

  bool due(double t, In, In, const RefineCause& cause) const override {
    if (refined_) return false;
    return cause.contact.empty() ? t >= at_time : cause.contact == at_contact;
  }
  std::unique_ptr<Transfer> refine(double, In, In, const RefineCause&) override {
    refined_ = true;
    elements *= 2;
    return std::make_unique<Halving>(spoils);
  }
  void archive(Archive& a) override { a("elements", elements), a("refined", refined_); }

 private:
  bool refined_ = false;
  std::array<std::string, 2> names_ = {"left", "right"};
};

}  // namespace

TRAMMEL_PLUGIN(body<RefiningBar>("refining_bar", "elastic bar along x that halves its elements once")
                   .source("linear finite elements")
                   .parameter("elements", &RefiningBar::elements, {.min = 1, .doc = "at the start"})
                   .parameter("stiffness", &RefiningBar::stiffness, {.unit = "N", .min = 0, .doc = "EA"})
                   .parameter("speed", &RefiningBar::speed, {.unit = "m/s", .doc = "along x, at the start"})
                   .parameter("stretch", &RefiningBar::stretch, {.doc = "strain at the start"})
                   .parameter("at_time", &RefiningBar::at_time,
                              {.unit = "s", .doc = "refines at the first step's end from then"})
                   .parameter("at_contact", &RefiningBar::at_contact, {.doc = "refines when this contact closes"})
                   .parameter("spoils", &RefiningBar::spoils, {.doc = "q or v: the refinement gives NaN in it"}))
