#include "simulate/results/observable.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "model/scene_keys.hpp"
#include "scene/expression.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"
#include "simulate/results/relative_motion.hpp"
#include "simulate/results/series_columns.hpp"
#include "system/least_multipliers.hpp"

namespace trammel::simulate {
namespace {

using model::MarkerRef;
using model::Model;
using Value = std::function<double(Moment&)>;
using Choices = std::vector<std::pair<std::string, Value>>;  // full names

void add_marker(const std::string& name, MarkerRef marker, const Model& model, Choices& choices) {
  for (const auto& [component, what] : motion_components(model, marker))
    choices.emplace_back(fmt::format("{}.{}", name, component),
                         [marker, what = what](Moment& m) { return seen_from(m, marker, MarkerRef{}, what); });
}

using WorldVector = std::function<Vec3(Moment&)>;

// In the plane the one number of a vector; in space its length, and the vector in world axes.
void add_tangential(const std::string& name, Space space, const WorldVector& vector, Choices& choices) {
  if (space == Space::planar) {
    choices.emplace_back(name, [=](Moment& m) { return vector(m)[0]; });
    return;
  }
  choices.emplace_back(name, [=](Moment& m) { return vector(m).norm(); });
  for (int k = 0; k < 3; ++k)
    choices.emplace_back(fmt::format("{}_{}", name, "xyz"[k]), [=](Moment& m) { return vector(m)[k]; });
}

double normal_force(Moment& m, int i) {
  if (!m.system().modes().contacts[i].closed) return 0;
  const Vec& lambda = m.lambda();
  return m.system().normal_force(i, lambda);
}

// `space`: planar for a contact with one tangent.
void add_friction(const std::string& name, int i, Space space, Choices& choices) {
  add_tangential(
      name + ".slip", space, [=](Moment& m) { return m.system().along_tangents(i, m.system().slip(i)); }, choices);
  add_tangential(
      name + ".friction", space,
      [=](Moment& m) -> Vec3 {
        if (!m.system().modes().contacts[i].closed) return Vec3::Zero(space == Space::planar ? 1 : 3);
        const Vec& lambda = m.lambda();
        return m.system().along_tangents(i, m.system().friction_force(i, lambda));
      },
      choices);
  choices.emplace_back(name + ".sticks", [=](Moment& m) {
    return m.system().modes().contacts[i].friction == model::ContactMode::Friction::stick ? 1.0 : 0.0;
  });
}

void add_contact(int i, const Model& model, Choices& choices) {
  const model::ContactEntry& contact = model.contacts[i];
  const std::string name = contact.path();
  if (contact.joint) {
    choices.emplace_back(name + ".load", [=](Moment& m) { return normal_force(m, i); });
    add_friction(name, i, Space::planar, choices);
    return;
  }
  choices.emplace_back(name + ".gap", [=](Moment& m) { return m.system().gap(i); });
  choices.emplace_back(name + ".gap_rate", [=](Moment& m) { return m.system().gap_rate(i); });
  choices.emplace_back(name + ".force", [=](Moment& m) { return normal_force(m, i); });
  if (contact.friction) add_friction(name, i, model.world.space, choices);
  choices.emplace_back(name + ".closed", [=](Moment& m) { return m.system().modes().contacts[i].closed ? 1.0 : 0.0; });
}

Choices all_choices(const Model& model) {
  Choices choices;
  for (int b = 0; b < int(model.bodies.size()); ++b) {
    const model::BodyEntry& entry = model.bodies[b];
    if (entry.observed) {
      const auto names = entry.observed->observables();
      for (int k = 0; k < int(names.size()); ++k)
        choices.emplace_back(entry.name + "." + names[k], [&entry, k](Moment& m) {
          const State& s = m.state();
          return entry.observed->observe(k, s.t, s.q.segment(entry.q0, entry.nq), s.v.segment(entry.v0, entry.nv));
        });
    }
    const auto markers = entry.body->markers();
    for (int k = 0; k < int(markers.size()); ++k) add_marker(entry.name + "." + markers[k], {b, k}, model, choices);
  }
  for (int i = 0; i < int(model.contacts.size()); ++i) add_contact(i, model, choices);
  for (const model::BodyEntry& entry : model.bodies)
    if (entry.rows > 0)
      choices.emplace_back(entry.name + ".reaction",
                           [&entry](Moment& m) { return m.reactions().segment(entry.row, entry.rows).norm(); });
  for (const model::JointEntry& entry : model.joints)
    choices.emplace_back("joints." + entry.name + ".reaction",
                         [&entry](Moment& m) { return m.reactions().segment(entry.row, entry.rows).norm(); });
  choices.emplace_back("energy.kinetic", [](Moment& m) { return m.energy().kinetic; });
  choices.emplace_back("energy.potential", [](Moment& m) { return m.energy().potential; });
  choices.emplace_back("energy.elastic", [](Moment& m) { return m.energy().elastic; });
  choices.emplace_back("energy.total", [](Moment& m) { return m.energy().total(); });
  return choices;
}

// A column computed from other observables: "=rod.angle - crank.angle".
Value derived(const std::string& name, const std::string& text, const scene::Formula& formula, const Choices& choices) {
  std::vector<Value> inputs;
  for (const int i : formula.uses()) inputs.push_back(choices[std::size_t(i)].second);
  return [=](Moment& m) {
    std::vector<double> values;
    for (const Value& input : inputs) values.push_back(input(m));
    const double value = formula(values);
    if (!std::isfinite(value))
      throw model::NotSolvable(
          fmt::format("record.observe.{}: \"{}\" is {}", name, text, std::isnan(value) ? "not a number" : "infinite"));
    return value;
  };
}

// {"of": "block.com.x", "relative_to": "table.origin", "since_start": true}: a marker's motion seen from another one.
class MotionReader {
 public:
  MotionReader(const Model& model, scene::Problems& problems) : model_(model), problems_(problems) {}

