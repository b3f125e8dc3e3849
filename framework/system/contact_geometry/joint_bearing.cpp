// The free motion of a joint with friction, which is its one tangent. Row 0 stays 0; the normal force follows from the
// joint's own rows (system/point/joint_friction.cpp).
#include "system/contact_geometry/contact_geometry.hpp"

namespace trammel::model {

namespace {

class SlipInJoint final : public ContactGeometry {
 public:
  SlipInJoint(const Model& model, const ContactEntry& entry, MarkerMotions& markers)
      : bearing_(*entry.joint->bearing),
        joint_(model.joints[std::size_t(entry.joint->joint)]),
        space_(model.world.space),
        markers_(markers),
        A_(markers.slot(entry.A)),
        B_(markers.slot(entry.B)) {}

  std::vector<int> slots() const override { return {A_, B_}; }
  CallSite call() const override { return {&joint_.origin, "slip_row"}; }

  void rows(const Point& at, Rows& rows) override {
    const Motion& A = markers_.motion(A_, at.t, at.q, at.v);
    slip_.resize(1, space_);
    bearing_.slip_row(at.t, A, markers_.motion(B_, at.t, at.q, at.v), slip_);
    rows.g(1) = slip_.g(0), rows.g_t(1) = slip_.g_t(0), rows.gamma(1) = slip_.gamma(0);
    for (int k = 0; k < 2; ++k) rows.H(k).row(1) = slip_.H(k).row(0);
  }

  // Nothing is added here: the force along the slip depends on the loads of the joint's own rows
  // (JointFriction::add_tangent).
  void add_reaction_tangent(const Point&, const Rows&, const Eigen::Vector3d&, double, Matrix&) override {}

  int tangents() const override { return 1; }
  Eigen::Vector2d coordinates_from(const Eigen::Vector2d& anchor, const Rows& rows) const override {
    return {bearing_.slid(anchor[0], rows.g(1)), 0};
  }

 private:
  const BearingJoint& bearing_;
  const JointEntry& joint_;
  Space space_;
  MarkerMotions& markers_;
  int A_, B_;
  Rows slip_;
};

}  // namespace

std::unique_ptr<ContactGeometry> joint_bearing(const Model& model, const ContactEntry& entry, MarkerMotions& markers) {
  return std::make_unique<SlipInJoint>(model, entry, markers);
}

}  // namespace trammel::model
