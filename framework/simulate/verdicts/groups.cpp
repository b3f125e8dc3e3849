#include "simulate/verdicts/groups.hpp"

#include <algorithm>

namespace trammel::simulate {

namespace {

// Members of a group hold each other's forces: if one of them is asked, all are. True if this has added any.
bool ask_whole_groups(const std::vector<model::SharedRows>& groups, std::vector<bool>& asked) {
  bool more = false;
  for (const model::SharedRows& group : groups) {
    std::vector<int> members = group.sliding;
    for (const auto* directions : {&group.basis, &group.implied})
      for (const model::ContactDirection& d : *directions) members.push_back(d.contact);
    const auto is_asked = [&](int contact) { return asked[std::size_t(contact)]; };
    if (std::none_of(members.begin(), members.end(), is_asked)) continue;
    for (const int contact : members)
      if (!is_asked(contact)) asked[std::size_t(contact)] = more = true;
  }
  return more;
}

}  // namespace

std::size_t implied_rows(const model::Modes& modes) {
  std::size_t count = 0;
  for (const model::SharedRows& group : modes.shared) count += group.implied.size();
  return count;
}

bool shares_tangents(const model::SharedRows& group, int contact) {
  const auto is = [contact](const model::ContactDirection& d) { return d.contact == contact && d.row > 0; };
  return std::any_of(group.basis.begin(), group.basis.end(), is) ||
         std::any_of(group.implied.begin(), group.implied.end(), is);
}

void keep_others(const model::Modes& decided, std::vector<bool> asked, model::Modes& modes) {
  while (ask_whole_groups(decided.shared, asked) || ask_whole_groups(modes.shared, asked)) {
  }
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (!asked[i]) modes.contacts[i] = decided.contacts[i];
  const auto is_asked = [&](const model::SharedRows& group) {
    return asked[std::size_t(group.implied.front().contact)];
  };
  std::erase_if(modes.shared, [&](const model::SharedRows& group) { return !is_asked(group); });
  for (const model::SharedRows& group : decided.shared)
    if (!is_asked(group)) modes.shared.push_back(group);
}

bool take_springs(const std::vector<model::ContactSpring>& found, model::Modes& modes) {
  for (const auto& [contact, spring, push] : found) {
    modes.contacts[std::size_t(contact)].spring = spring;
    modes.contacts[std::size_t(contact)].push = push;
  }
  return found.empty() || found.front().spring != complementarity::Spring::locked;
}

}  // namespace trammel::simulate
