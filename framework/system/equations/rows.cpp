#include "system/equations/rows.hpp"

#include <algorithm>

#include <trammel/linear_rows.hpp>

#include "linear/dense/prefetch.hpp"
#include "linear/dense/row_products.hpp"
#include "linear/dense/simd_columns.hpp"
#include "linear/kkt.hpp"

namespace trammel::model {

RowsAtPoint::RowsAtPoint(Point& at, ContactsAtPoint& contacts, JointFriction& friction, BodyBlocks* blocks)
    : at_(at), contacts_(contacts), friction_(friction), blocks_(blocks) {
  order_joints();
  for (std::size_t k = 0; k < at_.model->bodies.size(); ++k)
    if (at_.model->bodies[k].rows > 0) constrained_.push_back(k);
  lay_out(at_.model->sizes.nc, at_.model->sizes.nc);
}

// Sorts joints for cache locality; with many bodies, separates those with constant rows.
void RowsAtPoint::order_joints() {
  const auto stands = [this](const JointEntry& joint) {
    const auto* linear = dynamic_cast<const LinearRows*>(joint.joint.get());
    return linear && linear->linear() &&
           std::all_of(joint.markers.begin(), joint.markers.end(), [this](const MarkerRef& m) {
             return m.body < 0 || dynamic_cast<const LinearMarkers*>(at_.model->bodies[std::size_t(m.body)].body.get());
           });
  };
  std::vector<int> first;
  for (const JointEntry& joint : at_.model->joints) {
    first.push_back(int(at_.model->bodies.size()));
    for (const MarkerRef& marker : joint.markers)
      if (marker.body >= 0) first.back() = std::min(first.back(), marker.body);
  }
  for (std::size_t i = 0; i < first.size(); ++i)
    (blocks_ && stands(at_.model->joints[i]) ? constant_joints_ : joint_order_).push_back(i);
  std::stable_sort(joint_order_.begin(), joint_order_.end(),
                   [&](std::size_t i, std::size_t j) { return first[i] < first[j]; });
}

void RowsAtPoint::lay_out(int count, int held) {
  count_ = count;
  held_ = held;
  fresh_ = false;
  if (!blocks_) return;
  std::vector<BodyBlocks::Tie> ties;
  const auto tie = [&ties](int first, int rows, const auto& markers, bool constant) {
    BodyBlocks::Tie& one = ties.emplace_back(BodyBlocks::Tie{first, rows, constant, {}});
    for (const MarkerRef& marker : markers) one.bodies.push_back(marker.body);
  };
  for (std::size_t b = 0; b < at_.model->bodies.size(); ++b)
    if (const BodyEntry& body = at_.model->bodies[b]; body.rows > 0)
      ties.push_back({body.row, body.rows, false, {int(b)}});
  for (std::size_t i = 0; i < at_.model->joints.size(); ++i) {
    const JointEntry& joint = at_.model->joints[i];
    tie(joint.row, joint.rows, joint.markers, std::binary_search(constant_joints_.begin(), constant_joints_.end(), i));
  }
  contacts_.for_each_row([&](ContactDirection d, int row) {
    BodyBlocks::Tie& one = ties.emplace_back(BodyBlocks::Tie{row, 1, false, {}});
    for (const int i : contacts_.acting_with(d)) {
      const Slots& slots = contacts_.slots(i);
      for (int k = 0; k < slots.count; ++k) one.bodies.push_back(at_.markers.body(slots[k]));
    }
  });
  std::sort(ties.begin(), ties.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  blocks_->lay_out(ties);
  constant_rows_placed_ = false;
}

bool RowsAtPoint::evaluate() {
  if (fresh_) return false;
  g_.resize(count_);
  g_dot_.resize(count_);
  gamma_.resize(count_);
  if (blocks_)
    evaluate_constant_rows();
  else
    G_.setZero(count_, at_.model->sizes.nv);
  const std::vector<BodyEntry>& bodies = at_.model->bodies;
  for (std::size_t k = 0; k < constrained_.size(); ++k) {
    numerics::look_ahead(k, constrained_.size(), [&](std::size_t next) {
      at_.prefetch(bodies[constrained_[next]]);
      if (blocks_) blocks_->prefetch_rows(constrained_[next]);
    });
    evaluate_own_rows(bodies[constrained_[k]]);
  }
  for (const std::size_t i : joint_order_) {
    const JointEntry& entry = at_.model->joints[i];
    at_.called(entry.origin, "rows");
    const Slots& slots = at_.joints[i];
    const Seen seen = at_.motions_in_passing(slots);
    at_.evaluate(*entry.joint, entry.rows, seen, slots.count, rows_);
    place(rows_, slots, seen, 0, entry.rows, entry.row);
  }
  coupled_ = false;
  for (int i = 0; i < contacts_.count(); ++i)
    if (contacts_.mode(i).closed && !contacts_.on_surface(i)) evaluate_contact(i);
  friction_.unload();
  if (coupled_) couple();
  at_.returned();
  fresh_ = true;
  return true;
}

void RowsAtPoint::evaluate_contact(int i) {
  const auto row_of = [&](int direction) { return contacts_.loads.place({i, direction}).row; };
  coupled_ = coupled_ || (!contacts_.entry(i).force && contacts_.friction_ratio(i) != Tangential::Zero());
  if (row_of(0) < 0 && row_of(1) < 0 && row_of(2) < 0) return;
  const Rows& of_contact = contacts_.rows(i);  // first: it determines the motions of points of surfaces
  const Slots& slots = contacts_.slots(i);
  const Seen seen = at_.motions(slots);
  if (const int row = row_of(0); row >= 0) {
    place(of_contact, slots, seen, 0, 1, row);
    g_(row) -= contacts_.mode(i).offset;
  }
  for (int k = 1; k <= contacts_.tangents(i); ++k) {
    if (row_of(k) < 0) continue;
    place(of_contact, slots, seen, k, 1, row_of(k));
    g_(row_of(k)) = contacts_.displacement(i)[k - 1];
  }
}

void RowsAtPoint::evaluate_constant_rows() {
  if (!constant_rows_placed_) place_constant_rows();
  constant_rows_.evaluate(at_.q, at_.v, g_, g_dot_, gamma_);
}

// At q = 0 linear markers are at x_0, and linear rows have the value g_0.
void RowsAtPoint::place_constant_rows() {
  constant_rows_.clear();
  for (const std::size_t i : constant_joints_) {
    const JointEntry& entry = at_.model->joints[i];
    const Slots& slots = at_.joints[i];
    std::array<Motion, Rows::most_markers> motions;
    std::array<const Motion*, Rows::most_markers> seen{};
    for (std::size_t k = 0; k < std::size_t(slots.count); ++k) {
      motions[k] = at_.markers.motion_at_zero(slots[int(k)]);
      seen[k] = &motions[k];
    }
    at_.called(entry.origin, "rows");
    rows_.resize(entry.rows, at_.model->world.space, slots.count);
    entry.joint->rows_between(0, Motions(seen.data(), std::size_t(slots.count)), rows_);
    for (int k = 0; k < slots.count; ++k)  // sums from 0, in the order of the layout
      blocks_->add_rows(at_.markers.body(slots[k]), entry.row, motions[std::size_t(k)], {rows_.H(k), 0, entry.rows});
    for (int row = 0; row < entry.rows; ++row) {
      constant_rows_.add_row(entry.row + row, rows_.g(row));
      for (int k = 0; k < slots.count; ++k) {
        if (at_.markers.body(slots[k]) < 0) continue;
        const Motion& m = motions[std::size_t(k)];
        const BodyEntry& body = at_.model->bodies[std::size_t(at_.markers.body(slots[k]))];
        constant_rows_.add_marker();
        for (std::size_t j = 0; j < m.dofs.size(); ++j)
          constant_rows_.add_entry(body.q0 + m.dofs[j], body.v0 + m.dofs[j],
                                   rows_.H(k).row(row).dot(m.J.col(Eigen::Index(j))));
      }
    }
  }
  constant_rows_placed_ = true;
}

void RowsAtPoint::place(const Rows& r, const Slots& slots, const Seen& motions, Eigen::Index first, Eigen::Index n,
                        int row) {
  for (Eigen::Index i = 0; i < n; ++i) {
    g_(row + i) = r.g(first + i);
    g_dot_(row + i) = r.g_t(first + i);
    gamma_(row + i) = r.gamma(first + i);
  }
  for (int k = 0; k < slots.count && blocks_; ++k) blocks_->clear_rows(at_.markers.body(slots[k]), row, n);
  for (int k = 0; k < slots.count; ++k) {
    const Motion& m = *motions[std::size_t(k)];
    add_motion({r.H(k), first, n}, m, g_dot_.data() + row, gamma_.data() + row);
    if (blocks_)
      blocks_->add_rows(at_.markers.body(slots[k]), row, m, {r.H(k), first, n});
    else
      at_.markers.add_rows(slots[k], m, row, {r.H(k), first, n}, G_);
  }
}

void RowsAtPoint::evaluate_own_rows(const BodyEntry& entry) {
  at_.called(entry.origin, "own_rows");
  const auto v_body = at_.v_of(entry);
  own_rows_.resize(entry.rows, entry.nv);
  entry.constrained->own_rows(at_.t, at_.q_of(entry), v_body, own_rows_);
  for (int i = 0; i < entry.rows; ++i) {
    double rate = own_rows_.g_t(i);
    for (int j = 0; j < entry.nv; ++j) rate += own_rows_.G(i, j) * v_body(j);
    g_(entry.row + i) = own_rows_.g(i);
    g_dot_(entry.row + i) = rate;
    gamma_(entry.row + i) = own_rows_.gamma(i);
  }
  if (blocks_)
    blocks_->set_own_rows(std::size_t(&entry - at_.model->bodies.data()), own_rows_.G);
  else
    G_.block(entry.row, entry.v0, entry.rows, entry.nv) += own_rows_.G;
}

// W: G plus the friction of sliding contacts and joints that depends on the force of a row.
void RowsAtPoint::couple() {
  if (blocks_)
    blocks_->couple();
  else
    W_ = G_;
  for (int i = 0; i < contacts_.count(); ++i) {
    if (!contacts_.mode(i).closed || contacts_.entry(i).force) continue;
    if (const Tangential ratio = contacts_.friction_ratio(i); ratio != Tangential::Zero()) add_sliding(i, ratio);
  }
}

void RowsAtPoint::add_sliding(int i, const Tangential& ratio) {
  const Rows& r = contacts_.rows(i);
  // Adds share * (ratio . tangents) to a row of W.
  const auto add_share = [&](int row, double share) {
    add_to_reaction(contacts_.slots(i).A, row, share * pressed_by(r.H_A, 0, ratio).transpose());
    add_to_reaction(contacts_.slots(i).B, row, share * pressed_by(r.H_B, 0, ratio).transpose());
  };
  if (contacts_.in_joint(i)) {
    const JointEntry& joint = friction_.joint_of(i);
    const Vec6& by = friction_.load_by_row(i);
    for (int k = 0; k < joint.rows; ++k)
      if (by[k] != 0) add_share(joint.row + k, -by[k]);
    const auto& [rows, D] = friction_.share(i);
    for (std::size_t k = 0; k < rows.size(); ++k) add_share(rows[k], -by.dot(D.col(Eigen::Index(k))));
    return;
  }
  const ContactLoads& loads = contacts_.loads;
  const ContactLoads::Place& place = loads.place({i, 0});
  if (place.group < 0) return add_share(place.row, 1);
  const auto shares = loads.shares(place);
  for (int k = 0; k < int(shares.size()); ++k)
    if (shares[k] != 0) add_share(loads.row_of_basis(place.group, k), shares[k]);
}

void RowsAtPoint::add_to_reaction(int slot, int row, const Mat6& H) {
  if (blocks_)
    blocks_->add_reaction(at_.markers.body(slot), row, at_.motion(slot), {H, 0, H.rows()});
  else
    at_.markers.add_rows(slot, at_.motion(slot), row, {H, 0, H.rows()}, W_);
}

void RowsAtPoint::unload_bearings() {
  if (friction_.unload() && fresh_ && coupled_) couple();
}

bool RowsAtPoint::load_bearings(const Vec& lambda) {
  if (friction_.none()) return false;
  const JointFriction::Loaded loaded = friction_.load_with(lambda);
  if (loaded.changed) couple();
  return loaded.far;
}

void RowsAtPoint::add_times(double c, const Vec& x, Vec& rc) const {
  if (blocks_)
    numerics::add_rows_times(blocks_->bodies(), c, x, rc);
  else
    numerics::add_rows_product(c, G_, x, rc);
}

void RowsAtPoint::add_force(double c, const Vec& y, Vec& r) const {
  if (blocks_)
    numerics::add_rows_force(blocks_->bodies(), c, y, r);
  else
    numerics::add_transposed_product(c, G_, y, r);
}

void RowsAtPoint::add_reaction(double c, const Vec& lambda, Vec& r) {
  load_bearings(lambda);
  if (!coupled_)
    add_force(c, lambda, r);
  else if (blocks_)
    numerics::add_reaction(blocks_->bodies(), c, lambda, r);
  else
    numerics::add_transposed_product(c, W_, lambda, r);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> RowsAtPoint::sparse() const {
  std::vector<Eigen::Triplet<double, int>> entries;
  const auto add = [&entries](int row, int column, double value) {
    if (value != 0) entries.emplace_back(row, column, value);
  };
  if (blocks_) {
    for (const numerics::BodyBlock& body : blocks_->bodies())
      for (std::size_t i = 0; i < body.rows.size(); ++i)
        for (int k = 0; k < int(body.Gt.rows()); ++k) add(body.rows[i], body.v0 + k, body.Gt(k, Eigen::Index(i)));
  } else {
    for (int i = 0; i < count_; ++i)
      for (int j = 0; j < at_.model->sizes.nv; ++j) add(i, j, G_(i, j));
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> all(count_, at_.model->sizes.nv);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

double RowsAtPoint::rank_tolerance() const {
  return numerics::rank_tolerance_at(g_.size() ? g_.lpNorm<Eigen::Infinity>() / at_.markers.sizes().length : 0);
}

CallSite RowsAtPoint::find_not_finite() {
  for (std::size_t i = 0; i < at_.joints.size(); ++i) {
    const JointEntry& entry = at_.model->joints[i];
    at_.evaluate(*entry.joint, entry.rows, at_.motions(at_.joints[i]), at_.joints[i].count, rows_);
    if (!rows_.g.allFinite() || !rows_.gamma.allFinite()) return {&entry.origin, "rows"};
    for (int k = 0; k < at_.joints[i].count; ++k)
      if (!rows_.H(k).allFinite()) return {&entry.origin, "rows"};
  }
  return {};
}

}  // namespace trammel::model
