// Out-of-line destructors of the public interfaces. They place each interface's vtable and type_info once, in
// libtrammel, so that dynamic_cast and exceptions work between program and plugins, even if a plugin hides its symbols.
#include <algorithm>
#include <stdexcept>

#include <trammel/archive.hpp>
#include <trammel/awaits_contact.hpp>
#include <trammel/body.hpp>
#include <trammel/component.hpp>
#include <trammel/contact.hpp>
#include <trammel/correction.hpp>
#include <trammel/counts_turns.hpp>
#include <trammel/faces.hpp>
#include <trammel/fidelity.hpp>
#include <trammel/fields.hpp>
#include <trammel/force.hpp>
#include <trammel/integrator.hpp>
#include <trammel/linear_rows.hpp>
#include <trammel/linear_theory.hpp>
#include <trammel/methods/oscillating_steps.hpp>
#include <trammel/natural_boundary.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/observed_units.hpp>
#include <trammel/outside_domain.hpp>
#include <trammel/own_tolerances.hpp>
#include <trammel/parameters.hpp>
#include <trammel/rigid_motions.hpp>
#include <trammel/system.hpp>
#include <trammel/theory_limit.hpp>

namespace trammel {

System::~System() = default;
Component::~Component() = default;
Archive::~Archive() = default;

ParameterError::ParameterError(std::string parameter, const std::string& message)
    : std::runtime_error(message), parameter_(std::move(parameter)) {}
ParameterError::~ParameterError() = default;
OutsideDomain::~OutsideDomain() = default;

HasRigidMotions::~HasRigidMotions() = default;

// Abilities of integrators.
ErrorEstimate::~ErrorEstimate() = default;
DenseOutput::~DenseOutput() = default;
OscillatingSteps::~OscillatingSteps() = default;
LinearTheory::~LinearTheory() = default;
Resizable::~Resizable() = default;
OwnTolerances::~OwnTolerances() = default;
Transfer::~Transfer() = default;

// Of corrections.
NeedsMomentum::~NeedsMomentum() = default;

// Of forces.
WrenchTangent::~WrenchTangent() = default;

// Abilities of bodies.
SharedMotion::~SharedMotion() = default;
MassAndForce::~MassAndForce() = default;
ExactTangent::~ExactTangent() = default;
ReactionDerivative::~ReactionDerivative() = default;
Constrained::~Constrained() = default;
Observed::~Observed() = default;
Drawn::~Drawn() = default;
Refinable::~Refinable() = default;
HasMomentum::~HasMomentum() = default;
HasFields::~HasFields() = default;
HasFaces::~HasFaces() = default;
ObservedUnits::~ObservedUnits() = default;
HasFidelity::~HasFidelity() = default;
TheoryLimit::~TheoryLimit() = default;
NaturalBoundary::~NaturalBoundary() = default;
AwaitsContact::~AwaitsContact() = default;
LinearMarkers::~LinearMarkers() = default;
CarriedStress::~CarriedStress() = default;
SampledSurface::~SampledSurface() = default;
SlidingSurface::~SlidingSurface() = default;
ForceBySurfacePoints::~ForceBySurfacePoints() = default;
Surface::~Surface() = default;

// Abilities of joints and forces.
LinearRows::~LinearRows() = default;
NeedsOrientation::~NeedsOrientation() = default;
CountsTurns::~CountsTurns() = default;

void Archive::operator()(std::string_view name, std::vector<Vec>& values) {
  const std::string stem(name);
  int count = static_cast<int>(values.size());
  (*this)(stem + ".count", count);
  if (count < 0) throw std::length_error(stem + ".count");
  values.resize(std::min(values.size(), static_cast<std::size_t>(count)));
  // Grow one by one: a damaged archive may state a count that is too large.
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (i == values.size()) values.emplace_back();
    (*this)(stem + "." + std::to_string(i), values[i]);
  }
}

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::integrator:
      return "integrator";
    case Kind::body:
      return "body";
    case Kind::joint:
      return "joint";
    case Kind::force:
      return "force";
    case Kind::contact:
      return "contact";
    case Kind::friction:
      return "friction";
    case Kind::correction:
      return "correction";
    case Kind::part:
      return "part";
  }
  return "component";
}

}  // namespace trammel
