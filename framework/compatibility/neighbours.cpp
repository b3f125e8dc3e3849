#include "compatibility/neighbours.hpp"

#include "compatibility/forms.hpp"

namespace trammel::compatibility {

std::string names_that(plugin::Registry& registry, Kind kind, const std::function<bool(const Component&)>& can) {
  std::string names;
  for (const plugin::Entry* entry : registry.all())
    if (entry->declaration.kind == kind && can(*forms(*entry).front().component))
      names += (names.empty() ? "" : ", ") + entry->declaration.name;
  return names.empty() ? "none found" : names;
}

}  // namespace trammel::compatibility
