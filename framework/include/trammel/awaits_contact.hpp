// Ability of a body one of whose parameters names a contact of the scene: the name is checked once all contacts are known.
#pragma once

#include <string>

namespace trammel {

class AwaitsContact {
 public:
  virtual ~AwaitsContact();
  virtual std::string awaited_contact() const = 0;  // "": none
  virtual std::string where_awaited() const = 0;    // the parameter, "refine.on_contact"
};

}  // namespace trammel
