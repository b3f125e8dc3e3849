#include "simulate/contact/contact_audit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

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

void ContactAudit::take_force(int contact, double force) {
  double& largest = largest_[contact];
  largest = std::max(largest, force);
}

bool ContactAudit::counts(const Worst& worst) const {
  if (worst.contact < 0) return false;
  const auto largest = largest_.find(worst.contact);
  return largest == largest_.end() || worst.force > eps * largest->second;
}

void ContactAudit::raise(Worst& worst, int contact, double t, double amount, double scale) {
  take_force(contact, scale);
  if (!counts(worst)) worst = {};
  const Worst found{contact, t, amount, amount / scale};
  if (amount > std::max(little, worst.relative) * scale && counts(found)) worst = found;
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
    take_force(i, std::max(std::abs(N), T.norm()));
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
    raise_worst(looked.contact, state.t, looked.excess, acts, scale.of(looked.contact));
  }
}

void ContactAudit::raise_worst(int contact, double t, const Excess& excess, const ActsOn& acts, const Scale& scale) {
  if (excess.pull > acts.noise) raise(pull_, contact, t, excess.pull, acts.force);
  if (excess.beyond_cone > acts.noise) raise(beyond_cone_, contact, t, excess.beyond_cone, acts.force);
  if (excess.along_slip > acts.noise && excess.slip > drift_beside(acts.speed, scale))
    raise(along_slip_, contact, t, excess.along_slip, acts.force);
}

void ContactAudit::look_at_groups(model::AssembledSystem& system, double t, const Vec& lambda,
                                  const ContactScale& scale) {
  const std::vector<model::SharedRows>& shared = system.modes().shared;
  for (std::size_t group = 0; group < shared.size(); ++group) {
    const double missing = -system.spare_load(int(group), lambda), largest = system.largest_load(int(group), lambda);
    if (missing > little * largest && missing > noise(system, shared[group], scale))
      raise(overloaded_, shared[group].implied.front().contact, t, missing, largest);
    if (const double off = system.off_span(int(group)); off > dependent)
      raise(unbalanced_, shared[group].implied.front().contact, t, off * largest, largest);
  }
}

std::vector<std::string> ContactAudit::warnings(const model::Model& model, const Ledger& ledger,
                                                double no_energy) const {
  std::vector<std::string> texts;
  const auto name = [&model](int contact) { return model.contacts[std::size_t(contact)].path(); };
  if (counts(pull_))
    texts.push_back(fmt::format("not to be trusted: {} pulled with {:.3g} N at t = {:.9g} s; a contact only pushes",
                                name(pull_.contact), pull_.force, pull_.t));
  if (counts(beyond_cone_))
    texts.push_back(fmt::format("not to be trusted: the friction of {} was {:.3g} N beyond its bound at t = {:.9g} s",
                                name(beyond_cone_.contact), beyond_cone_.force, beyond_cone_.t));
  if (counts(along_slip_))
    texts.push_back(fmt::format(
        "not to be trusted: the friction of {} pushed along its slip with {:.3g} N at t = {:.9g} s; it only opposes it",
        name(along_slip_.contact), along_slip_.force, along_slip_.t));
  if (counts(overloaded_))
    texts.push_back(fmt::format(
        "not to be trusted: {} and those it shares rows with carry {:.3g} N more than they can at t = {:.9g} s",
        name(overloaded_.contact), overloaded_.force, overloaded_.t));
  if (counts(unbalanced_))
    texts.push_back(fmt::format(
        "not to be trusted: the forces of {} and those it shares rows with are {:.3g} N off those that move the bodies "
        "at t = {:.9g} s",
        name(unbalanced_.contact), unbalanced_.force, unbalanced_.t));
  const double moved = std::abs(ledger.dissipated()) + std::abs(ledger.supplied()) + ledger.friction().lpNorm<1>();
  for (Eigen::Index i = 0; i < ledger.friction().size(); ++i)
    if (-ledger.friction()[i] > std::max(little * moved, no_energy))
      texts.push_back(fmt::format("not to be trusted: the friction of {} supplied {:.3g} J; friction only takes",
                                  name(int(i)), -ledger.friction()[i]));
  return texts;
}

void ContactAudit::Worst::archive(Archive& a, const std::string& name) {
  a(name + "_contact", contact), a(name + "_t", t), a(name + "_force", force), a(name + "_relative", relative);
}

void ContactAudit::archive(Archive& a, std::size_t contacts) {
  const auto known = [contacts](double i) {
    if (!(i >= -1 && i < double(contacts))) throw std::out_of_range("contact");
    return int(i);
  };
  pull_.archive(a, "pull"), beyond_cone_.archive(a, "beyond_cone");
  along_slip_.archive(a, "along_slip"), overloaded_.archive(a, "overloaded");
  unbalanced_.archive(a, "unbalanced");
  for (const Worst* worst : {&pull_, &beyond_cone_, &along_slip_, &overloaded_, &unbalanced_}) known(worst->contact);
  Vec flat(Eigen::Index(3 * indeterminate_.size()));
  Eigen::Index k = 0;
  for (const auto& [contact, span] : indeterminate_) {
    flat.segment<3>(k) << contact, span.first, span.last;
    k += 3;
  }
  a("indeterminate", flat);
  indeterminate_.clear();
  for (k = 0; k + 2 < flat.size(); k += 3) indeterminate_[std::max(0, known(flat[k]))] = {flat[k + 1], flat[k + 2]};
  Vec forces = Vec::Zero(Eigen::Index(contacts));
  for (const auto& [contact, force] : largest_) forces[contact] = force;
  a("largest_forces", forces);
  if (forces.size() != Eigen::Index(contacts)) throw std::length_error("largest_forces");
  for (std::size_t i = 0; i < contacts; ++i) largest_[int(i)] = forces[Eigen::Index(i)];
}

}  // namespace trammel::simulate
