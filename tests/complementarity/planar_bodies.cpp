#include "planar_bodies.hpp"

#include <cmath>
#include <numbers>

namespace trammel::complementarity {

using Eigen::Vector2d;
using Eigen::Vector3d;

int PlanarBodies::add(const Vector2d& centre, double mass, double inertia, const Vector3d& acceleration) {
  bodies_.push_back({centre, Vector3d(1 / mass, 1 / mass, 1 / inertia), acceleration});
  return int(bodies_.size()) - 1;
}

void PlanarBodies::touch(int below, int above, const Vector2d& x, const Vector2d& normal, double mu, double approach) {
  touches_.push_back({below, above, x, normal.normalized(), mu, approach});
}

void PlanarBodies::let_slide(int way) {
  touches_.back().slides = way;
}

Eigen::RowVectorXd PlanarBodies::row(int below, int above, const Vector2d& x, const Vector2d& e) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(3 * Eigen::Index(bodies_.size()));
  const auto add = [&](int body, double sign) {
    if (body == ground) return;
    const Vector2d r = x - bodies_[std::size_t(body)].centre;
    row.segment<3>(3 * body) += sign * Vector3d(e[0], e[1], r[0] * e[1] - r[1] * e[0]);
  };
  add(above, 1), add(below, -1);
  return row;
}

Problem PlanarBodies::problem(std::string kind) const {
  const auto contacts = Eigen::Index(touches_.size());
  Vec weight(3 * bodies_.size()), acceleration(3 * bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    weight.segment<3>(3 * Eigen::Index(i)) = bodies_[i].weight;
    acceleration.segment<3>(3 * Eigen::Index(i)) = bodies_[i].acceleration;
  }
  Mat G(2 * contacts, weight.size());
  Vec approach = Vec::Zero(2 * contacts);
  Problem problem;
  for (Eigen::Index i = 0; i < contacts; ++i) {
    const Touch& t = touches_[std::size_t(i)];
    G.row(2 * i) = row(t.below, t.above, t.x, t.normal);
    G.row(2 * i + 1) = row(t.below, t.above, t.x, {t.normal[1], -t.normal[0]});
    approach[2 * i] = t.approach;
    ContactPoint& p = problem.points.emplace_back();
    p.normal = int(2 * i), p.tangent = int(2 * i + 1);
    p.kind = t.slides != 0 ? ContactPoint::Tangent::sliding : ContactPoint::Tangent::resting;
    if (t.slides != 0)
      p.ratio = {-t.slides * t.mu, 0};
    else
      p.coefficient = t.mu;
  }
  problem.A = G * weight.asDiagonal() * G.transpose();
  problem.b = G * acceleration - approach;
  problem.kind = std::move(kind);
  return problem;
}

namespace {

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}
bool chance(std::mt19937& random, double probability) {
  return uniform(random, 0, 1) < probability;
}
int some(std::mt19937& random, int from, int to) {
  return std::uniform_int_distribution<int>(from, to)(random);
}
// 1e-6 to 1e6 rarely, mostly 1.
double some_ratio(std::mt19937& random) {
  return chance(random, 0.6) ? 1 : std::pow(10, uniform(random, -6, 6));
}
double some_friction(std::mt19937& random) {
  constexpr double coefficients[] = {0, 0.1, 0.3, 0.5, 1, 3, 100};
  return chance(random, 0.5) ? coefficients[some(random, 0, 6)] : uniform(random, 0, 1.5);
}
int some_way(std::mt19937& random) {
  return chance(random, 0.5) ? 1 : -1;
}

constexpr double g = 9.81;
const Vector3d weight(0, -g, 0);

