// The integrators by name, in every form that steps differently.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <trammel/testing/measurements.hpp>

#include "posed.hpp"

namespace trammel::test {

using Settings = std::vector<std::pair<std::string, ParameterValue>>;

inline std::unique_ptr<Integrator> make(const std::string& name, const Settings& settings = {}) {
  return from_plugin(TRAMMEL_BUILD_DIR "/lib/trammel", name, settings)();
}

// `n` more steps of size h, without a restart. Throws if one is rejected.
inline State advance(Integrator& method, System& s, State now, double h, int n) {
  State next;
  for (int i = 0; i < n; ++i) {
    const Outcome outcome = method.step(s, now, h, next);
    if (!outcome) throw std::runtime_error(outcome.reason());
    method.accept(s, now, next);
    std::swap(now, next);
  }
  return now;
}

// Every integrator, in every form that steps differently.
struct Form {
  std::string name;
  Settings settings;
};
inline std::vector<Form> all_forms() {
  using std::string;
  return {{"hht_alpha", {{"alpha", -0.15}}},
          {"hht_alpha", {{"alpha", -0.15}, {"formulation", string("index3")}}},
          {"hht_alpha", {{"alpha", 0.0}}},
          {"hht_alpha", {{"alpha", -1.0 / 3}}},
          {"newmark", {}},
          {"newmark", {{"beta", 0.3025}, {"gamma", 0.6}, {"formulation", string("index3")}}},
          {"generalized_alpha", {{"rho_inf", 0.8}}},
          {"generalized_alpha", {{"rho_inf", 0.8}, {"formulation", string("index3")}}},
          {"adams_baumgarte", {}},
          {"adams_baumgarte", {{"predictor", string("ab3")}}},
          {"runge_kutta_4", {}},
          {"runge_kutta_4", {{"rows", string("projected")}}},
          {"dormand_prince", {}},
          {"dormand_prince", {{"rows", string("projected")}}},
          {"dop853", {}},
          {"dop853", {{"rows", string("projected")}}},
          {"adams_baumgarte", {{"rows", string("null_space")}}},
          {"runge_kutta_4", {{"rows", string("null_space")}}},
          {"dormand_prince", {{"rows", string("null_space")}}},
          {"dop853", {{"rows", string("null_space")}}},
          {"exponential_collocation", {}},
          {"exponential_collocation", {{"rows", string("projected")}}},
          {"exponential_collocation", {{"rows", string("null_space")}}}};
}
inline std::string describe(const Form& form) {
  std::string text = form.name;
  for (const auto& [key, value] : form.settings) {
    text += " " + key + "=";
    if (const double* x = std::get_if<double>(&value)) text += std::to_string(*x);
    if (const std::string* x = std::get_if<std::string>(&value)) text += *x;
  }
  return text;
}

}  // namespace trammel::test
