#include "complementarity/forces_at_rest.hpp"

#include <algorithm>
#include <cmath>

#include "complementarity/shares/row_basis.hpp"
#include "complementarity/spring_motion.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Index;

std::vector<Index> rows_held(const ContactPoint& p) {
  std::vector<Index> rows;
  if (p.normal >= 0) rows.push_back(p.normal);
  for (int k = 0; k < p.tangents && p.held(); ++k) rows.push_back(p.tangent + k);
  return rows;
}

// With columns by the place of each row in `held`.
SharingContact sharing(const ContactPoint& p, const std::vector<Index>& held) {
  const auto column = [&held](Index row) { return std::find(held.begin(), held.end(), row) - held.begin(); };
  SharingContact c;
  c.coefficient = p.coefficient;
  c.given = p.given;
  if (p.normal >= 0) c.normal = column(p.normal);
  for (int k = 0; k < p.tangents && p.held(); ++k) c.tangents.push_back(column(p.tangent + k));
  return c;
}

}  // namespace

std::optional<Vec> forces_at_rest(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& N) {
  std::vector<Index> rows;
  for (const ContactPoint& p : points) {
    if (p.kind == ContactPoint::Tangent::sliding || (p.normal >= 0 && std::isnan(N[p.normal]))) return std::nullopt;
    const std::vector<Index> own = rows_held(p);
    rows.insert(rows.end(), own.begin(), own.end());
  }
  const RowBasis found = find_basis(A, rows);
  const Mat E = found.resultants();
  std::vector<Index> held = found.basis;
  held.insert(held.end(), found.implied.begin(), found.implied.end());
  std::vector<SharingContact> contacts;
  std::vector<double> pressed;
  for (const ContactPoint& p : points) {
    if (rows_held(p).empty()) continue;
    contacts.push_back(sharing(p, held));
    pressed.push_back(p.normal >= 0 ? N[p.normal] : p.given);
  }
  const auto pushes = pushes_of(contacts, E, Eigen::Map<const Vec>(pressed.data(), Index(pressed.size())));
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].push = pushes[i];
  const Vec lambda = A(found.basis, found.basis).ldlt().solve(-b(found.basis));
  const std::optional<SpringMotion> motion = follow_loads(contacts, E, lambda);
  if (!motion || !motion->carries(lambda)) return std::nullopt;
  Vec F = Vec::Zero(b.size());
  F(held) = motion->F;
  return F;
}

}  // namespace trammel::complementarity
