// Problems of the test harness posed as systems, and a few that only these tests need.
#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <trammel/testing/measurements.hpp>

namespace trammel::test {

// A problem with its System; used as one.
class Posed {
 public:
  explicit Posed(Problem problem) : problem_(std::move(problem)), system_(problem_.system()) {}
  operator System&() { return *system_; }
  System* operator->() { return system_.get(); }

  State start() const { return problem_.solution(0); }
  State exact(double t) const { return problem_.solution(t); }
  // The consistent state there.
  State at(double t, const Vec& q, const Vec& v) {
    State s{t, q, v, {}, {}};
    system_->move_to(t, q, v);
    system_->accelerate({}, s.a, s.lambda);
    return s;
  }

 private:
  Problem problem_;
  std::unique_ptr<System> system_;
};

// q_i'' = -omega_i^2 q_i - 2 mu q_i', from q = 1, v = 0.
inline Problem oscillators(std::vector<double> frequencies, double mu = 0) {
  const Vec omega = Eigen::Map<Vec>(frequencies.data(), Eigen::Index(frequencies.size()));
  Problem p;
  p.name = "oscillators";
  p.M = Mat::Identity(omega.size(), omega.size());
  p.force = [=](double, const Vec& q, const Vec& v) -> Vec {
    return -(omega.array().square() * q.array()).matrix() - 2 * mu * v;
  };
  p.tangent = [=](const Blend& c, const Vec&, const Vec&) -> Mat {
    return (c.c_k * omega.array().square() + c.c_d * 2 * mu).matrix().asDiagonal();
  };
  p.exact = [=](double t, Vec& q, Vec& v) {
    q = Vec::Ones(omega.size()), v = Vec::Zero(omega.size());
    for (Eigen::Index i = 0; i < omega.size() && t != 0; ++i) {  // w = 0 without a frequency: the start only
      const double w = std::sqrt(omega[i] * omega[i] - mu * mu), e = std::exp(-mu * t);
      q[i] = e * (std::cos(w * t) + mu / w * std::sin(w * t));
      v[i] = -e * (w + mu * mu / w) * std::sin(w * t);
    }
  };
  return p;
}

// 1 kg sliding to the right at 1 m/s on the plane y = 0 with friction mu and nothing that presses it, `above` the
// plane. The start only.
inline Problem sliding(double mu, double above) {
  Problem p;
  p.name = "sliding";
  p.closed_form = false;
  p.M = Mat::Identity(2, 2);
  p.force = [](double, const Vec&, const Vec&) -> Vec { return Vec::Zero(2); };
  p.rows = [mu](double, const Vec& q, const Vec&) -> Problem::Rows {
    return {q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1), Eigen::RowVector2d(-mu, 1)};
  };
  p.exact = [above](double, Vec& q, Vec& v) { q = Eigen::Vector2d(0, above), v = Eigen::Vector2d(1, 0); };
  return p;
}

// The pendulum with its rod taken off.
inline Problem flight() {
  Problem p = problems::pendulum_with_rod();
  p.rows = {};
  return p;
}

// One coordinate of unit mass under a force, from q = start at rest. The start only.
inline Problem particle(std::function<Vec(double, const Vec&, const Vec&)> force, double start = 0) {
  Problem p;
  p.name = "particle";
  p.closed_form = false;
  p.M = Mat::Ones(1, 1);
  p.force = std::move(force);
  p.exact = [start](double, Vec& q, Vec& v) { q = Vec::Constant(1, start), v = Vec::Zero(1); };
  return p;
}

// Nothing moves: nv = 0.
inline Problem nothing() {
  Problem p;
  p.name = "nothing";
  p.M = Mat(0, 0);
  p.force = [](double, const Vec&, const Vec&) { return Vec(0); };
  p.exact = [](double, Vec& q, Vec& v) { q = v = Vec(0); };
  return p;
}

}  // namespace trammel::test
