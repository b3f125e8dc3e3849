// Rigid bodies in the plane that touch: the Delassus matrix and accelerations of their contacts, from their Jacobians.
#pragma once

#include <random>

#include <Eigen/Core>

#include "problem.hpp"

namespace trammel::complementarity {

class PlanarBodies {
 public:
  static constexpr int ground = -1;

  // At `centre`, with the acceleration that it has without contacts: x, y, rotation. Returns its number.
  int add(const Eigen::Vector2d& centre, double mass, double inertia, const Eigen::Vector3d& acceleration);

  // `above` touches `below` at x; the normal points to `above`. The tangent is the normal turned by -90 degrees.
  // `approach`: what the surfaces do besides [m/s^2], which bodies at rest that touch do not have.
  void touch(int below, int above, const Eigen::Vector2d& x, const Eigen::Vector2d& normal, double mu,
             double approach = 0);

  // The last contact slides: `above` moves with `way` (1 or -1) along the tangent.
  void let_slide(int way);

  Problem problem(std::string kind) const;

 private:
  struct Body {
    Eigen::Vector2d centre;
    Eigen::Vector3d weight, acceleration;  // weight: 1 / mass, 1 / mass, 1 / inertia
  };
  Eigen::RowVectorXd row(int below, int above, const Eigen::Vector2d& x, const Eigen::Vector2d& direction) const;

  struct Touch {
    int below, above;
    Eigen::Vector2d x, normal;
    double mu, approach;
    int slides = 0;
  };
  std::vector<Body> bodies_;
  std::vector<Touch> touches_;
};

// One of the structured kinds, of some random measures, with no more contacts than this: stacks, arches, channels,
// piles of discs, tables of many feet, wedges, feet that nearly coincide.
Problem any_structure(std::mt19937& random, int most_contacts);

// Larger ones. mass_ratio: of the uppermost block to the lowest.
Problem stack(std::mt19937& random, int blocks, double mu, double base_acceleration, double mass_ratio);
Problem arch(int voussoirs, double mu, double thickness);  // thickness: of the mean radius
Problem pile_of_discs(std::mt19937& random, int rows, double mu);
Problem table(std::mt19937& random, int feet, double mu, double push);

}  // namespace trammel::complementarity
