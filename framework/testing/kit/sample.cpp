#include "testing/kit/sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "plugin/describe.hpp"

namespace trammel::kit {

namespace {

using Json = nlohmann::ordered_json;
using Type = Parameter::Type;

// Limits as they are usual, where the declaration says so.
struct Range {
  double low, high;
};
Range range_of(const ParameterTraits& t) {
  return {std::max(t.min, t.usual_min), std::min(t.max, t.usual_max)};
}

double inside(const ParameterTraits& t) {
  const auto [low, high] = range_of(t);
  if (std::isfinite(low) && std::isfinite(high)) return (low + high) / 2;
  if (std::isfinite(low)) return low + 1;
  return std::isfinite(high) ? high - 1 : 0.7;
}

Json numbers(int count, double value) {
  Json all = Json::array();
  for (int i = 0; i < count; ++i) all.push_back(value);
  return all;
}

// `which` tells two required vectors apart: the ends of a bar must not coincide.
Json required_value(const Parameter& p, Space space, int which, int attempt) {
  constexpr std::array lengths = {1, 2, 3, 6};
  switch (p.type) {
    case Type::integer:
      return std::ceil(inside(p.traits));
    case Type::boolean:
      return false;
    case Type::text:
      return p.choices.empty() ? Json("") : Json(p.choices.front());
    case Type::vector: {
      Json v = Json::array();
      for (int i = 0; i < dimension(space); ++i) v.push_back((i == which % 3 ? 1.0 : 0.3) + 0.1 * which);
      return v;
    }
    case Type::numbers:
      return numbers(lengths[std::size_t(attempt)], std::ceil(inside(p.traits)));
    case Type::named_numbers:
    case Type::named_vectors:
    case Type::named_parts:
      return Json::object();
    default:
      return inside(p.traits);
  }
}

double random_number(const ParameterTraits& t, double fallback, std::mt19937& random) {
  auto [low, high] = range_of(t);
  if (!std::isfinite(low) || !std::isfinite(high)) {
    const double size = std::abs(fallback) > 0 ? std::abs(fallback) : 1;
    if (fallback > 0 && !(t.min < 0)) return std::clamp(fallback * std::pow(10, between(random, -1, 1)), low, high);
    low = std::max(low, fallback - size), high = std::min(high, fallback + size);
  }
  const double x = between(random, low, high);
  return t.above_min && x <= t.min ? (low + high) / 2 : x;
}

double number_of(const ParameterValue& value) {
  if (const double* x = std::get_if<double>(&value)) return *x;
  if (const int* n = std::get_if<int>(&value)) return *n;
  if (const TimeFunction* f = std::get_if<TimeFunction>(&value); f && f->is_constant()) return (*f)(0);
  return 0;
}

std::string refusal(const plugin::Entry& entry, const Json& object, Space space) {
  try {
    make_from(entry, object.dump(), world_of(space));
    return "";
  } catch (const std::exception& e) {
    return e.what();
  }
}

void add_least(const plugin::Entry& entry, Space space, std::vector<Form>& forms, std::string& refused) {
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const Json object = least_entry(entry.declaration, space, attempt);
    const std::string words = refusal(entry, object, space);
    if (words.empty()) {
      forms.push_back({space == Space::planar ? "planar" : "spatial", object.dump(), world_of(space)});
      return;
    }
    if (attempt == 0)
      refused += fmt::format("\n  {} {}\n    {}", to_string(entry.declaration.kind), object.dump(), words);
  }
}

// Space is nothing to an integrator or to laws of contact.
bool knows_space(Kind kind) {
  return kind == Kind::body || kind == Kind::joint || kind == Kind::force;
}

void add_given(const std::string& text, std::vector<Form>& forms) {
  Json object = Json::parse(text);
  const Space space = object.value("space", "planar") == "spatial" ? Space::spatial : Space::planar;
  World world = world_of(space);
  if (object.value("gravity", true) == false) world.gravity.setZero();
  object.erase("space"), object.erase("gravity");
  std::string name = object.value("form", space == Space::planar ? "planar" : "spatial");
  object.erase("form");
  forms.push_back({std::move(name), object.dump(), std::move(world)});
}

// Each choice in turn; those that do not go together with the rest are left out.
void add_choices(const plugin::Entry& entry, std::vector<Form>& forms) {
  const std::size_t plain = forms.size();
  for (std::size_t i = 0; i < plain; ++i)
    for (const Parameter& p : entry.declaration.parameters)
      for (const std::string& choice : p.choices) {
        const Form& form = forms[i];
        Json object = Json::parse(form.entry);
        const Json* chosen = find_at(object, p.name);
        if (chosen ? *chosen == choice : plugin::text(plugin::default_of(entry, p)) == Json(choice).dump()) continue;
        set_at(object, p.name, choice);
        if (refusal(entry, object, form.world.space).empty())
          forms.push_back({fmt::format("{}{}{} {}", form.name, form.name.empty() ? "" : ", ", p.name, choice),
                           object.dump(), form.world});
      }
}

}  // namespace

void set_at(Json& object, const std::string& dotted, Json value) {
  const auto dot = dotted.find('.');
  if (dot == dotted.npos)
    object[dotted] = std::move(value);
  else
    set_at(object[dotted.substr(0, dot)], dotted.substr(dot + 1), std::move(value));
}

const Json* find_at(const Json& object, const std::string& dotted) {
  const auto dot = dotted.find('.');
  const auto at = object.find(dotted.substr(0, dot));
  if (at == object.end()) return nullptr;
  return dot == dotted.npos ? &*at : find_at(*at, dotted.substr(dot + 1));
}

Json least_entry(const Declaration& declaration, Space space, int attempt) {
  Json object = {{"type", declaration.name}};
  int which = 0;
  for (const Parameter& p : declaration.parameters)
    if (p.traits.required) set_at(object, p.name, required_value(p, space, which++, attempt));
  return object;
}

std::optional<Json> random_value(const Parameter& p, const ParameterValue& fallback, Space space,
                                 std::mt19937& random) {
  switch (p.type) {
    case Type::number:
    case Type::time_function:
      return random_number(p.traits, number_of(fallback), random);
    case Type::integer: {
      const double x = std::round(random_number(p.traits, number_of(fallback), random));
      return std::clamp(x, std::ceil(p.traits.min), std::floor(p.traits.max));
    }
    case Type::boolean:
      return random() % 2 == 0;
    case Type::text:
      return p.choices.empty() ? std::nullopt : std::optional<Json>(p.choices[random() % p.choices.size()]);
    case Type::vector: {
      Json v = Json::array();
      for (int i = 0; i < dimension(space); ++i) v.push_back(random_number(p.traits, 0, random));
      return v;
    }
    default:
      return {};
  }
}

std::vector<Form> forms_of(const plugin::Entry& entry, const std::vector<std::string>& given, Level level) {
  std::vector<Form> forms;
  std::string refused;
  for (const std::string& text : given) add_given(text, forms);
  if (given.empty()) {
    add_least(entry, Space::planar, forms, refused);
    if (knows_space(entry.declaration.kind)) add_least(entry, Space::spatial, forms, refused);
  }
  if (forms.empty())
    throw std::runtime_error(
        fmt::format("{} \"{}\" refuses the parameters that were made up for it; give some by --with, "
                    "a JSON object as in a scene:{}",
                    to_string(entry.declaration.kind), entry.declaration.name, refused));
  if (!knows_space(entry.declaration.kind) && forms.size() == 1) forms[0].name.clear();
  if (level == Level::full) add_choices(entry, forms);
  return forms;
}

}  // namespace trammel::kit
