// An integrator by the name and the parameters that a scene would give it.
#pragma once

#include <string>
#include <vector>

#include <trammel/testing/measurements.hpp>

#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::stability {

class IntegratorUnderTest {
 public:
  // settings: paths of its parameters, {"alpha", "-0.3"}. Throws scene::SceneError, plugin::UnknownComponent.
  IntegratorUnderTest(plugin::Registry& registry, std::string name, std::vector<scene::Override> settings);

  const std::string& name() const { return name_; }
  std::string described() const;  // "hht_alpha (alpha = -0.3)"
  std::string object() const;     // as a scene writes it, JSON without steps
  bool has_parameter(const std::string& name) const;
  const std::vector<std::string>& choices(const std::string& parameter) const;  // empty: it has none of this name
  // Makes prepared instances; `more` settings come after the user's.
  Maker maker(std::vector<scene::Override> more = {}) const;

 private:
  plugin::Registry* registry_;
  std::string name_;
  std::vector<scene::Override> settings_;
  const plugin::Entry* entry_;
};

}  // namespace trammel::stability
