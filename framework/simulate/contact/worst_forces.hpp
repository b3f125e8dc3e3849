// The worst of the forces that contacts cannot exert, of each kind, and whether it counts: what is round-off of the
// largest force in its island during the run moves nothing. That force may come later, so each island has its own worst
// ones, which are the largest: where these do not count, no others do.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>

#include <trammel/archive.hpp>

namespace trammel::simulate {

enum class Violation { pull, beyond_cone, along_slip, overloaded, unbalanced };  // contact_audit.hpp

// An archived number of a contact; throws std::out_of_range if there is none.
int contact_number(double archived, std::size_t contacts);

class WorstForces {
 public:
  struct Worst {
    int contact = -1;
    double t = 0, force = 0;  // [s], [N]
  };
  // Islands are those of ContactScale.
  void take_force(std::size_t island, double force);  // that acts on any of its contacts [N]
  void raise(Violation kind, std::size_t island, const Worst& found);
  // Of those that count: of the island in which it is the largest beside its forces.
  std::optional<Worst> worst(Violation kind) const;

  void archive(Archive& a, std::size_t contacts);

 private:
  double beside_largest(std::size_t island, double force) const;

  std::array<std::map<std::size_t, Worst>, 5> of_kind_;  // by island
  std::map<std::size_t, double> largest_;                // [N] by island
};

}  // namespace trammel::simulate
