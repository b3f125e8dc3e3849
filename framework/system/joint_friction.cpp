// Joints with friction at the point: their slip, the loads of their bearings, and W for given multipliers.
//
//     N(lambda) = sum_k |L_k lambda|,  L_k = C_k H_B^T      homogeneous of degree 1, so with n = dN/dlambda at lambda
//     W^T lambda = (G^T - r h^T n) lambda                   r = T/N while sliding, h: the row of the slip
//
// W^T lambda is the reaction at lambda, and W^T its derivative there. Hence solving with W of the last lambda is a
// Newton iteration. If the loads are scalars (a planar guide), n depends only on their signs, and the second iterate is
// exact.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <trammel/joint_friction.hpp>

#include "system/assembly.hpp"
#include "system/locks_itself.hpp"

namespace trammel {

BearingJoint::~BearingJoint() = default;

int Bearings::add(int rows) {
  const auto first = C.rows();
  C.conservativeResize(first + rows, Eigen::NoChange);
  C.bottomRows(rows).setZero();
  sizes[std::size_t(count++)] = rows;
  return int(first);
}

namespace model {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Calls use(first row, rows) for each bearing.
template <class Use>
void for_each_bearing(const Bearings& bearings, Use&& use) {
  int first = 0;
  for (int k = 0; k < bearings.count; ++k) {
    const int rows = bearings.sizes[std::size_t(k)];
    use(first, rows);
    first += rows;
  }
}

double total(const Bearings& bearings, const Vec6& loads) {
  double N = 0;
  for_each_bearing(bearings, [&](int first, int rows) { N += loads.segment(first, rows).norm(); });
  return N;
}

}  // namespace

void AssembledSystem::Work::reserve_bearings() {
  for (int i = 0; i < int(model->contacts.size()); ++i)
    if (model->contacts[std::size_t(i)].joint) {
      bearing_of.resize(model->contacts.size(), -1);
      bearing_of[std::size_t(i)] = int(bearings.size());
      bearings.push_back({.contact = i});
    }
  bear_nothing();
}

const JointEntry& AssembledSystem::Work::joint_of(int contact) const {
  return model->joints[std::size_t(model->contacts[std::size_t(contact)].joint->joint)];
}

AssembledSystem::Work::Bearing& AssembledSystem::Work::bearing(int contact) {
  Bearing& b = bearings[std::size_t(bearing_of[std::size_t(contact)])];
  if (b.point == point) return b;
  const JointEntry& joint = joint_of(contact);
  const Slots& at = contact_slots[std::size_t(contact)];
  const CallSite around = site;
  called(joint.origin, "rows");
  evaluate_constraint(*joint.joint, joint.rows, motions(at), at.count, rows);
  called(joint.origin, "bearings");
  b.at.begin(model->world.space);
  model->contacts[std::size_t(contact)].joint->bearing->bearings(t, motion(at.A), motion(at.B), b.at);
  site = around;
  b.loads = b.at.C * rows.H_B.transpose();
  b.point = point;
  return b;
}

double AssembledSystem::Work::bearing_load(int contact, const Vec& lambda) {
  const JointEntry& joint = joint_of(contact);
  const Bearing& b = bearing(contact);
  return total(b.at, b.loads * lambda.segment(joint.row, joint.rows));
}

bool AssembledSystem::Work::slides_in_bearing(int contact) {
  return modes.contacts[std::size_t(contact)].closed && friction_ratio(contact) != Tangential::Zero();
}

void AssembledSystem::Work::bear_nothing() {
  bool bore = false;
  for (Bearing& b : bearings) {
    bore = bore || (b.load_by_row.size() > 0 && !b.load_by_row.isZero(0));
    b.load_by_row.setZero(joint_of(b.contact).rows);
  }
  if (bore && rows_fresh && coupled) couple_reactions();
}

bool AssembledSystem::Work::bear(const Vec& lambda) {
  if (bearings.empty()) return false;
  // The load of a lightly loaded joint is limited by the round-off of larger loads in other joints.
  const double largest = lambda.size() > 0 ? lambda.lpNorm<Eigen::Infinity>() : 0;
  bool changed = false, far = false;
  for (Bearing& b : bearings) {
    if (!slides_in_bearing(b.contact)) continue;
    bearing(b.contact);
    const JointEntry& joint = joint_of(b.contact);
    const Vec6 of_joint = lambda.segment(joint.row, joint.rows), p = b.loads * of_joint;
    const double round_off = 64 * eps * largest * b.loads.cwiseAbs().sum();
    far = far || std::abs(total(b.at, p) - b.load_by_row.dot(of_joint)) > round_off;
    const Vec6 before = b.load_by_row;
    b.load_by_row.setZero();
    for_each_bearing(b.at, [&](int first, int n) {
      const double load = p.segment(first, n).norm();
      if (load > 0) b.load_by_row += b.loads.middleRows(first, n).transpose() * (p.segment(first, n) / load);
    });
    changed = changed || b.load_by_row != before;
  }
  if (changed) couple_reactions();
  return far;
}

void AssembledSystem::Work::fail_without_loads() {
  std::string names;
  for (const Bearing& b : bearings)
    if (slides_in_bearing(b.contact))
      names += (names.empty() ? "" : ", ") + model->contacts[std::size_t(b.contact)].path();
  throw LocksItself(
      fmt::format("the sliding friction of {} was not found: the bearings' loads and the friction that follows from "
                  "them raise each "
                  "other; with so much friction the joint may lock itself as it slides",
                  names));
}

namespace {

// The force along the slip on both markers: of a sticking row, or sliding friction from the loads by the joint's
// multipliers.
class SlipForce final : public MarkerWrenches {
 public:
  SlipForce(const JointEntry& joint, const BearingJoint& bearing, double t, const Vec6& lambda, double ratio,
            double held)
      : joint_(joint), bearing_(bearing), t_(t), lambda_(lambda), ratio_(ratio), held_(held) {}