// A block between floor and ceiling, perhaps squeezed by them.
Problem channel(std::mt19937& random) {
  PlanarBodies bodies;
  const double L = uniform(random, 0.2, 2), H = uniform(random, 0.2, 2), mu = some_friction(random);
  const bool slides = chance(random, 0.5);
  const int way = some_way(random);
  const double push = chance(random, 0.3) ? 0 : uniform(random, -30, 30);
  const int block =
      bodies.add({0, 0}, 1, (L * L + H * H) / 12,
                 {push, chance(random, 0.3) ? 0 : -g, chance(random, 0.5) ? 0 : uniform(random, -50, 50)});
  const double squeeze = chance(random, 0.1) ? 1 : 0;
  for (const double y : {-1, 1})
    for (const double x : {-1, 1}) {
      bodies.touch(PlanarBodies::ground, block, {x * L / 2, y * H / 2}, {0, -y}, mu, y > 0 ? squeeze : 0);
      if (slides) bodies.let_slide(way);
    }
  return bodies.problem("channel");
}

// A disc or a block in a V of any opening.
Problem wedge(std::mt19937& random) {
  PlanarBodies bodies;
  const double mu = some_friction(random), half = uniform(random, 0.02, 1.5);
  const int body =
      bodies.add({0, 0}, 1, uniform(random, 0.05, 1), {uniform(random, -5, 5), -g, uniform(random, -20, 20)});
  for (const int side : {-1, 1}) {
    const Vector2d normal(-side * std::cos(half), std::sin(half)), along(normal[1], -normal[0]);
    const int touches = some(random, 1, 2);
    for (int k = 0; k < touches; ++k) {
      bodies.touch(PlanarBodies::ground, body, -normal + (touches == 1 ? 0.0 : k - 0.5) * along, normal, mu);
      if (chance(random, 0.3)) bodies.let_slide(some_way(random));
    }
  }
  return bodies.problem("wedge");
}

// Feet that nearly coincide: near-singular.
Problem near_feet(std::mt19937& random) {
  PlanarBodies bodies;
  const double apart = std::pow(10, uniform(random, -5, -1)), mu = some_friction(random);
  const int body = bodies.add({0, 1}, 1, 0.3, {uniform(random, -10, 10), -g, uniform(random, -10, 10) * apart});
  for (const double x : {-0.5, -0.5 + apart, 0.5, 0.5 + apart}) {
    bodies.touch(PlanarBodies::ground, body, {x, 0}, {0, 1}, mu);
    if (chance(random, 0.3)) bodies.let_slide(some_way(random));
  }
  return bodies.problem("feet " + std::to_string(apart) + " apart");
}

// The rod of Painleve and others that are thrown, tip on the floor, perhaps its other end at a wall.
Problem rod(std::mt19937& random) {
  PlanarBodies bodies;
  const double angle = uniform(random, 0.1, 1.5), mu = uniform(random, 0, 3);
  const Vector2d half(std::cos(angle) / 2, std::sin(angle) / 2);
  const int body = bodies.add({0, 0}, 1, 1.0 / 12, {uniform(random, -5, 5), -g, uniform(random, -30, 30)});
  bodies.touch(PlanarBodies::ground, body, -half, {0, 1}, mu);
  if (chance(random, 0.7)) bodies.let_slide(some_way(random));
  if (chance(random, 0.5)) {
    bodies.touch(PlanarBodies::ground, body, half, {-1, 0}, mu);
    if (chance(random, 0.5)) bodies.let_slide(some_way(random));
  }
  return bodies.problem("rod");
}

}  // namespace

Problem stack(std::mt19937& random, int blocks, double mu, double base_acceleration, double mass_ratio) {
  PlanarBodies bodies;
  double y = 0, mass = 1;
  const double w = 1, ratio = std::pow(mass_ratio, 1.0 / std::max(1, blocks - 1));
  for (int i = 0; i < blocks; ++i, mass *= ratio) {
    const double h = uniform(random, 0.3, 1.5);
    bodies.add({0, y + h / 2}, mass, mass * (w * w + h * h) / 12, {-base_acceleration, -g, 0});
    for (const double x : {-w / 2, w / 2}) bodies.touch(i - 1, i, {x, y}, {0, 1}, mu);
    y += h;
  }
  return bodies.problem("stack of " + std::to_string(blocks));
}

