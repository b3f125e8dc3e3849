// A spatial chain of n links in Simbody, tree coordinates: hinges about y and z in turn, hinge 1 given 1 rad/s.
//
//   simbody_chain N ACCURACY

#include <cstdlib>

#include "simbody_run.hpp"

namespace {

using namespace SimTK;

constexpr double length = 0.1, width = 0.01, mass = 0.1;  // [m], [m], [kg] of a link

/// A pin turns about z of its frame; this frame has it along the body's y.
Rotation along_y() {
  return Rotation(-Pi / 2, XAxis);
}

Body link() {
  const Inertia inertia = mass * UnitInertia::brick(Vec3(length, width, width) / 2);
  return Body::Rigid(MassProperties(mass, Vec3(0), inertia));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  const int n = std::atoi(arguments[1]);

  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  Force::Gravity gravity(forces, matter, Vec3(0, 0, -9.81));
  MobilizedBody last = matter.updGround();
  for (int i = 0; i < n; ++i) {
    const Rotation axis = i % 2 == 0 ? along_y() : Rotation();
    const Vec3 end = i == 0 ? Vec3(0) : Vec3(length / 2, 0, 0);
    last = MobilizedBody::Pin(last, Transform(axis, end), link(), Transform(axis, Vec3(-length / 2, 0, 0)));
  }

  State start = system.realizeTopology();
  matter.getMobilizedBody(MobilizedBodyIndex(2)).setOneU(start, 0, 1);
  peers::print(peers::run(system, start, std::atof(arguments[2]), 1, 0.25, [&](const State& now) {
    const Vec3 tip = last.findStationLocationInGround(now, Vec3(length / 2, 0, 0));
    return std::vector<double>{tip[0], tip[1], tip[2]};
  }));
}