  void operator()(Motions markers, std::span<Wrench> on) const override {
    const Motion &A = *markers[0], &B = *markers[1];
    const Space space = A.x.size() == 2 ? Space::planar : Space::spatial;
    Rows slip;
    slip.resize(1, space);
    bearing_.slip_row(t_, A, B, slip);
    const double along = held_ - (ratio_ == 0 ? 0 : ratio_ * load(markers, space));
    on[0] = slip.H_A.transpose() * Vec6::Constant(1, along);
    on[1] = slip.H_B.transpose() * Vec6::Constant(1, along);
  }
  bool depends_on_velocity() const override { return false; }

 private:
  double load(Motions markers, Space space) const {
    Rows rows;
    rows.resize(joint_.rows, space);
    joint_.joint->rows_between(t_, markers, rows);
    Bearings bearings;
    bearings.begin(space);
    bearing_.bearings(t_, *markers[0], *markers[1], bearings);
    return total(bearings, bearings.C * (rows.H_B.transpose() * lambda_));
  }

  const JointEntry& joint_;
  const BearingJoint& bearing_;
  double t_;
  Vec6 lambda_;
  double ratio_, held_;
};

}  // namespace

void AssembledSystem::Work::add_slip_tangent(int contact, Blend c, const Vec& lambda, Matrix& S) {
  const Slots& at = contact_slots[std::size_t(contact)];
  const Rows& r = this->contact(contact);
  const double damping = friction_damping(contact)(0, 0);
  if (c.c_d != 0 && damping != 0) {
    const double weight = c.c_d * damping * bearing_load(contact, lambda);
    for (int k = 0; k < at.count; ++k)
      for (int l = 0; l < at.count; ++l)
        chain.add_pair(at[k], at[l], r.H(k).row(1).transpose() * r.H(l).row(1), weight, S);
  }
  const int row = loads.place({contact, 1}).row;
  const double ratio = friction_ratio(contact)[0], held = row >= 0 ? lambda(row) : 0;
  if (c.c_k == 0 || (ratio == 0 && held == 0)) return;
  const JointEntry& joint = joint_of(contact);
  called(joint.origin, "bearings");
  const SlipForce force(joint, *model->contacts[std::size_t(contact)].joint->bearing, t,
                        lambda.segment(joint.row, joint.rows), ratio, held);
  const std::array<int, 2> both = {at.A, at.B};
  add_wrench_tangent(chain, both, t, q, v, force, c.c_k, 0, S);
}

}  // namespace model
}  // namespace trammel
