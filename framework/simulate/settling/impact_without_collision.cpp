#include "simulate/settling/impact_without_collision.hpp"

#include <algorithm>

#include "simulate/settling/contact_events.hpp"
#include "simulate/settling/contact_failure.hpp"
#include "simulate/settling/latches.hpp"
#include "simulate/settling/pressed_until_now.hpp"

namespace trammel::simulate {

using complementarity::ContactSolution;
using complementarity::LcpOutcome;

namespace {

// Of the coefficients of friction: how far the state may be from that at which joints lock.
constexpr double locked_by_error = 1e-7;
// Slips of about one size are faster than others by this factor. A block that turns about its corner between two others
// slips at its foot, and at the corner only by the clearance that let it turn.
constexpr double much_faster = 1e3;

bool is_idle(const model::Modes& modes, int contact) {
  return std::any_of(modes.shared.begin(), modes.shared.end(), [&](const model::SharedRows& group) {
    const auto row = [contact](const model::ContactDirection& d) { return d.contact == contact && d.row == 0; };
    const auto has_no_share = [&](const std::vector<model::ContactDirection>& rows, std::ptrdiff_t first) {
      const auto k = std::find_if(rows.begin(), rows.end(), row) - rows.begin();
      return k < std::ssize(rows) && group.share.row(first + k).isZero(0);
    };
    return has_no_share(group.basis, 0) || has_no_share(group.implied, std::ssize(group.basis));
  });
}

// Whether the same contacts carry and slide.
bool carry_alike(const model::Modes& a, const model::Modes& b) {
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    const bool same = a.contacts[i].closed == b.contacts[i].closed && a.contacts[i].friction == b.contacts[i].friction;
    if (!same || is_idle(a, int(i)) != is_idle(b, int(i))) return false;
  }
  return true;
}

// [m/s] The fastest of each size of slips, the slowest first.
std::vector<double> sizes_of(std::vector<double> slips) {
  std::sort(slips.begin(), slips.end());
  std::vector<double> sizes;
  for (const double slip : slips) {
    if (sizes.empty() || slip > much_faster * sizes.back()) sizes.push_back(slip);
    sizes.back() = slip;
  }
  return sizes;
}

}  // namespace

// An impact may have happened before at the same instant. Where one leaves contacts without finite forces still,
// another follows: each ends a slip. The end of motions that are too short to follow (rule 2) may bring a slip back, so
// later ones keep such motions.
ContactSolution ImpactWithoutCollision::strike(State& state, const ContactChanges& changes, bool jumped,
                                               std::vector<ContactEvent>& events) {
  bool without_collision = false;
  for (std::size_t left = at_.touching.size();; --left) {
    scene_.system.set_modes(at_.before);
    scene_.system.move_to(state.t, state.q, state.v);
    if (jumped || without_collision) {
      append_impacts(scene_, at_, state.t, without_collision, events);
      impacts_.find_touching({});
    }
    for (TouchingContact& c : at_.touching) c.keeps_rates = without_collision;
    const ContactSolution impact = end_slowest_slips(state, changes, jumped || without_collision);
    if (impact.outcome != LcpOutcome::solved) {
      const ContactSolution others =
          changes.locked ? decide_otherwise(state, changes) : decide_at_once(state, changes, jumped);
      if (others.outcome != LcpOutcome::solved)
        fail_without_impact(scene_, {state.t, impact, decision_.instant().bearings_undecided()}, at_);
      return others;
    }
    lock_latches(scene_, state, changes, at_, events);
    forget_pressed_by_impact(scene_, at_);
    const ContactSolution solution = decision_.instant().decide(state, changes, true);
    if (solution.outcome != LcpOutcome::no_solution || left == 0) return solution;
    without_collision = true;
  }
}

// The smallest impulses that leave finite forces end the slowest slips; faster ones go on as they are. If there is no
// such impact, faster slips may end in it, too.
ContactSolution ImpactWithoutCollision::end_slowest_slips(State& state, const ContactChanges& changes, bool jumped) {
  std::vector<double> slips;
  for (TouchingContact& c : at_.touching) {
    c.slides = slides(c.contact, jumped);
    if (c.slides) slips.push_back(scene_.system.slip(c.contact).norm());
  }
  if (slips.empty()) slips.push_back(0);  // joints slide alone
  ContactSolution impact;
  for (const double size : sizes_of(slips)) {
    find_approaches(size);
    impact = strike_raised(state, changes, changes.raised);
    if (impact.outcome == LcpOutcome::solved) return impact;
  }
  // Steps may end a little before the state at which joints lock.
  if (changes.locked && impact.outcome == LcpOutcome::gave_up && changes.raised < locked_by_error)
    impact = strike_raised(state, changes, locked_by_error);
  return impact;
}

// Before an impact, by its mode, since its slip may just pass 0.
bool ImpactWithoutCollision::slides(int contact, bool jumped) const {
  if (!scene_.system.model().contacts[std::size_t(contact)].friction) return false;
  const model::ContactMode& mode = at_.before.contacts[std::size_t(contact)];
  const bool in_mode = !jumped && mode.closed && mode.friction == model::ContactMode::Friction::slide;
  return in_mode || scene_.system.slip(contact).norm() > scene_.scale.of(contact).rest_speed();
}

// With coefficients of friction that are larger by the part `raised`.
ContactSolution ImpactWithoutCollision::strike_raised(State& state, const ContactChanges& changes, double raised) {
  for (TouchingContact& c : at_.touching) c.without_collision = true, c.raised = raised;
  for (TouchingContact& c : at_.bearings) c.without_collision = true, c.raised = raised;
  return impacts_.strike(state, changes);
}

// Contacts approach by a small part of their slips. Those that slip faster than `slip` go on sliding as they do.
void ImpactWithoutCollision::find_approaches(double slip) {
  for (TouchingContact& c : at_.touching) {
    if (!scene_.system.model().contacts[std::size_t(c.contact)].friction) continue;
    const double own = scene_.system.slip(c.contact).norm();
    c.slides_on = own > slip;
    c.approach = c.slides_on ? 0 : -vanishing_approach * own;
  }
}

// Forces exist at this instant, and only those a moment later do not (rule 11). A contact whose force fell through 0
// may be needed.
ContactSolution ImpactWithoutCollision::decide_at_once(State& state, const ContactChanges& changes, bool jumped) {
  ContactChanges others = changes;
  others.released.clear();
  return decision_.instant().decide(state, others, jumped);
}

// Decides as for the state beyond the critical one, and accepts only other modes than the present ones, whose forces
// grow beyond all bounds.
ContactSolution ImpactWithoutCollision::decide_otherwise(const State& state, const ContactChanges& changes) {
  for (TouchingContact& c : at_.touching) c.without_collision = false;
  decision_.instant().gather({state, changes, false});
  const auto solution = decision_.what_follows().decide(
      state, changes, false, std::vector<bool>(at_.modes.contacts.size(), true), {LcpOutcome::gave_up, 0});
  if (solution.outcome == LcpOutcome::solved && carry_alike(at_.modes, at_.before)) return {LcpOutcome::gave_up, 0};
  return solution;
}

}  // namespace trammel::simulate
