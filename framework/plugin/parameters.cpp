#include "plugin/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "plugin/breadcrumb.hpp"
#include "plugin/describe.hpp"
#include "plugin/guard.hpp"
#include "scene/suggestion.hpp"

namespace trammel::plugin {

namespace {

using scene::Problems;
using scene::Value;

// The first dot splits a dotted name into a key and a name inside its object.
std::pair<std::string_view, std::string_view> split(std::string_view dotted) {
  const auto dot = dotted.find('.');
  if (dot == dotted.npos) return {dotted, {}};
  return {dotted.substr(0, dot), dotted.substr(dot + 1)};
}

const Value* find(const Value& object, std::string_view dotted) {
  const auto [key, rest] = split(dotted);
  const Value* member = object.find(key);
  return !member || rest.empty() ? member : find(*member, rest);
}

// The valid keys of the object at `prefix` ("" or "modes."), each once.
std::vector<std::string> keys_at(const std::vector<Parameter>& parameters, std::string_view prefix) {
  std::vector<std::string> keys;
  for (const Parameter& parameter : parameters) {
    if (!parameter.name.starts_with(prefix)) continue;
    const std::string key(split(std::string_view(parameter.name).substr(prefix.size())).first);
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  return keys;
}

void check_keys(const Declaration& declaration, const Value& object, const std::string& prefix,
                std::span<const FrameworkKey> framework_keys, Problems& problems) {
  const std::vector<std::string> keys = keys_at(declaration.parameters, prefix);
  for (const auto& [key, member] : object.members()) {
    if (std::ranges::find(framework_keys, key, &FrameworkKey::name) != framework_keys.end()) continue;
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      std::vector<std::string> candidates = keys;
      for (const FrameworkKey& known : framework_keys) candidates.push_back(known.name);
      problems.error(member.problem(fmt::format("{} \"{}\" has no parameter \"{}\"{}", to_string(declaration.kind),
                                                declaration.name, prefix + key, scene::did_you_mean(key, candidates))));
      continue;
    }
    const std::string inner = prefix + key + ".";
    const std::vector<std::string> inner_keys = keys_at(declaration.parameters, inner);
    if (inner_keys.empty()) continue;
    if (member.type() == Value::Type::object)
      check_keys(declaration, member, inner, {}, problems);
    else
      problems.error(member.problem(
          fmt::format("expected an object with {}, found {}", fmt::join(inner_keys, ", "), member.type_name())));
  }
}

void set_parameters(Component& component, const Declaration& declaration, const Value& object,
                    std::span<const FrameworkKey> framework_keys, Space space, Problems& problems);

// Reads one parameter's value from the scene and checks type, range and choices. Nothing if a problem was reported.
class ValueReader {
 public:
  ValueReader(const Parameter& parameter, Space space, Problems& problems)
      : parameter_(parameter), space_(space), problems_(problems) {}

  std::optional<ParameterValue> read(const Value& value) const {
    using Type = Parameter::Type;
    switch (parameter_.type) {
      case Type::number:
        return checked(value, value.read_number(problems_));
      case Type::integer:
        return checked(value, value.read_integer(problems_));
      case Type::boolean:
        return pass(value.read_boolean(problems_));
      case Type::text:
        return choice(value, value.read_text(problems_));
      case Type::numbers:
        return checked(value, numbers(value));
      case Type::vector:
        return pass(vector(value));
      case Type::time_function:
        return law(value);
      case Type::named_numbers:
        return named<double>(value, [this](const Value& v) { return ranged(v, v.read_number(problems_)); });
      case Type::named_vectors:
        return named<Vec3>(value, [this](const Value& v) { return vector(v); });
      case Type::named_parts:
        return named<std::shared_ptr<Component>>(value, [this](const Value& v) { return part(v); });
    }
    return {};
  }

 private:
  template <class T>
  static std::optional<ParameterValue> pass(std::optional<T> x) {
    return x ? std::optional<ParameterValue>(std::move(*x)) : std::nullopt;
  }

  template <class T>
  std::optional<ParameterValue> checked(const Value& value, std::optional<T> x) const {
    return pass(ranged(value, std::move(x)));
  }

  template <class T>
  std::optional<T> ranged(const Value& value, std::optional<T> x) const {
    return x && in_range(value, *x) ? std::move(x) : std::nullopt;
  }

  bool in_range(const Value& value, double x) const { return plugin::in_range(value, x, parameter_, problems_); }

  bool in_range(const Value& value, const std::vector<double>& numbers) const {
    return std::all_of(numbers.begin(), numbers.end(), [&](double x) { return in_range(value, x); });
  }

