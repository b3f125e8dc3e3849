// A component's declaration: its name, its source in the literature and its parameters, each declared once.
//
//     TRAMMEL_PLUGIN(trammel::integrator<HhtAlpha>("hht_alpha", "HHT-alpha with stabilised constraints")
//                        .source("Negrut et al. 2007, J. Comput. Nonlinear Dynam. 2(1), 73-85")
//                        .parameter("alpha", &HhtAlpha::alpha, {.min = -1.0 / 3, .max = 0, .doc = "0: trapezoidal"}))
//
// The member gives the type, its initialiser the default. Parsing, range errors, suggestions of names, `trammel
// describe`, the JSON Schema and the manual are derived from the declaration. A dotted name ("modes.axial") stands for
// a member of a nested JSON object.
#pragma once

#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <trammel/component.hpp>
#include <trammel/time_function.hpp>

namespace trammel {

enum class Kind { integrator, body, joint, force, contact, friction, correction, part };
const char* to_string(Kind);

// Objects keyed by name, in scene order: {"tip": 1.0, "middle": 0.5}.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

// The types that a parameter's member may have; std::optional<T> distinguishes a missing parameter.
//   double, int, bool, std::string    a number, a whole number, true/false, text
//   Vec3                              a vector of the scene's dimension: 2 entries planar, 3 spatial
//   std::vector<double>               any number of numbers; a single one needs no brackets
//   TimeFunction                      a number, an expression of t or a table
//   Named<double>, Named<Vec3>        objects keyed by name
//   Named<Part>                       parts keyed by name, objects with their own parameters: declared by .parts(...)
//   an enum                           one of the names given to .choice(...)
using ParameterValue = std::variant<std::monostate, double, int, bool, std::string, Vec3, std::vector<double>,
                                    TimeFunction, Named<double>, Named<Vec3>, Named<std::shared_ptr<Component>>>;

// Properties of one parameter. A value outside min..max is an error, outside usual_min..usual_max a warning.
struct ParameterTraits {
  const char* unit = "1";
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  double usual_min = -std::numeric_limits<double>::infinity();
  double usual_max = std::numeric_limits<double>::infinity();
  bool above_min = false;  // min itself is refused too ("greater than")
  bool required = false;
  const char* doc = "";
  int derivatives = 0;  // of a law of time: highest derivative that the component uses; all lower ones must not jump
};

struct Declaration;

struct Parameter {
  std::string name;  // dotted
  // As in ParameterValue; a choice is text with `choices`.
  enum class Type {
    number,
    integer,
    boolean,
    text,
    vector,
    numbers,
    time_function,
    named_numbers,
    named_vectors,
    named_parts
  };
  Type type;
  bool optional = false;
  ParameterTraits traits;
  std::vector<std::string> choices;
  std::function<void(Component&, const ParameterValue&)> set;
  std::function<ParameterValue(const Component&)> get;  // monostate: an empty optional
  std::shared_ptr<const Declaration> part = {};         // of named_parts: the declaration of each part
};

namespace detail {

template <class T>
struct ParameterTypeOf;
template <>
struct ParameterTypeOf<double> {
  static constexpr auto value = Parameter::Type::number;
};
template <>
struct ParameterTypeOf<int> {
  static constexpr auto value = Parameter::Type::integer;
};
template <>
struct ParameterTypeOf<bool> {
  static constexpr auto value = Parameter::Type::boolean;
};
template <>
struct ParameterTypeOf<std::string> {
  static constexpr auto value = Parameter::Type::text;
};
template <>
struct ParameterTypeOf<Vec3> {
  static constexpr auto value = Parameter::Type::vector;
};
template <>
struct ParameterTypeOf<std::vector<double>> {
  static constexpr auto value = Parameter::Type::numbers;
};
template <>
struct ParameterTypeOf<TimeFunction> {
  static constexpr auto value = Parameter::Type::time_function;
};
template <>
struct ParameterTypeOf<Named<double>> {
  static constexpr auto value = Parameter::Type::named_numbers;
};
template <>
struct ParameterTypeOf<Named<Vec3>> {
  static constexpr auto value = Parameter::Type::named_vectors;
};

}  // namespace detail

struct Declaration {
  Kind kind;
  std::string name;
  std::string summary;  // one line
  std::string source;   // paper, equations
  std::vector<Parameter> parameters;
  std::function<std::unique_ptr<Component>()> make;  // with every parameter at its default
  // Of bodies, for the manual: the names of their markers and of their observables (Observed).
  std::string markers = {}, observables = {};
};

// The builder behind integrator<T>(...), body<T>(...), ...
template <class T>
class Declare {
 public:
  Declare(Kind kind, std::string name, std::string summary) {
    declaration_.kind = kind;
    declaration_.name = std::move(name);
    declaration_.summary = std::move(summary);
    declaration_.make = [] { return std::make_unique<T>(); };
  }

  Declare& source(std::string text) {
    declaration_.source = std::move(text);
    return *this;
  }

  // Names, comma-separated, and words for those that depend on parameters: "root, tip, and those of \"markers\"".
  Declare& markers(std::string names) {
    declaration_.markers = std::move(names);
    return *this;
  }
  Declare& observables(std::string names) {
    declaration_.observables = std::move(names);
    return *this;
  }

