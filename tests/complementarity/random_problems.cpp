#include "random_problems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace trammel::complementarity {
namespace {

using Tangent = ContactPoint::Tangent;

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}
bool chance(std::mt19937& random, double probability) {
  return uniform(random, 0, 1) < probability;
}

Vec normal_numbers(std::mt19937& random, Eigen::Index n) {
  std::normal_distribution<double> normal;
  return Vec::NullaryExpr(n, [&] { return normal(random); });
}

// Gives the contact its rows.
void place(ContactPoint& p, bool unilateral, bool tangential, int tangents, int& rows) {
  if (unilateral) p.normal = rows++;
  p.tangents = tangents;
  if (tangential) p.tangent = rows, rows += tangents;
}

ContactPoint random_point(std::mt19937& random, const RandomKinds& kinds, int tangents, int& rows) {
  ContactPoint p;
  const bool given = !kinds.unilateral_only && chance(random, 0.15), frictionless = !given && chance(random, 0.1);
  const bool slides = !kinds.resting_only && !given && chance(random, 0.35);
  place(p, !given, !frictionless, tangents, rows);
  if (given) p.given = chance(random, 0.1) ? 0 : uniform(random, 0, 3);
  if (frictionless) return p;
  const double mu = chance(random, 0.1) ? 0 : uniform(random, 0, kinds.most_friction);
  p.kind = slides ? Tangent::sliding : Tangent::resting;
  if (slides) {
    const double angle = tangents == 2         ? uniform(random, 0, 2 * std::numbers::pi)
                         : chance(random, 0.5) ? 0
                                               : std::numbers::pi;
    p.ratio = mu * Eigen::Vector2d(std::cos(angle), tangents == 2 ? std::sin(angle) : 0);
  } else {
    p.coefficient = mu;
  }
  return p;
}

Problem random_contacts(std::mt19937& random, const RandomKinds& kinds, int tangents) {
  Problem problem;
  int rows = 0;
  for (int i = 0; i < kinds.contacts; ++i) problem.points.push_back(random_point(random, kinds, tangents, rows));
  const Mat G = normal_numbers(random, rows * kinds.velocities).reshaped(rows, kinds.velocities);
  problem.A = G * G.transpose();
  Vec a = normal_numbers(random, kinds.velocities);
  for (const ContactPoint& p : problem.points)  // towards the contacts
    if (p.normal >= 0) a -= uniform(random, 0, 0.8) * G.row(p.normal).transpose();
  problem.b = G * a + kinds.noise * normal_numbers(random, rows);
  return problem;
}

}  // namespace

Problem random_planar(std::mt19937& random, const RandomKinds& kinds) {
  Problem problem = random_contacts(random, kinds, 1);
  problem.kind = "random, " + std::to_string(kinds.contacts) + " contacts, " + std::to_string(kinds.velocities) +
                 " velocities, noise " + std::to_string(kinds.noise) + ", friction up to " +
                 std::to_string(kinds.most_friction);
  return problem;
}

Problem any_planar(std::mt19937& random, int contacts) {
  RandomKinds kinds;
  kinds.contacts = contacts;
  kinds.velocities = std::uniform_int_distribution<int>(1, 2 * contacts + 2)(random);
  kinds.noise = chance(random, 0.2) ? 0.3 : 0;
  const double coefficients[] = {0.3, 1, 3, 100};
  kinds.most_friction = coefficients[std::uniform_int_distribution<int>(0, 3)(random)];
  kinds.unilateral_only = chance(random, 0.5);
  kinds.resting_only = chance(random, 0.4);
  return random_planar(random, kinds);
}

Problem random_normals(std::mt19937& random, int n, int velocities, double noise) {
  Problem problem;
  problem.kind = std::to_string(n) + " normals of " + std::to_string(velocities) + " velocities";
  const Mat G = normal_numbers(random, n * velocities).reshaped(n, velocities) / std::sqrt(double(velocities));
  problem.A = G * G.transpose();
  problem.b =
      G * (normal_numbers(random, velocities) - 0.5 * G.transpose() * Vec::Ones(n)) + noise * normal_numbers(random, n);
  for (int i = 0; i < n; ++i) problem.points.push_back({.normal = i});
  return problem;
}

Problem random_spatial(std::mt19937& random, const RandomKinds& kinds) {
  Problem problem = random_contacts(random, kinds, 2);
  problem.kind = "random in space";
  return problem;
}

std::vector<std::size_t> random_order(std::mt19937& random, std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

}  // namespace trammel::complementarity
