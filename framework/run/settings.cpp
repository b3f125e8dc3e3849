#include "run/settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/scene_keys.hpp"
#include "plugin/parameters.hpp"
#include "run/setting_parts.hpp"
#include "scene/suggestion.hpp"

namespace trammel::simulate {
namespace {

using model::check_keys;
using scene::Problems;
using scene::Value;

// Every key of an object is declared.
bool check_part(const Value& object, const plugin::Part& part, std::vector<std::string> more, Problems& problems) {
  std::vector<std::string> keys = part.names();
  keys.insert(keys.end(), more.begin(), more.end());
  return check_keys(object, keys, problems);
}

// The number at `key` within its declared range; `fallback` if it is absent.
double number(const Value& object, const plugin::Part& part, const char* key, double fallback, Problems& problems) {
  const Value* value = object.find(key);
  if (!value) return fallback;
  const std::optional<double> x = value->read_number(problems);
  if (!x) return fallback;
  const Parameter& declared = part.declared(key);
  const bool whole = declared.type != Parameter::Type::integer || *x == std::floor(*x);
  if (whole) return plugin::in_range(*value, *x, declared, problems) ? *x : fallback;
  problems.error(value->problem(fmt::format("found {}, expected {}", *x, plugin::expected(declared))));
  return fallback;
}

// The least step that a run can take [s]: t + h must differ from t, with h accurate to a few per cent.
struct Resolution {
  double least, at;  // [s] at this t
  bool admits(const Value& value, double h, Problems& problems) const {
    if (h >= least) return true;
    problems.error(value.problem(
        fmt::format("found {}, expected a step of at least {:.2g} s: at t = {:.6g} s a smaller one is lost in t + h", h,
                    least, at)));
    return false;
  }
};

Resolution resolution_of(const Settings& settings) {
  const double largest = std::max(std::abs(settings.start), std::abs(settings.until));
  return {16 * std::numeric_limits<double>::epsilon() * largest, largest};
}

StepChoice read_step(const Value& value, const Resolution& resolution, Problems& problems) {
  StepChoice choice;
  if (value.type() != Value::Type::object) {
    if (const auto h = value.read_number(problems)) {
      if (!(*h > 0))
        problems.error(value.problem(fmt::format("found {}, expected a step > 0 [s] or {{\"tolerance\": 1e-9}}", *h)));
      else if (resolution.admits(value, *h, problems))
        choice.fixed = *h;
    }
    return choice;
  }
  const plugin::Part& part = setting_part("step");
  check_part(value, part, {}, problems);
  const double both = number(value, part, "tolerance", choice.tolerance.relative, problems);
  if (!value.find("tolerance") && !(value.find("relative") && value.find("absolute")))
    problems.error(value.problem("give \"tolerance\", or both \"relative\" and \"absolute\""));
  choice.tolerance.relative = number(value, part, "relative", both, problems);
  choice.tolerance.absolute =
      number(value, part, "absolute", 0, problems);  // 0: in the scene's own unit (ContactScale)
  const auto length = [&](const char* key, double fallback) {
    const double h = number(value, part, key, fallback, problems);
    return h == fallback || resolution.admits(*value.find(key), h, problems) ? h : fallback;
  };
  choice.initial = length("initial", choice.initial);
  choice.least = number(value, part, "min", choice.least, problems);
  choice.most = length("max", choice.most);
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
  const plugin::Part& part = setting_part("simulate");
  check_part(*simulate, part, {}, problems);
  const auto read = [&](const char* key, double fallback) { return number(*simulate, part, key, fallback, problems); };
  settings.start = read("start", settings.start);
  settings.until = read("until", settings.start);
  if (settings.until < settings.start) {
    problems.error(simulate->find("until")->problem(
        fmt::format("found {}, expected a number >= {} [s], the start", settings.until, settings.start)));
    settings.until = settings.start;
  }
  settings.contact_hold = read("contact_hold", settings.contact_hold);
  settings.chatter_steps = read("chatter_steps", settings.chatter_steps);
  settings.event_limit = static_cast<long long>(std::min(read("event_limit", double(settings.event_limit)), 1e18));
}

void read_static(const Value& root, Settings& settings, Problems& problems) {
  const Value* statics = root.find("static");
  const plugin::Part& part = setting_part("static");
  if (!statics || !check_part(*statics, part, {}, problems)) return;
  const auto read = [&](const char* key, double fallback) { return number(*statics, part, key, fallback, problems); };
  settings.load_steps = int(read("steps", settings.load_steps));
  settings.load_iterations = int(read("iterations", settings.load_iterations));
  settings.load_tolerance = read("tolerance", settings.load_tolerance);
  if (const Value* arc = statics->find("arc_length")) {
    if (arc->type() == Value::Type::boolean)
      settings.arc_length = arc->boolean();
    else
      problems.error(arc->problem(fmt::format("found {}, expected true or false", arc->type_name())));
  }
}

// Times of the run, one or many; ascending.
std::vector<double> read_times(const Value& value, const Settings& settings, Problems& problems) {
  std::vector<double> times;
  if (value.type() == Value::Type::array)
    times = value.read_numbers(problems).value_or(times);
  else if (const std::optional<double> t = value.read_number(problems))
    times = {*t};
  std::sort(times.begin(), times.end());
  for (const double t : times)
    if (!(t >= settings.start && t <= settings.until))
      problems.error(
          value.problem(fmt::format("found {}, expected times from {} to {} [s]", t, settings.start, settings.until)));
  return times;
}

void read_record(const Value& root, Settings& settings, Problems& problems) {
  const double length = settings.until - settings.start;
  settings.every = length > 0 ? length / 1000 : 1;
  const Value* record = root.find("record");
  if (!record) return;
  const plugin::Part& part = setting_part("record");
  check_part(*record, part, {"observe"}, problems);
  settings.every = number(*record, part, "every", settings.every, problems);
  if (length / settings.every > 1e9)
    problems.error(
        record->problem(fmt::format("{} s recorded every {} s are more than 1e9 rows", length, settings.every)));
  if (const Value* fields = record->find("fields")) settings.field_times = read_times(*fields, settings, problems);
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
    const Resolution resolution = resolution_of(settings);
    if (const Value* step = integrator.find("step"))
      settings.step = read_step(*step, resolution, problems);
    else
      problems.error(integrator.problem("\"step\" is missing: a length in s, or {\"tolerance\": 1e-9}"));
    if (const Value* contact = integrator.find("contact_step")) {
      settings.contact_step = read_step(*contact, resolution, problems);
      settings.own_contact_step = true;
    } else {
      settings.contact_step = settings.step;
    }
  }
  if (const Value* initial = root.find("initial")) settings.initial = read_initial(*initial, problems);
  return settings;
}

}  // namespace trammel::simulate
