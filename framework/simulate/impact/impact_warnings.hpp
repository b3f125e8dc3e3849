// What a run has to say about its impacts: those that created energy, and those that were ended before their law had
// ended them.
//
// Contacts take sum_i -L_i (u_i- + u_i+)/2 - T_i (s_i- + s_i+)/2 out of the kinetic energy, whatever moving rows and
// bases supply; where that is negative beyond round-off, the impact created energy. The sum is over contacts that act
// on each other (TouchingContact::island): what others lose at that instant hides no gain. Shares of single contacts,
// or of friction, prove nothing: with e = 0 friction may stop a slip s- and then hold what the impact presses the other
// way, T . s- > 0, and that is the course of Coulomb's law. The gain in per cent is that of the kinetic energy before.
#pragma once

#include <string>
#include <vector>

#include <trammel/archive.hpp>

#include "model/model.hpp"
#include "simulate/impact/impact.hpp"

namespace trammel::simulate {

class ImpactWarnings {
 public:
  // After an impact at t; `kinetic` [J] before it. Slower than `at_rest` is no motion that could give work.
  void check(double t, double kinetic, double at_rest, const std::vector<TouchingContact>& touching, bool cut_short);
  std::vector<std::string> lines(const model::Model& model) const;
  void archive(Archive& a, std::size_t contacts);

 private:
  long long gains_ = 0, cut_short_ = 0;
  double total_ = 0;                             // [J]
  double largest_ = 0, kinetic_ = 0, time_ = 0;  // [J], [J] before it, [s]
  std::vector<int> contacts_;                    // that pushed in the largest
  double first_cut_ = 0;                         // [s]
};

}  // namespace trammel::simulate
