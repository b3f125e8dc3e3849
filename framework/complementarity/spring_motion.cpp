#include "complementarity/spring_motion.hpp"

#include <algorithm>

#include <trammel/decompositions.hpp>

#include "complementarity/contact_forces.hpp"
#include "complementarity/shares/springs_at_rest.hpp"

namespace trammel::complementarity {
namespace {

// How much more than springs bodies yield to what is missed of the resultants: each round leaves the inverse of it.
// With 1e5 contacts near their bounds miss more than `lost_balance`, whatever the number of rounds.
constexpr double yields_more = 1e6;
constexpr int most_rounds_of_yielding = 8, most_rounds_of_modes = 20;
// Of the resultants: more is a loss of balance, less is what the rounds leave. The loads exceed it within an instant.
constexpr double lost_balance = 1e-8, no_loss = 1e-12;
// Of the forces: what the solution near the springs may be off their conditions. It moves springs beyond their bounds,
// step after step, and so past the load at which they let go.
constexpr double obeys = 1e-9;

// Of all springs, of which there is one at least.
bool push_is_known(const std::vector<SharingContact>& contacts) {
  const auto unknown = [](const SharingContact& c) { return c.normal >= 0 && !c.push; };
  return std::none_of(contacts.begin(), contacts.end(), unknown) &&
         std::any_of(contacts.begin(), contacts.end(), [](const SharingContact& c) { return c.normal >= 0; });
}

ContactPoint point_of(const SharingContact& c) {
  ContactPoint p;
  p.normal = int(c.normal), p.given = c.given, p.coefficient = c.coefficient;
  if (c.tangents.empty()) return p;
  p.tangent = int(c.tangents.front()), p.tangents = int(c.tangents.size());
  p.kind = ContactPoint::Tangent::resting;
  return p;
}

std::vector<std::optional<double>> none_known(const std::vector<SharingContact>& contacts) {
  return std::vector<std::optional<double>>(contacts.size());
}

// The normal directions of the contacts, in rows of length 1 at right angles to each other: then the least y has the
// least E_n^T y, whatever the basis of the resultants was.
Mat orthonormal_rows(const Mat& E_n) {
  const Eigen::ColPivHouseholderQR<Mat> qr(E_n.transpose());
  return first_columns_of_q(qr, qr.rank()).transpose();
}

// Where it presses, the force itself is more accurate.
double push_of(double N, double moved) {
  return N > 0 ? N : std::min(0.0, moved);
}

// The forces while no spring moves: the friction that comes nearest to the balance, which is the solution if nothing is
// missed. There may be others, far away, in which all slip at once.
NearbySolution without_motion(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda) {
  NearbySolution still{Vec::Zero(E.cols()), Vec::Zero(E.cols())};
  std::vector<ContactPoint> rubbing;
  std::vector<Eigen::Index> columns;
  for (const SharingContact& c : contacts) {
    const double N = c.normal >= 0 ? std::max(0.0, *c.push) : c.given;
    if (c.normal >= 0) still.F[c.normal] = N, still.a[c.normal] = N - *c.push;
    if (c.tangents.empty() || !(N > 0)) continue;
    ContactPoint& p = rubbing.emplace_back(point_of(c));
    p.normal = -1, p.given = N, p.tangent = int(columns.size());
    columns.insert(columns.end(), c.tangents.begin(), c.tangents.end());
  }
  const Mat E_t = E(Eigen::all, columns);
  Vec T, slip;
  const Vec b = -E_t.transpose() * (lambda - E * still.F);
  if (solve_contacts(rubbing, E_t.transpose() * E_t, b, T, slip).outcome == LcpOutcome::solved) still.F(columns) = T;
  return still;
}

// How far forces are from the conditions of springs and friction that `moved` their contacts [N].
double violated(const std::vector<SharingContact>& contacts, const Vec& F, const Vec& moved) {
  double most = 0;
  for (const SharingContact& c : contacts) {
    const double N = c.normal >= 0 ? F[c.normal] : c.given, bound = c.coefficient * std::max(0.0, N);
    if (c.normal >= 0) most = std::max(most, std::abs(N - std::max(0.0, moved[c.normal])));
    if (c.tangents.empty()) continue;
    Vec along = F(c.tangents) + moved(c.tangents);
    if (const double size = along.norm(); size > bound) along *= bound / size;
    most = std::max(most, (F(c.tangents) - along).norm());
  }
  return most;
}

SpringMotion motion_of(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, const Vec& F,
                       const Vec& moved) {
  SpringMotion motion{F, {}, (lambda - E * F).norm(), violated(contacts, F, moved)};
  for (const SharingContact& c : contacts)
    motion.push.push_back(c.normal >= 0 ? std::optional(push_of(F[c.normal], moved[c.normal])) : std::nullopt);
  return motion;
}

struct SpringMode {
  bool presses = false;
  Vec ratio;  // friction to normal force where it slips; empty: sticks
};

std::vector<SpringMode> modes_shown_by(const NearbySolution& at, const std::vector<SharingContact>& contacts) {
  std::vector<SpringMode> modes;
  for (const SharingContact& c : contacts) {
    SpringMode& mode = modes.emplace_back();
    mode.presses = c.normal < 0 || at.F[c.normal] > 0;
    const Vec slip = -at.a(c.tangents);
    if (!slip.isZero(0)) mode.ratio = c.coefficient * slip.normalized();
  }
  return modes;
}

struct ForcesAndMotion {
  Vec F, moved;  // moved: p + E_n^T dy, E_t^T dy
};

// In these modes the conditions are linear. The friction of contacts that stick is the nearest to F where it is not
// unique.
ForcesAndMotion solve_in(const std::vector<SpringMode>& modes, const std::vector<SharingContact>& contacts,
                         const Mat& E, const Vec& lambda, const Vec& near) {
  ForcesAndMotion found{Vec::Zero(E.cols()), {}};
  Mat by_motion = Mat::Zero(E.cols(), E.rows());  // dF/dy
  std::vector<Eigen::Index> sticking;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const SharingContact& c = contacts[i];
    if (!modes[i].presses) continue;
    const double N = c.normal >= 0 ? *c.push : c.given;
    if (c.normal >= 0) found.F[c.normal] = N, by_motion.row(c.normal) = E.col(c.normal).transpose();
    const Vec& ratio = modes[i].ratio;
    if (ratio.size() == 0) sticking.insert(sticking.end(), c.tangents.begin(), c.tangents.end());
    if (ratio.size() > 0) found.F(c.tangents) = N * ratio;
    if (ratio.size() > 0 && c.normal >= 0) by_motion(c.tangents, Eigen::all) = ratio * E.col(c.normal).transpose();
  }
  found.F(sticking) = near(sticking);
  const Eigen::Index rows = E.rows(), held = Eigen::Index(sticking.size());
  Mat A = Mat::Zero(rows + held, rows + held);
  A << E * by_motion, E(Eigen::all, sticking), E(Eigen::all, sticking).transpose(), Mat::Zero(held, held);
  Vec b = Vec::Zero(rows + held);
  b.head(rows) = lambda - E * found.F;
  const Vec x = A.completeOrthogonalDecomposition().solve(b);
  found.F += by_motion * x.head(rows);
  found.F(sticking) += x.tail(held);
  found.moved = E.transpose() * x.head(rows);
  for (const SharingContact& c : contacts)
    if (c.normal >= 0) found.moved[c.normal] += *c.push;
  return found;
}

// Contacts that do not obey change their modes. True: some have.
bool change_modes(std::vector<SpringMode>& modes, const std::vector<SharingContact>& contacts,
                  const ForcesAndMotion& found) {
  bool changed = false;
  const double least = no_loss * found.F.norm();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const SharingContact& c = contacts[i];
    const double N = c.normal >= 0 ? found.F[c.normal] : c.given, p = c.normal >= 0 ? found.moved[c.normal] : N;
    if (modes[i].presses != (p > 0) && std::abs(p) > least) modes[i].presses = p > 0, changed = true;
    if (c.tangents.empty() || !modes[i].presses) continue;
    const Vec T = found.F(c.tangents);
    Vec& ratio = modes[i].ratio;
    if (ratio.size() > 0 && ratio.dot(Vec(found.moved(c.tangents))) < 0)
      ratio.resize(0), changed = true;
    else if (ratio.size() == 0 && T.norm() > c.coefficient * std::max(0.0, N) + least)
      ratio = c.coefficient * T.normalized(), changed = true;
  }
  return changed;
}

