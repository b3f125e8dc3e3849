#include "simulate/observable.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "scene/suggestion.hpp"

namespace trammel::simulate {
namespace {

using model::MarkerRef;
using model::Model;
using Value = std::function<double(Moment&)>;
using Choices = std::vector<std::pair<std::string, Value>>;  // full names

double acceleration(Moment& moment, MarkerRef marker, int component) {
  const Vec& a = moment.a();
  const Motion& motion = moment.system().motion(marker);
  double sum = motion.bias.size() > component ? motion.bias[component] : 0;
  if (marker.body < 0) return sum;
  const int v0 = moment.system().model().bodies[marker.body].v0;
  for (std::size_t k = 0; k < motion.dofs.size(); ++k)
    sum += motion.J(component, Eigen::Index(k)) * a[v0 + motion.dofs[k]];
  return sum;
}

void add_marker(const std::string& name, MarkerRef marker, Space space, Choices& choices) {
  static constexpr std::array axes = {"x", "y", "z"};
  const int n = dimension(space);
  for (int i = 0; i < n; ++i)
    choices.emplace_back(fmt::format("{}.{}", name, axes[i]),
                         [=](Moment& m) { return m.system().motion(marker).x[i]; });
  for (int i = 0; i < n; ++i)
    choices.emplace_back(fmt::format("{}.v{}", name, axes[i]),
                         [=](Moment& m) { return m.system().motion(marker).V[i]; });
  for (int i = 0; i < n; ++i)
    choices.emplace_back(fmt::format("{}.a{}", name, axes[i]), [=](Moment& m) { return acceleration(m, marker, i); });
  if (space == Space::spatial) return;
  choices.emplace_back(name + ".angle", [=](Moment& m) { return m.system().motion(marker).angle; });
  choices.emplace_back(name + ".omega", [=](Moment& m) { return m.system().motion(marker).V[2]; });
  choices.emplace_back(name + ".alpha", [=](Moment& m) { return acceleration(m, marker, 2); });
}

void add_contact(const std::string& name, int i, Choices& choices) {
  choices.emplace_back(name + ".gap", [=](Moment& m) { return m.system().gap(i); });
  choices.emplace_back(name + ".gap_rate", [=](Moment& m) { return m.system().gap_rate(i); });
  choices.emplace_back(name + ".force", [=](Moment& m) {
    if (!m.system().modes().contacts[i].closed) return 0.0;
    const Vec& lambda = m.lambda();
    return m.system().normal_force(i, lambda);
  });
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
    for (int k = 0; k < int(markers.size()); ++k)
      add_marker(entry.name + "." + markers[k], {b, k}, model.world.space, choices);
  }
  for (int i = 0; i < int(model.contacts.size()); ++i) add_contact("contacts." + model.contacts[i].name, i, choices);
  for (const model::JointEntry& entry : model.joints)
    choices.emplace_back("joints." + entry.name + ".reaction",
                         [&entry](Moment& m) { return m.lambda().segment(entry.row, entry.rows).norm(); });
  choices.emplace_back("energy.kinetic", [](Moment& m) { return m.energy().kinetic; });
  choices.emplace_back("energy.potential", [](Moment& m) { return m.energy().potential; });
  choices.emplace_back("energy.elastic", [](Moment& m) { return m.energy().elastic; });
  choices.emplace_back("energy.total", [](Moment& m) { return m.energy().total(); });
  return choices;
}

}  // namespace

const Energy& Moment::energy() {
  if (!std::exchange(energy_known_, true)) energy_ = system_.energy();
  return energy_;
}

void Moment::solve() {
  if (!std::exchange(solved_, true)) system_.accelerate({}, a_, lambda_);
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
  Choices choices = all_choices(model);
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  for (const auto& [name, value] : observe->members()) {
    if (name.empty() || name == "t" || name.find_first_of(",\"\n\r") != std::string::npos)
      problems.error(value.problem(fmt::format("\"{}\" cannot be a column's name", name)));
    const auto what = value.read_text(problems);
    if (!what) continue;
    const auto found = std::find(names.begin(), names.end(), *what);
    if (found == names.end())
      problems.error(value.problem(fmt::format("no observable \"{}\"{}", *what, scene::did_you_mean(*what, names))));
    else
      columns.push_back({name, choices[std::size_t(found - names.begin())].second});
  }
  return columns;
}

}  // namespace trammel::simulate
