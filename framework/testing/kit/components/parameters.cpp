// What a component does with every value that its declaration allows.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "plugin/describe.hpp"
#include "plugin/plugin_error.hpp"
#include "testing/kit/components/common.hpp"
#include "testing/kit/exercise.hpp"
#include "testing/kit/sample.hpp"

namespace trammel::kit {

namespace {

using Json = nlohmann::ordered_json;

constexpr ClaimsOf parameter_claim{"parameters.", "trammel/parameters.hpp"};

// "" if the component runs with these parameters or refuses them with words of its own.
std::string tried(const Subject& s, const Json& object, bool& refused) {
  try {
    const auto component = make_from(s.entry, object.dump(), s.form.world);
    refused = false;
    return exercise(s, *component);
  } catch (const scene::SceneError&) {
    refused = true;
    return "";
  } catch (const std::exception& e) {
    return e.what();
  }
}

Report defaults_run(const Subject& s) {
  Report report;
  bool refused = false;
  const std::string fault = tried(s, Json::parse(s.form.entry), refused);
  report.claim(fmt::format("{} runs", s.form.entry), fault.empty() && !refused, refused ? "it is refused" : fault);
  return report;
}

bool has_bounds(const Parameter& p) {
  const bool number = p.type == Parameter::Type::number || p.type == Parameter::Type::integer;
  return number && (std::isfinite(p.traits.min) || std::isfinite(p.traits.max));
}

std::string has_no_bounds(const Subject& s) {
  return std::ranges::any_of(s.declaration().parameters, has_bounds) ? ""
                                                                     : "no parameter has a lower or an upper bound";
}

Report bounds_run(const Subject& s) {
  Report report;
  for (const Parameter& p : s.declaration().parameters) {
    if (!has_bounds(p)) continue;
    for (const double bound : {p.traits.min, p.traits.max}) {
      if (!std::isfinite(bound) || (p.traits.above_min && bound == p.traits.min)) continue;
      Json object = Json::parse(s.form.entry);
      set_at(object, p.name, p.type == Parameter::Type::integer ? Json(std::llround(bound)) : Json(bound));
      bool refused = false;
      const std::string fault = tried(s, object, refused);
      if (!fault.empty()) report.claim(fmt::format("{} = {} runs or is refused", p.name, bound), false, fault);
    }
  }
  report.claim("every bound runs or is refused by its parameter's name", report.holds);
  return report;
}

Report outside_is_refused(const Subject& s) {
  Report report;
  for (const Parameter& p : s.declaration().parameters) {
    if (!has_bounds(p)) continue;
    for (const bool low : {true, false}) {
      const double bound = low ? p.traits.min : p.traits.max;
      if (!std::isfinite(bound)) continue;
      const double step = p.type == Parameter::Type::integer ? 1 : 1e-3 * (1 + std::abs(bound));
      Json object = Json::parse(s.form.entry);
      const double outside = low ? bound - step : bound + step;
      set_at(object, p.name, p.type == Parameter::Type::integer ? Json(std::llround(outside)) : Json(outside));
      std::string refusal;
      try {
        make_from(s.entry, object.dump(), s.form.world);
      } catch (const scene::SceneError& e) {
        refusal = e.what();
      }
      if (refusal.find(p.name) == refusal.npos)
        report.claim(fmt::format("{} = {} is refused by name", p.name, outside), false,
                     refusal.empty() ? "it was accepted" : refusal);
    }
  }
  report.claim("values outside their range are refused by name", report.holds);
  return report;
}

Json random_entry(const Subject& s, std::mt19937& random) {
  Json object = Json::parse(s.form.entry);
  for (const Parameter& p : s.declaration().parameters) {
    if (random() % 2) continue;
    // Sizes of lists and counts decide the cost of a component; what was given for them stays.
    if (p.type == Parameter::Type::integer && find_at(object, p.name)) continue;
    if (auto value = random_value(p, plugin::default_of(s.entry, p), s.form.world.space, random))
      set_at(object, p.name, std::move(*value));
  }
  return object;
}

Report random_sets_run(const Subject& s) {
  Report report;
  std::mt19937 random = s.random(71);
  const int sets = s.level == Level::quick ? 200 : 1000;
  int refused = 0;
  for (int i = 0; i < sets && report.holds; ++i) {
    const Json object = random_entry(s, random);
    bool was_refused = false;
    const std::string fault = tried(s, object, was_refused);
    refused += was_refused;
    if (!fault.empty()) report.claim(fmt::format("{} is finite or refused", object.dump()), false, fault);
  }
  report.claim(fmt::format("{} sets of parameters inside their ranges are finite or refused", sets), report.holds,
               fmt::format("{} refused", refused));
  return report;
}

std::string has_none(const Subject& s) {
  return s.declaration().parameters.empty() ? "it declares no parameters" : "";
}

// What an author can forget in a declaration.
Report are_declared_in_full(const Subject& s) {
  Report report;
  const Declaration& d = s.declaration();
  report.claim("the component has a summary and a source", !d.summary.empty() && !d.source.empty(),
               d.source.empty() ? "there is no .source(...)" : "");
  for (const Parameter& p : d.parameters) {
    const std::string name = "parameter " + p.name;
    // A name and a unit may be sufficient: {"length": 1}, in m.
    const bool documented = *p.traits.doc || std::string(p.traits.unit) != "1" || !p.choices.empty();
    if (!documented) report.claim(name + " has a doc or a unit", false);
    const ParameterValue fallback = plugin::default_of(s.entry, p);
    if (p.traits.required) continue;
    double x = std::nan("");
    if (const double* number = std::get_if<double>(&fallback)) x = *number;
    if (const int* number = std::get_if<int>(&fallback)) x = *number;
    if (x < p.traits.min || x > p.traits.max || (p.traits.above_min && x == p.traits.min))
      report.claim(name + " has its default inside its range", false, fmt::format("{} is outside", x));
  }
  report.claim("parameters are documented, and their defaults are inside their ranges", report.holds);
  return report;
}

Report are_in_the_manual(const Subject& s) {
  Report report;
  const std::string manual = plugin::describe(s.entry), schema = plugin::schema({&s.entry});
  for (const Parameter& p : s.declaration().parameters) {
    const std::string key = p.name.substr(p.name.rfind('.') + 1);
    report.claim(p.name + " is in the manual and in the schema",
                 manual.find(key) != manual.npos && schema.find("\"" + key + "\"") != schema.npos);
  }
  return report;
}

}  // namespace

Checks parameter_checks() {
  const char* const declared = "A component's declaration: its name, its source in the literature and its parameters";
  const char* const range = "A value outside min..max is an error, outside usual_min..usual_max a warning.";
  return {
      {parameter_claim("are-declared-in-full", "Source, documentation and defaults are declared.",
                       "min <= default <= max", declared),
       Level::quick, are_declared_in_full},
      {parameter_claim(
           "are-in-the-manual", "Manual and schema name every parameter.", "keys of the parser = keys of the manual",
           "Parsing, range errors, suggestions of names, `trammel describe`, the JSON Schema and the manual are "
           "derived "
           "from the declaration."),
       Level::quick, are_in_the_manual, has_none},
      {parameter_claim("defaults-run", "The defaults run.", "|result| < infinity",
                       "The member gives the type, its initialiser the default."),
       Level::quick, defaults_run},
      {parameter_claim("bounds-run", "The bounds of each range run or are refused.",
                       "|result(min)|, |result(max)| < infinity", range),
       Level::quick, bounds_run, has_no_bounds},
      {parameter_claim("outside-is-refused", "A value outside its range is refused by its name.",
                       "x < min or x > max: an error", range),
       Level::quick, outside_is_refused, has_no_bounds},
      {parameter_claim("random-sets-run", "Random sets inside the ranges are finite or refused.",
                       "|result| < infinity, or ParameterError", range),
       Level::quick, random_sets_run, has_none}};
}

}  // namespace trammel::kit
