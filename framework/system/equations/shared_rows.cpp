#include "system/equations/shared_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <trammel/decompositions.hpp>

#include "complementarity/shares/carrying_rows.hpp"
#include "complementarity/shares/independent_rows.hpp"
#include "linear/dense/block_signs.hpp"

namespace trammel::model {
namespace {

using Eigen::Index;

// Relative to the terms of the rates of a motion: K is still valid. Shares, and with them the forces of idle contacts,
// jump by as much where K is renewed.
constexpr double round_off = 1e-13;

}  // namespace

void SharedRowsAtPoint::lay_out() {
  solved_at_.assign(contacts_.modes.shared.size(), {});
  off_span_.assign(contacts_.modes.shared.size(), 0);
}

void SharedRowsAtPoint::evaluate_rows() {
  if (!rows_.evaluate()) return;
  if (rows_.coupled() && contacts_.loads.sliding_shares() && follow()) rows_.couple();
}

bool SharedRowsAtPoint::follow() {
  std::vector<SharedRows>& groups = contacts_.modes.shared;
  if (groups.empty()) return false;
  evaluate_rows();  // calls this function itself if the shares affect the motion
  if (std::exchange(followed_at_, at_.configuration) == at_.configuration) return false;
  const Vec some = response_.some_motion();
  bool changed = false;
  for (int group = 0; group < int(groups.size()); ++group) {
    const SharedRows& shared = groups[std::size_t(group)];
    double& off = off_span_[std::size_t(group)];
    off = off_span(shared, some);
    if (off <= round_off) continue;
    renew(group);
    off = off_span(shared, some);
    changed = true;
  }
  return changed;
}

SharedRowsAtPoint::Rate SharedRowsAtPoint::rate_by(ContactDirection d, const Vec& some) {
  Rate rate;
  at_.for_each_entry(contacts_.slots(d.contact), contacts_.rows(d.contact), d.row, [&](double along, int velocity) {
    const double term = along * some(velocity);
    rate.sum += term, rate.terms += std::abs(term);
  });
  return rate;
}

// The largest rate of implied rows that K leaves, relative to its terms.
double SharedRowsAtPoint::off_span(const SharedRows& group, const Vec& some) {
  std::vector<Rate> of_basis;
  double largest = 0;
  for (const ContactDirection& d : group.basis) of_basis.push_back(rate_by(d, some));
  for (Index i = 0; i < group.K.rows(); ++i) {
    const Rate own = rate_by(group.implied[std::size_t(i)], some);
    double off = own.sum, terms = own.terms;
    for (Index j = 0; j < group.K.cols(); ++j) {
      const Rate& other = of_basis[std::size_t(j)];
      off -= group.K(i, j) * other.sum;
      terms += std::abs(group.K(i, j)) * other.terms;
    }
    if (terms > 0) largest = std::max(largest, std::abs(off) / terms);
  }
  return largest;
}

void SharedRowsAtPoint::renew(int group) {
  SharedRows& shared = contacts_.modes.shared[std::size_t(group)];
  std::vector<ContactDirection> all = shared.basis;
  all.insert(all.end(), shared.implied.begin(), shared.implied.end());
  std::vector<Index> basis, implied;
  for (std::size_t k = 0; k < all.size(); ++k) (k < shared.basis.size() ? basis : implied).push_back(Index(k));
  Mat jump, A;
  response_.respond(all, jump, A);
  const Mat K = complementarity::implied_by(A, basis, implied);
  if (!K.allFinite()) return;  // the basis has become dependent; the solver for accelerations handles this
  std::vector<bool> idle;
  for (Index k = 0; k < shared.share.rows(); ++k) idle.push_back(shared.share.row(k).isZero(0));
  shared.K = K;
  const bool any_idle = std::find(idle.begin(), idle.end(), true) != idle.end();
  shared.share =
      any_idle ? complementarity::least_norm_shares(shared.resultants(), idle) : complementarity::least_norm_shares(K);
  contacts_.loads.form_resultants(group);
}

ContactLoads::Bounds SharedRowsAtPoint::bounds(int contact, const Vec& lambda) {
  const ContactEntry& entry = contacts_.entry(contact);
  ContactLoads::Bounds bounds;
  if (entry.coulomb) bounds.coefficient = entry.coulomb->static_coefficient();
  if (contacts_.loads.place({contact, 0}).group < 0) bounds.given = std::max(0.0, force_along({contact, 0}, lambda));
  return bounds;
}

const ContactLoads& SharedRowsAtPoint::prepared(int group, const Vec& lambda) {
  follow();
  solved_at_[std::size_t(group)] = {};
  contacts_.loads.prepare(group, lambda, [&](int contact) { return bounds(contact, lambda); });
  return contacts_.loads;
}

// Independent combinations of velocities, as many as there are.
Mat SharedRowsAtPoint::moved_with_sliding(int group) {
  std::vector<ContactDirection> all = contacts_.loads.members(group);
  const auto members = Index(all.size());
  const std::vector<int>& sliding = contacts_.modes.shared[std::size_t(group)].sliding;
  for (const int contact : sliding)
    for (int k = 0; k <= contacts_.tangents(contact); ++k) all.push_back({contact, k});
  Mat jump, A;
  evaluate_rows();
  response_.respond(all, jump, A);
  // Uses accelerations along the directions: those of coordinates have different units.
  Mat moved(A.rows(), members + Index(sliding.size()));
  moved.leftCols(members) = A.leftCols(members);
  Index column = members, from = members;
  for (const int contact : sliding) {
    const Index n = contacts_.tangents(contact);
    moved.col(column++) = A.col(from) + A.middleCols(from + 1, n) * contacts_.friction_ratio(contact).head(n);
    from += 1 + n;
  }
  return complementarity::independent_rows(moved);
}

const ContactLoads& SharedRowsAtPoint::solved(int group, const Vec& lambda) {
  ContactLoads& loads = contacts_.loads;
  follow();
  SolvedAt& at = solved_at_[std::size_t(group)];
  if (at.point == at_.number && at.configuration == at_.configuration && at.lambda.size() == lambda.size() &&
      at.lambda == lambda)
    return loads;
  bool found = loads.solve(group, lambda, [&](int contact) { return bounds(contact, lambda); });
  if (!found && !contacts_.modes.shared[std::size_t(group)].sliding.empty())
    found = loads.solve_with_sliding(group, moved_with_sliding(group));
  if (!found) loads.solve_beyond_cones(group);
  at = {at_.number, at_.configuration, lambda};
  return loads;
}

double SharedRowsAtPoint::force_along(ContactDirection d, const Vec& lambda) {
  const ContactLoads::Place& place = contacts_.loads.place(d);
  if (d.row == 0 && contacts_.in_joint(d.contact)) return friction_.load(d.contact, lambda);
  if (place.group >= 0) return solved(place.group, lambda).load(place);
  if (place.row >= 0) return -lambda(place.row);
  if (d.row > 0 || !contacts_.entry(d.contact).force || !contacts_.mode(d.contact).closed) return 0;
  if (contacts_.on_surface(d.contact)) return contacts_.surface(d.contact).sums().normal;
  return contacts_.law_normal(d.contact);
}

double SharedRowsAtPoint::spring_force(int contact, const Vec& lambda) {
  follow();
  const ContactLoads::Place& place = contacts_.loads.place({contact, 0});
  const SharedRows& shared = contacts_.modes.shared[std::size_t(place.group)];
  const Mat E = shared.resultants();
  std::vector<Index> among;
  for (Index k = 0; k < E.cols(); ++k)
    if (!shared.share.row(k).isZero(0)) among.push_back(k);
  among.push_back(place.index);
  Vec resultants(E.rows());
  for (Index k = 0; k < E.rows(); ++k) resultants[k] = -lambda(contacts_.loads.row_of_basis(place.group, int(k)));
  return complementarity::force_as_spring(E(Eigen::all, among), resultants);
}

double SharedRowsAtPoint::leverage(int group) {
  follow();
  return contacts_.modes.shared[std::size_t(group)].K.rowwise().lpNorm<1>().maxCoeff();
}

double SharedRowsAtPoint::off_span(int group) {
  follow();
  return off_span_[std::size_t(group)];
}

void SharedRowsAtPoint::change_signs(numerics::BlockSigns& signs) {
  follow();
  for (int group = 0; group < int(contacts_.modes.shared.size()); ++group) {
    const SharedRows& shared = contacts_.modes.shared[std::size_t(group)];
    std::vector<Index> carrying;
    for (Index k = 0; k < shared.share.rows(); ++k)
      if (!shared.share.row(k).isZero(0)) carrying.push_back(k);
    if (std::ssize(carrying) == shared.share.rows() || std::ssize(carrying) != shared.K.cols()) continue;
    const Mat E = shared.resultants()(Eigen::all, carrying);
    if (!(Eigen::PartialPivLU<Mat>(E).determinant() < 0)) continue;
    std::vector<int> rows;
    for (int k = 0; k < int(shared.basis.size()); ++k) rows.push_back(contacts_.loads.row_of_basis(group, k));
    signs.flip(rows);
  }
}

}  // namespace trammel::model
