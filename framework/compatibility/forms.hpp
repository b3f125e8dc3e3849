// The forms of a component: with every parameter at its default, and with each other value of each of its choices. What
// a component can do often depends on a choice: the formulation of a method, the moment at which a law decides.
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

// The form with all defaults first. Where a planar scene's `prepare` asks for more parameters, it is the component
// without them; choices that `prepare` refuses alone are left out.
std::vector<Form> forms(const plugin::Entry& entry);

// Of these forms the first and those that differ from it by what `tell` returns.
template <class Tell>
std::vector<Form> that_differ(const std::vector<Form>& all, Tell tell) {
  std::vector<Form> kept;
  for (const Form& form : all)
    if (kept.empty() || tell(*form.component) != tell(*kept.front().component)) kept.push_back(form);
  return kept;
}

}  // namespace trammel::compatibility
