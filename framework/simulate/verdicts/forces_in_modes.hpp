// The forces and accelerations that contacts have in the modes decided, and whether these are those of the solution
// that the modes are to show.
#pragma once

#include <vector>

#include "simulate/contact/contact_scene.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

class ForcesInModes {
 public:
  // In the modes `at.modes` of a problem that is solved.
  ForcesInModes(const ContactScene& scene, const ContactsAtEvent& at, const ContactProblem& problem)
      : system_(scene.system), at_(at), problem_(problem) {}

  void find(const State& state);
  // The same; false if these modes have no finite forces, as where a joint locks itself: they are only tried.
  [[nodiscard]] bool exist(const State& state);
  // As found last.
  const Vec& a() const { return a_; }
  const Vec& lambda() const { return lambda_; }

  // By island of the problem.
  std::vector<bool> can_be_exerted(const State& state);  // finds the forces: they push and stay in their cones
  std::vector<bool> moves_as_found() const;              // its contacts accelerate in these modes as in the solution
  std::vector<bool> presses_as_found() const;            // the sliding contacts that press in the solution press

 private:
  model::AssembledSystem& system_;
  const ContactsAtEvent& at_;
  const ContactProblem& problem_;
  Vec a_, lambda_;
};

}  // namespace trammel::simulate