// The solution near `at`, which is known up to the errors beside forces that are `yields_more` times as large.
SpringMotion without_yielding(const NearbySolution& at, const std::vector<SharingContact>& contacts, const Mat& E,
                              const Vec& lambda) {
  std::vector<SpringMode> modes = modes_shown_by(at, contacts);
  ForcesAndMotion found = solve_in(modes, contacts, E, lambda, at.F);
  for (int round = 0; round < most_rounds_of_modes && change_modes(modes, contacts, found); ++round)
    found = solve_in(modes, contacts, E, lambda, at.F);
  return motion_of(contacts, E, lambda, found.F, found.moved);
}

// The solution near `nearby`, if it is known.
std::optional<SpringMotion> follow_near(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda,
                                        NearbySolution nearby) {
  const bool near = nearby.F.size() > 0;
  const ModeSearch search = near ? ModeSearch::none : ModeSearch::of_few_contacts;  // without it, another try follows
  const double s = yields_more * double(E.cols()) / E.squaredNorm();
  Mat A = s * E.transpose() * E;
  Vec p = Vec::Zero(E.cols()), r = lambda, F, w;
  std::vector<ContactPoint> points;
  for (const SharingContact& c : contacts) {
    points.push_back(point_of(c));
    if (c.normal >= 0) A(c.normal, c.normal) += 1, p[c.normal] = *c.push;
  }
  const std::vector<double> nothing(points.size(), 0);
  std::vector<double> violation;
  std::optional<SpringMotion> best;
  NearbySolution at;
  for (int round = 0; round < most_rounds_of_yielding; ++round) {
    const Vec b = -s * E.transpose() * r - p;
    if (solve_contacts(points, A, b, F, w, nothing, violation, {nearby, {}}, search).outcome != LcpOutcome::solved)
      return std::nullopt;
    if (near) nearby = {F, w};
    const Vec missed = lambda - E * F;
    if (best && !(missed.norm() < 0.5 * best->missed)) break;
    const Vec moved = p + s * E.transpose() * (r - E * F);
    best = motion_of(contacts, E, lambda, F, moved);
    at = {F, w};
    if (best->missed <= no_loss * lambda.norm()) break;
    r += missed;
  }
  if (!best->carries(lambda) || best->violated <= no_loss * best->F.norm()) return best;
  const SpringMotion exact = without_yielding(at, contacts, E, lambda);
  return exact.missed <= no_loss * lambda.norm() && exact.violated < best->violated ? exact : best;
}

}  // namespace

