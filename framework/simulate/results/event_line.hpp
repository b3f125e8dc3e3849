// Lines of events.csv: time, kind and component, then a column for each figure, empty where an event has none.
//
//     t,kind,component,impulse,approach,separation,energy_lost,friction,direction
//
// In space friction_x, friction_y, friction_z and direction_x, ... follow: vectors of contacts in world axes (friction
// and direction without axis are those of joints, along their one free motion). Scenes with a body that can refine have
// cause and coordinates, energies, mass and momenta before and after it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "simulate/results/contact_event.hpp"
#include "simulate/results/refine_event.hpp"

namespace trammel::simulate {

class EventLine {
 public:
  explicit EventLine(const model::Model& model);
  const std::vector<std::string>& columns() const { return columns_; }
  std::string header() const;
  void append(const ContactEvent& event, std::string& out) const;
  void append(const RefineEvent& event, std::string& out) const;

 private:
  using Figures = std::vector<std::pair<std::string, double>>;
  void append(double t, std::string_view kind, const std::string& component, const std::string& cause,
              const Figures& figures, std::string& out) const;
  const model::Model& model_;
  std::vector<std::string> columns_;
};

}  // namespace trammel::simulate