  template <class Owner, class Value>
  Declare& parameter(std::string name, Value Owner::*member, ParameterTraits traits = {}) {
    add(
        std::move(name), detail::ParameterTypeOf<Value>::value, traits,
        [member](Component& c, const ParameterValue& v) { static_cast<T&>(c).*member = std::get<Value>(v); },
        [member](const Component& c) -> ParameterValue { return static_cast<const T&>(c).*member; });
    return *this;
  }

  template <class Owner, class Value>
  Declare& parameter(std::string name, std::optional<Value> Owner::*member, ParameterTraits traits = {}) {
    add(
        std::move(name), detail::ParameterTypeOf<Value>::value, traits,
        [member](Component& c, const ParameterValue& v) { static_cast<T&>(c).*member = std::get<Value>(v); },
        [member](const Component& c) -> ParameterValue {
          const auto& value = static_cast<const T&>(c).*member;
          return value ? ParameterValue(*value) : ParameterValue();
        });
    declaration_.parameters.back().optional = true;
    return *this;
  }

  template <class Owner, class Enum>
  Declare& choice(std::string name, Enum Owner::*member, std::vector<std::pair<std::string, Enum>> names,
                  ParameterTraits traits = {}) {
    std::vector<std::string> choices;
    for (const auto& [text, value] : names) choices.push_back(text);
    add(
        std::move(name), Parameter::Type::text, traits,
        [member, names](Component& c, const ParameterValue& v) {
          for (const auto& [text, value] : names)
            if (text == std::get<std::string>(v)) static_cast<T&>(c).*member = value;
        },
        [member, names](const Component& c) -> ParameterValue {
          for (const auto& [text, value] : names)
            if (value == static_cast<const T&>(c).*member) return text;
          return {};
        });
    declaration_.parameters.back().choices = std::move(choices);
    return *this;
  }

  // Named parts, each with the parameters that `part` declares: {"roof": {"length": 3}, "wall": {"length": 2}}. A Part
  // derives from Component and must be copyable. The framework does not call its `prepare`; the owning component may.
  template <class Owner, class Part>
  Declare& parts(std::string name, Named<Part> Owner::*member, const Declaration& part, ParameterTraits traits = {}) {
    add(
        std::move(name), Parameter::Type::named_parts, traits,
        [member](Component& c, const ParameterValue& v) {
          auto& all = static_cast<T&>(c).*member;
          all.clear();
          for (const auto& [key, one] : std::get<Named<std::shared_ptr<Component>>>(v))
            all.emplace_back(key, static_cast<const Part&>(*one));
        },
        [member](const Component& c) -> ParameterValue {
          Named<std::shared_ptr<Component>> all;
          for (const auto& [key, one] : static_cast<const T&>(c).*member)
            all.emplace_back(key, std::make_shared<Part>(one));
          return all;
        });
    declaration_.parameters.back().part = std::make_shared<const Declaration>(part);
    return *this;
  }

  // One part whose parameters appear in the component's own JSON object, as if the component had declared them.
  template <class Owner, class Part>
  Declare& own_part(Part Owner::*member, const Declaration& part) {
    for (Parameter p : part.parameters) {
      p.set = [member, set = p.set](Component& c, const ParameterValue& v) { set(static_cast<T&>(c).*member, v); };
      p.get = [member, get = p.get](const Component& c) { return get(static_cast<const T&>(c).*member); };
      declaration_.parameters.push_back(std::move(p));
    }
    return *this;
  }

  operator Declaration() const { return declaration_; }

 private:
  void add(std::string name, Parameter::Type type, ParameterTraits traits,
           std::function<void(Component&, const ParameterValue&)> set,
           std::function<ParameterValue(const Component&)> get) {
    declaration_.parameters.push_back({std::move(name), type, false, traits, {}, std::move(set), std::move(get), {}});
  }
  Declaration declaration_;
};

template <class T>
Declare<T> integrator(std::string name, std::string summary) {
  return {Kind::integrator, std::move(name), std::move(summary)};
}
template <class T>
Declare<T> body(std::string name, std::string summary) {
  return {Kind::body, std::move(name), std::move(summary)};
}
template <class T>
Declare<T> joint(std::string name, std::string summary) {
  return {Kind::joint, std::move(name), std::move(summary)};
}
template <class T>
Declare<T> force(std::string name, std::string summary) {
  return {Kind::force, std::move(name), std::move(summary)};
}
template <class T>
Declare<T> contact(std::string name, std::string summary) {
  return {Kind::contact, std::move(name), std::move(summary)};
}
template <class T>
Declare<T> friction(std::string name, std::string summary) {
  return {Kind::friction, std::move(name), std::move(summary)};
}
template <class T>
Declare<T> correction(std::string name, std::string summary) {
  return {Kind::correction, std::move(name), std::move(summary)};
}
template <class T>
Declare<T> part(std::string name, std::string summary) {
  return {Kind::part, std::move(name), std::move(summary)};
}

}  // namespace trammel
