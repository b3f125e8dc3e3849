// The forms of a component: with every parameter at its default, and with each other value of each of its choices. The
// abilities of a component often depend on a choice: the formulation of a method, the time at which a law decides.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugin/registry.hpp"

namespace trammel::compatibility {

struct Form {
  std::string type;               // in a scene
  std::string parameter, choice;  // of the choice that is not at its default; empty: all are
  std::shared_ptr<const Component> component;

  std::string name() const;  // "hht_alpha", "hht_alpha with formulation index3"
};

// The form with all defaults first. If `prepare` asks for more parameters in a planar scene, it is the component
// without them; single choices that `prepare` refuses are left out.
std::vector<Form> forms(const plugin::Entry& entry);

// The first of these forms, and those with another value of `property`.
template <class Property>
std::vector<Form> that_differ(const std::vector<Form>& all, Property property) {
  std::vector<Form> kept;
  for (const Form& form : all)
    if (kept.empty() || property(*form.component) != property(*kept.front().component)) kept.push_back(form);
  return kept;
}

}  // namespace trammel::compatibility
