// A force and a moment on one marker, as laws of time; "on" in the scene names the marker.
//
//     wrench = (F(t), M(t)) in world axes, or in the marker's axes ("frame": "body")
//     supplied power  F . V + M omega        no potential: even the work of a constant load counts as supplied
//
// The marker is B. A is the ground; the wrench on it has no effect and remains zero.
#include <Eigen/Geometry>

#include <trammel/force.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Load : Force, WrenchTangent, NeedsOrientation {
  enum class Frame { world, body };
  Frame frame = Frame::world;
  TimeFunction force_x, force_y;
  std::optional<TimeFunction> force_z, torque_x, torque_y, torque_z;  // spatial scenes only
  std::optional<TimeFunction> moment;                                 // planar scenes only

  void prepare(const World& world) override {
    const bool spatial = world.space == Space::spatial;
    for (const auto& [name, given] : {std::pair{"force.z", &force_z}, std::pair{"torque.x", &torque_x},
                                      std::pair{"torque.y", &torque_y}, std::pair{"torque.z", &torque_z}})
      if (!spatial && *given)
        throw ParameterError(name, "this scene is planar: a load has force.x, force.y and moment");
    if (spatial && moment)
      throw ParameterError("moment", "this scene is spatial: a moment is given as torque.x, torque.y and torque.z");
  }

  bool needs_orientation(int marker) const override {
    return marker == 1 && (frame == Frame::body || moment || torque_x || torque_y || torque_z);
  }

  void wrench(double t, const Motion&, const Motion& B, Wrench&, Wrench& on_B) const override { on_B += at(t, B); }
  double potential(double, const Motion&, const Motion&) const override { return 0; }
  Power power(double t, const Motion&, const Motion& B) const override { return {.supplied = at(t, B).dot(B.V)}; }

  // A load that is fixed in the marker's axes turns with them.
  void add_wrench_tangent(double t, const Motion&, const Motion& B, PairTangent& K, PairTangent&) const override {
    if (frame == Frame::world) return;
    const Wrench w = at(t, B);
    if (w.size() == 3) {
      K.BB(0, 2) -= w(1), K.BB(1, 2) += w(0);
      return;
    }
    for (const int part : {0, 3})
      for (int i = 0; i < 3; ++i)
        K.BB.block<3, 1>(part, 3 + i) += Eigen::Vector3d::Unit(i).cross(Eigen::Vector3d(w.segment<3>(part)));
  }

 private:
  Wrench at(double t, const Motion& B) const {
    const auto at_t = [t](const std::optional<TimeFunction>& law) { return law ? (*law)(t) : 0.0; };
    if (B.x.size() == 2) {
      Wrench w(3);
      w << force_x(t), force_y(t), at_t(moment);
      if (frame == Frame::body) w.head<2>() = B.R * w.head<2>().eval();
      return w;
    }
    Wrench w(6);
    w << force_x(t), force_y(t), at_t(force_z), at_t(torque_x), at_t(torque_y), at_t(torque_z);
    if (frame == Frame::body) {
      w.head<3>() = B.R * w.head<3>().eval();
      w.tail<3>() = B.R * w.tail<3>().eval();
    }
    return w;
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::force<Load>("load", "force and moment on a marker as laws of time")
        .source("an applied wrench")
        .parameter("force.x", &Load::force_x, {.unit = "N", .doc = "a number or a law of t"})
        .parameter("force.y", &Load::force_y, {.unit = "N", .doc = "a number or a law of t"})
        .parameter("force.z", &Load::force_z, {.unit = "N", .doc = "in spatial scenes; a number or a law of t"})
        .parameter("moment", &Load::moment,
                   {.unit = "N m", .doc = "in planar scenes, counter-clockwise; a number or a law of t"})
        .parameter("torque.x", &Load::torque_x, {.unit = "N m", .doc = "in spatial scenes; a number or a law of t"})
        .parameter("torque.y", &Load::torque_y, {.unit = "N m", .doc = "in spatial scenes; a number or a law of t"})
        .parameter("torque.z", &Load::torque_z, {.unit = "N m", .doc = "in spatial scenes; a number or a law of t"})
        .choice("frame", &Load::frame, {{"world", Load::Frame::world}, {"body", Load::Frame::body}},
                {.doc = "axes of force and torque: the world's, or the marker's"}))
