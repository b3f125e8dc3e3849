// The base of all components: parameters from the scene, and a call that checks them before the run.
#pragma once

#include <stdexcept>
#include <string>

#include <trammel/types.hpp>

namespace trammel {

// Thrown by `prepare` to refuse a parameter; the framework adds file, line and JSON path of that parameter.
//     throw ParameterError("mount", "give exactly one of hinge, clamped, free");
class ParameterError : public std::runtime_error {
 public:
  ParameterError(std::string parameter, const std::string& message);
  ~ParameterError() override;
  const std::string& parameter() const { return parameter_; }

 private:
  std::string parameter_;  // dotted name as declared, e.g. "modes.axial"
};

class Component {
 public:
  virtual ~Component();
  // Called once, after the declared parameters were set and checked, before any other method.
  virtual void prepare(const World&) {}

 protected:
  Component() = default;
  Component(const Component&) = default;
  Component& operator=(const Component&) = default;
};

}  // namespace trammel
