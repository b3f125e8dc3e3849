// Rows of bodies, joints and contacts at the point: g, g_dot, gamma, G and W.
#include "linear/dense/prefetch.hpp"
#include "system/assembly.hpp"

namespace trammel::model {

void AssembledSystem::Work::evaluate_rows() {
  if (rows_fresh) return;
  g.resize(sizes.nc);
  g_dot.resize(sizes.nc);
  gamma.resize(sizes.nc);
  if (blocks)
    evaluate_constant_rows();
  else
    G.setZero(sizes.nc, sizes.nv);
  for (std::size_t k = 0; k < constrained.size(); ++k) {
    numerics::look_ahead(k, constrained.size(), [&](std::size_t next) { prefetch_body(constrained[next]); });
    evaluate_own_rows(model->bodies[constrained[k]]);
  }
  for (const std::size_t i : joint_order) {
    const JointEntry& entry = model->joints[i];
    called(entry.origin, "rows");
    const Slots& at = joint_slots[i];
    const Seen seen = motions_in_passing(at);
    evaluate_constraint(*entry.joint, entry.rows, seen, at.count, rows);
    place_rows(rows, at, seen, 0, entry.rows, entry.row);
  }
  coupled = false;
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (!modes.contacts[i].closed || on_surface(i)) continue;
    const auto row_of = [&](int direction) { return loads.place({int(i), direction}).row; };
    coupled = coupled || (!model->contacts[i].force && friction_ratio(int(i)) != Tangential::Zero());
    if (row_of(0) < 0 && row_of(1) < 0 && row_of(2) < 0) continue;
    const Rows& of_contact = contact(int(i));  // before its motions, which it determines on surfaces
    const Seen seen = motions(contact_slots[i]);
    if (const int row = row_of(0); row >= 0) {
      place_rows(of_contact, contact_slots[i], seen, 0, 1, row);
      g(row) -= modes.contacts[i].offset;
    }
    for (int k = 1; k <= tangents(int(i)); ++k) {
      if (row_of(k) < 0) continue;
      place_rows(of_contact, contact_slots[i], seen, k, 1, row_of(k));
      g(row_of(k)) = displacement(int(i))[k - 1];
    }
  }
  bear_nothing();
  if (coupled) couple_reactions();
  returned();
  rows_fresh = true;
  if (coupled && loads.sliding_shares() && follow_shares()) couple_reactions();
}

void AssembledSystem::Work::evaluate_constant_rows() {
  if (!constant_rows_placed) place_constant_rows();
  constant_rows.evaluate(q, v, g, g_dot, gamma);
}

// At q = 0 linear markers are at x_0, and linear rows have the value g_0.
void AssembledSystem::Work::place_constant_rows() {
  constant_rows.clear();
  for (const std::size_t i : constant_joints) {
    const JointEntry& entry = model->joints[i];
    const Slots& at = joint_slots[i];
    std::array<Motion, Rows::most_markers> motions;
    std::array<const Motion*, Rows::most_markers> seen{};
    for (std::size_t k = 0; k < std::size_t(at.count); ++k) {
      motions[k] = chain.motion_at_zero(at[int(k)]);
      seen[k] = &motions[k];
    }
    called(entry.origin, "rows");
    rows.resize(entry.rows, model->world.space, at.count);
    entry.joint->rows_between(0, Motions(seen.data(), std::size_t(at.count)), rows);
    for (int k = 0; k < at.count; ++k)  // from 0, as it was laid out
      blocks->add_rows(chain.body(at[k]), entry.row, motions[std::size_t(k)], {rows.H(k), 0, entry.rows});
    for (int row = 0; row < entry.rows; ++row) {
      constant_rows.add_row(entry.row + row, rows.g(row));
      for (int k = 0; k < at.count; ++k) {
        if (chain.body(at[k]) < 0) continue;
        const Motion& m = motions[std::size_t(k)];
        const BodyEntry& body = model->bodies[std::size_t(chain.body(at[k]))];
        constant_rows.add_marker();
        for (std::size_t j = 0; j < m.dofs.size(); ++j)
          constant_rows.add_entry(body.q0 + m.dofs[j], body.v0 + m.dofs[j],
                                  rows.H(k).row(row).dot(m.J.col(Eigen::Index(j))));
      }
    }
  }
  constant_rows_placed = true;
}

AssembledSystem::Work::Seen AssembledSystem::Work::motions(const Slots& at) {
  Seen seen{};
  for (int k = 0; k < at.count; ++k) seen[std::size_t(k)] = &motion(at[k]);
  return seen;
}

