#include "system/equations/shared_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
// Relative to the multipliers of joints that hold the rows of a group: a smaller part in an implied row counts as 0.
constexpr double round_off_of_joints = 1e-12;
// Relative to the load of a joint: the fixed-point iteration ends at changes up to this. Each change is about mu times
// the one before.
constexpr double round_off_of_loads = 1e-13;
// Of the forces that are shared: smaller changes that no longer decrease end it, too, and loads that differ by less are
// the same ones again.
constexpr double round_off_of_shares = 1e-9;
constexpr int most_rounds = 100;
constexpr int most_moves = 10;  // in a row: doublings of loads, or halvings of their change

using LoadsOfJoints = std::map<int, double>;

// Relative to the loads; the largest of all joints, infinite if there are none to compare with.
double change(const LoadsOfJoints& from, const LoadsOfJoints& to) {
  if (from.size() != to.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (const auto& [joint, load] : to) {
    const double before = from.at(joint), scale = std::max(load, before);
    if (scale > 0) largest = std::max(largest, std::abs(load - before) / scale);
  }
  return largest;
}

LoadsOfJoints doubled(LoadsOfJoints loads) {
  for (auto& [joint, load] : loads) load *= 2;
  return loads;
}

LoadsOfJoints halfway(LoadsOfJoints from, const LoadsOfJoints& to) {
  for (auto& [joint, load] : from) load = (load + to.at(joint)) / 2;
  return from;
}

}  // namespace

void SharedRowsAtPoint::lay_out() {
  solved_at_.assign(contacts_.modes.shared.size(), {});
  off_span_.assign(contacts_.modes.shared.size(), 0);
  part_of_joints_.assign(contacts_.modes.shared.size(), {});
  friction_.clear_shares();
  followed_at_ = -1;
}

void SharedRowsAtPoint::evaluate_rows() {
  if (!rows_.evaluate()) return;
  if (rows_.coupled() && (contacts_.loads.sliding_shares() || !friction_.none()) && follow()) rows_.couple();
}

bool SharedRowsAtPoint::follow() {
  std::vector<SharedRows>& groups = contacts_.modes.shared;
  if (groups.empty()) return false;
  evaluate_rows();  // calls this function itself if the shares affect the motion
  if (std::exchange(followed_at_, at_.configuration) == at_.configuration) return false;
  part_of_joints_.assign(groups.size(), {});
  const Vec some = response_.some_motion(), sizes = response_.sizes_of_motions();
  bool changed = false;
  for (int group = 0; group < int(groups.size()); ++group) {
    const SharedRows& shared = groups[std::size_t(group)];
    double& off = off_span_[std::size_t(group)];
    const Off before = off_span(shared, some, sizes);
    off = before.of_free;
    if (before.of_terms <= round_off) continue;
    renew(group);
    off = off_span(shared, some, sizes).of_free;
    changed = true;
  }
  if (friction_.none()) return changed;
  share_with_joints();
  return true;
}

// g_implied = K g_basis + C g_joints
const Mat& SharedRowsAtPoint::part_of_joints(int g) {
  std::optional<Mat>& part = part_of_joints_[std::size_t(g)];
  if (part) return *part;
  const SharedRows& group = contacts_.modes.shared[std::size_t(g)];
  const Index n = group.K.cols(), m = group.K.rows();
  std::vector<ContactDirection> all = group.basis;
  all.insert(all.end(), group.implied.begin(), group.implied.end());
  const Mat held = response_.held_by_joints(all), K = group.K.transpose();
  Mat& C = part.emplace(held.rightCols(m) - held.leftCols(n) * K);
  const Mat terms = held.rightCols(m).cwiseAbs() + held.leftCols(n).cwiseAbs() * K.cwiseAbs();
  if (terms.size() > 0) C = (C.array().abs() > round_off_of_joints * terms.maxCoeff()).select(C, 0).eval();
  return C;
}

