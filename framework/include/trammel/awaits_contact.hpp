// Ability of a body with a parameter that names a contact of the scene. The framework checks the name when all contacts
// are built.
#pragma once

#include <string>

namespace trammel {

class AwaitsContact {
 public:
  virtual ~AwaitsContact();
  virtual std::string awaited_contact() const = 0;  // the contact's name; "": none
  virtual std::string where_awaited() const = 0;    // the parameter's name, for example "refine.on_contact"
};

}  // namespace trammel
