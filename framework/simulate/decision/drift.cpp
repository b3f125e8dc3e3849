#include "simulate/decision/drift.hpp"

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;
using Tangent = Participant::Tangent;

namespace {

// Of `least_slip`: a smaller slip left in a contact at rest turns its friction by no more (system/point/slip.hpp) when
// it begins to slide.
constexpr double no_turn = 1e-9;

}  // namespace

// Steps leave small rates in rows, so the slips of the feet of one block do not reach 0 at one instant. A slip that
// does not follow from these rates is a motion, however slow: in a row of dominoes each moves the one behind it by half
// as much. In space, contacts whose slip is too slow to have a direction are added too: a body that slides and spins
// ends both at once.
bool Drift::stop_with_others(ContactChanges& changes) const {
  if (changes.stopped.empty()) return false;
  const std::vector<double> independent = problem_.independent_slip(problem_.rates(scene_.system));
  // Joints' rows have drifts of their own, from which a slip may follow.
  const bool joints = scene_.system.model().sizes.nc > 0;
  const std::size_t before = changes.stopped.size();
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    const int contact = problem_.who[i].contact;
    const model::ContactMode& slid = at_.before.contacts[contact];
    if (problem_.who[i].tangent != Tangent::sliding || !slid.closed || contains(changes.stopped, contact)) continue;
    if (!scene_.system.model().contacts[contact].coulomb) continue;
    const double speed = scene_.system.slip(contact).norm();
    const Scale scale = scene_.scale.of(contact);
    const bool held = independent[i] <= (joints ? scale.drift() : scale.rest_speed());
    if (speed < slid.least_slip || (held && speed <= scale.drift())) changes.stopped.push_back(contact);
  }
  return changes.stopped.size() > before;
}

bool Drift::end_drift(State& state, ContactChanges& changes, bool jumped) {
  bool drifted = false, turns = false;
  for (Participant& p : problem_.who) {
    if (p.tangent != Tangent::resting) continue;
    p.a_t = scene_.system.slip(p.contact);
    const double drift = p.a_t.norm(), least = scene_.least_slip(p.contact);  // 0 in the plane, where no slip turns
    drifted = drifted || drift > scene_.stick_speed(p.contact);
    turns = turns || (least > 0 && drift > no_turn * least);
  }
  if (!drifted && !turns) return false;
  Vec dv;
  problem_.end_slip(dv);
  state.v += dv;
  scene_.system.move_to(state.t, state.q, state.v);
  for (Participant& p : problem_.who)  // slow slips have turned
    if (p.tangent == Tangent::sliding) participants_.add_friction({state, changes, jumped}, p);
  if (!drifted) return false;
  bool more = false;
  for (int i = 0; i < int(at_.before.contacts.size()); ++i) {
    if (!at_.before.contacts[i].closed || at_.before.contacts[i].friction != Friction::slide) continue;
    if (contains(changes.stopped, i) || scene_.system.slip(i).norm() > scene_.scale.of(i).rest_speed()) continue;
    changes.stopped.push_back(i);
    more = true;
  }
  return more;
}

}  // namespace trammel::simulate
