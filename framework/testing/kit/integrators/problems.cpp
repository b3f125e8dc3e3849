#include "testing/kit/integrators/problems.hpp"

#include <cmath>

namespace trammel::kit {

using namespace problems;

Problem some_oscillator(const Subject& s) {
  std::mt19937 random = s.random(1);
  const double omega = between(random, 1.5, 2.5);
  return oscillator(omega, between(random, 0.05, 0.15));
}

Problem some_pendulum(const Subject& s) {
  std::mt19937 random = s.random(2);
  const double theta = between(random, 0.7, 1.2);
  return pendulum(theta, between(random, 0.1, 0.6));
}

Problem some_pendulum_of_varying_mass(const Subject& s) {
  std::mt19937 random = s.random(3);
  const double theta = between(random, 0.7, 1.2);
  return pendulum_of_varying_mass(theta, between(random, 0.1, 0.6));
}

Problem some_rod(const Subject& s, std::vector<double> row_weights) {
  std::mt19937 random = s.random(4);
  const double theta = between(random, 0.7, 1.2);
  return pendulum_with_rod(theta, between(random, 0.1, 0.6), std::move(row_weights));
}

Problem some_wind(const Subject& s) {
  std::mt19937 random = s.random(7);
  return problems::pendulum_on_swinging_pivot(between(random, 0.15, 0.3));
}

Problem some_turning_wire(const Subject& s) {
  std::mt19937 random = s.random(5);
  return bead_on_turning_wire(between(random, 1.6, 2.2));
}

Problem some_top(const Subject& s) {
  std::mt19937 random = s.random(6);
  return heavy_top(between(random, 14, 20));
}

Problem any_pendulum(const Subject& s) {
  return s.traits().rows ? some_rod(s) : some_pendulum(s);
}

Problem springs(std::vector<double> frequencies) {
  const Vec omega = Eigen::Map<Vec>(frequencies.data(), Eigen::Index(frequencies.size()));
  const Vec k = omega.cwiseAbs2();
  Problem p;
  p.name = "springs";
  p.closed_form = false;
  p.M = Mat::Identity(omega.size(), omega.size());
  p.force = [k](double, const Vec& q, const Vec&) -> Vec { return -k.cwiseProduct(q); };
  p.tangent = [k](const Blend& c, const Vec&, const Vec&) -> Mat { return (c.c_k * k).asDiagonal(); };
  p.exact = [n = omega.size()](double, Vec& q, Vec& v) { q = Vec::Ones(n), v = Vec::Zero(n); };
  return p;
}

Problem particle(std::function<Vec(double, const Vec&, const Vec&)> force) {
  Problem p;
  p.name = "particle";
  p.closed_form = false;
  p.M = Mat::Ones(1, 1);
  p.force = std::move(force);
  p.exact = [](double, Vec& q, Vec& v) { q = v = Vec::Zero(1); };
  return p;
}

Problem some_spring_pair(const Subject& s) {
  std::mt19937 random = s.random(8);
  const double k = between(random, 20, 40);  // [N/m], of 1 m
  const auto stretched = [](const Vec& q) { return (q.tail(2) - q.head(2)).norm() - 1; };
  Problem p;
  p.name = "masses on a spring";
  p.closed_form = false;
  p.M = Vec{{1, 1, 2, 2}}.asDiagonal();
  p.force = [=](double, const Vec& q, const Vec&) -> Vec {
    const Eigen::Vector2d d = q.tail(2) - q.head(2), pull = k * stretched(q) * d / d.norm();
    return Vec{{pull(0), pull(1), -pull(0), -pull(1)}};
  };
  p.exact = [](double, Vec& q, Vec& v) {
    q = Vec{{0, 0, 1.1, 0.2}};
    v = Vec{{0.5, -1, 1, 1}};
  };
  p.energy = {
      10, [=, M = p.M](const State& at) { return at.v.dot(M * at.v) / 2 + k * stretched(at.q) * stretched(at.q) / 2; }};
  p.rigid_motions = [](const Vec& q) -> Mat { return Mat{{1, 0, -q(1)}, {0, 1, q(0)}, {1, 0, -q(3)}, {0, 1, q(2)}}; };
  return p;
}

Problem flight(const Problem& rod) {
  Problem p = rod;
  p.name = "flight";
  p.rows = {};
  p.closed_form = false;
  return p;
}

Problem nothing() {
  Problem p;
  p.name = "nothing";
  p.M = Mat(0, 0);
  p.force = [](double, const Vec&, const Vec&) { return Vec(0); };
  p.exact = [](double, Vec& q, Vec& v) { q = v = Vec(0); };
  return p;
}

Problem shifted(Problem p, double t_0) {
  p.force = [force = p.force, t_0](double t, const Vec& q, const Vec& v) { return force(t - t_0, q, v); };
  if (p.rows) p.rows = [rows = p.rows, t_0](double t, const Vec& q, const Vec& v) { return rows(t - t_0, q, v); };
  p.exact = [exact = p.exact, t_0](double t, Vec& q, Vec& v) { exact(t - t_0, q, v); };
  return p;
}

const Vec& Failing::f() {
  f_ = sound_.f();
  if (how_ != How::singular && fails()) f_.setConstant(poison());
  return f_;
}

void Failing::accelerate(Stabilisation s, Vec& a, Vec& lambda) {
  sound_.accelerate(s, a, lambda);
  if (how_ != How::singular && fails()) a.setConstant(poison());
}

void Failing::factorise(Blend b, const Vec& a, const Vec& lambda, Factors kept) {
  ++evaluations;
  iterations_factorised += kept == Factors::iteration && (b.c_d != 0 || b.c_k != 0);
  sound_.factorise(b, a, lambda, kept);
}

bool Failing::correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors kept) {
  const bool solved = sound_.correct(r, rc, da, dlambda, kept);
  return solved && !(how_ == How::singular && fails());
}

}  // namespace trammel::kit
