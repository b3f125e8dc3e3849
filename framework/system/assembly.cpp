#include "system/assembly.hpp"

#include <algorithm>

#include <trammel/linear_rows.hpp>

#include "linear/dense/prefetch.hpp"

namespace trammel::model {

AssembledSystem::Work::Work(std::shared_ptr<const Model> m, Storage how)
    : model(std::move(m)), storage(how), chain(*model, site) {
  const Storage chosen = storage == Storage::automatic ? storage_for(*model) : storage;
  sparse = chosen == Storage::sparse;
  if (chosen == Storage::blocks) blocks.emplace(*model), blocks->kept[at_point].passing = true;
  const auto slots = [](const std::vector<int>& each) {
    Slots at{.count = int(each.size())};
    int* const places[] = {&at.A, &at.B, &at.C, &at.D};
    for (std::size_t k = 0; k < each.size(); ++k) *places[k] = each[k];
    return at;
  };
  const auto slots_of = [&](const std::vector<MarkerRef>& markers) {
    std::vector<int> each;
    for (const MarkerRef& marker : markers) each.push_back(chain.slot(marker));
    return slots(each);
  };
  // Those of forces lie next to each other in memory: of many bodies most joints' markers may not be asked for.
  for (const ForceEntry& entry : model->forces) force_slots.push_back(slots_of({entry.A, entry.B}));
  for (const JointEntry& entry : model->joints) joint_slots.push_back(slots_of(entry.markers));
  order_joints();
  for (std::size_t k = 0; k < model->bodies.size(); ++k)
    if (model->bodies[k].rows > 0) constrained.push_back(k);
  for (const ContactEntry& entry : model->contacts) {
    const auto& geometry = geometries.emplace_back(make_contact_geometry(*model, entry, chain));
    contact_slots.push_back(slots(geometry->slots()));
    surfaces.push_back({dynamic_cast<SurfaceContact*>(geometry.get())});
  }
  contact_rows.resize(model->contacts.size());
  modes.contacts.resize(model->contacts.size());
  loads.lay_out(modes);
  sizes = model->sizes;
  held_rows = sizes.nc;
  reserve_bearings();
  if (sparse) reserve_contacts();
  lay_out_blocks();
}

// With many bodies, constant rows are stored.
void AssembledSystem::Work::order_joints() {
  const auto stands = [this](const JointEntry& joint) {
    const auto* linear = dynamic_cast<const LinearRows*>(joint.joint.get());
    return linear && linear->linear() &&
           std::all_of(joint.markers.begin(), joint.markers.end(), [this](const MarkerRef& m) {
             return m.body < 0 || dynamic_cast<const LinearMarkers*>(model->bodies[std::size_t(m.body)].body.get());
           });
  };
  std::vector<int> first;
  for (const JointEntry& joint : model->joints) {
    first.push_back(int(model->bodies.size()));
    for (const MarkerRef& marker : joint.markers)
      if (marker.body >= 0) first.back() = std::min(first.back(), marker.body);
  }
  for (std::size_t i = 0; i < first.size(); ++i)
    (blocks && stands(model->joints[i]) ? constant_joints : joint_order).push_back(i);
  std::stable_sort(joint_order.begin(), joint_order.end(),
                   [&](std::size_t i, std::size_t j) { return first[i] < first[j]; });
}

void AssembledSystem::Work::lay_out_blocks() {
  if (!blocks) return;
  std::vector<BodyBlocks::Tie> ties;
  const auto tie = [&ties](int first, int count, const auto& markers, bool constant = false) {
    BodyBlocks::Tie& one = ties.emplace_back(BodyBlocks::Tie{first, count, constant, {}});
    for (const MarkerRef& marker : markers) one.bodies.push_back(marker.body);
  };
  for (std::size_t b = 0; b < model->bodies.size(); ++b)
    if (const BodyEntry& body = model->bodies[b]; body.rows > 0) ties.push_back({body.row, body.rows, false, {int(b)}});
  for (std::size_t i = 0; i < model->joints.size(); ++i) {
    const JointEntry& joint = model->joints[i];
    tie(joint.row, joint.rows, joint.markers, std::binary_search(constant_joints.begin(), constant_joints.end(), i));
  }
  for_each_contact_row([&](ContactDirection d, int row) {
    BodyBlocks::Tie& one = ties.emplace_back(BodyBlocks::Tie{row, 1, false, {}});
    for (const int i : contacts_of_row(d)) {
      const Slots& at = contact_slots[std::size_t(i)];
      for (int k = 0; k < at.count; ++k) one.bodies.push_back(chain.body(at[k]));
    }
  });
  std::sort(ties.begin(), ties.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  blocks->lay_out(ties);
  constant_rows_placed = false;
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

// Where a body's numbers begin, whose length only it knows, and its own rows go.
void AssembledSystem::Work::prefetch_body(std::size_t body) {
  constexpr std::size_t as_a_rule = 192;
  const BodyEntry& entry = model->bodies[body];
  numerics::prefetch(entry.body.get(), as_a_rule);
  const std::size_t own = std::size_t(entry.rows) * std::size_t(entry.nv);
  if (blocks) numerics::prefetch(blocks->bodies()[body].Gt.data(), own * sizeof(double));
}

// Evaluates M, unless it is constant and available, and the bodies' part of f together: callers usually need both.
void AssembledSystem::Work::evaluate_bodies() {
  ++counts.residual_evaluations;
  if (!mass_fresh && sparse) sum_mass(), mass_fresh = true;
  if (!mass_fresh && !blocks) M.setZero(sizes.nv, sizes.nv);
  f.setZero(sizes.nv);
  for (std::size_t k = 0; k < model->bodies.size(); ++k) {
    numerics::look_ahead(k, model->bodies.size(), [&](std::size_t next) { prefetch_body(next); });
    const BodyEntry& entry = model->bodies[k];
    const auto q_body = q.segment(entry.q0, entry.nq);
    const auto v_body = v.segment(entry.v0, entry.nv);
    if (!mass_fresh) {
      Matrix target = blocks ? Matrix::onto(blocks->mass(k)) : Matrix::onto(M).from(entry.v0, entry.v0);
      if (blocks) blocks->mass(k).setZero();
      if (entry.mass_and_force) {
        called(entry.origin, "mass_and_force");
        entry.mass_and_force->mass_and_force(t, q_body, v_body, target, f.segment(entry.v0, entry.nv));
        continue;
      }
      called(entry.origin, "mass");
      entry.body->mass(t, q_body, target);
    }
    called(entry.origin, "force");
    entry.body->force(t, q_body, v_body, f.segment(entry.v0, entry.nv));
  }
  returned();
  mass_fresh = bodies_fresh = true;
}

void AssembledSystem::Work::sum_mass() {
  sparse_mass.fill(sizes.nv, [this] {
    for (const BodyEntry& entry : model->bodies) {
      called(entry.origin, "mass");
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
    numerics::look_ahead(i, force_slots.size(), [&](std::size_t next) {
      chain.prefetch(force_slots[next].A), chain.prefetch(force_slots[next].B);
    });
    const int A = force_slots[i].A, B = force_slots[i].B;
    called(model->forces[i].origin, "wrench");
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
    called(model->contacts[i].origin, "normal");
    const double N = law->normal(r.g(0), rate, modes.contacts[i].approach_speed);
    const Tangential ratio = friction_ratio(int(i));
    const Slots& at = contact_slots[i];
    for (int k = 0; k < at.count; ++k) chain.add_wrench(at[k], pressed_by(r.H(k), 1, ratio), N, f);
  }
  returned();
  force_fresh = true;
  return f;
}

}  // namespace trammel::model
