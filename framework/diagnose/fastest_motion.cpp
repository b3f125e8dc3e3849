#include "diagnose/fastest_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace trammel::simulate {
namespace {

constexpr int most_products = 30;
constexpr double near = 0.01;  // relative change of an estimate that ends the iteration

class Operators {
 public:
  Operators(model::AssembledSystem& system, const State& s) : system_(system) {
    const auto [nq, nv, nc] = system.sizes();
    no_rows_.setZero(nc);
    zero_.setZero(nv);
    system.move_to(s.t, s.q, zero_);
    system.accelerate({}, a_, lambda_);
    K_ = system.sparse_tangent({0, 0, 1}, a_, lambda_);
    D_ = system.sparse_tangent({0, 1, 0}, a_, lambda_);
    system.factorise({1, 0, 0}, zero_, no_rows_, Factors::projection);
  }

  const Eigen::SparseMatrix<double>& K() const { return K_; }
  const Eigen::SparseMatrix<double>& D() const { return D_; }

  // y = P M^-1 r. False: the rows are singular.
  [[nodiscard]] bool along_rows(const Vec& r, Vec& y) {
    return system_.correct(-r, no_rows_, y, mu_, Factors::projection) && y.allFinite();
  }

  double norm(const Vec& x) { return std::sqrt(std::max(0.0, x.dot(momentum(x)))); }
  const Vec& momentum(const Vec& x) {
    momentum_.setZero(x.size());
    system_.add_mass_times(1, x, momentum_);
    return momentum_;
  }

  // The largest |P M^-1 B x| / |x|, and an x that comes near it.
  double largest(const Eigen::SparseMatrix<double>& B, Vec& x) {
    Vec y = uneven(x.size());
    if (!along_rows(y, x)) return 0;
    double found = 0;
    for (int i = 0; i < most_products; ++i) {
      const double size = norm(x);
      if (!(size > 0)) return 0;
      x /= size;
      if (!along_rows(B * x, y)) return found;
      const double before = found;
      found = norm(y);
      x.swap(y);
      if (std::abs(found - before) <= near * found) break;
    }
    return found;
  }

 private:
  // The same vector every time; a mode could be perpendicular to it only by chance.
  static Vec uneven(Eigen::Index n) {
    Vec x(n);
    for (Eigen::Index i = 0; i < n; ++i) x[i] = std::sin(1 + 1.7 * double(i) + 0.1 * double(i) * double(i));
    return x;
  }

  model::AssembledSystem& system_;
  Eigen::SparseMatrix<double> K_, D_;
  Vec a_, lambda_, no_rows_, zero_, mu_, momentum_;
};

// The body with the largest part of the kinetic energy of x.
int body_of_most_energy(Operators& operators, const model::Model& model, const Vec& x) {
  const Vec p = operators.momentum(x);
  int most = -1;
  double largest = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::BodyEntry& body = model.bodies[b];
    const double energy = body.nv > 0 ? x.segment(body.v0, body.nv).dot(p.segment(body.v0, body.nv)) : 0;
    if (energy > largest) largest = energy, most = int(b);
  }
  return most;
}

}  // namespace

FastestMotion fastest_motion(model::AssembledSystem& system, const State& state) {
  FastestMotion fastest;
  if (system.sizes().nv == 0) return fastest;
  Operators operators(system, state);
  Vec swings = Vec::Zero(system.sizes().nv), decays = swings;
  fastest.frequency = std::sqrt(operators.largest(operators.K(), swings));
  fastest.decay = operators.largest(operators.D(), decays);
  if (fastest.rate() > 0)
    fastest.body = body_of_most_energy(operators, system.model(), fastest.frequency >= fastest.decay ? swings : decays);
  return fastest;
}

std::string description(const FastestMotion& fastest, const model::Model& model) {
  if (fastest.body < 0) return "nothing swings or decays at its start";
  const std::string& who = model.bodies[std::size_t(fastest.body)].name;
  return fastest.frequency >= fastest.decay ? fmt::format("bodies.{} swings at {:.3g} rad/s", who, fastest.frequency)
                                            : fmt::format("bodies.{} decays at {:.3g} 1/s", who, fastest.decay);
}

}  // namespace trammel::simulate
