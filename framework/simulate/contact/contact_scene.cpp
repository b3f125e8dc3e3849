#include "simulate/contact/contact_scene.hpp"

#include "simulate/contact/law_speeds.hpp"

namespace trammel::simulate {

double ContactScene::capture_speed(int contact) const {
  return simulate::capture_speed(this->contact(contact), scale.of(contact));
}

double ContactScene::stick_speed(int contact) const {
  return simulate::stick_speed(this->contact(contact), scale.of(contact));
}

double ContactScene::least_slip(int contact) const {
  return system.model().world.space == Space::spatial ? scale.of(contact).least_speed() : 0;
}

}  // namespace trammel::simulate
