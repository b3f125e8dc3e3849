#include "problem.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::complementarity {
namespace {

using Tangent = ContactPoint::Tangent;

// The rows of A that belong to the contacts, in this order.
std::vector<Eigen::Index> rows_of(const Problem& problem, const std::vector<std::size_t>& order) {
  std::vector<Eigen::Index> rows;
  for (const std::size_t i : order) {
    const ContactPoint& p = problem.points[i];
    if (p.normal >= 0) rows.push_back(p.normal);
    for (int k = 0; k < p.tangents && p.tangent >= 0; ++k) rows.push_back(p.tangent + k);
  }
  return rows;
}

double normal_offence(const ContactPoint& p, const Mat& A, const Vec& F, const Vec& a) {
  const double N = A(p.normal, p.normal) * F[p.normal], a_n = a[p.normal];
  return std::max({-N, -a_n, std::min(std::abs(N), std::abs(a_n))});
}

double tangent_offence(const ContactPoint& p, const Mat& A, const Vec& F, const Vec& a, double little) {
  const auto T = F.segment(p.tangent, p.tangents), a_t = a.segment(p.tangent, p.tangents);
  const double stiff = A.block(p.tangent, p.tangent, p.tangents, p.tangents).trace() / p.tangents;
  const double N = p.normal >= 0 ? F[p.normal] : p.given;
  if (p.kind == Tangent::sliding) return stiff * (T - N * p.ratio.head(p.tangents)).norm();
  const double bound = p.coefficient * std::max(0.0, N);
  if (a_t.norm() <= little) return stiff * std::max(0.0, T.norm() - bound);
  // Slides, or its acceleration is an error.
  return std::min(a_t.norm(), stiff * (T + bound * a_t.normalized()).norm());
}

}  // namespace

Answer solve(const Problem& problem, double nothing) {
  Answer answer;
  const ContactSolution found = solve_contacts(problem.points, problem.A, problem.b, answer.F, answer.a, nothing);
  answer.outcome = found.outcome;
  answer.violation = found.violation;
  return answer;
}

double little(const Problem& problem, const Vec& F) {
  return 1e-9 * problem.b.lpNorm<Eigen::Infinity>() +
         1e-13 * (problem.A.cwiseAbs() * F.cwiseAbs()).lpNorm<Eigen::Infinity>();
}

double offence(const Problem& problem, const Vec& F, const Vec& a) {
  double worst = (problem.A * F + problem.b - a).lpNorm<Eigen::Infinity>();
  for (const ContactPoint& p : problem.points) {
    if (p.normal >= 0) worst = std::max(worst, normal_offence(p, problem.A, F, a));
    if (p.tangent >= 0 && p.kind != Tangent::none)
      worst = std::max(worst, tangent_offence(p, problem.A, F, a, little(problem, F)));
  }
  return worst;
}

Problem permuted(const Problem& problem, const std::vector<std::size_t>& order) {
  Problem result;
  result.kind = problem.kind;
  int rows = 0;
  for (const std::size_t i : order) {
    ContactPoint& p = result.points.emplace_back(problem.points[i]);
    if (p.normal >= 0) p.normal = rows++;
    if (p.tangent >= 0) p.tangent = rows, rows += p.tangents;
  }
  const std::vector<Eigen::Index> from = rows_of(problem, order);
  result.A = problem.A(from, from);
  result.b = problem.b(from);
  return result;
}

Vec permuted_back(const Problem& problem, const std::vector<std::size_t>& order, const Vec& x) {
  Vec result(x.size());
  Eigen::Index k = 0;
  for (const Eigen::Index row : rows_of(problem, order)) result[row] = x[k++];
  return result;
}

}  // namespace trammel::complementarity
