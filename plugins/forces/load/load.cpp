// A force and a moment on one marker, as laws of time; "on" in the scene names the marker.
//
//     wrench = (F(t), M(t)) in world axes, or turned with the marker ("frame": "body")
//     supplied power  F . V + M omega        there is no potential: even a constant load counts as supplied
//
// The marker is B; what A, the ground, receives has no effect and is left at zero.
#include <trammel/force.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Load : Force {
  enum class Frame { world, body };
  Frame frame = Frame::world;
  TimeFunction force_x, force_y;
  std::optional<TimeFunction> force_z;  // spatial scenes only
  std::optional<TimeFunction> moment;   // planar scenes only

  void prepare(const World& world) override {
    if (world.space == Space::planar && force_z)
      throw ParameterError("force.z", "this scene is planar: a load has force.x, force.y and moment");
    if (world.space == Space::spatial && moment)
      throw ParameterError("moment", "this scene is spatial: a load has force.x, force.y and force.z, no moment");
  }

  void wrench(double t, const Motion&, const Motion& B, Wrench&, Wrench& on_B) const override { on_B += at(t, B); }
  double potential(double, const Motion&, const Motion&) const override { return 0; }
  Power power(double t, const Motion&, const Motion& B) const override { return {.supplied = at(t, B).dot(B.V)}; }

 private:
  Wrench at(double t, const Motion& B) const {
    const auto dim = B.x.size();
    Vec3 F(dim);
    F(0) = force_x(t);
    F(1) = force_y(t);
    if (dim == 3) F(2) = force_z ? (*force_z)(t) : 0;
    Wrench w = Wrench::Zero(B.V.size());
    w.head(dim) = frame == Frame::body ? Vec3(B.R * F) : F;
    if (moment) w(2) = (*moment)(t);
    return w;
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::force<Load>("load", "force and moment on a marker as laws of time")
                   .source("an applied wrench")
                   .parameter("force.x", &Load::force_x, {.unit = "N", .doc = "a number or a law of t"})
                   .parameter("force.y", &Load::force_y, {.unit = "N", .doc = "a number or a law of t"})
                   .parameter("force.z", &Load::force_z,
                              {.unit = "N", .doc = "in spatial scenes; a number or a law of t"})
                   .parameter("moment", &Load::moment,
                              {.unit = "N m", .doc = "in planar scenes, counter-clockwise; a number or a law of t"})
                   .choice("frame", &Load::frame, {{"world", Load::Frame::world}, {"body", Load::Frame::body}},
                           {.doc = "axes of the force: the world's, or the marker's"}))