  std::optional<Column> read(const std::string& name, const scene::Value& value) {
    if (!model::check_keys(value, {"of", "relative_to", "since_start"}, problems_)) return {};
    const scene::Value* of = value.find("of");
    if (!of) {
      problems_.error(value.problem("\"of\" is missing: a marker's motion, such as \"beam.tip.y\""));
      return {};
    }
    const auto text = of->read_text(problems_);
    if (!text) return {};
    const auto dot = text->rfind('.');
    const auto A = dot == text->npos ? std::nullopt : model::find_marker(model_, text->substr(0, dot));
    std::optional<MotionComponent> what;
    if (A)
      for (const auto& [component, candidate] : motion_components(model_, *A))
        if (text->substr(dot + 1) == component) what = candidate;
    if (!what) {
      problems_.error(
          of->problem(fmt::format("no motion \"{}\" of a marker{}", *text, scene::did_you_mean(*text, all_motions()))));
      return {};
    }
    const auto B = observer(value.find("relative_to"));
    if (!B) return {};
    Column column{name, [A = *A, B = *B, what = *what](Moment& m) { return seen_from(m, A, B, what); }, false};
    column.quantity = observable_quantity(*text, model_);
    if (const scene::Value* seen_by = value.find("relative_to"))
      column.quantity.meaning += fmt::format(", seen from {}", seen_by->text());
    if (const scene::Value* since = value.find("since_start"))
      column.since_start = since->read_boolean(problems_).value_or(false);
    if (column.since_start && what->order > 0)
      problems_.error(value.find("since_start")->problem("only a place or an angle is taken since the start"));
    return column;
  }

 private:
  std::vector<std::string> all_motions() const {
    std::vector<std::string> names;
    const auto add = [&](const std::string& marker, MarkerRef ref) {
      for (const auto& [component, what] : motion_components(model_, ref)) names.push_back(marker + "." + component);
    };
    add("ground", MarkerRef{});
    for (int body = 0; body < int(model_.bodies.size()); ++body) {
      const model::BodyEntry& entry = model_.bodies[std::size_t(body)];
      const auto markers = entry.body->markers();
      for (int marker = 0; marker < int(markers.size()); ++marker)
        add(entry.name + "." + markers[std::size_t(marker)], {body, marker});
    }
    return names;
  }

