#include "simulate/results/relative_motion.hpp"

#include <Eigen/Geometry>

#include "model/scene_keys.hpp"

namespace trammel::simulate {
namespace {

using Eigen::Vector3d;

// Linear and angular part of a twist, in the plane as in space.
struct Twist {
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();

  Twist(const Vec6& twist) {
    const Eigen::Index dim = twist.size() == 3 ? 2 : 3, turns = twist.size() - dim;
    linear.head(dim) = twist.head(dim);
    angular.tail(turns) = twist.tail(turns);
  }
};

Twist acceleration(Moment& moment, model::MarkerRef marker, const Motion& motion) {
  Vec6 A = motion.bias;
  if (marker.body < 0) return A;
  const Vec& a = moment.a();
  const int v0 = moment.system().model().bodies[std::size_t(marker.body)].v0;
  for (std::size_t k = 0; k < motion.dofs.size(); ++k) A += motion.J.col(Eigen::Index(k)) * a[v0 + motion.dofs[k]];
  return A;
}

}  // namespace

std::vector<std::pair<std::string, MotionComponent>> motion_components(const model::Model& model,
                                                                       model::MarkerRef marker) {
  return motion_components(model.world.space, model::has_orientation(model, marker));
}

std::vector<std::pair<std::string, MotionComponent>> motion_components(Space space, bool orientation) {
  std::vector<std::pair<std::string, MotionComponent>> all;
  const char* prefixes[] = {"", "v", "a"};
  const char* axes[] = {"x", "y", "z"};
  for (int order = 0; order < 3; ++order)
    for (int i = 0; i < dimension(space); ++i)
      all.emplace_back(std::string(prefixes[order]) + axes[i], MotionComponent{order, i});
  if (!orientation) return all;
  if (space == Space::planar)
    for (const auto& [name, order] : {std::pair{"angle", 0}, std::pair{"omega", 1}, std::pair{"alpha", 2}})
      all.emplace_back(name, MotionComponent{order, 2});
  else
    for (const auto& [name, order] : {std::pair{"omega_", 1}, std::pair{"alpha_", 2}})
      for (int i = 0; i < 3; ++i) all.emplace_back(std::string(name) + axes[i], MotionComponent{order, 3 + i});
  return all;
}

double seen_from(Moment& moment, model::MarkerRef A, model::MarkerRef B, MotionComponent what) {
  const Motion &at_A = moment.system().motion(A), &at_B = moment.system().motion(B);
  const auto dim = at_A.x.size();
  const bool angular = what.component >= dim;
  if (what.order == 0 && angular) return at_A.angle - at_B.angle;
  Vector3d d = Vector3d::Zero();
  d.head(dim) = at_A.x - at_B.x;
  const auto in_B = [&](const Twist& twist) {
    if (angular && dim == 2) return twist.angular[2];
    const Vector3d& vector = angular ? twist.angular : twist.linear;
    return at_B.R.col(what.component % dim).dot(vector.head(dim));
  };
  if (what.order == 0) return at_B.R.col(what.component).dot(d.head(dim));
  Twist V = at_A.V;
  const Twist V_B = at_B.V;
  V.linear -= V_B.linear + V_B.angular.cross(d);
  V.angular -= V_B.angular;
  if (what.order == 1) return in_B(V);
  Twist a = acceleration(moment, A, at_A);
  const Twist a_B = acceleration(moment, B, at_B);
  a.linear -=
      a_B.linear + a_B.angular.cross(d) + V_B.angular.cross(V_B.angular.cross(d)) + 2 * V_B.angular.cross(V.linear);
  a.angular -= a_B.angular + V_B.angular.cross(V.angular);
  return in_B(a);
}

}  // namespace trammel::simulate
