#include "stability/small_steps.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trammel::stability {

std::vector<SmallStep> small_steps(const Maker& make, std::span<const double> steps) {
  constexpr int n = 10;  // the noise differs from step to step; its size does not
  const Problem problem = problems::pendulum_with_rod();
  std::vector<SmallStep> all;
  for (const double h : steps) {
    SmallStep one{.h = h};
    double lambda = 0, speed = 0;
    try {
      const auto method = make();
      const auto system = problem.system();
      integrate(*method, *system, problem.solution(0), n * h, n, [&](const State& x) {
        const State exact = problem.solution(x.t);
        lambda = std::max(lambda, exact.lambda.lpNorm<Eigen::Infinity>());
        speed = std::max(speed, exact.v.lpNorm<Eigen::Infinity>());
        one.lambda_error = std::max(one.lambda_error, (x.lambda - exact.lambda).lpNorm<Eigen::Infinity>());
        one.velocity_error = std::max(one.velocity_error, (x.v - exact.v).lpNorm<Eigen::Infinity>());
      });
      one.lambda_error /= lambda, one.velocity_error /= speed;
    } catch (const std::runtime_error& e) {
      one.rejected = e.what();
    }
    all.push_back(one);
  }
  return all;
}

}  // namespace trammel::stability
