#include "spatial_bodies.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace trammel::complementarity {
namespace {

using Eigen::Vector3d;

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

struct Touch {
  Vector3d x, normal;  // from the centre; towards the body
};

struct Body {
  double mass = 1, inertia = 0.2;
  Vector3d acceleration, turn;  // without contacts
  std::vector<Touch> touches;
};

Problem problem_of(const Body& body, double mu, std::string kind) {
  Problem problem;
  problem.kind = std::move(kind);
  const auto n = Eigen::Index(body.touches.size());
  Mat G(3 * n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [x, normal] = body.touches[std::size_t(i)];
    const Vector3d first = normal.unitOrthogonal(), axes[] = {normal, first, normal.cross(first)};
    for (int k = 0; k < 3; ++k) G.row(3 * i + k) << axes[k].transpose(), x.cross(axes[k]).transpose();
    problem.points.push_back({.normal = int(3 * i),
                              .tangent = int(3 * i + 1),
                              .tangents = 2,
                              .kind = ContactPoint::Tangent::resting,
                              .coefficient = mu});
  }
  Vec weight(6), a(6);
  weight << Vector3d::Constant(1 / body.mass), Vector3d::Constant(1 / body.inertia);
  a << body.acceleration, body.turn;
  problem.A = G * weight.asDiagonal() * G.transpose();
  problem.b = G * a;
  return problem;
}

std::vector<Touch> feet(std::mt19937& random, int count) {
  std::vector<Touch> touches;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * (k + uniform(random, -0.2, 0.2)) / count;
    touches.push_back({{std::cos(angle), std::sin(angle), -0.5}, Vector3d::UnitZ()});
  }
  return touches;
}

// Two on the floor, two at the ceiling.
std::vector<Touch> channel() {
  std::vector<Touch> touches;
  for (const double z : {-0.5, 0.5})
    for (const double y : {-1, 1}) touches.push_back({{0, y, z}, {0, 0, z < 0 ? 1.0 : -1.0}});
  return touches;
}

// A ball between inclined planes, or on other balls.
std::vector<Touch> below_a_ball(std::mt19937& random, int count) {
  const double incline = uniform(random, 0.2, 1);  // steeper ones jam
  std::vector<Touch> touches;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    const Vector3d normal(std::sin(incline) * std::cos(angle), std::sin(incline) * std::sin(angle), std::cos(incline));
    touches.push_back({-0.5 * normal, normal});
  }
  return touches;
}

}  // namespace

Problem any_spatial_structure(std::mt19937& random, double most_friction) {
  const auto vector = [&](double size) {
    return Vector3d(uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size));
  };
  Body body;
  body.mass = std::pow(10, uniform(random, -1, 1));
  body.inertia = body.mass * uniform(random, 0.1, 1);
  body.acceleration = Vector3d(0, 0, -9.81) + vector(4);
  body.turn = vector(5);
  const double mu = uniform(random, 0, most_friction);
  switch (std::uniform_int_distribution<int>(0, 4)(random)) {
    case 0:
      body.touches = feet(random, 4);
      return problem_of(body, mu, "table");
    case 1:
      body.touches = feet(random, 3);
      return problem_of(body, mu, "tripod");
    case 2:
      body.touches = channel();
      return problem_of(body, mu, "channel");
    case 3:
      body.touches = below_a_ball(random, 2);
      return problem_of(body, mu, "ball in a groove");
    default:
      body.touches = below_a_ball(random, 3);
      return problem_of(body, mu, "ball on three");
  }
}

Problem plate_on_balls(std::mt19937& random, int balls, double mu) {
  constexpr double radius = 0.05, half = 0.02;  // [m] of a ball; of the plate's thickness
  const double plate = 20, ball = 0.5, turning = 0.6;
  const Eigen::Index nv = 6 * (balls + 1);
  Vec weight(nv), a = Vec::Zero(nv);
  weight.head(3).setConstant(1 / plate), weight.segment(3, 3).setConstant(1 / turning);
  a.head(6) << uniform(random, -8, 8), uniform(random, -8, 8), -9.81, uniform(random, -40, 40),
      uniform(random, -40, 40), uniform(random, -5, 5);
  const double direction = uniform(random, 0, 2 * std::numbers::pi);
  const Eigen::AngleAxisd tilt(2 * std::atan(mu) * uniform(random, 0.9, 1.1),
                               Vector3d(std::cos(direction), std::sin(direction), 0));
  Problem problem;
  problem.kind = "plate on balls";
  Mat G = Mat::Zero(6 * balls, nv);
  for (int i = 0; i < balls; ++i) {
    const Eigen::Index at = 6 * (i + 1);
    weight.segment(at, 3).setConstant(1 / ball), weight.segment(at + 3, 3).setConstant(2.5 / (ball * radius * radius));
    a[at + 2] = -9.81;
    const Vector3d on_plate = tilt * Vector3d(uniform(random, -0.25, 0.25), uniform(random, -0.25, 0.25), -half);
    for (int upper = 0; upper < 2; ++upper) {
      const Vector3d normal = upper ? Vector3d(tilt * -Vector3d::UnitZ()) : Vector3d(Vector3d::UnitZ());
      const Vector3d first = normal.unitOrthogonal();
      const Vector3d axes[] = {normal, first, normal.cross(first)};
      const int row = 6 * i + 3 * upper;
      for (int k = 0; k < 3; ++k) {
        G.row(row + k).segment(at, 6) << axes[k].transpose(), (-radius * normal).cross(axes[k]).transpose();
        if (upper) G.row(row + k).head(6) << -axes[k].transpose(), -on_plate.cross(axes[k]).transpose();
      }
      problem.points.push_back({.normal = row,
                                .tangent = row + 1,
                                .tangents = 2,
                                .kind = ContactPoint::Tangent::resting,
                                .coefficient = mu});
    }
  }
  problem.A = G * weight.asDiagonal() * G.transpose();
  problem.b = G * a;
  return problem;
}

}  // namespace trammel::complementarity