// Forces F = -share lambda along the implied rows add C^T F to the multipliers of the joints.
void SharedRowsAtPoint::share_with_joints() {
  friction_.clear_shares();
  for (int g = 0; g < int(contacts_.modes.shared.size()); ++g) {
    const SharedRows& group = contacts_.modes.shared[std::size_t(g)];
    std::vector<int> rows;
    for (int k = 0; k < int(group.basis.size()); ++k) rows.push_back(contacts_.loads.row_of_basis(g, k));
    friction_.add_shares(rows, -part_of_joints(g) * group.share.bottomRows(group.K.rows()));
  }
}

Vec SharedRowsAtPoint::reactions(const Vec& lambda) {
  follow();
  Vec all = lambda;
  for (int g = 0; g < int(contacts_.modes.shared.size()); ++g) {
    const SharedRows& group = contacts_.modes.shared[std::size_t(g)];
    Vec F(group.K.rows());
    for (Index i = 0; i < F.size(); ++i) F[i] = force_along(group.implied[std::size_t(i)], lambda);
    all.head(rows_.held()) += part_of_joints(g) * F;
  }
  return all;
}

SharedRowsAtPoint::Rate SharedRowsAtPoint::rate_by(ContactDirection d, const Vec& some, const Vec& sizes) {
  Rate rate;
  at_.for_each_entry(contacts_.slots(d.contact), contacts_.rows(d.contact), d.row, [&](double along, int velocity) {
    const double term = along * some(velocity);
    rate.sum += term, rate.terms += std::abs(term), rate.free += std::abs(along * sizes(velocity));
  });
  return rate;
}

