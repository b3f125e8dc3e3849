// A motor between two markers with a linear torque-speed characteristic.
//
//     M = stall (command(t) - phi' / free)       phi' [rad/s]: rate of B against A about the axis, see axis_angle.hpp
//
// stall [N m] is the moment at rest and free [rad/s] the speed without load, both at command 1; -1 is full reverse. The
// moment is +M h on B and -M h on A, with h the gradient of phi. The whole power M phi', of either sign, counts as
// supplied. Source: armature equation of a direct-current motor without inductance.
#include <trammel/axis_angle.hpp>
#include <trammel/force.hpp>
#include <trammel/joint_rows.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Drive : Force, NeedsOrientation {
  double stall = 0, free_speed = 0;
  TimeFunction command{1};
  std::optional<Vec3> axis;

  void prepare(const World& world) override { phi_ = AxisAngle(spatial_axis(world, axis, "axis")); }

  bool needs_orientation(int) const override { return true; }

  void wrench(double t, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const Vec3 on_shaft = moment(t, A, B) * phi_.gradient(A, B);
    on_A.tail(on_shaft.size()) -= on_shaft;
    on_B.tail(on_shaft.size()) += on_shaft;
  }

  double potential(double, const Motion&, const Motion&) const override { return 0; }
  Power power(double t, const Motion& A, const Motion& B) const override {
    return {.supplied = moment(t, A, B) * phi_.rate(A, B)};
  }

 private:
  double moment(double t, const Motion& A, const Motion& B) const {
    return stall * (command(t) - phi_.rate(A, B) / free_speed);
  }

  AxisAngle phi_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::force<Drive>("drive", "motor with a stall moment and a free speed, turning B against A")
                   .source("torque-speed line of a direct-current motor without inductance")
                   .parameter("stall", &Drive::stall,
                              {.unit = "N m", .min = 0, .above_min = true, .required = true, .doc = "moment at rest"})
                   .parameter("free_speed", &Drive::free_speed,
                              {.unit = "rad/s", .min = 0, .above_min = true, .required = true, .doc = "without load"})
                   .parameter("command", &Drive::command,
                              {.usual_min = -1, .usual_max = 1, .doc = "share of the voltage; a number or a law of t"})
                   .parameter("axis", &Drive::axis, {.doc = "spatial: in marker A's axes; [0, 0, 1] if left out"}))