bool SpringMotion::carries(const Vec& lambda) const {
  return missed <= lost_balance * lambda.norm();
}

SpringsThatHold SpringMotion::springs() const {
  SpringSet set;
  for (const std::optional<double>& p : push) set.push_back(!p || *p > 0 ? Spring::presses : Spring::parts);
  return {set, push};
}

std::optional<SpringMotion> follow_loads(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda) {
  if (!push_is_known(contacts)) return std::nullopt;
  const NearbySolution still = without_motion(contacts, E, lambda);
  SpringMotion unmoved{still.F, {}, (lambda - E * still.F).norm()};
  for (const SharingContact& c : contacts) unmoved.push.push_back(c.push);
  if (unmoved.carries(lambda)) return unmoved;
  const SpringMotion direct = without_yielding(still, contacts, E, lambda);
  if (direct.missed <= no_loss * lambda.norm() && direct.violated <= no_loss * direct.F.norm()) return direct;
  const auto near = follow_near(contacts, E, lambda, still);
  if (near && near->carries(lambda) && near->violated <= obeys * near->F.norm()) return near;
  return follow_near(contacts, E, lambda, {});
}

// Loads that these normal forces carry without friction are followed from springs that touch.
std::vector<std::optional<double>> pushes_of(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& N) {
  if (!can_be_wedged_in(contacts, E)) return none_known(contacts);
  std::vector<SharingContact> without_friction;
  std::vector<Eigen::Index> columns, who;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].normal < 0) continue;
    SharingContact& c = without_friction.emplace_back();
    c.normal = Eigen::Index(who.size()), c.push = 0;
    columns.push_back(contacts[i].normal), who.push_back(Eigen::Index(i));
  }
  const Mat normals = orthonormal_rows(E(Eigen::all, columns));
  const Vec lambda = normals * N(who);
  const auto motion = follow_loads(without_friction, normals, lambda);
  std::vector<std::optional<double>> pushes = none_known(contacts);
  if (!motion || !motion->carries(lambda)) return pushes;
  for (std::size_t k = 0; k < who.size(); ++k) pushes[std::size_t(who[k])] = motion->push[k];
  return pushes;
}

}  // namespace trammel::complementarity