// The largest parts of all implied rows. Rates that joints hold at 0 are round-off, however small their terms are.
SharedRowsAtPoint::Off SharedRowsAtPoint::off_span(const SharedRows& group, const Vec& some, const Vec& sizes) {
  std::vector<Rate> of_basis;
  Off largest;
  for (const ContactDirection& d : group.basis) of_basis.push_back(rate_by(d, some, sizes));
  for (Index i = 0; i < group.K.rows(); ++i) {
    const Rate own = rate_by(group.implied[std::size_t(i)], some, sizes);
    double off = own.sum, terms = own.terms, free = own.free;
    for (Index j = 0; j < group.K.cols(); ++j) {
      const Rate& other = of_basis[std::size_t(j)];
      const double times = std::abs(group.K(i, j));
      off -= group.K(i, j) * other.sum;
      terms += times * other.terms, free += times * other.free;
    }
    if (terms > 0) largest.of_terms = std::max(largest.of_terms, std::abs(off) / terms);
    if (free > 0) largest.of_free = std::max(largest.of_free, std::abs(off) / free);
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

SharedRowsAtPoint::LoadsOfJoints SharedRowsAtPoint::loads_as_springs(int group, const Vec& lambda) {
  LoadsOfJoints loads;
  for (const ContactDirection& d : contacts_.loads.members(group))
    if (contacts_.in_joint(d.contact)) loads[d.contact] = friction_.load(d.contact, lambda);
  return loads;
}

// The forces that a group shares act on its joints, in place of those of equal springs.
SharedRowsAtPoint::LoadsOfJoints SharedRowsAtPoint::loads_as_solved(int group, const Vec& lambda) {
  LoadsOfJoints loads = solved_at_[std::size_t(group)].of_joints;
  if (loads.empty()) return loads;
  const std::vector<ContactDirection>& implied = contacts_.modes.shared[std::size_t(group)].implied;
  Vec more(Index(implied.size()));
  for (std::size_t i = 0; i < implied.size(); ++i)
    more[Index(i)] =
        contacts_.loads.load(contacts_.loads.place(implied[i])) - contacts_.loads.spring(implied[i], lambda);
  const Vec on_joints = part_of_joints(group) * more;
  for (auto& [contact, load] : loads) load = friction_.load(contact, lambda, on_joints);
  return loads;
}

// A joint that slides, or shares with none, has the load of equal springs, which affects the motion.
double SharedRowsAtPoint::load_of_joint(int contact, const Vec& lambda) {
  follow();
  int group = -1;
  for (int k = 0; k < contacts_.tangents(contact); ++k)
    group = std::max(group, contacts_.loads.place({contact, 1 + k}).group);
  if (group < 0) return friction_.load(contact, lambda);
  solved(group, lambda);
  return solved_at_[std::size_t(group)].of_joints.at(contact);
}

ContactLoads::Bounds SharedRowsAtPoint::bounds(int contact, const Vec& lambda, const LoadsOfJoints& of_joints) {
  const ContactEntry& entry = contacts_.entry(contact);
  ContactLoads::Bounds bounds;
  if (entry.coulomb) bounds.coefficient = entry.coulomb->static_coefficient();
  if (contacts_.in_joint(contact))
    bounds.given = of_joints.at(contact);
  else if (contacts_.loads.place({contact, 0}).group < 0)
    bounds.given = std::max(0.0, force_along({contact, 0}, lambda));
  return bounds;
}

const ContactLoads& SharedRowsAtPoint::prepared(int group, const Vec& lambda) {
  if (!friction_.none()) solved(group, lambda);
  follow();
  const SolvedAt at = std::exchange(solved_at_[std::size_t(group)], {});
  contacts_.loads.prepare(group, lambda, [&](int contact) { return bounds(contact, lambda, at.of_joints); });
  return contacts_.loads;
}

// E of ContactLoads::solve_with_sliding: a largest set of independent rows of the motions that unit forces cause.
// Empty where nothing slides.
Mat SharedRowsAtPoint::moved_with_sliding(int group) {
  if (contacts_.modes.shared[std::size_t(group)].sliding.empty()) return {};
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

ContactLoads::Held SharedRowsAtPoint::solve(int group, const Vec& lambda, const LoadsOfJoints& of_joints) {
  using Held = ContactLoads::Held;
  ContactLoads& loads = contacts_.loads;
  const Held held = loads.solve(group, lambda, [&](int contact) { return bounds(contact, lambda, of_joints); });
  if (held != Held::beyond_cones) return held;
  if (!contacts_.modes.shared[std::size_t(group)].sliding.empty())
    if (loads.solve_with_sliding(group, moved_with_sliding(group))) return Held::with_sliding;
  loads.solve_beyond_cones(group);
  return held;
}

// The loads of joints at rest bound the forces that are shared, and follow from them: a fixed-point iteration. Larger
// loads hold whatever smaller ones do. So it begins with loads that hold the group, as far as any do, and where those
// that follow no longer hold it as well, it goes halfway back. If the same loads follow again, or it comes to no end
// this way, no loads are those of forces that they bound; the last that followed count, which do not hold the group.
const ContactLoads& SharedRowsAtPoint::solved(int group, const Vec& lambda) {
  using Held = ContactLoads::Held;
  follow();
  SolvedAt& at = solved_at_[std::size_t(group)];
  if (at.is(at_, lambda)) return contacts_.loads;
  at = {at_.number, at_.configuration, lambda, loads_as_springs(group, lambda)};
  Held best = Held::beyond_cones;
  LoadsOfJoints last, followed = at.of_joints;  // the last loads under which it was held best, those that followed
  LoadsOfJoints too_small;                      // the last that followed and did not hold it as well
  double least = std::numeric_limits<double>::infinity();  // change so far
  for (int round = 0, moves = 0; round < most_rounds && moves <= most_moves; ++round) {
    const Held held = solve(group, lambda, at.of_joints);
    if (at.of_joints.empty()) return contacts_.loads;
    if (held == Held::beyond_cones || held < best) {
      if (moves == 0) too_small = at.of_joints;
      at.of_joints = last.empty() ? doubled(at.of_joints) : halfway(at.of_joints, last), ++moves;
      continue;
    }
    LoadsOfJoints next = loads_as_solved(group, lambda);
    last = std::exchange(at.of_joints, next);
    const double changed = change(last, next);
    if (changed <= round_off_of_loads || (changed <= round_off_of_shares && changed >= least)) return contacts_.loads;
    best = held, followed = std::move(next), moves = 0, least = changed;
    if (change(too_small, followed) <= round_off_of_shares) break;
  }
  at.of_joints = std::move(followed);
  (void)solve(group, lambda, at.of_joints);
  return contacts_.loads;
}

double SharedRowsAtPoint::force_along(ContactDirection d, const Vec& lambda) {
  const ContactLoads::Place& place = contacts_.loads.place(d);
  if (d.row == 0 && contacts_.in_joint(d.contact)) return load_of_joint(d.contact, lambda);
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
