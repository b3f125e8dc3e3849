// Impacts of all contacts that touch (rule 1 of contact_mode.hpp), again with e = 0 for rebounds that steps cannot
// follow (rule 2), and what they cost.
#pragma once

#include <vector>

#include "simulate/impact/impact_laws.hpp"
#include "simulate/impact/impact_warnings.hpp"
#include "simulate/settling/chatter.hpp"

namespace trammel::simulate {

struct ImpactLoss {
  int contact;
  double energy;  // [J]
};

class ContactImpacts {
 public:
  ContactImpacts(const ContactScene& scene, ContactsAtEvent& at) : scene_(scene), at_(at), chatter_(scene, at) {}

  void forget_losses() { losses_.clear(), lost_elsewhere_ = 0; }
  void find_touching(const ContactChanges& changes);  // at.touching, with the rates at the system's point
  void find_bearings();                               // at.bearings
  // v jumps; sets the impulses and rates after it. Without a solution v stays.
  [[nodiscard]] complementarity::ContactSolution strike(State& state, const ContactChanges& changes);

  // Energy lost since forget_losses [J]: through contacts, also closed ones; and elsewhere, through moving rows.
  const std::vector<ImpactLoss>& losses() const { return losses_; }
  double lost_elsewhere() const { return lost_elsewhere_; }
  ImpactWarnings& warnings() { return warnings_; }
  const ImpactWarnings& warnings() const { return warnings_; }

 private:
  [[nodiscard]] complementarity::ContactSolution strike_with_captures(State& state, const ContactChanges& changes,
                                                                      BriefMotions& brief);
  bool capture_chatter(const std::vector<bool>& falls);
  std::vector<TouchingContact> touching_and_bearings() const;
  [[nodiscard]] complementarity::ContactSolution solve_impacts(const State& state, std::vector<TouchingContact>& all);
  double rest_speed(const std::vector<TouchingContact>& contacts) const;  // [m/s] the largest of their thresholds

  const ContactScene& scene_;
  ContactsAtEvent& at_;
  Chatter chatter_;
  ImpactLaws laws_;
  ImpactWarnings warnings_;
  std::vector<ImpactLoss> losses_;
  double lost_elsewhere_ = 0;
  bool cut_short_ = false;  // some of the last impacts had not ended (ImpactLaws::cut_short)
  Vec dv_, v_before_;       // [m/s] of the last impact
};

}  // namespace trammel::simulate
