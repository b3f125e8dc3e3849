#include "diagnose/mass_ratio.hpp"

#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace trammel::simulate {
namespace {

// Groups of connected bodies: each body refers to another one of its group, or is its first.
class Groups {
 public:
  explicit Groups(std::size_t bodies) : first_(bodies) { std::iota(first_.begin(), first_.end(), 0); }
  int of(int body) {
    while (first_[std::size_t(body)] != body)
      body = first_[std::size_t(body)] = first_[std::size_t(first_[std::size_t(body)])];
    return body;
  }
  void join(int a, int b) { first_[std::size_t(of(a))] = of(b); }

 private:
  std::vector<int> first_;
};

}  // namespace

MassRatio mass_ratio(const model::Model& model, const State& state) {
  Groups groups(model.bodies.size());
  for (const model::JointEntry& joint : model.joints) {
    int before = -1;
    for (const model::MarkerRef& marker : joint.markers) {
      if (marker.body < 0) continue;  // the ground connects nothing
      if (before >= 0) groups.join(before, marker.body);
      before = marker.body;
    }
  }
  std::vector<MassRatio> by_group(model.bodies.size());
  MassRatio largest;
  for (int b = 0; b < int(model.bodies.size()); ++b) {
    const model::BodyEntry& body = model.bodies[std::size_t(b)];
    if (!body.momentum || body.nv == 0) continue;
    const double mass =
        body.momentum->momentum(state.t, state.q.segment(body.q0, body.nq), state.v.segment(body.v0, body.nv)).mass;
    if (!(mass > 0)) continue;
    MassRatio& group = by_group[std::size_t(groups.of(b))];
    if (group.light < 0 || mass < group.light_mass) group.light = b, group.light_mass = mass;
    if (group.heavy < 0 || mass > group.heavy_mass) group.heavy = b, group.heavy_mass = mass;
    if (largest.light < 0 || group.heavy_mass * largest.light_mass > largest.heavy_mass * group.light_mass)
      largest = group;
  }
  return largest;
}

std::string description(const MassRatio& ratio, const model::Model& model) {
  return fmt::format("bodies.{} of {:.3g} kg is tied to bodies.{} of {:.3g} kg, a mass ratio of {:.3g}",
                     model.bodies[std::size_t(ratio.light)].name, ratio.light_mass,
                     model.bodies[std::size_t(ratio.heavy)].name, ratio.heavy_mass,
                     ratio.heavy_mass / ratio.light_mass);
}

}  // namespace trammel::simulate
