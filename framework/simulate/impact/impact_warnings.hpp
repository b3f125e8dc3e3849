// Warnings about the impacts of a run: those that created energy, and those that were ended before their law had ended
// them.
//
// Contacts take sum_i -L_i (u_i- + u_i+)/2 - T_i (s_i- + s_i+)/2 out of the kinetic energy, whatever moving rows and
// bases supply. If this is negative beyond round-off, the impact created energy. The sum runs over contacts that act on
// each other (TouchingContact::island), so that a loss elsewhere at the same instant hides no gain. Terms of single
// contacts, or of friction, prove nothing: with e = 0 friction may stop a slip s- and then hold against a force in the
// other direction, T . s- > 0, as Coulomb's law allows. The gain is given in per cent of the kinetic energy before the
// impact.
#pragma once

#include <string>
#include <vector>

#include <trammel/archive.hpp>

#include "model/model.hpp"
#include "simulate/impact/impact.hpp"

namespace trammel::simulate {

class ImpactWarnings {
 public:
  // After an impact at t; `kinetic` [J] is the energy before it. Rates below `at_rest` give no work.
  void check(double t, double kinetic, double at_rest, const std::vector<TouchingContact>& touching, bool cut_short);
  std::vector<std::string> lines(const model::Model& model) const;
  void archive(Archive& a, std::size_t contacts);

 private:
  long long gains_ = 0, cut_short_ = 0;
  double total_ = 0;                             // [J] gained in all
  double largest_ = 0, kinetic_ = 0, time_ = 0;  // [J] largest gain, [J] kinetic energy before it, [s]
  std::vector<int> contacts_;                    // that had impulses in the largest
  double first_cut_ = 0;                         // [s]
};

}  // namespace trammel::simulate
