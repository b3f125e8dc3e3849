// The guard around calls into plugins: it converts exceptions to a PluginError that names library, call and time, and
// restores rounding mode and locale. require_* checks the size and finiteness of results.
//
//     guard(origin, "force", t, [&] { body.force(t, q, v, f); });
//     require_finite(origin, "force", t, "f", f);
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include <trammel/types.hpp>

#include "plugin/plugin_error.hpp"
#include "plugin/process/settings.hpp"

namespace trammel::plugin {

// Errors of the framework that may pass through a plugin's stack frames, such as a singular mass matrix while an
// integrator calls `accelerate`. They are not caused by the plugin, and the guard does not convert them.
class PassesThroughPlugins {
 public:
  virtual ~PassesThroughPlugins();
};

// To be called in a catch block: rethrows PluginError, PassesThroughPlugins and a lack of memory unchanged, any other
// exception as a PluginError.
[[noreturn]] void rethrow_as_plugin_error(const Origin& origin, const char* call, std::optional<double> t);

template <class Call>
decltype(auto) guard(const Origin& origin, const char* call, std::optional<double> t, Call&& body) {
  const ProcessSettings settings;
  try {
    return std::forward<Call>(body)();
  } catch (...) {
    rethrow_as_plugin_error(origin, call, t);
  }
}

[[noreturn]] void throw_not_finite(const Origin&, const char* call, double t, const char* what, Eigen::Index entry,
                                   double value);

// `what` names the result in the message: "f", "kinetic energy".
inline void require_finite(const Origin& origin, const char* call, double t, const char* what, double value) {
  if (!std::isfinite(value)) throw_not_finite(origin, call, t, what, -1, value);
}

template <class Derived>
void require_finite(const Origin& origin, const char* call, double t, const char* what,
                    const Eigen::DenseBase<Derived>& x) {
  // x - x is 0 for finite numbers and NaN otherwise; the compiler vectorises the sum of these terms.
  if (const auto& d = x.derived(); d.size() != 0 && !((d.array() - d.array()).sum() == 0))
    for (Eigen::Index j = 0, entry = 0; j < d.cols(); ++j)
      for (Eigen::Index i = 0; i < d.rows(); ++i, ++entry)
        if (!std::isfinite(d.coeff(i, j))) throw_not_finite(origin, call, t, what, entry, d.coeff(i, j));
}

}  // namespace trammel::plugin
