// Problems on which the kit measures integrators beside those of trammel/testing/problems.hpp, and systems that fail.
#pragma once

#include <limits>

#include <trammel/testing/problems.hpp>

#include "testing/kit/subject.hpp"

namespace trammel::kit {

constexpr double pendulum_omega = 3.132;  // [rad/s] sqrt(9.81/1 m)

// Their numbers vary with the seed, within ranges over which the claims hold alike.
Problem some_oscillator(const Subject& s);
Problem some_pendulum(const Subject& s);
Problem some_pendulum_of_varying_mass(const Subject& s);
Problem some_rod(const Subject& s, std::vector<double> row_weights = {1});
Problem some_wind(const Subject& s);
Problem some_turning_wire(const Subject& s);
Problem some_top(const Subject& s);
Problem any_pendulum(const Subject& s);  // with its rod where the method takes rows

// q_i'' = -omega_i^2 q_i, from q = 1 at rest. The start only.
Problem springs(std::vector<double> frequencies);
// One coordinate of unit mass under a force, from q = 0 at rest. The start only.
Problem particle(std::function<Vec(double, const Vec&, const Vec&)> force);
// Two masses in the plane on the ends of a spring, which turn, move and breathe; they know their motions as one rigid
// body. The start only.
Problem some_spring_pair(const Subject& s);
// The pendulum with its rod taken off. The start only.
Problem flight(const Problem& rod);
Problem nothing();  // nv = 0

// The same motion, t_0 later.
Problem shifted(Problem problem, double t_0);

// Forwards to a system, counts what is asked, and answers the n-th request for forces, accelerations or corrections
// with what no method can use.
class Failing final : public System {
 public:
  enum class How { beyond_range, not_a_number, singular };
  Failing(System& sound, How how) : sound_(sound), how_(how) {}
  void fail_at(int n) { left_ = n; }
  bool has_failed() const { return left_ < 0; }

  Sizes sizes() const override { return sound_.sizes(); }
  void rate(const Vec& q, const Vec& v, Vec& q_dot) const override { sound_.rate(q, v, q_dot); }
  void normalise(Vec& q) const override { sound_.normalise(q); }
  void retract(const Vec& q, const Vec& dq, Vec& q_new) const override { sound_.retract(q, dq, q_new); }
  void difference(const Vec& q1, const Vec& q0, Vec& dq) const override { sound_.difference(q1, q0, dq); }
  void move_to(double t, const Vec& q, const Vec& v) override {
    ++evaluations;
    sound_.move_to(t, q, v);
  }
  const Vec& f() override;
  const Vec& g() override { return sound_.g(); }
  const Vec& g_dot() override { return sound_.g_dot(); }
  void add_mass_times(double c, const Vec& a, Vec& r) override { sound_.add_mass_times(c, a, r); }
  void add_reaction(double c, const Vec& lambda, Vec& r) override { sound_.add_reaction(c, lambda, r); }
  void add_rows_times(double c, const Vec& x, Vec& rc) override { sound_.add_rows_times(c, x, rc); }
  void add_rows_force(double c, const Vec& mu, Vec& r) override { sound_.add_rows_force(c, mu, r); }
  Energy energy() override { return sound_.energy(); }
  void accelerate(Stabilisation s, Vec& a, Vec& lambda) override;
  void factorise(Blend b, const Vec& a, const Vec& lambda, Factors kept) override;
  [[nodiscard]] bool correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors kept) override;

  long long evaluations = 0;      // at a point, and factorisations
  int iterations_factorised = 0;  // with c_d or c_k: what only an implicit method asks for

 private:
  bool fails() { return left_ >= 0 && left_-- == 0; }
  double poison() const { return how_ == How::beyond_range ? 1e200 : std::numeric_limits<double>::quiet_NaN(); }

  System& sound_;
  How how_;
  int left_ = std::numeric_limits<int>::min();  // evaluations before the failure
  Vec f_;
};

}  // namespace trammel::kit
