#include "complementarity/shares/spare_load.hpp"

#include <algorithm>

#include <trammel/decompositions.hpp>

#include "complementarity/programs/cone_program.hpp"

namespace trammel::complementarity {

using Eigen::Index;

// Each contact is unloaded to x_0 = N - s, where s is bounded: s + x = most_spare_load.
double spare_load(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec* F, double wanted) {
  Vec F_s = Vec::Zero(E.cols());  // dF/ds
  for (const SharingContact& c : contacts)
    if (c.normal >= 0 && c.carries) F_s[c.normal] = 1;
  ConeProgram program = sharing_program(contacts, E, lambda);
  const Index rows = program.G.rows(), columns = program.G.cols();
  program.D.setZero(columns + 1);
  program.cones.push_back(1);
  program.u.setOnes(rows + 1);
  program.u.head(E.rows()) = E * F_s;
  const double size = std::max(program.r.lpNorm<Eigen::Infinity>(), 1e-300);
  program.r.conservativeResize(rows + 1);
  program.r /= size;
  program.wanted = wanted / size;
  program.r[rows] = most_spare_load;
  Mat G = Mat::Zero(rows + 1, columns + 1);
  G.topLeftCorner(rows, columns) = program.G;
  G(rows, columns) = 1;
  program.G = std::move(G);
  const ConeSolution solution = solve_cone_program(program);
  if (F) {
    *F = size * (forces_of(contacts, solution.x.head(columns), E.cols()) + solution.s * F_s);
    const Vec missed = lambda - E * *F;
    *F += Eigen::CompleteOrthogonalDecomposition<Mat>(E).solve(missed);
  }
  return size * solution.s;
}

}  // namespace trammel::complementarity
