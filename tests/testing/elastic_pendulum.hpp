// A body for tests of the checks: a point of mass m on a damped spring from the origin, correct unless a fault is set.
//
//     q = (r, theta), x = r (sin theta, -cos theta), e = x/r, M = diag(m, m r^2)
//     f_r = m r theta'^2 + m g cos(theta) - k (r - L) - c r',   f_theta = -2 m r r' theta' - m g r sin(theta)
#pragma once

#include <cmath>

#include <trammel/body.hpp>

namespace trammel::test {

enum class BodyDefect {
  none,
  asymmetric_mass,
  negative_mass,
  mass_claims_to_be_constant,
  kinetic_energy_without_a_half,
  force_makes_energy,
  damper_supplies,
  force_overwrites,
  two_markers_of_one_name,
  motion_leaves_the_bias,
  velocity_turns_the_other_way,
  jacobian_has_a_wrong_sign,
  bias_without_coriolis,
  tangent_without_damping,
  reaction_derivative_without_radius,
  starts_nowhere,
  shape_comes_and_goes,
};

class ElasticPendulum : public Body, public ExactTangent, public ReactionDerivative, public Observed, public Drawn {
 public:
  explicit ElasticPendulum(BodyDefect defect) : defect_(defect) {}

  Coordinates coordinates() const override { return Coordinates::flat(2); }
  void initial(Out q, Out v) const override {
    q << (has(BodyDefect::starts_nowhere) ? std::nan("") : 1.2), 0.5;
    v.setZero();
    if (has(BodyDefect::starts_nowhere)) q(1) = 0.5;
  }
  void mass(double, In q, Matrix& M) const override {
    const double sign = has(BodyDefect::negative_mass) ? -1 : 1;
    M.add(0, 0, m);
    M.add(1, 1, sign * m * q(0) * q(0));
    if (has(BodyDefect::asymmetric_mass)) M.add(0, 1, 0.01), M.add(1, 0, -0.01);  // v^T M v does not see it
  }
  bool mass_is_constant() const override { return has(BodyDefect::mass_claims_to_be_constant); }
  void force(double, In q, In v, Out f) const override {
    if (has(BodyDefect::force_overwrites)) f.setZero();
    const double coriolis = has(BodyDefect::force_makes_energy) ? -1.9 : -2;
    f(0) += m * q(0) * v(1) * v(1) + m * g * std::cos(q(1)) - k * (q(0) - L) - c * v(0);
    f(1) += coriolis * m * q(0) * v(0) * v(1) - m * g * q(0) * std::sin(q(1));
  }
  Energy energy(double, In q, In v) const override {
    const double kinetic = (m * v(0) * v(0) + m * std::pow(q(0) * v(1), 2)) / 2;
    return {.kinetic = has(BodyDefect::kinetic_energy_without_a_half) ? 2 * kinetic : kinetic,
            .potential = -m * g * q(0) * std::cos(q(1)),
            .elastic = k * std::pow(q(0) - L, 2) / 2};
  }
  Power power(double, In, In v) const override {
    const double lost = c * v(0) * v(0);
    if (has(BodyDefect::damper_supplies)) return {.supplied = -2 * lost, .dissipated = -lost};
    return {.dissipated = lost};
  }

  std::span<const std::string> markers() const override { return names_; }
  void motion(int, double, In q, In v, Motion& motion) const override {
    const double s = std::sin(q(1)), c_ = std::cos(q(1)), turn = has(BodyDefect::velocity_turns_the_other_way) ? -1 : 1;
    const Eigen::Vector2d e(s, -c_), n(c_, s);
    const bool reused = motion.J.size() > 0;
    motion.x = q(0) * e;
    motion.R = Eigen::Matrix2d{{c_, -s}, {s, c_}};
    motion.angle = q(1);
    motion.dofs.assign({0, 1});
    motion.J = Jac::Zero(3, 2);
    motion.J.topRows<2>() << e, q(0) * n;
    motion.J(2, 1) = turn;
    motion.V = motion.J * v;
    if (has(BodyDefect::jacobian_has_a_wrong_sign)) motion.J(2, 1) = -1;
    const double coriolis = has(BodyDefect::bias_without_coriolis) ? 1 : 2;
    if (reused && has(BodyDefect::motion_leaves_the_bias)) return;
    motion.bias = Vec6::Zero(3);
    motion.bias.head<2>() = coriolis * v(0) * v(1) * n - q(0) * v(1) * v(1) * e;
  }

  void add_tangent(double, In q, In v, In a, Blend b, Matrix& S) const override {
    const double s = std::sin(q(1)), co = std::cos(q(1)), r = q(0),
                 damping = has(BodyDefect::tangent_without_damping) ? 0 : c;
    S.add(0, 0, b.c_m * m + b.c_d * damping + b.c_k * (k - m * v(1) * v(1)));
    S.add(0, 1, -b.c_d * 2 * m * r * v(1) + b.c_k * m * g * s);
    S.add(1, 0, b.c_d * 2 * m * r * v(1) + b.c_k * (2 * m * r * a(1) + 2 * m * v(0) * v(1) + m * g * s));
    S.add(1, 1, b.c_m * m * r * r + b.c_d * 2 * m * r * v(0) + b.c_k * m * g * r * co);
  }
  void add_reaction_derivative(int, double, In q, const Wrench& F, double factor, Matrix& S) const override {
    const Eigen::Vector2d e(std::sin(q(1)), -std::cos(q(1))), n(-e.y(), e.x());
    const double across = factor * F.head<2>().dot(n), along = factor * F.head<2>().dot(e);
    S.add(0, 1, across);
    S.add(1, 0, across);
    S.add(1, 1, has(BodyDefect::reaction_derivative_without_radius) ? -along : -q(0) * along);
  }

  std::span<const std::string> observables() const override { return observables_; }
  double observe(int, double, In q, In) const override { return q(0) - L; }
  void shape(double, In q, Mat& points) const override {
    points = Mat::Zero(2, has(BodyDefect::shape_comes_and_goes) && q(0) > 1.2 ? 3 : 2);
    points.col(1) = q(0) * Eigen::Vector2d(std::sin(q(1)), -std::cos(q(1)));
  }

 private:
  bool has(BodyDefect defect) const { return defect_ == defect; }

  static constexpr double m = 1.3, g = 9.81, k = 40, c = 0.6, L = 1;
  BodyDefect defect_;
  std::vector<std::string> names_ = {"tip", has(BodyDefect::two_markers_of_one_name) ? "tip" : "end"};
  std::vector<std::string> observables_ = {"stretch"};
};

}  // namespace trammel::test
