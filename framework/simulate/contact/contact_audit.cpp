#include "simulate/contact/contact_audit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "linear/dense/eps.hpp"
#include "simulate/contact/force_noise.hpp"
#include "simulate/results/observable.hpp"

namespace trammel::simulate {
namespace {

// Of the forces that act on a contact, or of all energy that was lost: round-off, and the inaccuracy of located events.
constexpr double little = 1e-8;
// Rows up to an angle of 3e-7 to others count as dependent (complementarity/shares/row_basis.hpp).
constexpr double dependent = 1e-6;

// [N] A smaller force along any direction of the group accelerates nothing.
double noise(model::AssembledSystem& system, const model::SharedRows& group, const ContactScale& scale) {
  std::vector<model::ContactDirection> directions = group.basis;
  directions.insert(directions.end(), group.implied.begin(), group.implied.end());
  double least = std::numeric_limits<double>::infinity();
  for (const double each : judge_forces(system, directions, Vec::Zero(std::ssize(directions)), scale).noise)
    if (each > 0) least = std::min(least, each);  // 0: nothing can move along it
  return least;
}

bool never_releases(const model::ContactEntry& entry) {
  return entry.restitution && entry.restitution->treatment().release == Restitution::Release::never;
}

// [m/s] As Scale::drift, also of a scene in which nothing has moved yet.
double drift_beside(double speed, Scale scale) {
  scale.speed = std::max(scale.speed, speed);
  return scale.drift();
}

}  // namespace

void ContactAudit::raise(Violation kind, std::size_t island, const WorstForces::Worst& found, double acts) {
  worst_.take_force(island, acts);
  if (found.force > little * acts) worst_.raise(kind, island, found);
}

void ContactAudit::look(model::AssembledSystem& system, const State& state, const ContactScale& scale) {
  const std::vector<model::ContactMode>& modes = system.modes().contacts;
  std::vector<int> closed;
  for (int i = 0; i < int(modes.size()); ++i) {
    const model::ContactEntry& entry = system.model().contacts[std::size_t(i)];
    if (modes[std::size_t(i)].closed && (entry.restitution || entry.joint)) closed.push_back(i);
  }
  if (closed.empty()) return;
  Moment moment(system, state);
  const Vec& lambda = moment.lambda();
  look_at_groups(system, state.t, lambda, scale);
  for (const int i : closed) {
    if (!system.sharing(i).shared) continue;
    const auto [span, added] = indeterminate_.try_emplace(i, Span{state.t, state.t});
    span->second.last = state.t;
  }
  look_at_forces(system, state, closed, lambda, scale);
}

// By how much the force of a contact exceeds what its law permits.
ContactAudit::Excess ContactAudit::excess(model::AssembledSystem& system, int contact, double N,
                                          const model::Tangential& T, const Scale& scale) {
  const model::ContactEntry& entry = system.model().contacts[std::size_t(contact)];
  const model::ContactMode::Friction friction = system.modes().contacts[std::size_t(contact)].friction;
  Excess excess{.pull = -N};
  if (entry.coulomb && friction == model::ContactMode::Friction::stick)
    excess.beyond_cone = T.norm() - std::max(0.0, entry.coulomb->static_coefficient() * N);
  if (entry.coulomb && friction == model::ContactMode::Friction::slide) {
    const model::Tangential slip = system.slip(contact);
    excess.slip = slip.norm();
    if (excess.slip > scale.drift()) excess.along_slip = T.dot(slip) / excess.slip;
  }
  return excess;
}

void ContactAudit::look_at_forces(model::AssembledSystem& system, const State& state, const std::vector<int>& closed,
                                  const Vec& lambda, const ContactScale& scale) {
  struct Looked {
    int contact;
    Eigen::Index first;  // in F: its normal, which a joint does not have, then its tangents
    Excess excess;
  };
  std::vector<model::ContactDirection> directions;
  std::vector<double> forces;
  std::vector<Looked> all;
  bool doubtful = false;
  for (const int i : closed) {
    const model::ContactEntry& entry = system.model().contacts[std::size_t(i)];
    const double N = system.normal_force(i, lambda);
    const model::Tangential T = system.friction_force(i, lambda);
    worst_.take_force(scale.island(i), std::max(std::abs(N), T.norm()));
    const auto first = Eigen::Index(forces.size());
    if (!entry.joint) directions.push_back({i, 0}), forces.push_back(N);  // the load of bearings has no direction
    for (int k = 0; k < system.tangents(i) && entry.friction; ++k)
      directions.push_back({i, 1 + k}), forces.push_back(T[k]);
    if (never_releases(entry)) continue;  // a latch may pull
    const Excess found = excess(system, i, N, T, scale.of(i));
    doubtful = doubtful || found.largest() > little * std::abs(N);
    all.push_back({i, first, found});
  }
  if (!doubtful) return;  // the scale of the forces that act on a contact is no less than its own force
  const Judged judged =
      judge_forces(system, directions, Eigen::Map<const Vec>(forces.data(), std::ssize(forces)), scale);
  for (const Looked& looked : all) {
    ActsOn acts;
    for (Eigen::Index k = looked.first; k < judged.scale.size(); ++k) {
      if (directions[std::size_t(k)].contact != looked.contact) break;
      acts.force = std::max(acts.force, judged.scale[k]);
      acts.noise = std::max(acts.noise, judged.noise[k]);
      acts.speed = std::max(acts.speed, judged.speed[k]);
    }
    raise_worst(looked.contact, state.t, looked.excess, acts, scale);
  }
}

void ContactAudit::raise_worst(int contact, double t, const Excess& excess, const ActsOn& acts,
                               const ContactScale& scale) {
  const auto raise_if = [&](bool any, Violation kind, double force) {
    if (any && force > acts.noise) raise(kind, scale.island(contact), {contact, t, force}, acts.force);
  };
  raise_if(true, Violation::pull, excess.pull);
  raise_if(true, Violation::beyond_cone, excess.beyond_cone);
  raise_if(excess.slip > drift_beside(acts.speed, scale.of(contact)), Violation::along_slip, excess.along_slip);
}

void ContactAudit::look_at_groups(model::AssembledSystem& system, double t, const Vec& lambda,
                                  const ContactScale& scale) {
  const std::vector<model::SharedRows>& shared = system.modes().shared;
  for (std::size_t group = 0; group < shared.size(); ++group) {
    const int contact = shared[group].implied.front().contact;
    const double missing = -system.spare_load(int(group), lambda), largest = system.largest_load(int(group), lambda);
    if (missing > little * largest && missing > noise(system, shared[group], scale))
      raise(Violation::overloaded, scale.island(contact), {contact, t, missing}, largest);
    if (const double off = system.off_span(int(group)); off > dependent)
      raise(Violation::unbalanced, scale.island(contact), {contact, t, off * largest}, largest);
  }
}

std::vector<std::string> ContactAudit::warnings(const model::Model& model, const Ledger& ledger,
                                                double no_energy) const {
  std::vector<std::string> texts;
  const auto name = [&model](int contact) { return model.contacts[std::size_t(contact)].path(); };
  if (const auto worst = worst_.worst(Violation::pull))
    texts.push_back(fmt::format("not to be trusted: {} pulled with {:.3g} N at t = {:.9g} s; a contact only pushes",
                                name(worst->contact), worst->force, worst->t));
  if (const auto worst = worst_.worst(Violation::beyond_cone))
    texts.push_back(fmt::format("not to be trusted: the friction of {} was {:.3g} N beyond its bound at t = {:.9g} s",
                                name(worst->contact), worst->force, worst->t));
  if (const auto worst = worst_.worst(Violation::along_slip))
    texts.push_back(fmt::format(
        "not to be trusted: the friction of {} pushed along its slip with {:.3g} N at t = {:.9g} s; it only opposes it",
        name(worst->contact), worst->force, worst->t));
  if (const auto worst = worst_.worst(Violation::overloaded))
    texts.push_back(fmt::format(
        "not to be trusted: {} and those it shares rows with carry {:.3g} N more than they can at t = {:.9g} s",
        name(worst->contact), worst->force, worst->t));
  if (const auto worst = worst_.worst(Violation::unbalanced))
    texts.push_back(fmt::format(
        "not to be trusted: the forces of {} and those it shares rows with are {:.3g} N off those that move the bodies "
        "at t = {:.9g} s",
        name(worst->contact), worst->force, worst->t));
  const double moved = std::abs(ledger.dissipated()) + std::abs(ledger.supplied()) + ledger.friction().lpNorm<1>();
  for (Eigen::Index i = 0; i < ledger.friction().size(); ++i)
    if (-ledger.friction()[i] > std::max(little * moved, no_energy))
      texts.push_back(fmt::format("not to be trusted: the friction of {} supplied {:.3g} J; friction only takes",
                                  name(int(i)), -ledger.friction()[i]));
  return texts;
}

void ContactAudit::archive(Archive& a, std::size_t contacts) {
  worst_.archive(a, contacts);
  Vec flat(Eigen::Index(3 * indeterminate_.size()));
  Eigen::Index k = 0;
  for (const auto& [contact, span] : indeterminate_) {
    flat.segment<3>(k) << contact, span.first, span.last;
    k += 3;
  }
  a("indeterminate", flat);
  indeterminate_.clear();
  for (k = 0; k + 2 < flat.size(); k += 3)
    indeterminate_[contact_number(flat[k], contacts)] = {flat[k + 1], flat[k + 2]};
}

}  // namespace trammel::simulate
