#include "least_norm.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "feasible_point.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Index;
using Tangent = ContactPoint::Tangent;

bool closed(const ContactPoint& p, const Vec& a, double nothing) {
  return p.normal < 0 || a[p.normal] <= nothing;
}

// The rows along which a closed contact that does not slide may exert forces, and the normals of its cone that are
// active at F.
class ActiveCones {
 public:
  ActiveCones(const Problem& problem, const Vec& F, const Vec& a, double nothing) : m_(F.size()) {
    const double no_force = 1e-9 * F.lpNorm<Eigen::Infinity>();
    for (const ContactPoint& p : problem.points) {
      if (!closed(p, a, nothing)) continue;
      const double N = p.normal >= 0 ? F[p.normal] : p.given;
      if (p.normal >= 0) rows.push_back(p.normal);
      if (!p.held()) {
        if (p.normal >= 0 && N <= no_force) add(p, -1, 0);
        continue;
      }
      rows.push_back(p.tangent);
      for (const double side : {-1, 1})
        if (side * F[p.tangent] >= p.coefficient * N - no_force) add(p, -p.coefficient, side);
    }
  }

  std::vector<Index> rows;
  std::vector<Vec> normals;

 private:
  void add(const ContactPoint& p, double along_normal, double along_tangent) {
    Vec normal = Vec::Zero(m_);
    if (p.normal >= 0) normal[p.normal] = along_normal;
    if (along_tangent != 0) normal[p.tangent] = along_tangent;
    normals.push_back(normal);
  }

  Index m_;
};

}  // namespace

bool slides(const Problem& problem, const Vec& a, double nothing) {
  for (const ContactPoint& p : problem.points) {
    if (!closed(p, a, nothing)) continue;
    if (p.slides() || (p.held() && a.segment(p.tangent, p.tangents).norm() > nothing)) return true;
  }
  return false;
}

namespace {

// Columns that span what A y can be, without the directions that are round-off.
Mat span(const Mat& A) {
  const Vec length = A.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Mat scaled = length.cwiseInverse().asDiagonal() * A * length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Mat> modes(scaled);
  Index rank = 0;
  for (const double square : modes.eigenvalues()) rank += square > 1e-12;
  const Eigen::HouseholderQR<Mat> qr(length.asDiagonal() * modes.eigenvectors().rightCols(rank));
  return qr.householderQ() * Mat::Identity(A.rows(), rank);
}

}  // namespace

// A_R y - sum of s_k n_k = F_R with s >= 0 and y of any sign.
double distance_from_least_norm(const Problem& problem, const Vec& F, const Vec& a, double nothing) {
  const ActiveCones cones(problem, F, a, nothing);
  const double size = F.lpNorm<Eigen::Infinity>();
  const auto n = Index(cones.rows.size()), sides = Index(cones.normals.size());
  if (n == 0 || size == 0) return 0;
  const Mat range = span(problem.A(cones.rows, cones.rows));
  Mat B(n, 2 * range.cols() + sides);
  B.leftCols(range.cols()) = range, B.middleCols(range.cols(), range.cols()) = -range;
  for (Index k = 0; k < sides; ++k) B.rightCols(sides).col(k) = -cones.normals[std::size_t(k)](cones.rows).normalized();
  Vec x;
  return feasible_point(B, F(cones.rows) / size, x);
}

}  // namespace trammel::complementarity
