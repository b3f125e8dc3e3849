#include "complementarity/shares/carrying_equations.hpp"

#include <cmath>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

using Tangent = ContactRole::Tangent;
using Eigen::Index;

// Relative to a row's own stiffness: a smaller pivot counts as 0. Rows that count as independent (row_basis.hpp) may
// leave as little without any friction; friction makes the equations singular only where it takes most of that away.
constexpr double singular = 1e-12, left_by_friction = 1e-2;

double last_pivot(const Eigen::FullPivLU<Mat>& lu) {
  const Index n = lu.rows();
  return n == 0 ? 1 : std::abs(lu.matrixLU()(n - 1, n - 1));
}

Vec sliding_under_given_forces(const std::vector<ContactPoint>& points, const std::vector<ContactRole>& roles,
                               Index m) {
  Vec F = Vec::Zero(m);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const ContactPoint& p = points[i]; p.normal < 0 && p.held() && roles[i].tangent == Tangent::slides)
      F.segment(p.tangent, p.tangents) = p.given * roles[i].ratio.head(p.tangents);
  return F;
}

}  // namespace

CarryingEquations::CarryingEquations(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b,
                                     const std::vector<ContactRole>& roles, const CarryingRows& carrying)
    : basis_(carrying.rows.basis), F_0_(sliding_under_given_forces(points, roles, b.size())) {
  rest_ = A * F_0_ + b;
  if (basis_.empty()) return;
  F_lambda_ = along_rows(points, roles, carrying) * carrying.share;
  // Powers of two: scaling adds no round-off.
  scale_ = A.diagonal()(basis_).unaryExpr([](double x) { return std::exp2(-std::round(std::log2(x) / 2)); });
  const Mat scaled = scale_.asDiagonal() * (A(basis_, Eigen::all) * F_lambda_) * scale_.asDiagonal();
  lu_.compute(scaled);
  regular_ = least_pivot() > singular;
  if (regular_) return;
  const Mat without_friction = scale_.asDiagonal() * A(basis_, basis_) * scale_.asDiagonal();
  regular_ = least_pivot() > left_by_friction * last_pivot(Eigen::FullPivLU<Mat>(without_friction));
}

Mat CarryingEquations::along_rows(const std::vector<ContactPoint>& points, const std::vector<ContactRole>& roles,
                                  const CarryingRows& carrying) const {
  std::vector<Index> rows = carrying.rows.basis;
  rows.insert(rows.end(), carrying.rows.implied.begin(), carrying.rows.implied.end());
  Mat W = Mat::Zero(F_0_.size(), Index(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) W(rows[k], Index(k)) = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& p = points[i];
    if (roles[i].tangent != Tangent::slides || p.normal < 0) continue;
    W.middleRows(p.tangent, p.tangents) += roles[i].ratio.head(p.tangents) * W.row(p.normal);
  }
  return W;
}

double CarryingEquations::least_pivot() const {
  return last_pivot(lu_);
}

Vec CarryingEquations::correction(const Vec& a) const {
  const Vec right = -scale_.cwiseProduct(a(basis_));
  return scale_.cwiseProduct(lu_.solve(right));
}

Vec CarryingEquations::forces() const {
  if (basis_.empty()) return F_0_;
  return F_0_ + F_lambda_ * correction(rest_);
}

}  // namespace trammel::complementarity
