// Rows that are implied by others at the point:
//
//     g_implied = K g_basis + a combination of the joints' rows
//
// K depends on the configuration. It is constant if the dependence follows from the geometry of one body, such as the
// feet of a table; it changes if bodies that touch at one point turn against each other. K is tested with one
// pseudo-random motion that the joints permit.
#include <cmath>
#include <utility>

#include "complementarity/shares/carrying_rows.hpp"
#include "system/assembly.hpp"

namespace trammel::model {
namespace {

using Eigen::Index;

// Relative to the rates of the motion. Entries of K below 1e-9 are neglected (complementarity/shares/row_basis.cpp),
// which limits its accuracy.
constexpr double same = 1e-8;
// Relative to the terms of a rate, if joints fix the direction.
constexpr double round_off = 1e-12;

Vec pseudo_random(Index n) {
  return Vec::NullaryExpr(n, [](Index i) { return std::sin(1 + 1.618033988749895 * double(i * i + 1)); });
}

}  // namespace

Vec AssembledSystem::Work::some_motion() {
  const Vec weight = mass_diagonal().cwiseSqrt(), numbers = pseudo_random(sizes.nv);
  if (held_rows == 0) return numbers.cwiseQuotient(weight);
  Vec some;
  with_joints_held()(numbers.cwiseProduct(weight), some);
  return some;
}

AssembledSystem::Work::Rate AssembledSystem::Work::rate_by(ContactDirection d, const Vec& some) {
  const Rows& r = contact(d.contact);
  const Slots& at = contact_slots[std::size_t(d.contact)];
  Rate rate;
  for (int k = 0; k < at.count; ++k) {
    if (chain.body(at[k]) < 0) continue;
    const Motion& m = motion(at[k]);
    const int v0 = chain.first_velocity(at[k]);
    for_each_column({r.H(k), d.row, 1}, m.J, [&](Index j, const double* along, auto) {
      const double term = *along * some(v0 + m.dofs[std::size_t(j)]);
      rate.sum += term, rate.terms += std::abs(term);
    });
  }
  return rate;
}

bool AssembledSystem::Work::still_implied(const SharedRows& group, const Vec& some) {
  std::vector<Rate> of_basis;
  for (const ContactDirection& d : group.basis) of_basis.push_back(rate_by(d, some));
  for (Index i = 0; i < group.K.rows(); ++i) {
    const Rate own = rate_by(group.implied[std::size_t(i)], some);
    double off = own.sum, size = std::abs(own.sum), terms = own.terms;
    for (Index j = 0; j < group.K.cols(); ++j) {
      const Rate& other = of_basis[std::size_t(j)];
      off -= group.K(i, j) * other.sum;
      size += std::abs(group.K(i, j) * other.sum), terms += std::abs(group.K(i, j)) * other.terms;
    }
    if (std::abs(off) > same * size + round_off * terms) return false;
  }
  return true;
}

bool AssembledSystem::Work::follow_shares() {
  if (modes.shared.empty()) return false;
  evaluate_rows();  // which updates the shares if they affect the motion
  if (std::exchange(shares_at, configuration) == configuration) return false;
  const Vec some = some_motion();
  bool changed = false;
  for (int group = 0; group < int(modes.shared.size()); ++group) {
    if (still_implied(modes.shared[std::size_t(group)], some)) continue;
    renew_shares(group);
    changed = true;
  }
  return changed;
}

void AssembledSystem::Work::renew_shares(int group) {
  SharedRows& shared = modes.shared[std::size_t(group)];
  std::vector<ContactDirection> all = shared.basis;
  all.insert(all.end(), shared.implied.begin(), shared.implied.end());
  std::vector<Index> basis, implied;
  for (std::size_t k = 0; k < all.size(); ++k) (k < shared.basis.size() ? basis : implied).push_back(Index(k));
  Mat jump, A;
  impulse_response(all, jump, A);
  const Mat K = complementarity::implied_by(A, basis, implied);
  if (!K.allFinite()) return;  // the basis has become dependent: handled by the solver for accelerations
  Mat shares = K;
  for (Index i = 0; i < K.rows(); ++i)
    if (shared.share.row(Index(basis.size()) + i).isZero(0)) shares.row(i).setZero();  // idle
  shared.K = K;
  shared.share = complementarity::least_norm_shares(shares);
  loads.form_resultants(group);
}

}  // namespace trammel::model
