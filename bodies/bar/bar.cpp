// A straight rigid rod in natural coordinates, its two end points, in the plane or in space.
//
//     q = (x_1, x_2)          M = m/6 [2 1; 1 2] + diag(m_1, m_2), each entry times the identity     constant
//     g = (d . d / L - L) / 2 = 0,   d = x_2 - x_1        its own row [m]: |d| - L near 0, of unit gradient
//     g_dot = d . (v_2 - v_1) / L,   gamma = -|v_2 - v_1|^2 / L
//
// m [kg] uniform along the rod, m_1, m_2 [kg] points at its ends, L [m]. A marker at the fraction s is x = (1 - s) x_1
// + s x_2. The row's multiplier [N] is the mean tension. No term depends on velocity, which is the advantage of natural
// coordinates.
//
// Two points have no orientation: markers have the world's axes, which do not turn with the bar. Moments on them, and
// joints and forces that hold or measure their axes, are refused (NeedsOrientation). Forces at points off the ends do
// turn the bar. Source: J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994,
// sections 2.1.3 and 4.2.
#include <array>
#include <cmath>

#include <trammel/body.hpp>
#include <trammel/linear_rows.hpp>
#include <trammel/observed_units.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Bar : Body,
             ExactTangent,
             ReactionDerivative,
             Constrained,
             LinearMarkers,
             Observed,
             ObservedUnits,
             Drawn,
             HasMomentum {
  // Data of every evaluation, next to each other in memory.
  Space space_ = Space::planar;
  double L_ = 0;
  Eigen::Vector2d weight_;  // [kg] part of the mass at each end, for gravity
  Vec3 gravity_;

  double mass_ = 0;
  std::optional<double> length_;
  Vec3 from_ = Vec3::Zero(2), to_ = Vec3::Zero(2), from_velocity_ = Vec3::Zero(2), to_velocity_ = Vec3::Zero(2);
  std::vector<double> end_masses_;
  Named<double> more_markers_;

  void prepare(const World& world) override {
    space_ = world.space;
    gravity_ = world.gravity;
    set_masses();
    L_ = length_ ? *length_ : (to_ - from_).stableNorm();
    if (!(L_ > 0)) throw ParameterError("to", "the bar has length 0: \"to\" is where \"from\" is");
    if (!std::isnormal(L_ * L_))
      throw ParameterError(length_ ? "length" : "to",
                           "the bar is too short or too long for its length to be squared; expected 1.5e-154 m to "
                           "1.3e154 m");
    names_ = {"from", "to", "mid"};
    at_ = {0, 1, 0.5};
    for (const auto& [name, at] : more_markers_) names_.push_back(name), at_.push_back(at);
    if (space_ == Space::planar) observables_.push_back("angle");
  }

  Coordinates coordinates() const override { return Coordinates::flat(2 * dim()); }
  void initial(Out q, Out v) const override {
    q << from_, to_;
    v << from_velocity_, to_velocity_;
  }

  void mass(double, In, Matrix& M) const override { add_mass(1, M); }
  bool mass_is_constant() const override { return true; }
  void force(double, In, In, Out f) const override {
    f.head(dim()) += weight_(0) * gravity_;
    f.tail(dim()) += weight_(1) * gravity_;
  }
  Energy energy(double, In q, In v) const override {
    const Vec3 v_1 = v.head(dim()), v_2 = v.tail(dim());
    const double T = m_(0, 0) * v_1.squaredNorm() + 2 * m_(0, 1) * v_1.dot(v_2) + m_(1, 1) * v_2.squaredNorm();
    return {.kinetic = T / 2, .potential = -gravity_.dot(weight_(0) * q.head(dim()) + weight_(1) * q.tail(dim()))};
  }

  std::span<const std::string> markers() const override { return names_; }
  void motion(int marker, double, In q, In v, Motion& motion) const override {
    const double s = at_[std::size_t(marker)];
    const int n = dim(), twist = twist_size(space_);
    if (motion.J.cols() != 2 * n || motion.J.rows() != twist || motion.J(0, 0) != 1 - s || motion.J(0, n) != s)
      prepare_motion(s, motion);
    motion.x = (1 - s) * q.head(n) + s * q.tail(n);
    motion.V.head(n) = (1 - s) * v.head(n) + s * v.tail(n);
  }

  int row_count() const override { return 1; }
  void own_rows(double, In q, In v, BodyRows& rows) const override {
    const int n = dim();
    const Vec3 d = q.tail(n) - q.head(n), d_dot = v.tail(n) - v.head(n);
    // (|d| - L)(|d| + L)/(2 L) keeps the digits that d . d - L^2 would lose.
    const double length = d.norm();
    rows.g(0) = (length - L_) * (length + L_) / (2 * L_);
    rows.G.row(0).head(n) = -d.transpose() / L_;
    rows.G.row(0).tail(n) = d.transpose() / L_;
    rows.gamma(0) = -d_dot.squaredNorm() / L_;
  }
  void add_own_rows_derivative(double, In, In lambda, double c, Matrix& S) const override {
    const double k = c * lambda(0) / L_;
    for (int i = 0, n = dim(); i < n; ++i)
      S.add(i, i, k), S.add(i, n + i, -k), S.add(n + i, i, -k), S.add(n + i, n + i, k);
  }

  // Gravity is uniform and nothing turns: the tangent is the mass alone; the generalised force of a wrench is
  // independent of q.
  void add_tangent(double, In, In, In, Blend c, Matrix& S) const override { add_mass(c.c_m, S); }
  void add_reaction_derivative(int, double, In, const Wrench&, double, Matrix&) const override {}

  std::span<const std::string> observables() const override { return observables_; }
  std::string_view unit(int observable) const override { return observable == 0 ? "m" : "rad"; }
  double observe(int observable, double, In q, In) const override {
    const Vec3 d = q.tail(dim()) - q.head(dim());
    return observable == 0 ? d.norm() : std::atan2(d(1), d(0));
  }
  void shape(double, In q, Mat& points) const override {
    points.resize(dim(), 2);
    points << q.head(dim()), q.tail(dim());
  }

  Momentum momentum(double, In q, In v) const override {
    const int n = dim();
    Momentum all{.mass = m_.sum(), .linear = weight_(0) * v.head(n) + weight_(1) * v.tail(n), .angular = {}};
    all.angular.setZero(rotations(space_));
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const Vec3 x = q.segment(i * n, n), u = v.segment(j * n, n);
        const int first = space_ == Space::planar ? 2 : 0;  // in the plane only the component along its normal
        for (int k = first; k < 3; ++k)
          all.angular(k - first) += m_(i, j) * (x((k + 1) % 3) * u((k + 2) % 3) - x((k + 2) % 3) * u((k + 1) % 3));
      }
    return all;
  }

 private:
  // The constant data of a marker.
  void prepare_motion(double s, Motion& motion) const {
    const int n = dim(), twist = twist_size(space_);
    motion.R = Mat3::Identity(n, n);
    motion.angle = 0;
    motion.V = motion.bias = Vec6::Zero(twist);
    motion.dofs.resize(std::size_t(2 * n));
    motion.J.setZero(twist, 2 * n);
    for (int i = 0; i < 2 * n; ++i) motion.dofs[std::size_t(i)] = i;
    for (int i = 0; i < n; ++i) motion.J(i, i) = 1 - s, motion.J(i, n + i) = s;
  }

  int dim() const { return dimension(space_); }

  void set_masses() {
    if (end_masses_.size() == 1) end_masses_.push_back(end_masses_[0]);
    if (end_masses_.empty()) end_masses_ = {0, 0};
    if (end_masses_.size() != 2)
      throw ParameterError("end_masses", "expected one number for both ends, or two: [at from, at to]");
    m_ << 2, 1, 1, 2;
    m_ *= mass_ / 6;
    m_.diagonal() += Eigen::Vector2d(end_masses_[0], end_masses_[1]);
    weight_ = m_.rowwise().sum();
    if (mass_ == 0 && !(end_masses_[0] > 0 && end_masses_[1] > 0))
      throw ParameterError("mass", "a bar without mass needs a point with mass at both ends: \"end_masses\"");
  }
  void add_mass(double c, Matrix& M) const {
    const int n = dim();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < n; ++k) M.add(i * n + k, j * n + k, c * m_(i, j));
  }

  Eigen::Matrix2d m_;  // by end points
  std::vector<std::string> names_, observables_ = {"length"};
  std::vector<double> at_;  // by marker
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::body<Bar>("bar", "straight rigid rod by its end points, planar or spatial")
        .source("J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994")
        .markers("from, to, mid, and those of \"markers\"")
        .observables("length; in the plane angle")
        .parameter("mass", &Bar::mass_, {.unit = "kg", .min = 0, .required = true, .doc = "uniform along the bar"})
        .parameter("from", &Bar::from_, {.unit = "m", .required = true, .doc = "first end at the start"})
        .parameter("to", &Bar::to_, {.unit = "m", .required = true, .doc = "second end at the start"})
        .parameter("from_velocity", &Bar::from_velocity_, {.unit = "m/s", .doc = "of the first end at the start"})
        .parameter("to_velocity", &Bar::to_velocity_, {.unit = "m/s", .doc = "of the second end at the start"})
        .parameter("length", &Bar::length_,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "the distance of from and to if left out"})
        .parameter("end_masses", &Bar::end_masses_,
                   {.unit = "kg", .min = 0, .doc = "of points at the ends: one number for both, or two"})
        .parameter("markers", &Bar::more_markers_,
                   {.doc = "more markers: name and fraction of the way from \"from\" to \"to\""}))
