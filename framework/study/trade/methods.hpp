// The integrators that a scene can be run with, and the settings by which each is made more accurate.
//
// A level is one setting: a tolerance of 10^(-2 - level/2), of the step or of the method's own control (fidelity.hpp);
// or, for methods without error control, a fixed step of 4 h 2^(-level). h is the scene's own step, or the smaller of
// the interval between records and a thousandth of the time.
#pragma once

#include <string>
#include <vector>

#include "plugin/registry.hpp"
#include "scene/value.hpp"
#include "study/cases/batch.hpp"

namespace trammel::study {

struct Method {
  enum class Varied { tolerance, step };  // what differs from level to level
  std::string name;                       // "dop853"; the scene's own with fixed steps: "hht_alpha, fixed steps"
  std::string type;
  std::string family;  // methods of different families share no formula: what two of them agree on is trusted
  int order = 1;
  Varied varied = Varied::tolerance;
  bool own = false;                          // with the parameters given in the scene
  std::string integrator;                    // its JSON object without steps
  double step = 0, contact_step = 0;         // [s] for fixed steps; contact_step 0: none
  std::vector<std::string> tolerances = {};  // the method's own parameters; then `step` stays as it is

  int levels() const { return varied == Varied::tolerance ? 19 : 10; }
  double asked(int level) const;            // the tolerance, or the step [s]
  std::string setting(int level) const;     // "tolerance 3.2e-06", for the user
  std::string with_level(int level) const;  // the JSON object with steps
  std::string with_tolerance(double tolerance) const;
  Overrides overrides(int level) const { return {{"integrator", with_level(level)}}; }
};

struct Refusal {
  std::string type, reason;
};

struct Methods {
  std::vector<Method> capable;
  std::vector<Refusal> refused;
};

// The installed integrators that accept the scene.
Methods methods_for(const SceneSource& source, plugin::Registry& registry);

}  // namespace trammel::study
