#include "complementarity/spring_motion.hpp"

#include <algorithm>

#include "complementarity/contact_forces.hpp"

namespace trammel::complementarity {
namespace {

// How much more than springs bodies yield to what is missed of the resultants: each round leaves the inverse of it.
// With 1e5 contacts near their bounds miss more than `lost_balance`, whatever the number of rounds.
constexpr double yields_more = 1e6;
constexpr int most_rounds_of_yielding = 8;
// Of the resultants: more is a loss of balance, less is what the rounds leave. The loads exceed it within an instant.
constexpr double lost_balance = 1e-8, no_loss = 1e-12;

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

// Where it presses, the force itself is more accurate.
double push_of(double N, double moved) {
  return N > 0 ? N : std::min(0.0, moved);
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
  const double s = yields_more * double(E.cols()) / E.squaredNorm();
  Mat A = s * E.transpose() * E;
  Vec p = Vec::Zero(E.cols()), r = lambda, F, w;
  std::vector<ContactPoint> points;
  for (const SharingContact& c : contacts) {
    points.push_back(point_of(c));
    if (c.normal >= 0) A(c.normal, c.normal) += 1, p[c.normal] = *c.push;
  }
  std::optional<SpringMotion> best;
  for (int round = 0; round < most_rounds_of_yielding; ++round) {
    const Vec b = -s * E.transpose() * r - p;
    if (solve_contacts(points, A, b, F, w).outcome != LcpOutcome::solved) return std::nullopt;
    const Vec missed = lambda - E * F;
    if (best && !(missed.norm() < best->missed)) break;
    const Vec moved = p + s * E.transpose() * (r - E * F);
    best = SpringMotion{F, {}, missed.norm()};
    for (const SharingContact& c : contacts)
      best->push.push_back(c.normal >= 0 ? std::optional(push_of(F[c.normal], moved[c.normal])) : std::nullopt);
    if (best->missed <= no_loss * lambda.norm()) break;
    r += missed;
  }
  return best;
}

}  // namespace trammel::complementarity
