// Making an integrator by name through the registry, running it, and fitting orders of convergence.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <trammel/integrator.hpp>

#include "plugin/registry.hpp"

namespace trammel::test {

using Settings = std::vector<std::pair<std::string, ParameterValue>>;

inline std::unique_ptr<Integrator> make(const std::string& name, const Settings& settings = {}) {
  static plugin::Registry registry = [] {
    plugin::Registry r(plugin::Registry::Start::empty);
    r.search(TRAMMEL_BUILD_DIR "/lib/trammel");
    return r;
  }();
  const Declaration& declaration = registry.find(Kind::integrator, name).declaration;
  std::unique_ptr<Component> component = declaration.make();
  for (const auto& [key, value] : settings) {
    bool found = false;
    for (const Parameter& p : declaration.parameters)
      if (p.name == key) p.set(*component, value), found = true;
    if (!found) throw std::runtime_error(name + " has no parameter " + key);
  }
  component->prepare(World{});
  return std::unique_ptr<Integrator>(&dynamic_cast<Integrator&>(*component.release()));
}

// `n` steps of size h. Throws if one is rejected.
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

inline State run(Integrator& method, System& s, const State& start, double until, int n) {
  method.restart(s, start);
  return advance(method, s, start, (until - start.t) / n, n);
}

// The slope of log(error) over log(h), by least squares; errors at n, 2 n, 4 n, ... steps.
struct Fit {
  double order = 0;
  std::string table;
};
inline Fit fit(int n, int runs, const std::function<double(int)>& error) {
  Fit result;
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < runs; ++i, n *= 2) {
    const double e = error(n), x = -std::log(n), y = std::log(e);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
    result.table += std::to_string(n) + " steps: error " + std::to_string(e * 1e9) + "e-9\n";
  }
  result.order = (runs * sxy - sx * sy) / (runs * sxx - sx * sx);
  return result;
}

// Keeps what an integrator archives, and gives it back.
class MemoryArchive final : public Archive {
 public:
  bool reading = false;
  std::map<std::string, Vec, std::less<>> vectors;

  using Archive::operator();
  void operator()(std::string_view name, bool& x) override { exchange(bools_, name, x); }
  void operator()(std::string_view name, int& x) override { exchange(ints_, name, x); }
  void operator()(std::string_view name, long long& x) override { exchange(longs_, name, x); }
  void operator()(std::string_view name, double& x) override { exchange(doubles_, name, x); }
  void operator()(std::string_view name, std::string& x) override { exchange(texts_, name, x); }
  void operator()(std::string_view name, Vec& x) override { exchange(vectors, name, x); }

 private:
  template <class T>
  void exchange(std::map<std::string, T, std::less<>>& kept, std::string_view name, T& x) {
    if (reading)
      x = kept.at(std::string(name));
    else
      kept[std::string(name)] = x;
  }
  std::map<std::string, bool, std::less<>> bools_;
  std::map<std::string, int, std::less<>> ints_;
  std::map<std::string, long long, std::less<>> longs_;
  std::map<std::string, double, std::less<>> doubles_;
  std::map<std::string, std::string, std::less<>> texts_;
};

inline bool same_bits(const Vec& a, const Vec& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}
inline bool same_bits(const State& a, const State& b) {
  return a.t == b.t && same_bits(a.q, b.q) && same_bits(a.v, b.v) && same_bits(a.a, b.a) &&
         same_bits(a.lambda, b.lambda);
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
          {"dormand_prince", {}},
          {"dop853", {}}};
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
