#include "simulate/settling/contact_failure.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "run/run_failed.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

namespace {

// True if the contacts have no forces without friction either.
bool blocked(model::AssembledSystem& system, const std::vector<Participant>& who) {
  ContactProblem without_friction;
  for (const Participant& p : who) {
    if (!p.unilateral) continue;
    Participant& pressing = without_friction.who.emplace_back();
    pressing.contact = p.contact, pressing.a_n = p.a_n, pressing.nothing = p.nothing;
  }
  if (without_friction.who.empty()) return false;
  without_friction.prepare(system);
  return without_friction.solve().outcome == LcpOutcome::no_solution;
}

// Who takes part, by name.
struct Names {
  std::string contacts, joints;
  bool rigid = false;  // any contact is
};

Names names_of(const ContactScene& scene, const std::vector<Participant>& who) {
  Names all;
  for (const Participant& p : who) {
    const model::ContactEntry& entry = scene.contact(p.contact);
    std::string& names = entry.joint ? all.joints : all.contacts;
    all.rigid = all.rigid || entry.restitution;
    names += (names.empty() ? "" : ", ") + (entry.joint ? entry.path() : entry.name);
  }
  return all;
}

std::string advice(const Names& who) {
  return who.contacts.empty() ? "" : fmt::format("; {}, has one", other_law(who.rigid));
}

std::string why_not_found(const Unsolved& search, const Names& who) {
  if (search.bearings_undecided)
    return fmt::format(
        "was not found: no modes of {}, sticking or sliding, agree with the loads of the bearings that follow from "
        "them; with so much friction a joint may lock itself",
        who.joints);
  const bool only_contacts = who.joints.empty();
  return fmt::format("was not found: the best try violates the conditions of {} by {:.2g} of the forces{}{}",
                     only_contacts ? "the contacts" : "contacts and bearings", search.solution.violation,
                     only_contacts ? fmt::format(", {:.0g} is asked for", complementarity::largest_violation) : "",
                     advice(who));
}

std::string why_there_is_none(const Names& who) {
  const char* rubbing = who.joints.empty()     ? (who.rigid ? "rigid contacts" : "contacts")
                        : who.contacts.empty() ? "joints"
                                               : "rigid contacts and joints";
  return fmt::format("has no solution: so much friction leaves {} none ({}){}", rubbing,
                     who.joints.empty() ? "Painleve" : "Painleve; self-locking", advice(who));
}

[[noreturn]] void fail_without_solution(const ContactScene& scene, const char* what, const Unsolved& search,
                                        const std::vector<Participant>& who) {
  const Names names = names_of(scene, who);
  const std::string contacts = names.contacts.empty() ? "" : "contacts " + names.contacts;
  std::string of = contacts + (names.contacts.empty() || names.joints.empty() ? "" : " and ") + names.joints, why;
  if (search.solution.outcome == LcpOutcome::gave_up)
    why = why_not_found(search, names);
  else if (blocked(scene.system, who))
    of = contacts, why = "has no solution: they close on bodies that cannot give way";
  else
    why = why_there_is_none(names);
  throw RunFailed(fmt::format("at t = {:.9g} s: the {} of {} {}", search.t, what, of, why));
}

}  // namespace

void fail_without_balance(const ContactScene& scene, const Unsolved& search, const std::vector<Participant>& who) {
  fail_without_solution(scene, "balance of forces", search, who);
}

void fail_without_impact(const ContactScene& scene, const Unsolved& search, const ContactsAtEvent& at) {
  std::vector<Participant> who;
  for (const TouchingContact& c : at.touching) {
    Participant& p = who.emplace_back();
    p.contact = c.contact;
    p.a_n = c.was_closed ? 0 : c.before;
  }
  for (const TouchingContact& c : at.bearings) {
    Participant& p = who.emplace_back();
    p.contact = c.contact, p.unilateral = false;
  }
  fail_without_solution(scene, "impact", search, who);
}

}  // namespace trammel::simulate
