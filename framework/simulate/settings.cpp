#include "simulate/settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/scene_keys.hpp"
#include "scene/suggestion.hpp"

namespace trammel::simulate {
namespace {

using model::check_keys;
using scene::Problems;
using scene::Value;

// The number at `key`, which must lie above (or at, if `or_equal`) `least`; `fallback` if it is absent.
double number(const Value& object, const char* key, double fallback, double least, bool or_equal, const char* unit,
              Problems& problems) {
  const Value* value = object.find(key);
  if (!value) return fallback;
  const std::optional<double> x = value->read_number(problems);
  if (!x) return fallback;
  if (or_equal ? *x >= least : *x > least) return *x;
  problems.error(
      value->problem(fmt::format("found {}, expected a number {} {} [{}]", *x, or_equal ? ">=" : ">", least, unit)));
  return fallback;
}

StepChoice read_step(const Value& value, Problems& problems) {
  StepChoice choice;
  if (value.type() != Value::Type::object) {
    if (const auto h = value.read_number(problems)) {
      if (*h > 0)
        choice.fixed = *h;
      else
        problems.error(value.problem(fmt::format("found {}, expected a step > 0 [s] or {{\"tolerance\": 1e-9}}", *h)));
    }
    return choice;
  }
  check_keys(value, {"tolerance", "relative", "absolute", "initial", "min", "max"}, problems);
  const double both = number(value, "tolerance", 1e-6, 0, false, "1", problems);
  if (!value.find("tolerance") && !(value.find("relative") && value.find("absolute")))
    problems.error(value.problem("give \"tolerance\", or both \"relative\" and \"absolute\""));
  choice.tolerance.relative = number(value, "relative", both, 0, true, "1", problems);
  choice.tolerance.absolute = number(value, "absolute", both, 0, false, "m, rad, m/s, rad/s", problems);
  choice.initial = number(value, "initial", 0, 0, false, "s", problems);
  choice.least = number(value, "min", 0, 0, false, "s", problems);
  choice.most = number(value, "max", choice.most, 0, false, "s", problems);
  if (choice.most < choice.least) problems.error(value.problem("\"max\" is less than \"min\""));
  return choice;
}

void read_simulate(const Value& root, Purpose purpose, Settings& settings, Problems& problems) {
  const Value* simulate = root.find("simulate");
  if (purpose == Purpose::statics && !simulate) {
    settings.until = 1;
    return;
  }
  if (!simulate || !simulate->find("until")) {
    const Value& at = simulate ? *simulate : root;
    problems.error(at.problem("the end of the run is missing: give \"simulate\": {\"until\": 2.0} [s]"));
    if (!simulate) return;
  }
  check_keys(*simulate, {"start", "until", "contact_hold", "chatter_steps", "event_limit"}, problems);
  settings.start = number(*simulate, "start", 0, -std::numeric_limits<double>::infinity(), true, "s", problems);
  settings.until = number(*simulate, "until", settings.start, settings.start, true, "s", problems);
  settings.contact_hold = number(*simulate, "contact_hold", 0, 0, true, "s", problems);
  settings.chatter_steps = number(*simulate, "chatter_steps", settings.chatter_steps, 0, true, "steps", problems);
  settings.event_limit = static_cast<long long>(
      number(*simulate, "event_limit", double(settings.event_limit), 1, true, "events", problems));
}

void read_static(const Value& root, Settings& settings, Problems& problems) {
  const Value* statics = root.find("static");
  if (!statics || !check_keys(*statics, {"steps", "tolerance", "iterations", "arc_length"}, problems)) return;
  const auto whole = [&](const char* key, int fallback) {
    const double x = number(*statics, key, fallback, 1, true, "1", problems);
    if (x == std::floor(x) && x <= 1e6) return int(x);
    problems.error(statics->find(key)->problem(fmt::format("found {}, expected a whole number up to 1000000", x)));
    return fallback;
  };
  settings.load_steps = whole("steps", settings.load_steps);
  settings.load_iterations = whole("iterations", settings.load_iterations);
  settings.load_tolerance = number(*statics, "tolerance", settings.load_tolerance, 0, false, "1", problems);
  if (const Value* arc = statics->find("arc_length")) {
    if (arc->type() == Value::Type::boolean)
      settings.arc_length = arc->boolean();
    else
      problems.error(arc->problem(fmt::format("found {}, expected true or false", arc->type_name())));
  }
}

void read_record(const Value& root, Settings& settings, Problems& problems) {
  const double length = settings.until - settings.start;
  settings.every = length > 0 ? length / 1000 : 1;
  const Value* record = root.find("record");
  if (!record) return;
  check_keys(*record, {"every", "observe"}, problems);
  settings.every = number(*record, "every", settings.every, 0, false, "s", problems);
  if (length / settings.every > 1e9)
    problems.error(
        record->problem(fmt::format("{} s recorded every {} s are more than 1e9 rows", length, settings.every)));
}

Settings::Initial read_initial(const Value& value, Problems& problems) {
  const Value* choice = &value;
  std::vector<std::string> names = {"check", "project"};
  if (value.type() == Value::Type::object) {
    check_keys(value, {"consistent"}, problems);
    choice = value.find("consistent");
    if (!choice) return Settings::Initial::check;
  } else {
    names.push_back("equilibrium");
  }
  const auto text = choice->read_text(problems);
  if (!text) return Settings::Initial::check;
  if (std::find(names.begin(), names.end(), *text) == names.end())
    problems.error(choice->problem(fmt::format("found \"{}\", expected \"{}\"{}", *text, fmt::join(names, "\" or \""),
                                               scene::did_you_mean(*text, names))));
  return *text == "equilibrium" ? Settings::Initial::equilibrium
         : *text == "project"   ? Settings::Initial::project
                                : Settings::Initial::check;
}

}  // namespace

const Value& integrator_entry(const Value& root) {
  if (const Value* given = root.find("integrator")) return *given;
  static const scene::Scene chosen =
      scene::Scene::parse(R"({"type": "dop853", "step": {"tolerance": 1e-9}})", "Trammel's choice of an integrator");
  return chosen.root();
}

Purpose purpose_of(const Value& root) {
  return root.find("static") && !root.find("integrator") ? Purpose::statics : Purpose::motion;
}

Settings read_settings(const Value& root, Purpose purpose, Problems& problems) {
  Settings settings;
  read_simulate(root, purpose, settings, problems);
  read_static(root, settings, problems);
  read_record(root, settings, problems);
  if (purpose == Purpose::motion) {
    const Value& integrator = integrator_entry(root);
    if (const Value* step = integrator.find("step"))
      settings.step = read_step(*step, problems);
    else
      problems.error(integrator.problem("\"step\" is missing: a length in s, or {\"tolerance\": 1e-9}"));
    if (const Value* contact = integrator.find("contact_step")) {
      settings.contact_step = read_step(*contact, problems);
      settings.own_contact_step = true;
    } else {
      settings.contact_step = settings.step;
    }
  }
  if (const Value* initial = root.find("initial")) settings.initial = read_initial(*initial, problems);
  return settings;
}

}  // namespace trammel::simulate
