#include "simulate/watch/theory_watch.hpp"

#include <fmt/format.h>

namespace trammel::simulate {

TheoryWatch::TheoryWatch(const model::Model& model) : model_(model) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (const auto* theory = dynamic_cast<const TheoryLimit*>(model.bodies[i].body.get()))
      watched_.push_back({i, theory, theory->bounds()});
}

std::string TheoryWatch::look(double t, const Vec& q) {
  for (Watched& w : watched_) {
    const model::BodyEntry& body = model_.bodies[w.body];
    const double measure = w.theory->stretched(t, q.segment(body.q0, body.nq));
    if (w.largest <= w.bounds.accurate && measure > w.bounds.accurate) w.passed_at = t;
    if (measure > w.largest) w.largest = measure, w.largest_at = t;
    if (measure > w.bounds.possible)
      return fmt::format(
          "bodies.{} cannot have this shape: its {} is {:.3g}, and a body's is {:.3g} at most; its theory is accurate "
          "to 1 % up to {:.3g}; {}",
          body.name, w.bounds.measure, measure, w.bounds.possible, w.bounds.accurate, w.bounds.alternative);
  }
  return "";
}

std::vector<std::string> TheoryWatch::warnings() const {
  std::vector<std::string> all;
  for (const Watched& w : watched_)
    if (w.largest > w.bounds.accurate)
      all.push_back(fmt::format(
          "bodies.{}: its {} passed {:.3g} at t = {:.9g}, where the error of its theory reaches 1 %, and went "
          "up to {:.3g} at t = {:.9g}; {}",
          model_.bodies[w.body].name, w.bounds.measure, w.bounds.accurate, w.passed_at, w.largest, w.largest_at,
          w.bounds.alternative));
  return all;
}

void TheoryWatch::archive(Archive& a) {
  for (Watched& w : watched_) {
    const std::string name = "theory_" + model_.bodies[w.body].name;
    a(name + "_largest", w.largest), a(name + "_largest_at", w.largest_at), a(name + "_passed_at", w.passed_at);
  }
}

}  // namespace trammel::simulate