Problem arch(int voussoirs, double mu, double thickness) {
  PlanarBodies bodies;
  const double part = std::numbers::pi / voussoirs;
  for (int i = 0; i < voussoirs; ++i) {
    const double angle = part * (i + 0.5), mass = part * thickness;
    bodies.add({std::cos(angle), std::sin(angle)}, mass, mass * (part * part + thickness * thickness) / 12, weight);
  }
  for (int i = 0; i <= voussoirs; ++i) {
    const double angle = part * i;
    const Vector2d radial(std::cos(angle), std::sin(angle)), normal(-radial[1], radial[0]);
    const int above = i < voussoirs ? i : PlanarBodies::ground;
    for (const double side : {-0.5, 0.5}) bodies.touch(i - 1, above, (1 + side * thickness) * radial, normal, mu);
  }
  return bodies.problem("arch of " + std::to_string(voussoirs));
}

Problem pile_of_discs(std::mt19937& random, int rows, double mu) {
  PlanarBodies bodies;
  std::vector<int> below;
  const double spread = 1 + (chance(random, 0.5) ? 0 : uniform(random, 0, 0.3)), mass = some_ratio(random);
  const double lift = std::sqrt(4 - spread * spread);
  const auto centre = [&](int row, int k) { return Vector2d(2 * spread * k + spread * row, 1 + lift * row); };
  for (int row = 0; row < rows; ++row) {
    std::vector<int> here;
    for (int k = 0; k < rows - row; ++k) {
      const double m = row == rows - 1 ? mass : 1;
      here.push_back(bodies.add(centre(row, k), m, m / 2, weight));
      if (row == 0) bodies.touch(PlanarBodies::ground, here.back(), centre(0, k) - Vector2d(0, 1), {0, 1}, mu);
      if (k > 0 && spread == 1)
        bodies.touch(here[std::size_t(k - 1)], here.back(), centre(row, k) - Vector2d(1, 0), {1, 0}, mu);
      for (int side = 0; side < 2 && row > 0; ++side) {
        const Vector2d normal = (centre(row, k) - centre(row - 1, k + side)) / 2;
        bodies.touch(below[std::size_t(k + side)], here.back(), centre(row, k) - normal, normal, mu);
      }
    }
    below = here;
  }
  return bodies.problem("pile of discs, " + std::to_string(rows) + " rows");
}

Problem table(std::mt19937& random, int feet, double mu, double push) {
  PlanarBodies bodies;
  const bool slides = chance(random, 0.3);
  const int way = some_way(random);
  const int body = bodies.add({uniform(random, -0.4, 0.4), 1}, 1, 0.3, {push, -g, uniform(random, -3, 3)});
  for (int i = 0; i < feet; ++i) {
    bodies.touch(PlanarBodies::ground, body, {i - (feet - 1) / 2.0, 0}, {0, 1}, mu);
    if (slides) bodies.let_slide(way);
  }
  return bodies.problem("table of " + std::to_string(feet) + " feet");
}

Problem any_structure(std::mt19937& random, int most_contacts) {
  const double mu = some_friction(random), push = chance(random, 0.3) ? 0 : uniform(random, -12, 12);
  for (;;) {
    Problem problem;
    switch (some(random, 0, 7)) {
      case 0:
        problem = stack(random, some(random, 1, most_contacts / 2), mu, push, some_ratio(random));
        break;
      case 1:
        problem = arch(some(random, 1, most_contacts / 2 - 1), mu, uniform(random, 0.05, 0.5));
        break;
      case 2:
        problem = channel(random);
        break;
      case 3:
        problem = pile_of_discs(random, some(random, 1, 2), mu);
        break;
      case 4:
        problem = table(random, some(random, 1, most_contacts), mu, push);
        break;
      case 5:
        problem = wedge(random);
        break;
      case 6:
        problem = near_feet(random);
        break;
      default:
        problem = rod(random);
        break;
    }
    if (int(problem.points.size()) <= most_contacts) return problem;
  }
}

}  // namespace trammel::complementarity
