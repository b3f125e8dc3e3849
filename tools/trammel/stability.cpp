// trammel stability INTEGRATOR: measured maps of stability and damping, beside theory.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "input.hpp"
#include "report/page.hpp"
#include "stability/page.hpp"

namespace trammel::tool {

namespace {

constexpr Option kOfMethod{"--set", "NAME=VALUE", "a parameter of the integrator, e.g. alpha=-0.3 (repeatable)"};

Exit stability(const Arguments& arguments) {
  plugin::Registry registry;
  load_plugins(arguments, registry);
  const report::Page page =
      stability::measure(stability::IntegratorUnderTest(registry, arguments.operand(), overrides_of(arguments)));
  if (arguments.has("--json")) {
    print_json({{"page", report::to_json(page)}});
    return Exit::done;
  }
  fmt::print("{}\n", report::text(page));
  fmt::print("\nTry: trammel check {}\n", arguments.operand());
  return Exit::done;
}

}  // namespace

Command stability_command() {
  return {"stability",
          "INTEGRATOR",
          "Measure where a method is stable, what it damps, and how it holds rows at small steps, beside theory.",
          {kOfMethod, kPlugin, kJson},
          stability};
}

}  // namespace trammel::tool
