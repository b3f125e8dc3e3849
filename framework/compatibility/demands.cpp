#include "compatibility/demands.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compatibility/contact_laws.hpp"

namespace trammel::compatibility {
namespace {

void add(std::vector<Demand>& all, Need need, const std::string& cause) {
  const auto same = [need](const Demand& one) { return one.need == need; };
  if (std::none_of(all.begin(), all.end(), same)) all.push_back({need, cause});
}

std::string cause_of(Need need, const model::ContactEntry& contact) {
  switch (need) {
    case Need::rows:
      return contact.restitution ? fmt::format("{} is a row while it is closed", contact.path())
                                 : fmt::format("the friction of {} sticks in a row", contact.path());
    case Need::friction:
      return fmt::format("the friction of {} sticks", contact.path());
    case Need::jumps:
      return fmt::format("the friction of {} is decided at every evaluation", contact.path());
    default:
      return contact.joint ? fmt::format("the friction of {} sticks and slides", contact.path())
                           : fmt::format("{} opens and closes", contact.path());
  }
}

bool turns_in_space(const model::BodyEntry& body) {
  return std::any_of(body.parts.begin(), body.parts.end(),
                     [](const Coordinates::Part& part) { return part.kind == Coordinates::Kind::rotation; });
}

}  // namespace

std::vector<Demand> demands(const model::Model& model) {
  std::vector<Demand> all;
  if (const std::vector<model::RowGroup> groups = model::row_groups(model); !groups.empty())
    add(all, Need::rows, fmt::format("{} has {}", groups.front().path, groups.front().count == 1 ? "a row" : "rows"));
  for (const model::ContactEntry& contact : model.contacts)
    for (const Need need : ContactLaws(contact).needs()) add(all, need, cause_of(need, contact));
  for (const model::BodyEntry& body : model.bodies)
    if (turns_in_space(body)) add(all, Need::rotations, fmt::format("bodies.{} turns in space", body.name));
  return all;
}

}  // namespace trammel::compatibility
