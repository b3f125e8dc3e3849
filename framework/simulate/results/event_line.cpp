#include "simulate/results/event_line.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace trammel::simulate {

namespace {

constexpr const char* axes = "xyz";

// "name" in the plane, "name_x", "name_y", "name_z" in space.
void add(std::vector<std::pair<std::string, double>>& figures, const std::string& name, const Vec3& x) {
  if (x.size() == 1) return figures.emplace_back(name, x[0]), void();
  for (Eigen::Index i = 0; i < 3; ++i) figures.emplace_back(fmt::format("{}_{}", name, axes[i]), x[i]);
}

void add_pair(std::vector<std::pair<std::string, double>>& figures, const std::string& name, double before,
              double after) {
  figures.emplace_back(name + "_before", before);
  figures.emplace_back(name + "_after", after);
}

}  // namespace

EventLine::EventLine(const model::Model& model)
    : model_(model), columns_{"t",          "kind",        "component", "impulse",  "approach",
                              "separation", "energy_lost", "friction",  "direction"} {
  const bool spatial = model.world.space == Space::spatial;
  if (spatial)
    for (const char* name : {"friction", "direction"})
      for (int i = 0; i < 3; ++i) columns_.push_back(fmt::format("{}_{}", name, axes[i]));
  if (std::none_of(model.bodies.begin(), model.bodies.end(),
                   [](const auto& body) { return body.refinable != nullptr; }))
    return;
  columns_.push_back("cause");
  std::vector<std::string> pairs = {"coordinates", "kinetic", "potential", "elastic", "mass"};
  for (int i = 0; i < dimension(model.world.space); ++i) pairs.push_back(fmt::format("momentum_{}", axes[i]));
  for (int i = spatial ? 0 : 2; i < 3; ++i) pairs.push_back(fmt::format("spin_{}", axes[i]));
  for (const std::string& name : pairs) columns_.insert(columns_.end(), {name + "_before", name + "_after"});
}

std::string EventLine::header() const {
  return fmt::format("{}\n", fmt::join(columns_, ","));
}

void EventLine::append(double t, std::string_view kind, const std::string& component, const std::string& cause,
                       const Figures& figures, std::string& out) const {
  fmt::format_to(std::back_inserter(out), "{:.17g},{},{}", t, kind, component);
  for (std::size_t c = 3; c < columns_.size(); ++c) {
    out += ',';
    if (columns_[c] == "cause") out += cause;
    for (const auto& [name, value] : figures)
      if (name == columns_[c]) fmt::format_to(std::back_inserter(out), "{:.17g}", value + 0.0);  // no -0
  }
  out += '\n';
}

void EventLine::append(const ContactEvent& event, std::string& out) const {
  using Kind = ContactEvent::Kind;
  Figures figures;
  const Kind kind = event.kind;
  if (kind == Kind::impact || kind == Kind::latch) {
    figures = {{"impulse", event.impulse},
               {"approach", event.approach},
               {"separation", event.separation},
               {"energy_lost", event.energy_lost}};
    add(figures, "friction", event.friction);
  } else if (kind == Kind::stick || kind == Kind::slip || kind == Kind::reversal) {
    add(figures, "friction", event.friction);
    if (kind != Kind::stick) add(figures, "direction", event.direction);
  } else if (kind == Kind::close) {
    figures = {{"approach", event.approach}};
  } else {
    figures = {{"separation", event.separation}};
  }
  append(event.t, to_string(kind), model_.contacts[std::size_t(event.contact)].path(), "", figures, out);
}

void EventLine::append(const RefineEvent& event, std::string& out) const {
  const RefineEvent::Side &before = event.before, &after = event.after;
  Figures figures;
  add_pair(figures, "coordinates", before.sizes.nq, after.sizes.nq);
  add_pair(figures, "kinetic", before.energy.kinetic, after.energy.kinetic);
  add_pair(figures, "potential", before.energy.potential, after.energy.potential);
  add_pair(figures, "elastic", before.energy.elastic, after.energy.elastic);
  if (before.momentum && after.momentum) {
    const Momentum &was = *before.momentum, &is = *after.momentum;
    add_pair(figures, "mass", was.mass, is.mass);
    for (Eigen::Index i = 0; i < was.linear.size(); ++i)
      add_pair(figures, fmt::format("momentum_{}", axes[i]), was.linear(i), is.linear(i));
    for (Eigen::Index i = 0; i < was.angular.size(); ++i)
      add_pair(figures, fmt::format("spin_{}", axes[was.angular.size() == 1 ? 2 : i]), was.angular(i), is.angular(i));
  }
  append(event.t, "refine", fmt::format("bodies.{}", model_.bodies[std::size_t(event.body)].name), event.cause, figures,
         out);
}

}  // namespace trammel::simulate
