// A scene with its first contacts closed, at another state than its start: forces there, and the tangent against their
// change.
#pragma once

#include <cmath>
#include <string>

#include "system/assembled_system.hpp"
#include "support/run_scene.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::test {

class Posed {
 public:
  explicit Posed(const std::string& text, const Overrides& overrides = {})
      : setup(simulate::set_up(scene::Scene::parse(text, "test.json", overrides), registry())), system(setup.model) {
    close(true);
    q = setup.initial.q, v = setup.initial.v;
  }
  void close(bool closed) {
    model::Modes modes;
    modes.contacts.resize(setup.model->contacts.size());
    for (auto& mode : modes.contacts) mode.closed = closed;
    system.set_modes(modes);
  }
  // Numbers without a pattern, on what is a plain vector.
  void shake(double displacement, double speed) {
    for (Eigen::Index i = 0; i < q.size(); ++i) q(i) += displacement * std::sin(3.0 * double(i));
    for (Eigen::Index i = 0; i < v.size(); ++i) v(i) += speed * std::cos(5.0 * double(i));
  }
  Vec force(const Vec& at_q, const Vec& at_v) {
    system.move_to(0, at_q, at_v);
    return system.f();
  }
  // Of the contacts alone.
  Vec contact_force() {
    const Vec all = force(q, v);
    close(false);
    const Vec others = force(q, v);
    close(true);
    return all - others;
  }
  // |S x - difference of -f along x| / |S x| for a direction x, S by positions or velocities.
  double tangent_error(const Vec& x, bool by_velocity, double step) {
    Mat S = Mat::Zero(v.size(), v.size());
    system.move_to(0, q, v);
    system.add_tangent(by_velocity ? Blend{0, 1, 0} : Blend{0, 0, 1}, Vec::Zero(v.size()), Vec::Zero(0), S);
    const auto along = [&](double s) -> Vec {
      if (by_velocity) return force(q, v + s * x);
      Vec moved;
      system.retract(q, s * x, moved);
      return force(moved, v);
    };
    // Fourth order: the law's slope jumps where a point is just reached, which a small step meets seldom.
    const Vec change = -(8 * (along(step) - along(-step)) - (along(2 * step) - along(-2 * step))) / (12 * step);
    return (S * x - change).norm() / change.norm();
  }

  simulate::Setup setup;
  model::AssembledSystem system;
  Vec q, v;
};

}  // namespace trammel::test