  std::optional<ParameterValue> choice(const Value& value, std::optional<std::string> text) const {
    const auto& choices = parameter_.choices;
    if (!text) return {};
    if (choices.empty() || std::find(choices.begin(), choices.end(), *text) != choices.end())
      return pass(std::move(text));
    const std::string near = scene::nearest(*text, choices);
    problems_.error(value.problem(fmt::format("found \"{}\", expected {}{}", *text, expected(parameter_),
                                              near.empty() ? "" : fmt::format(". Did you mean \"{}\"?", near))));
    return {};
  }

  // A single number is read as a list of one.
  std::optional<std::vector<double>> numbers(const Value& value) const {
    if (value.type() == Value::Type::array) return value.read_numbers(problems_);
    const auto number = value.read_number(problems_);
    return number ? std::optional(std::vector{*number}) : std::nullopt;
  }

  std::optional<Vec3> vector(const Value& value) const {
    const auto numbers = value.read_numbers(problems_);
    if (!numbers) return {};
    const auto n = static_cast<std::size_t>(dimension(space_));
    if (numbers->size() != n) {
      problems_.error(value.problem(fmt::format("found {} numbers, expected {}: the scene is {}", numbers->size(), n,
                                                space_ == Space::planar ? "planar" : "spatial")));
      return {};
    }
    if (!in_range(value, *numbers)) return {};
    return Vec3(Eigen::Map<const Vec>(numbers->data(), static_cast<Eigen::Index>(n)));
  }

  std::optional<std::shared_ptr<Component>> part(const Value& value) const {
    if (value.type() != Value::Type::object) {
      problems_.error(value.problem(fmt::format("expected an object, found {}", value.type_name())));
      return {};
    }
    const std::size_t before = problems_.errors().size();
    std::shared_ptr<Component> one = parameter_.part->make();
    set_parameters(*one, *parameter_.part, value, {}, space_, problems_);
    return problems_.errors().size() == before ? std::optional(std::move(one)) : std::nullopt;
  }

  std::optional<ParameterValue> law(const Value& value) const {
    std::optional<TimeFunction> f = value.read_time_function(problems_);
    if (f && f->is_constant() && !in_range(value, (*f)(0))) return {};
    return pass(std::move(f));
  }

  template <class T, class Read>
  std::optional<ParameterValue> named(const Value& value, Read read_one) const {
    if (value.type() != Value::Type::object) {
      problems_.error(value.problem(fmt::format("expected {}, found {}", expected(parameter_), value.type_name())));
      return {};
    }
    Named<T> all;
    for (const auto& [name, member] : value.members())
      if (auto one = read_one(member)) all.emplace_back(name, std::move(*one));
    if (all.size() != value.members().size()) return {};
    return all;
  }

