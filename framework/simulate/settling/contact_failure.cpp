// The messages of a run that ends because the contacts have no forces at an instant, or because none were found.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "run/run_failed.hpp"
#include "simulate/settling/contact_mode.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

void ContactModes::fail_without_balance(double t, const complementarity::ContactSolution& solution) const {
  fail_without_solution("balance of forces", t, solution, decision_.instant().problem().who);
}

void ContactModes::fail_without_impact(double t, const complementarity::ContactSolution& solution) const {
  std::vector<Participant> who;
  for (const TouchingContact& c : at_.touching) {
    Participant& p = who.emplace_back();
    p.contact = c.contact;
    p.a_n = c.was_closed ? 0 : c.before;
  }
  for (const TouchingContact& c : at_.bearings) {
    Participant& p = who.emplace_back();
    p.contact = c.contact, p.unilateral = false;
  }
  fail_without_solution("impact", t, solution, who);
}

// True if the contacts have no forces without friction either.
bool ContactModes::blocked(const std::vector<Participant>& who) const {
  ContactProblem without_friction;
  for (const Participant& p : who) {
    if (!p.unilateral) continue;
    Participant& pressing = without_friction.who.emplace_back();
    pressing.contact = p.contact, pressing.a_n = p.a_n, pressing.nothing = p.nothing;
  }
  if (without_friction.who.empty()) return false;
  without_friction.prepare(system_);
  return without_friction.solve().outcome == LcpOutcome::no_solution;
}

void ContactModes::fail_without_solution(const char* what, double t, const complementarity::ContactSolution& solution,
                                         const std::vector<Participant>& who) const {
  std::string contacts, joints;
  bool rigid = false;
  for (const Participant& p : who) {
    const model::ContactEntry& entry = system_.model().contacts[std::size_t(p.contact)];
    std::string& names = entry.joint ? joints : contacts;
    rigid = rigid || entry.restitution;
    names += (names.empty() ? "" : ", ") + (entry.joint ? entry.path() : entry.name);
  }
  const std::string advice = contacts.empty() ? "" : fmt::format("; {}, has one", other_law(rigid));
  const std::string of_contacts = contacts.empty() ? "" : "contacts " + contacts;
  std::string of = of_contacts + (contacts.empty() || joints.empty() ? "" : " and ") + joints, why;
  if (solution.outcome == LcpOutcome::gave_up && decision_.instant().bearings_undecided())
    why = fmt::format(
        "was not found: no modes of {}, sticking or sliding, agree with the loads of the bearings that follow from "
        "them; with so much friction a joint may lock itself",
        joints);
  else if (solution.outcome == LcpOutcome::gave_up)
    why = fmt::format("was not found: the best try violates the conditions of {} by {:.2g} of the forces{}{}",
                      joints.empty() ? "the contacts" : "contacts and bearings", solution.violation,
                      joints.empty() ? fmt::format(", {:.0g} is asked for", complementarity::largest_violation) : "",
                      advice);
  else if (blocked(who))
    of = of_contacts, why = "has no solution: they close on bodies that cannot give way";
  else
    why = fmt::format("has no solution: so much friction leaves {} none ({}){}",
                      joints.empty()     ? (rigid ? "rigid contacts" : "contacts")
                      : contacts.empty() ? "joints"
                                         : "rigid contacts and joints",
                      joints.empty() ? "Painleve" : "Painleve; self-locking", advice);
  throw RunFailed(fmt::format("at t = {:.9g} s: the {} of {} {}", t, what, of, why));
}

}  // namespace trammel::simulate
