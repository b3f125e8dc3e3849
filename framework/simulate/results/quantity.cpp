#include "simulate/results/quantity.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include <trammel/observed_units.hpp>

namespace trammel::simulate {

namespace {

using std::string_view;

struct Known {
  string_view name, unit, meaning;
};

// The motion of a marker; a letter behind an underscore or "v", "a" is the axis.
constexpr std::array motions = {Known{"x", "m", "position along x"},
                                Known{"y", "m", "position along y"},
                                Known{"z", "m", "position along z"},
                                Known{"vx", "m/s", "velocity along x"},
                                Known{"vy", "m/s", "velocity along y"},
                                Known{"vz", "m/s", "velocity along z"},
                                Known{"ax", "m/s^2", "acceleration along x"},
                                Known{"ay", "m/s^2", "acceleration along y"},
                                Known{"az", "m/s^2", "acceleration along z"},
                                Known{"angle", "rad", "angle"},
                                Known{"omega", "rad/s", "angular velocity"},
                                Known{"alpha", "rad/s^2", "angular acceleration"},
                                Known{"omega_x", "rad/s", "angular velocity about x"},
                                Known{"omega_y", "rad/s", "angular velocity about y"},
                                Known{"omega_z", "rad/s", "angular velocity about z"},
                                Known{"alpha_x", "rad/s^2", "angular acceleration about x"},
                                Known{"alpha_y", "rad/s^2", "angular acceleration about y"},
                                Known{"alpha_z", "rad/s^2", "angular acceleration about z"}};

constexpr std::array contacts = {Known{"gap", "m", "distance, > 0 apart"},
                                 Known{"gap_rate", "m/s", "rate of the gap, < 0 approaching"},
                                 Known{"force", "N", "normal force, >= 0 pushes"},
                                 Known{"closed", "1", "1 closed, 0 open"},
                                 Known{"load", "N", "sum of the forces on the joint's bearings"},
                                 Known{"sticks", "1", "1 sticks, 0 slides"},
                                 Known{"slip", "m/s", "tangential velocity of the first side over the second"},
                                 Known{"friction", "N", "tangential force on the first side"},
                                 Known{"reaction", "N, N m", "2-norm of the joint's multipliers"}};

constexpr std::array fixed = {
    Known{"t", "s", "time"},
    Known{"energy_kinetic", "J", "kinetic energy"},
    Known{"energy_potential", "J", "energy in gravity and force elements"},
    Known{"energy_elastic", "J", "elastic energy of bodies"},
    Known{"energy_total", "J", "sum of the energies"},
    Known{"energy_supplied", "J", "supplied since the start by drives, moving rows and moving markers"},
    Known{"energy_dissipated", "J", "dissipated since the start by all causes"},
    Known{"constraint_position", "m, rad", "2-norm of g over the active rows"},
    Known{"constraint_velocity", "m/s, rad/s", "2-norm of G v + g_t"},
    Known{"constraint_acceleration", "m/s^2, rad/s^2", "2-norm of G v' - gamma"},
    Known{"steps", "1", "accepted steps so far"}};

constexpr std::array events = {
    Known{"t", "s", "time"},
    Known{"kind", "", "what happened"},
    Known{"component", "", "path in the scene"},
    Known{"impulse", "N s", "along the normal, >= 0"},
    Known{"approach", "m/s", "speed of approach before"},
    Known{"separation", "m/s", "speed of separation after"},
    Known{"energy_lost", "J", "kinetic energy lost through this contact"},
    Known{"cause", "", "what a mesh was refined for"},
    Known{"coordinates", "1", "coordinates of the body"},
    Known{"kinetic", "J", "kinetic energy"},
    Known{"potential", "J", "potential energy"},
    Known{"elastic", "J", "elastic energy"},
    Known{"mass", "kg", "mass of the body"},
    Known{"momentum", "kg m/s", "momentum of the body"},
    Known{"spin", "kg m^2/s", "angular momentum about the origin"},
    Known{"friction", "N, N s", "tangential force on the first side; at an impact its impulse"},
    Known{"direction", "1", "of the slip velocity"}};

template <class Table>
const Known* find(const Table& table, string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Known& known) { return known.name == name; });
  return found == table.end() ? nullptr : &*found;
}

Quantity quantity(const Known* known, string_view path, string_view behind = "") {
  if (!known) return {"", "", std::string(path)};
  return {std::string(known->unit), std::string(known->meaning) + std::string(behind), std::string(path)};
}

// " along x" of "friction_x", whose stem is "friction".
std::pair<string_view, std::string> without_axis(string_view name) {
  if (name.size() > 2 && name[name.size() - 2] == '_' && string_view("xyz").find(name.back()) != name.npos)
    return {name.substr(0, name.size() - 2), fmt::format(" along {}", name.back())};
  return {name, ""};
}

Quantity of_body(string_view body, string_view rest, const model::Model& model) {
  const std::string path = fmt::format("bodies.{}", body);
  const auto named = std::find_if(model.bodies.begin(), model.bodies.end(),
                                  [&](const model::BodyEntry& entry) { return entry.name == body; });
  if (named == model.bodies.end()) return {};
  if (rest == "reaction") return {"N", "2-norm of the multipliers of the body's own rows", path};
  if (named->observed) {
    const auto names = named->observed->observables();
    const auto* units = dynamic_cast<const ObservedUnits*>(named->body.get());
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == rest)
        return {units ? std::string(units->unit(int(i))) : "", fmt::format("{} of the body", rest), path};
  }
  const auto dot = rest.rfind('.');
  if (dot == rest.npos) return {"", "", path};
  Quantity found = quantity(find(motions, rest.substr(dot + 1)), path);
  found.meaning += fmt::format(" of the marker {}", rest.substr(0, dot));
  return found;
}

}  // namespace

Quantity observable_quantity(string_view observable, const model::Model& model) {
  const auto dot = observable.find('.');
  if (dot == observable.npos) return {};
  const string_view first = observable.substr(0, dot), last = observable.substr(observable.rfind('.') + 1);
  if (first == "energy") return fixed_quantity(fmt::format("energy_{}", last));
  if (first != "contacts" && first != "joints") return of_body(first, observable.substr(dot + 1), model);
  const auto [stem, along] = without_axis(last);
  return quantity(find(contacts, stem), observable.substr(0, observable.rfind('.')), along);
}

Quantity fixed_quantity(string_view column) {
  return quantity(find(fixed, column), "");
}

Quantity event_quantity(string_view column) {
  std::string when;
  for (const string_view side : {"_before", "_after"})
    if (column.ends_with(side)) {
      column.remove_suffix(side.size());
      when = fmt::format(" {} the refinement", side.substr(1));
    }
  const auto [stem, along] = without_axis(column);
  return quantity(find(events, stem), "", along + when);
}

}  // namespace trammel::simulate
