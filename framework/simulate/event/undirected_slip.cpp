#include "simulate/event/undirected_slip.hpp"

#include <algorithm>

namespace trammel::simulate {
namespace {

double least_slip(const model::AssembledSystem& system, int contact) {
  return system.modes().contacts[std::size_t(contact)].least_slip;
}

bool lacks_direction(model::AssembledSystem& system, int contact) {
  return system.tangents(contact) > 1 && system.slip(contact).norm() < least_slip(system, contact);
}

}  // namespace

void UndirectedSlip::lasts(double h, double acceleration) {
  lasted += h;
  pushed = std::max(pushed, acceleration);
}

bool UndirectedSlip::would_stall(double h, double acceleration, double least_slip) const {
  return (lasted + h) * std::max(pushed, acceleration) > patience * least_slip;
}

void UndirectedSlip::measure(model::AssembledSystem& system, int contact, double h, const State& next) {
  if (lacks_direction(system, contact))
    lasts(h, system.slip_acceleration(contact, next.a).norm());
  else
    ends();
}

bool UndirectedSlip::stalls(model::AssembledSystem& system, int contact, double h, const State& next) const {
  return lacks_direction(system, contact) &&
         would_stall(h, system.slip_acceleration(contact, next.a).norm(), least_slip(system, contact));
}

}  // namespace trammel::simulate
