#include "linear/fronts/frontal_cholesky.hpp"

#include <random>

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

using Sparse = numerics::FrontalCholesky::Sparse;

// Masses on a line, tied by springs of random stiffness to those up to three away and to the ground by `ground`; free
// to move together without it.
Sparse springs(int n, double ground, unsigned seed) {
  std::mt19937 random{seed};
  std::uniform_real_distribution<double> stiffness(0.5, 2);
  Mat K = ground * Mat::Identity(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < std::min(n, i + 4); ++j) {
      const double k = stiffness(random);
      K(i, i) += k, K(j, j) += k, K(i, j) -= k, K(j, i) -= k;
    }
  return K.sparseView();
}

struct Attempt {
  numerics::FrontalPattern pattern;
  numerics::FrontalCholesky cholesky;
  bool factorise(const Sparse& A) {
    pattern.analyse(A);
    return cholesky.factorise(pattern, A, Vec(A.diagonal()));  // the diagonal dominates
  }
};

// Round-off leaves a last pivot of either sign, of about eps times the stiffness.
TEST(FrontalCholesky, RefusesWhatIsSingularButForRoundOff) {
  for (unsigned seed = 1; seed <= 40; ++seed) EXPECT_FALSE(Attempt().factorise(springs(50, 0, seed))) << seed;
}

// The smallest eigenvalue is the ground's stiffness: the error is bounded by eps times the condition, 1e9.
TEST(FrontalCholesky, SolvesWhatIsNearlySingular) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Sparse A = springs(50, 1e-8, seed);
    Attempt attempt;
    ASSERT_TRUE(attempt.factorise(A)) << seed;
    const Vec known = Vec::LinSpaced(50, -1, 2);
    Vec x = A * known;
    attempt.cholesky.substitute(attempt.pattern, x);
    EXPECT_LT((x - known).norm(), 1e-6 * known.norm()) << seed;
  }
}

}  // namespace
}  // namespace trammel::test
