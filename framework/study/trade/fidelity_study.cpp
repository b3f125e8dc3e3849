#include "study/trade/fidelity_study.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include <trammel/fidelity.hpp>

#include "plugin/parameters.hpp"
#include "simulate/start/setup.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

constexpr double factor_of_rung = 10;  // between the rungs of a real number

// The rungs of one parameter of a component that its declaration allows.
class Ladder {
 public:
  Ladder(std::vector<Rung>& all, const FidelityParameter& fidelity, const Parameter& parameter, std::string path)
      : all_(all), fidelity_(fidelity), parameter_(parameter), path_(std::move(path)) {}

  void operator()(const ParameterValue& now) {
    if (const auto* text = std::get_if<std::string>(&now))
      fidelity_.choices.empty() ? of_text(*text) : of_choice(*text);
    if (const int* n = std::get_if<int>(&now); n && *n > 0) of_integer(*n);
    if (const double* x = std::get_if<double>(&now); x && *x != 0) of_number(*x);
  }

 private:
  bool larger() const { return fidelity_.costs == FidelityParameter::Costs::more_if_larger; }

  void add(const std::string& value, bool finer) {
    all_.push_back({fmt::format("{} = {}", path_, value), {path_, value}, finer, true});
  }
  void add_number(double value, bool finer) {
    const ParameterTraits& t = parameter_.traits;
    if (value < t.min || value > t.max || (t.above_min && value == t.min)) return;
    add(fmt::format("{}", value), finer);
  }

  void of_choice(const std::string& now) {
    const auto& choices = fidelity_.choices;
    const auto found = std::find(choices.begin(), choices.end(), now);
    if (found == choices.end()) return;
    for (auto at = choices.begin(); at != choices.end(); ++at)
      if (at < found || at == found + 1) add(*at, at > found);
  }

  void of_integer(int now) {
    const int up = now + std::max(1, now / 2), down = now - 1, half = now / 2;
    add_number(larger() ? up : down, true);
    add_number(larger() ? down : up, false);
    if (larger() && half >= 1 && half < down) add_number(half, false);
  }

  void of_number(double now) {
    const double finer = larger() ? factor_of_rung : 1 / factor_of_rung;
    add_number(now * finer, true);
    for (const double factor : {1 / finer, 1 / (finer * finer)}) add_number(now * factor, false);
  }

  // "10x4": half as many again of each, and half as many.
  void of_text(const std::string& now) {
    for (const bool finer : {true, false}) {
      const std::string changed = with_numbers(now, [&](int n) { return finer == larger() ? n + n / 2 : n / 2; });
      if (changed != now && !changed.empty()) add(changed, finer);
    }
  }

  // Empty: a number would not be positive.
  template <class Change>
  static std::string with_numbers(const std::string& text, Change change) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
      if (std::isdigit(static_cast<unsigned char>(text[i])) == 0) {
        result += text[i++];
        continue;
      }
      std::size_t digits = 0;
      const int n = change(std::stoi(text.substr(i), &digits));
      if (n < 1) return "";
      result += std::to_string(n), i += digits;
    }
    return result;
  }

  std::vector<Rung>& all_;
  const FidelityParameter& fidelity_;
  const Parameter& parameter_;
  std::string path_;
};

// The object with another type: what the component does not declare, such as "between", stays.
std::string with_alternative(const scene::Value& object, const Declaration& declared,
                             const FidelityAlternative& other) {
  const auto own = [&](const std::string& key) {
    return std::any_of(declared.parameters.begin(), declared.parameters.end(),
                       [&](const Parameter& p) { return p.name == key || p.name.starts_with(key + "."); });
  };
  std::string text = fmt::format("{{\"type\":\"{}\"", other.type);
  for (const auto& [key, value] : object.members())
    if (key != "type" && !own(key)) text += fmt::format(",\"{}\":{}", key, json_text(value));
  for (const auto& [key, value] : other.parameters) text += fmt::format(",\"{}\":{}", key, value);
  return text + "}";
}

void of_component(std::vector<Rung>& all, const Component* component, Kind kind, const std::string& path,
                  const scene::Scene& scene, plugin::Registry& registry) {
  const auto* has = dynamic_cast<const HasFidelity*>(component);
  const scene::Value* type = scene.root().at_path(path + ".type");
  if (!has || !type) return;
  const Declaration& declaration = registry.find(kind, type->text()).declaration;
  for (const FidelityParameter& p : has->fidelity())
    for (const Parameter& parameter : declaration.parameters)
      if (parameter.name == p.name) Ladder(all, p, parameter, path + "." + p.name)(parameter.get(*component));
  for (const FidelityAlternative& other : has->alternatives())
    all.push_back({fmt::format("{} by {}", path, other.type),
                   {path, with_alternative(*scene.root().at_path(path), declaration, other)},
                   other.finer,
                   true});
}

// All, and each level if there are several.
void of_corrections(std::vector<Rung>& all, const scene::Scene& scene) {
  const scene::Value* corrections = scene.root().find("corrections");
  if (!corrections || corrections->type() != scene::Value::Type::object) return;
  all.push_back({"without corrections", {"corrections", "null"}, false, false});
  if (corrections->members().size() < 2) return;
  for (const auto& [level, how] : corrections->members())
    all.push_back({"without corrections of " + level, {"corrections." + level, "null"}, false, false});
}

// Units that were repeated by "for" have no path of their own.
bool applies(const SceneSource& source, const Rung& rung) {
  try {
    source.with({rung.change});
    return true;
  } catch (const scene::SceneError&) {
    return false;
  }
}

}  // namespace

bool overlap(const std::string& a, const std::string& b) {
  return a == b || a.starts_with(b + ".") || b.starts_with(a + ".");
}

std::vector<Rung> ladders(const SceneSource& source, plugin::Registry& registry) {
  std::vector<Rung> all;
  const scene::Scene scene = source.with();
  const simulate::Setup setup = simulate::set_up(scene, registry);
  for (const model::BodyEntry& body : setup.model->bodies)
    of_component(all, body.body.get(), Kind::body, "bodies." + body.name, scene, registry);
  for (const model::ContactEntry& contact : setup.model->contacts) {
    if (contact.joint) continue;
    of_component(all, contact.law.get(), Kind::contact, "contacts." + contact.name, scene, registry);
    if (!contact.friction) continue;
    of_component(all, contact.friction.get(), Kind::friction, "contacts." + contact.name + ".friction", scene,
                 registry);
    all.push_back({"without friction of contacts." + contact.name,
                   {"contacts." + contact.name + ".friction", "null"},
                   false,
                   false});
  }
  of_corrections(all, scene);
  std::erase_if(all, [&](const Rung& rung) { return !applies(source, rung); });
  return all;
}

}  // namespace trammel::study
