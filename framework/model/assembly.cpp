#include "model/assembly.hpp"

#include <algorithm>
#include <numeric>

namespace trammel::model {

AssembledSystem::Work::Work(std::shared_ptr<const Model> m, Storage how)
    : model(std::move(m)), storage(how), chain(*model) {
  const Storage chosen = storage == Storage::automatic ? storage_for(*model) : storage;
  sparse = chosen == Storage::sparse;
  if (chosen == Storage::blocks) blocks.emplace(*model);
  const auto slots_of = [this](const std::vector<MarkerRef>& markers) {
    Slots at{.count = int(markers.size())};
    int* const each[] = {&at.A, &at.B, &at.C, &at.D};
    for (std::size_t k = 0; k < markers.size(); ++k) *each[k] = chain.slot(markers[k]);
    return at;
  };
  for (const JointEntry& entry : model->joints) joint_slots.push_back(slots_of(entry.markers));
  order_joints();
  for (const ForceEntry& entry : model->forces) force_slots.push_back(slots_of({entry.A, entry.B}));
  for (const ContactEntry& entry : model->contacts) {
    if (entry.limit)
      contact_slots.push_back(slots_of(entry.limit->markers));
    else if (!entry.surface)
      contact_slots.push_back(slots_of({entry.A, entry.B}));
    surfaces.emplace_back();
    if (!entry.surface) continue;
    surfaces.back().contact = make_surface_contact(*model, entry, chain);
    const auto [A, B] = surfaces.back().contact->slots();
    contact_slots.push_back({.A = A, .B = B});
  }
  contact_rows.resize(model->contacts.size());
  modes.contacts.resize(model->contacts.size());
  contact_row.assign(model->contacts.size(), -1);
  stick_row.assign(model->contacts.size(), -1);
  sizes = model->sizes;
  held_rows = sizes.nc;
  if (sparse) reserve_contacts();
  lay_out_blocks();
}

void AssembledSystem::Work::order_joints() {
  std::vector<int> first;
  for (const JointEntry& joint : model->joints) {
    first.push_back(int(model->bodies.size()));
    for (const MarkerRef& marker : joint.markers)
      if (marker.body >= 0) first.back() = std::min(first.back(), marker.body);
  }
  joint_order.resize(first.size());
  std::iota(joint_order.begin(), joint_order.end(), std::size_t(0));
  std::stable_sort(joint_order.begin(), joint_order.end(),
                   [&](std::size_t i, std::size_t j) { return first[i] < first[j]; });
}

void AssembledSystem::Work::lay_out_blocks() {
  if (!blocks) return;
  std::vector<BodyBlocks::Tie> ties;
  const auto tie = [&ties](int first, int count, const auto& markers) {
    BodyBlocks::Tie& one = ties.emplace_back(BodyBlocks::Tie{first, count, {}});
    for (const MarkerRef& marker : markers) one.bodies.push_back(marker.body);
  };
  for (std::size_t b = 0; b < model->bodies.size(); ++b)
    if (const BodyEntry& body = model->bodies[b]; body.rows > 0) ties.push_back({body.row, body.rows, {int(b)}});
  for (const JointEntry& joint : model->joints) tie(joint.row, joint.rows, joint.markers);
  for (std::size_t i = 0; i < contact_row.size(); ++i) {
    const ContactEntry& contact = model->contacts[i];
    const std::vector<MarkerRef> pair = {contact.A, contact.B};
    if (contact_row[i] >= 0) tie(contact_row[i], 1, contact.limit ? contact.limit->markers : pair);
    if (stick_row[i] >= 0) tie(stick_row[i], dimension(model->world.space) - 1, pair);
  }
  std::sort(ties.begin(), ties.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  blocks->lay_out(ties);
}

void AssembledSystem::Work::move_to(double t_new, const Vec& q_new, const Vec& v_new) {
  const bool same_place = point > 0 && t == t_new && q == q_new;
  if (same_place && v == v_new) return;
  if (!same_place) ++configuration;
  t = t_new;
  q = q_new;
  v = v_new;
  ++point;
  chain.new_point();
  mass_fresh = mass_fresh && model->constant_mass;
  bodies_fresh = force_fresh = rows_fresh = false;
}

// M, unless it is constant and there already, and what the bodies add to f. Whoever asks for one needs the other soon.
void AssembledSystem::Work::evaluate_bodies() {
  ++counts.residual_evaluations;
  if (!mass_fresh && sparse) sum_mass(), mass_fresh = true;
  if (!mass_fresh && !blocks) M.setZero(sizes.nv, sizes.nv);
  f.setZero(sizes.nv);
  for (std::size_t k = 0; k < model->bodies.size(); ++k) {
    const BodyEntry& entry = model->bodies[k];
    const auto q_body = q.segment(entry.q0, entry.nq);
    const auto v_body = v.segment(entry.v0, entry.nv);
    if (!mass_fresh) {
      Matrix target = blocks ? Matrix::onto(blocks->mass(k)) : Matrix::onto(M).from(entry.v0, entry.v0);
      if (blocks) blocks->mass(k).setZero();
      if (entry.mass_and_force) {
        called(entry.name, "mass_and_force");
        entry.mass_and_force->mass_and_force(t, q_body, v_body, target, f.segment(entry.v0, entry.nv));
        continue;
      }
      called(entry.name, "mass");
      entry.body->mass(t, q_body, target);
    }
    called(entry.name, "force");
    entry.body->force(t, q_body, v_body, f.segment(entry.v0, entry.nv));
  }
  returned();
  mass_fresh = bodies_fresh = true;
}

void AssembledSystem::Work::sum_mass() {
  sparse_mass.fill(sizes.nv, [this] {
    for (const BodyEntry& entry : model->bodies) {
      called(entry.name, "mass");
      Matrix target = Matrix::onto(sparse_mass).from(entry.v0, entry.v0);
      entry.body->mass(t, q.segment(entry.q0, entry.nq), target);
    }
  });
}

void AssembledSystem::Work::evaluate_mass() {
  if (!mass_fresh) evaluate_bodies();
}

const Vec& AssembledSystem::Work::force() {
  if (force_fresh) return f;
  if (!bodies_fresh) evaluate_bodies();
  const int twist = twist_size(model->world.space);
  for (std::size_t i = 0; i < force_slots.size(); ++i) {
    const int A = force_slots[i].A, B = force_slots[i].B;
    called(model->forces[i].name, "wrench");
    on_A.setZero(twist);
    on_B.setZero(twist);
    model->forces[i].force->wrench(t, motion(A), motion(B), on_A, on_B);
    chain.add_wrench(A, on_A, 1, f);
    chain.add_wrench(B, on_B, 1, f);
  }
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    const ContactForce* law = model->contacts[i].force;
    if (!law || !modes.contacts[i].closed) continue;
    if (on_surface(i)) {
      surface(i).add_force(f);
      continue;
    }
    const Rows& r = contact(int(i));
    const double rate = contact_rate(int(i), 0);
    called(model->contacts[i].name, "normal");
    const double N = law->normal(r.g(0), rate, modes.contacts[i].approach_speed);
    const Tangential ratio = friction_ratio(int(i));
    const Slots& at = contact_slots[i];
    for (int k = 0; k < at.count; ++k) chain.add_wrench(at[k], pressed_by(r.H(k), 1, ratio), N, f);
  }
  returned();
  force_fresh = true;
  return f;
}

void AssembledSystem::Work::evaluate_rows() {
  if (rows_fresh) return;
  g.resize(sizes.nc);
  g_dot.resize(sizes.nc);
  gamma.resize(sizes.nc);
  if (blocks)
    blocks->clear_rows();
  else
    G.setZero(sizes.nc, sizes.nv);
  for (const BodyEntry& entry : model->bodies)
    if (entry.rows > 0) evaluate_own_rows(entry);
  for (const std::size_t i : joint_order) {
    const JointEntry& entry = model->joints[i];
    called(entry.name, "rows");
    evaluate_constraint(*entry.joint, joint_slots[i], rows);
    place_rows(rows, joint_slots[i], 0, entry.rows, entry.row);
  }
  coupled = false;
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (const int row = contact_row[i]; row >= 0) {
      place_rows(contact(int(i)), contact_slots[i], 0, 1, row);
      g(row) -= modes.contacts[i].offset;
      coupled = coupled || friction_ratio(int(i)) != Tangential::Zero();
    }
    if (const int row = stick_row[i]; row >= 0) {
      place_rows(contact(int(i)), contact_slots[i], 1, tangents(), row);
      g.segment(row, tangents()) = displacement(int(i)).head(tangents());
    }
  }
  if (coupled) couple_reactions();
  returned();
  rows_fresh = true;
}

