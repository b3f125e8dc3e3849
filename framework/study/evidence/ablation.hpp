// The value of each optional part of a scene: how the results change and what time is saved if it is left out; and the
// smallest scene that keeps a target.
//
// Optional parts are forces, contacts, joints, friction, corrections, gravity, and rungs of the components' fidelity
// parameters (trammel/fidelity.hpp). Components repeated by "for" are one part. Differences are those of
// study/trade/errors.hpp, with the scene's own run as reference.
#pragma once

#include <string>
#include <vector>

#include "report/page.hpp"
#include "study/cases/batch.hpp"

namespace trammel::study {

struct Part {
  std::string what;  // "without forces.damper", "bodies.beam.modes.axial = 3"
  scene::Override change;
  double difference = 0;     // largest scaled change of the observables
  std::string worst;         // the observable that changes most
  double cpu = 0;            // [s] without it
  std::string failure = "";  // why the scene does not run, or cannot be observed, without it; empty: it runs
};

struct Ablation {
  double cpu = 0;           // [s] of the scene as it is
  std::vector<Part> parts;  // the least important first
  double target = 0;
  std::vector<Part> left_out;  // of the smallest scene that keeps the target
  double difference = 0;       // of that scene, run with all of these left out at once
  double cpu_of_smallest = 0;  // [s]
};

// Throws SceneError, and std::runtime_error if the scene itself does not run to its end.
Ablation ablate(const SceneSource& source, plugin::Registry& registry, double target, int jobs = 0);

report::Page page_of(const Ablation& ablation, const std::string& scene);

}  // namespace trammel::study