AssembledSystem::Work::Seen AssembledSystem::Work::motions_in_passing(const Slots& at) {
  Seen seen{};
  for (int k = 0; k < at.count; ++k) seen[std::size_t(k)] = &chain.motion_in_passing(at[k], std::size_t(k), t, q, v);
  return seen;
}

void AssembledSystem::Work::place_rows(const Rows& r, const Slots& at, const Seen& motions, Eigen::Index first,
                                       Eigen::Index n, int row) {
  for (Eigen::Index i = 0; i < n; ++i) {
    g(row + i) = r.g(first + i);
    g_dot(row + i) = r.g_t(first + i);
    gamma(row + i) = r.gamma(first + i);
  }
  for (int k = 0; k < at.count && blocks; ++k) blocks->clear_rows(chain.body(at[k]), row, n);
  for (int k = 0; k < at.count; ++k) {
    const Motion& m = *motions[std::size_t(k)];
    add_motion({r.H(k), first, n}, m, g_dot.data() + row, gamma.data() + row);
    if (blocks)
      blocks->add_rows(chain.body(at[k]), row, m, {r.H(k), first, n});
    else
      chain.add_rows(at[k], m, row, {r.H(k), first, n}, G);
  }
}

void AssembledSystem::Work::evaluate_own_rows(const BodyEntry& entry) {
  called(entry.origin, "own_rows");
  const auto v_body = v.segment(entry.v0, entry.nv);
  own_rows.resize(entry.rows, entry.nv);
  entry.constrained->own_rows(t, q.segment(entry.q0, entry.nq), v_body, own_rows);
  for (int i = 0; i < entry.rows; ++i) {
    double rate = own_rows.g_t(i);
    for (int j = 0; j < entry.nv; ++j) rate += own_rows.G(i, j) * v_body(j);
    g(entry.row + i) = own_rows.g(i);
    g_dot(entry.row + i) = rate;
    gamma(entry.row + i) = own_rows.gamma(i);
  }
  if (blocks)
    blocks->set_own_rows(std::size_t(&entry - model->bodies.data()), own_rows.G);
  else
    G.block(entry.row, entry.v0, entry.rows, entry.nv) += own_rows.G;
}

void AssembledSystem::Work::evaluate_constraint(const Constraint& constraint, int n, const Seen& motions, int count,
                                                Rows& into) const {
  into.resize(n, model->world.space, count);
  constraint.rows_between(t, Motions(motions.data(), std::size_t(count)), into);
}

void AssembledSystem::Work::add_row_force(const Slots& at, const Rows& r, int row, double c, Vec& sum) const {
  for (int k = 0; k < at.count; ++k) chain.add_wrench(at[k], r.H(k).row(row).transpose(), c, sum);
}

// W: G plus the friction of sliding contacts and joints that depends on the force of a row.
void AssembledSystem::Work::couple_reactions() {
  const auto add_friction = [this](int slot, int row, const Mat6& H) {
    if (blocks)
      blocks->add_reaction(chain.body(slot), row, motion(slot), {H, 0, H.rows()});
    else
      chain.add_rows(slot, motion(slot), row, {H, 0, H.rows()}, W);
  };
  if (blocks)
    blocks->couple();
  else
    W = G;
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (!modes.contacts[i].closed || model->contacts[i].force) continue;
    const Tangential ratio = friction_ratio(int(i));
    if (ratio == Tangential::Zero()) continue;
    const Rows& r = contact(int(i));
    // share x (ratio . tangents) added to a row of W
    const auto add_share = [&](int row, double share) {
      add_friction(contact_slots[i].A, row, share * pressed_by(r.H_A, 0, ratio).transpose());
      add_friction(contact_slots[i].B, row, share * pressed_by(r.H_B, 0, ratio).transpose());
    };
    if (in_joint(int(i))) {
      const JointEntry& joint = model->joints[std::size_t(model->contacts[i].joint->joint)];
      const Vec6& by = bearing(int(i)).load_by_row;
      for (int k = 0; k < joint.rows; ++k)
        if (by[k] != 0) add_share(joint.row + k, -by[k]);
      continue;
    }
    const ContactLoads::Place& place = loads.place({int(i), 0});
    if (place.group < 0) {
      add_share(place.row, 1);
      continue;
    }
    const auto shares = loads.shares(place);
    for (int k = 0; k < int(shares.size()); ++k)
      if (shares[k] != 0) add_share(loads.row_of_basis(place.group, k), shares[k]);
  }
}

}  // namespace trammel::model