void AssembledSystem::Work::place_rows(const Rows& r, const Slots& at, Eigen::Index first, Eigen::Index n, int row) {
  for (Eigen::Index i = 0; i < n; ++i) {
    g(row + i) = r.g(first + i);
    g_dot(row + i) = r.g_t(first + i);
    gamma(row + i) = r.gamma(first + i);
  }
  for (int k = 0; k < at.count; ++k) {
    const Motion& m = motion(at[k]);
    add_motion({r.H(k), first, n}, m, g_dot.data() + row, gamma.data() + row);
    if (blocks)
      blocks->add_rows(chain.body(at[k]), row, m, {r.H(k), first, n});
    else
      chain.add_rows(at[k], row, {r.H(k), first, n}, G);
  }
}

void AssembledSystem::Work::evaluate_own_rows(const BodyEntry& entry) {
  called(entry.name, "own_rows");
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
    blocks->add_own_rows(std::size_t(&entry - model->bodies.data()), entry.row, own_rows.G);
  else
    G.block(entry.row, entry.v0, entry.rows, entry.nv) += own_rows.G;
}

void AssembledSystem::Work::evaluate_constraint(const Constraint& constraint, const Slots& at, Rows& into) {
  const Space space = model->world.space;
  into.resize(constraint.row_count(space), space, at.count);
  const std::array<const Motion*, Rows::most_markers> markers = {
      &motion(at.A), &motion(at.B), at.count > 2 ? &motion(at.C) : nullptr, at.count > 3 ? &motion(at.D) : nullptr};
  constraint.rows_between(t, Motions(markers.data(), std::size_t(at.count)), into);
}

void AssembledSystem::Work::add_row_force(const Slots& at, const Rows& r, int row, double c, Vec& sum) const {
  for (int k = 0; k < at.count; ++k) chain.add_wrench(at[k], r.H(k).row(row).transpose(), c, sum);
}

// W: where a contact slides, the friction beside the force of its row.
void AssembledSystem::Work::couple_reactions() {
  const auto add_friction = [this](int slot, int row, const Mat6& H) {
    if (blocks)
      blocks->add_reaction(chain.body(slot), row, motion(slot), {H, 0, H.rows()});
    else
      chain.add_rows(slot, row, {H, 0, H.rows()}, W);
  };
  if (blocks)
    blocks->couple();
  else
    W = G;
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (contact_row[i] < 0) continue;
    const Tangential ratio = friction_ratio(int(i));
    if (ratio == Tangential::Zero()) continue;
    const Rows& r = contact(int(i));
    add_friction(contact_slots[i].A, contact_row[i], pressed_by(r.H_A, 0, ratio).transpose());
    add_friction(contact_slots[i].B, contact_row[i], pressed_by(r.H_B, 0, ratio).transpose());
  }
}

}  // namespace trammel::model