  const Parameter& parameter_;
  Space space_;
  Problems& problems_;
};

// Gives a vector's default the scene's dimension: an empty or zero default becomes a zero vector; any other must fit.
void fit_default(Component& component, const Parameter& parameter, const Value& object, Space space,
                 Problems& problems) {
  if (parameter.type != Parameter::Type::vector) return;
  const ParameterValue value = parameter.get(component);
  const Vec3* x = std::get_if<Vec3>(&value);
  const int n = dimension(space);
  if (!x || x->size() == n) return;
  if (x->isZero(0))
    parameter.set(component, Vec3(Vec3::Zero(n)));
  else
    problems.error(object.problem(fmt::format("\"{}\" is missing: {}; its default {} has another dimension",
                                              parameter.name, expected(parameter), text(value))));
}

void set_parameters(Component& component, const Declaration& declaration, const Value& object,
                    std::span<const FrameworkKey> framework_keys, Space space, Problems& problems) {
  if (object.type() == Value::Type::object) check_keys(declaration, object, "", framework_keys, problems);
  for (const Parameter& parameter : declaration.parameters) {
    if (const Value* value = find(object, parameter.name)) {
      if (auto read = ValueReader(parameter, space, problems).read(*value)) parameter.set(component, *read);
    } else if (parameter.traits.required) {
      problems.error(object.problem(fmt::format("\"{}\" is missing: {}", parameter.name, expected(parameter))));
    } else {
      fit_default(component, parameter, object, space, problems);
    }
  }
}

}  // namespace

bool in_range(const Value& value, double x, const Parameter& declared, Problems& problems) {
  const ParameterTraits& traits = declared.traits;
  const bool above = traits.above_min ? x > traits.min : x >= traits.min;
  if (!above || !(x <= traits.max)) {
    problems.error(value.problem(fmt::format("found {}, expected {}", x, expected(declared))));
    return false;
  }
  if (x < traits.usual_min || x > traits.usual_max)
    problems.warning(value.problem(
        fmt::format("{} is unusual; it is usually {}", x, range(traits.usual_min, false, traits.usual_max))));
  return true;
}

scene::Problem refused(const Value& object, const ParameterError& e) {
  if (const Value* value = find(object, e.parameter())) return value->problem(e.what());
  scene::Problem problem = object.problem(e.what());
  problem.path += (problem.path.empty() ? "" : ".") + e.parameter();
  return problem;
}

std::span<const FrameworkKey> framework_keys(Kind kind) {
  static const FrameworkKey type = {"type", "the component's name"};
  static const std::vector<FrameworkKey> other = {type};
  static const std::vector<FrameworkKey> joint = {
      type,
      {"between",
       "[A, B], markers: \"beam.tip\", \"ground\" or a frame {\"point\": ..., \"angle\": ...} fixed in the world; "
       "three or four where a joint ties so many"},
      {"friction",
       "a law of friction, such as {\"type\": \"coulomb\", ...}, of a joint that bears beside its one free motion, "
       "as prismatic and revolute do; none if left out"}};
  static const std::vector<FrameworkKey> force = {type,
                                                  {"between", "[A, B], markers as those of joints"},
                                                  {"on", "in its place, the one marker that the force acts on"}};
  static const std::vector<FrameworkKey> contact = {
      type,
      {"between",
       "[marker, {\"plane\": {\"point\": ..., \"normal\": ..., \"on\": marker}}], [marker, {\"surface\": body}], "
       "[{\"surface\": body}, {\"plane\": ...}] or [{\"surface\": body}, {\"surface\": body}]; with \"reaches\" the "
       "markers of its joint"},
      {"radius", "[m] of a disk or sphere around the first marker; 0: a point"},
      {"friction", "a law of friction, such as {\"type\": \"coulomb\", ...}; none if left out"},
      {"reaches",
       "a joint of one row between the markers, such as {\"type\": \"distance\", \"length\": 1}: the contact closes at "
       "its 0"},
      {"from", "\"above\" or \"below\", the side that \"reaches\" is approached from; above if left out"}};
  static const std::vector<FrameworkKey> integrator = {
      type,
      {"step", "fixed [s], or controlled to a tolerance: see 'trammel describe step'"},
      {"contact_step", "the step while a contact is closed; \"step\" if left out"}};
  switch (kind) {
    case Kind::joint:
      return joint;
    case Kind::force:
      return force;
    case Kind::contact:
      return contact;
    case Kind::integrator:
      return integrator;
    default:
      return other;
  }
}

std::unique_ptr<Component> new_component(const Entry& entry, const std::string& path) {
  const Origin origin = entry.origin(path);
  return guard(origin, "its constructor", {}, [&] {
    const Breadcrumb goes_on(origin, "its constructor");
    return entry.declaration.make();
  });
}

std::unique_ptr<Component> make(const Entry& entry, const Value& object, std::span<const FrameworkKey> framework_keys,
                                const World& world, Problems& problems) {
  const Declaration& declaration = entry.declaration;
  const Origin origin = entry.origin(object.path());
  const std::size_t problems_before = problems.errors().size();
  auto component = new_component(entry, object.path());

  set_parameters(*component, declaration, object, framework_keys, world.space, problems);
  if (problems.errors().size() != problems_before) return nullptr;

  guard(origin, "prepare", {}, [&] {
    const Breadcrumb goes_on(origin, "prepare");
    try {
      component->prepare(world);
    } catch (const ParameterError& e) {
      problems.error(refused(object, e));
    }
  });
  return problems.errors().size() == problems_before ? std::move(component) : nullptr;
}

void throw_wrong_interface(const Entry& entry) {
  throw PluginError(
      entry.origin(""), "its constructor",
      fmt::format("it is declared as {} but does not derive from that interface", to_string(entry.declaration.kind)));
}

const Entry* entry_of(Registry& registry, Kind kind, const Value& object, Problems& problems) {
  if (object.type() != Value::Type::object) {
    problems.error(object.problem(fmt::format("expected an object with a \"type\", found {}", object.type_name())));
    return nullptr;
  }
  const Value* type = object.find("type");
  if (!type) {
    problems.error(object.problem(
        fmt::format("\"type\" is missing: which {} it is ('trammel list' shows them)", to_string(kind))));
    return nullptr;
  }
  return registry.find(kind, *type, problems);
}

}  // namespace trammel::plugin