  std::optional<MarkerRef> observer(const scene::Value* value) {
    if (!value) return MarkerRef{};
    const auto text = value->read_text(problems_);
    if (!text) return {};
    const auto B = model::find_marker(model_, *text);
    if (!B) problems_.error(value->problem(model::no_marker(model_, *text)));
    return B;
  }

  const Model& model_;
  scene::Problems& problems_;
};

// A column by its form: the motion of a marker, a formula of observables, an observable.
class ColumnReader {
 public:
  ColumnReader(const Model& model, scene::Problems& problems)
      : model_(model), problems_(problems), choices_(all_choices(model)), motions_(model, problems) {
    for (const auto& choice : choices_) names_.push_back(choice.first);
  }

  void check_name(const std::string& name, const scene::Value& value) {
    if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos)
      problems_.error(
          value.problem(fmt::format("\"{}\" cannot be a column's name, which is not empty and holds no comma, "
                                    "double quote or end of line: they separate the columns of series.csv",
                                    scene::shortened(name))));
    if (is_fixed_column(name))
      problems_.error(value.problem(fmt::format("series.csv has a column \"{}\" always; choose another name", name)));
  }

  std::optional<Column> read(const std::string& name, const scene::Value& value) {
    using Type = scene::Value::Type;
    if (value.type() == Type::object) return motions_.read(name, value);
    if (value.type() == Type::text && value.text().starts_with("=")) return formula(name, value);
    return observable(name, value);
  }

 private:
  std::optional<Column> formula(const std::string& name, const scene::Value& value) {
    const auto formula = value.read_formula(names_, problems_);
    if (!formula) return {};
    return Column{name, derived(name, value.text(), *formula, choices_), false, {"", value.text(), ""}};
  }

  std::optional<Column> observable(const std::string& name, const scene::Value& value) {
    const auto what = value.read_text(problems_);
    if (!what) return {};
    const auto found = std::find(names_.begin(), names_.end(), *what);
    if (found == names_.end()) {
      problems_.error(value.problem(fmt::format("no observable \"{}\"{}", *what, scene::did_you_mean(*what, names_))));
      return {};
    }
    return Column{name, choices_[std::size_t(found - names_.begin())].second, false,
                  observable_quantity(*what, model_)};
  }

  const Model& model_;
  scene::Problems& problems_;
  Choices choices_;
  MotionReader motions_;
  std::vector<std::string> names_;
};

}  // namespace

const Energy& Moment::energy() {
  if (!std::exchange(energy_known_, true)) energy_ = system_.energy();
  return energy_;
}

void Moment::solve() {
  if (std::exchange(solved_, true)) return;
  system_.accelerate({}, a_, lambda_);
  model::minimise_norm(system_, lambda_);
}

const Vec& Moment::reactions() {
  solve();
  if (system_.modes().shared.empty()) return lambda_;
  if (std::exchange(reactions_known_, true)) return reactions_;
  reactions_ = system_.reactions(lambda_);
  model::minimise_norm(system_, reactions_);
  return reactions_;
}

void begin_columns(std::vector<Column>& columns, model::AssembledSystem& system, const State& start) {
  Moment moment(system, start);
  for (Column& column : columns)
    if (column.since_start)
      column.value = [value = column.value, begin = column.value(moment)](Moment& m) { return value(m) - begin; };
}

std::vector<Column> read_observables(const scene::Value& root, const Model& model, scene::Problems& problems) {
  std::vector<Column> columns;
  const scene::Value* observe = root.at_path("record.observe");
  if (!observe) return columns;
  if (observe->type() != scene::Value::Type::object) {
    problems.error(
        observe->problem(fmt::format("found {}, expected {{\"column\": \"beam.tip.y\", ...}}", observe->type_name())));
    return columns;
  }
  ColumnReader reader(model, problems);
  for (const auto& [name, value] : observe->members()) {
    reader.check_name(name, value);
    if (auto column = reader.read(name, value)) columns.push_back(std::move(*column));
  }
  return columns;
}

}  // namespace trammel::simulate
