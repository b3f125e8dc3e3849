#include "system/point/joint_friction.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "system/markers/pair_tangent.hpp"
#include "system/point/locks_itself.hpp"

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

// Calls use(first row, number of rows) for each bearing.
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

JointFriction::JointFriction(Point& at, ContactsAtPoint& contacts) : at_(at), contacts_(contacts) {
  for (int i = 0; i < contacts_.count(); ++i)
    if (contacts_.in_joint(i)) {
      bearing_of_.resize(std::size_t(contacts_.count()), -1);
      bearing_of_[std::size_t(i)] = int(bearings_.size());
      bearings_.push_back({.contact = i});
    }
  unload();
}

const JointEntry& JointFriction::joint_of(int contact) const {
  return at_.model->joints[std::size_t(contacts_.entry(contact).joint->joint)];
}

JointFriction::Bearing& JointFriction::bearing(int contact) {
  Bearing& b = bearings_[std::size_t(bearing_of_[std::size_t(contact)])];
  if (b.point == at_.number) return b;
  const JointEntry& joint = joint_of(contact);
  const Slots& slots = contacts_.slots(contact);
  const CallSite around = at_.site;
  at_.called(joint.origin, "rows");
  at_.evaluate(*joint.joint, joint.rows, at_.motions(slots), slots.count, rows_);
  at_.called(joint.origin, "bearings");
  b.at.begin(at_.model->world.space);
  contacts_.entry(contact).joint->bearing->bearings(at_.t, at_.motion(slots.A), at_.motion(slots.B), b.at);
  at_.site = around;
  b.loads = b.at.C * rows_.H_B.transpose();
  b.point = at_.number;
  return b;
}

double JointFriction::load(int contact, const Vec& lambda, const Vec& beside) {
  const Bearing& b = bearing(contact);
  Vec6 all = reaction(contact, lambda);
  if (const JointEntry& joint = joint_of(contact); beside.size() > 0) all += beside.segment(joint.row, joint.rows);
  return total(b.at, b.loads * all);
}

Vec6 JointFriction::reaction(int contact, const Vec& lambda) const {
  const JointEntry& joint = joint_of(contact);
  Vec6 all = lambda.segment(joint.row, joint.rows);
  const auto& [rows, D] = share(contact);
  for (std::size_t k = 0; k < rows.size(); ++k) all += lambda(rows[k]) * D.col(Eigen::Index(k));
  return all;
}

const JointFriction::Share& JointFriction::share(int contact) const {
  return bearings_[std::size_t(bearing_of_[std::size_t(contact)])].share;
}

void JointFriction::clear_shares() {
  for (Bearing& b : bearings_) b.share = {};
}

void JointFriction::add_shares(const std::vector<int>& rows, const Mat& on_joints) {
  for (Bearing& b : bearings_) {
    const JointEntry& joint = joint_of(b.contact);
    const auto D = on_joints.middleRows(joint.row, joint.rows);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto column = D.col(Eigen::Index(k));
      if (column.isZero(0)) continue;
      b.share.rows.push_back(rows[k]);
      b.share.D.conservativeResize(joint.rows, b.share.D.cols() + 1);
      b.share.D.rightCols(1) = column;
    }
  }
}

const Vec6& JointFriction::load_by_row(int contact) const {
  return bearings_[std::size_t(bearing_of_[std::size_t(contact)])].load_by_row;
}

bool JointFriction::slides(int contact) {
  return contacts_.mode(contact).closed && contacts_.friction_ratio(contact) != Tangential::Zero();
}

bool JointFriction::unload() {
  bool loaded = false;
  for (Bearing& b : bearings_) {
    loaded = loaded || (b.load_by_row.size() > 0 && !b.load_by_row.isZero(0));
    b.load_by_row.setZero(joint_of(b.contact).rows);
  }
  return loaded;
}

JointFriction::Loaded JointFriction::load_with(const Vec& lambda) {
  // The load of a lightly loaded joint is as inexact as the round-off of the largest multiplier.
  const double largest = lambda.size() > 0 ? lambda.lpNorm<Eigen::Infinity>() : 0;
  Loaded loaded;
  for (Bearing& b : bearings_) {
    if (!slides(b.contact)) continue;
    bearing(b.contact);
    const Vec6 of_joint = reaction(b.contact, lambda), p = b.loads * of_joint;
    const double round_off = 64 * eps * largest * b.loads.cwiseAbs().sum();
    loaded.far = loaded.far || std::abs(total(b.at, p) - b.load_by_row.dot(of_joint)) > round_off;
    const Vec6 before = b.load_by_row;
    b.load_by_row.setZero();
    for_each_bearing(b.at, [&](int first, int n) {
      const double load = p.segment(first, n).norm();
      if (load > 0) b.load_by_row += b.loads.middleRows(first, n).transpose() * (p.segment(first, n) / load);
    });
    loaded.changed = loaded.changed || b.load_by_row != before;
  }
  return loaded;
}

void JointFriction::fail_without_loads() {
  std::string names;
  for (const Bearing& b : bearings_)
    if (slides(b.contact)) names += (names.empty() ? "" : ", ") + contacts_.entry(b.contact).path();
  throw LocksItself(
      fmt::format("the sliding friction of {} was not found: the bearings' loads and the friction that follows from "
                  "them raise each other; with so much friction the joint may lock itself as it slides",
                  names));
}

CallSite JointFriction::find_not_finite() {
  for (const Bearing& b : bearings_) {
    const Rows& slip = contacts_.rows(b.contact);
    if (!slip.g.allFinite() || !slip.gamma.allFinite() || !slip.H_A.allFinite() || !slip.H_B.allFinite())
      return {&joint_of(b.contact).origin, "slip_row"};
    if (!bearing(b.contact).loads.allFinite()) return {&joint_of(b.contact).origin, "bearings"};
  }
  return {};
}

namespace {

// The force along the slip on both markers: of a sticking row, or sliding friction by the loads of the bearings.
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

void JointFriction::add_tangent(int contact, Blend c, const Vec& lambda, Matrix& S) {
  const Slots& slots = contacts_.slots(contact);
  const Rows& r = contacts_.rows(contact);
  const double damping = contacts_.friction_damping(contact)(0, 0);
  if (c.c_d != 0 && damping != 0) {
    const double weight = c.c_d * damping * load(contact, lambda);
    for (int k = 0; k < slots.count; ++k)
      for (int l = 0; l < slots.count; ++l)
        at_.markers.add_pair(slots[k], slots[l], r.H(k).row(1).transpose() * r.H(l).row(1), weight, S);
  }
  const int row = contacts_.loads.place({contact, 1}).row;
  const double ratio = contacts_.friction_ratio(contact)[0], held = row >= 0 ? lambda(row) : 0;
  if (c.c_k == 0 || (ratio == 0 && held == 0)) return;
  const JointEntry& joint = joint_of(contact);
  at_.called(joint.origin, "bearings");
  const SlipForce force(joint, *contacts_.entry(contact).joint->bearing, at_.t, reaction(contact, lambda), ratio, held);
  const std::array<int, 2> both = {slots.A, slots.B};
  add_wrench_tangent(at_.markers, both, at_.t, at_.q, at_.v, force, c.c_k, 0, S);
}

}  // namespace model
}  // namespace trammel
