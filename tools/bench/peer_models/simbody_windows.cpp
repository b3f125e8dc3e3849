// IFToMM A02 in Simbody: N four-bar windows. The tree is every upright link on its pin to the ground and every top link
// on its left pin; the right pins close the loops: two rows each in the plane, a point on a line along z.
//
//   simbody_windows N ACCURACY

#include <cstdlib>

#include "simbody_run.hpp"

namespace {

using namespace SimTK;

const Vec3 a(-0.5, 0, 0), b(0.5, 0, 0);  // [m] the ends of a link

/// Slender, 1 m, 1 kg, along x.
Body link() {
  return Body::Rigid(MassProperties(1, Vec3(0), Inertia(0, 1. / 12, 1. / 12)));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  const int windows = std::atoi(arguments[1]);

  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  Force::Gravity gravity(forces, matter, Vec3(0, -9.81, 0));
  std::vector<MobilizedBody> up, top;
  for (int i = 0; i <= windows; ++i) {
    up.push_back(MobilizedBody::Pin(matter.updGround(), Transform(Vec3(i, 0, 0)), link(), Transform(a)));
  }
  for (int i = 0; i < windows; ++i) {
    top.push_back(MobilizedBody::Pin(up[i], Transform(b), link(), Transform(a)));
    Constraint::PointOnLine(up[i + 1], ZAxis, b, top[i], b);
  }

  State start = system.realizeTopology();
  for (const MobilizedBody& link : up) {
    link.setOneQ(start, 0, Pi / 2);
    link.setOneU(start, 0, -1);
  }
  for (const MobilizedBody& link : top) {
    link.setOneQ(start, 0, -Pi / 2);
    link.setOneU(start, 0, 1);
  }
  peers::print(peers::run(system, start, std::atof(arguments[2]), 10, 0.1, [&](const State& now) {
    const Vec3 B0 = up[0].findStationLocationInGround(now, b);
    return std::vector<double>{B0[0], B0[1]};
  }));
}
