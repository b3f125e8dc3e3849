#include "simulate/contact/ending_impulses.hpp"

#include <numeric>
#include <vector>

#include <trammel/decompositions.hpp>

#include "complementarity/shares/row_basis.hpp"

namespace trammel::simulate {
namespace {

// If the drifts of nearly dependent rows contradict each other, ending all of them takes changes of v that are many
// times as large and no drift any more (the first dominoes of a long row move very little while the last ones fall; a
// triangle that rocks about one foot, with the other one at a wall, all but reaches the floor). Then only the drifts
// of well-conditioned rows are ended, those of which other rows leave more than 1e-3 (`least_share` is its square).
constexpr double most_changed = 1e3, least_share = 1e-6;

Vec impulses_on_all(const Mat& A, const Vec& rates) {
  const Vec lost = -rates;
  return Eigen::CompleteOrthogonalDecomposition<Mat>(A).solve(lost);
}

// In the metric of the masses, relative to the change that ends each rate alone.
bool changes_too_much(const Mat& A, const Vec& rates, const Vec& P) {
  double alone = 0;
  for (Eigen::Index i = 0; i < P.size(); ++i)
    if (A(i, i) > 0) alone += rates[i] * rates[i] / A(i, i);
  return P.dot(A * P) > most_changed * most_changed * alone;
}

}  // namespace

Vec ending_impulses(const Mat& A, const Vec& rates) {
  const Vec P = impulses_on_all(A, rates);
  if (!changes_too_much(A, rates, P)) return P;
  std::vector<Eigen::Index> all(std::size_t(rates.size()));
  std::iota(all.begin(), all.end(), 0);
  const std::vector<Eigen::Index> ended = complementarity::well_conditioned_rows(A, all, least_share);
  Vec of_ended = Vec::Zero(rates.size());
  of_ended(ended) = impulses_on_all(A(ended, ended), rates(ended));
  return of_ended;
}

}  // namespace trammel::simulate
