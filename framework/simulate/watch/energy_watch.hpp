// Judges in each recorded state how much energy the method itself has made or taken.
//
//     drift          = E - E_expected                       E_expected: what the causes in the ledger explain
//     moved          = E_kin,0 + |E_el,0| + |E_pot - E_pot,0| + |supplied| + |refinements| + dissipated, the largest
//                      so far
//     relative drift = |drift| / (moved + little)
//
// `moved` is the largest energy that known causes can have set in motion. What a base brings in and takes out again
// counts while it is there; what the method creates never counts. `little` counts as no energy in this scene.
#pragma once

#include <string>

#include <trammel/archive.hpp>

#include "run/contact_scale.hpp"
#include "simulate/results/ledger.hpp"

namespace trammel::simulate {

class EnergyWatch {
 public:
  static constexpr double unexplained = 0.05;  // a larger relative drift makes a run doubtful

  EnergyWatch(model::AssembledSystem& system, const ContactScale& scale, const Ledger& ledger, double shortest_step)
      : system_(system), scale_(scale), ledger_(ledger), shortest_step_(shortest_step) {}
  void start(const Energy& initial);

  enum class Verdict { explained, unexplained, diverged, not_finite };
  struct Judgement {
    Verdict verdict;
    std::string sentence;  // of a run that diverged, or ends with a drift; else empty
  };
  // `energy`: at the system's point.
  Judgement look(const Energy& energy, bool at_end);
  void take_moved(const Energy& energy, const Ledger::Totals& totals);  // likewise

  double drift(const Energy& energy) const { return energy.total() - ledger_.energy(); }  // [J]
  double relative_drift(const Energy& energy);                                            // at the system's point
  double none() const { return none_; }  // [J] counts as no energy in this scene, in the state looked at last

  void archive(Archive& a);

 private:
  double little(double work);
  double work_over_length();

  model::AssembledSystem& system_;
  const ContactScale& scale_;
  const Ledger& ledger_;
  double shortest_step_;  // [s] that time resolves
  Energy start_;
  double moved_ = 0;                        // [J]
  double none_ = 0;                         // [J]
  double most_work_ = 0;                    // [J] without gravity: the largest work_over_length so far
  double drift_before_ = least_divergence;  // relative, in the record before; at least this
  static constexpr double least_divergence = 1e3;
};

}  // namespace trammel::simulate
