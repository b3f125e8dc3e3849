#include "model/assembly.hpp"

#include "model/numeric_derivative.hpp"

namespace trammel::model {

AssembledSystem::Work::Work(std::shared_ptr<const Model> m, Storage how)
    : model(std::move(m)), storage(how), chain(*model) {
  if (storage == Storage::blocks || (storage == Storage::automatic && BodyBlocks::worthwhile(*model)))
    blocks.emplace(*model);
  for (const JointEntry& entry : model->joints) joint_slots.push_back({chain.slot(entry.A), chain.slot(entry.B)});
  for (const ForceEntry& entry : model->forces) force_slots.push_back({chain.slot(entry.A), chain.slot(entry.B)});
  for (const ContactEntry& entry : model->contacts) {
    const int B = entry.surface ? chain.surface_slot(entry.surface->body) : chain.slot(entry.B);
    contact_slots.push_back({chain.slot(entry.A), B});
    surfaces.emplace_back();
    if (entry.surface) surfaces.back().emplace(Pressed{SurfaceContact(*model, entry)});
  }
  contact_rows.resize(model->contacts.size());
  modes.contacts.resize(model->contacts.size());
  contact_row.assign(model->contacts.size(), -1);
  stick_row.assign(model->contacts.size(), -1);
  sizes = model->sizes;
  lay_out_blocks();
}

void AssembledSystem::Work::lay_out_blocks() {
  if (!blocks) return;
  std::vector<BodyBlocks::Tie> ties;
  for (const JointEntry& joint : model->joints) ties.push_back({joint.row, joint.rows, joint.A.body, joint.B.body});
  for (std::size_t i = 0; i < contact_row.size(); ++i) {
    const auto [A, B] = std::pair{model->contacts[i].A.body, model->contacts[i].B.body};
    if (contact_row[i] >= 0) ties.push_back({contact_row[i], 1, A, B});
    if (stick_row[i] >= 0) ties.push_back({stick_row[i], dimension(model->world.space) - 1, A, B});
  }
  blocks->lay_out(ties);
}

void AssembledSystem::Work::move_to(double t_new, const Vec& q_new, const Vec& v_new) {
  if (point > 0 && t == t_new && q == q_new && v == v_new) return;
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
  if (!mass_fresh && !blocks) M.setZero(sizes.nv, sizes.nv);
  f.setZero(sizes.nv);
  for (std::size_t k = 0; k < model->bodies.size(); ++k) {
    const BodyEntry& entry = model->bodies[k];
    const auto q_body = q.segment(entry.q0, entry.nq);
    const auto v_body = v.segment(entry.v0, entry.nv);
    Matrix target = blocks ? Matrix::onto(blocks->mass(k)) : Matrix::onto(M).from(entry.v0, entry.v0);
    if (!mass_fresh && blocks) blocks->mass(k).setZero();
    if (!mass_fresh && entry.mass_and_force) {
      called(entry.name, "mass_and_force");
      entry.mass_and_force->mass_and_force(t, q_body, v_body, target, f.segment(entry.v0, entry.nv));
      continue;
    }
    called(entry.name, "mass");
    if (!mass_fresh) entry.body->mass(t, q_body, target);
    called(entry.name, "force");
    entry.body->force(t, q_body, v_body, f.segment(entry.v0, entry.nv));
  }
  returned();
  mass_fresh = bodies_fresh = true;
}

void AssembledSystem::Work::evaluate_mass() {
  if (!mass_fresh) evaluate_bodies();
}

const Vec& AssembledSystem::Work::force() {
  if (force_fresh) return f;
  if (!bodies_fresh) evaluate_bodies();
  const int twist = twist_size(model->world.space);
  for (std::size_t i = 0; i < force_slots.size(); ++i) {
    const auto [A, B] = force_slots[i];
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
    if (surfaces[i]) {
      const SurfaceContact& pressed = surface(i);
      chain.add_wrench(contact_slots[i].A, pressed.on_sphere(), 1, f);
      pressed.add_force(f);
      continue;
    }
    const Rows& r = contact(int(i));
    const auto [A, B] = contact_slots[i];
    const double rate = contact_rate(int(i), 0);
    called(model->contacts[i].name, "normal");
    const double N = law->normal(r.g(0), rate, modes.contacts[i].approach_speed);
    chain.add_wrench(A, r.H_A.row(0).transpose(), N, f);
    chain.add_wrench(B, r.H_B.row(0).transpose(), N, f);
    if (const double ratio = friction_ratio(int(i)); ratio != 0) {
      chain.add_wrench(A, r.H_A.row(1).transpose(), ratio * N, f);
      chain.add_wrench(B, r.H_B.row(1).transpose(), ratio * N, f);
    }
  }
  returned();
  force_fresh = true;
  return f;
}

const Rows& AssembledSystem::Work::contact(int i) {
  ContactRows& cache = contact_rows[std::size_t(i)];
  if (cache.point != point) {
    const auto [A, B] = contact_slots[std::size_t(i)];
    called(model->contacts[std::size_t(i)].name, "motion");
    const ContactEntry& entry = model->contacts[std::size_t(i)];
    const bool tangents = entry.friction != nullptr;
    cache.rows.resize(tangents ? dimension(model->world.space) : 1, model->world.space);
    if (entry.surface) {
      const double thick = model->bodies[std::size_t(entry.surface->body)].surface->half_thickness();
      const Motion& sphere = motion(A);
      surface_row(entry.geometry.radius + thick, sphere, chain.nearest(B, sphere.x, t, q, v), cache.rows);
    } else {
      model::contact_rows(entry.geometry, motion(A), motion(B), tangents, cache.rows);
    }
    returned();
    cache.point = point;
  }
  return cache.rows;
}

SurfaceContact& AssembledSystem::Work::surface(std::size_t i) {
  Pressed& pressed = *surfaces[i];
  if (pressed.point != point) {
    called(model->contacts[i].name, "normal");
    pressed.contact.evaluate(motion(contact_slots[i].A), q, v, modes.contacts[i].approach_speed);
    returned();
    pressed.point = point;
  }
  return pressed.contact;
}

double AssembledSystem::Work::contact_rate(int i, int row) {
  const Rows& r = contact(i);
  const auto [A, B] = contact_slots[std::size_t(i)];
  return r.H_A.row(row).dot(motion(A).V) + r.H_B.row(row).dot(motion(B).V);
}

double AssembledSystem::Work::friction_ratio(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  const ContactMode& mode = modes.contacts[std::size_t(i)];
  if (entry.coulomb) {
    if (mode.friction != ContactMode::Friction::slide) return 0;
    return -mode.direction * entry.coulomb->kinetic_coefficient(std::abs(contact_rate(i, 1)));
  }
  if (!entry.smooth) return 0;
  const double slip = contact_rate(i, 1);
  return std::copysign(entry.smooth->ratio(std::abs(slip)), -slip);
}

double AssembledSystem::Work::friction_damping(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  return entry.smooth ? entry.smooth->slope(std::abs(contact_rate(i, 1))) : 0;
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
  // Rows first .. first + n - 1 of r become rows `row` and on.
  const auto place = [&](const Rows& r, Pair pair, int row, Eigen::Index first, Eigen::Index n) {
    const Motion &A = motion(pair.A), &B = motion(pair.B);
    for (Eigen::Index i = 0; i < n; ++i) {
      double rate = r.g_t(first + i), free = r.gamma(first + i);
      for (Eigen::Index k = 0; k < A.V.size(); ++k) {
        const double a = r.H_A(first + i, k), b = r.H_B(first + i, k);
        rate += a * A.V(k) + b * B.V(k);
        free -= a * A.bias(k) + b * B.bias(k);
      }
      g(row + i) = r.g(first + i);
      g_dot(row + i) = rate;
      gamma(row + i) = free;
    }
    const Mat6 H_A = r.H_A.middleRows(first, n), H_B = r.H_B.middleRows(first, n);
    add_rows(pair.A, row, H_A);
    add_rows(pair.B, row, H_B);
  };
  for (std::size_t i = 0; i < joint_slots.size(); ++i) {
    const JointEntry& entry = model->joints[i];
    called(entry.name, "rows");
    rows.resize(entry.rows, model->world.space);
    entry.joint->rows(t, motion(joint_slots[i].A), motion(joint_slots[i].B), rows);
    place(rows, joint_slots[i], entry.row, 0, entry.rows);
  }
  coupled = false;
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (const int row = contact_row[i]; row >= 0) {
      place(contact(int(i)), contact_slots[i], row, 0, 1);
      g(row) -= modes.contacts[i].offset;
      coupled = coupled || friction_ratio(int(i)) != 0;
    }
    if (const int row = stick_row[i]; row >= 0) {
      place(contact(int(i)), contact_slots[i], row, 1, contact(int(i)).g.size() - 1);
      g(row) -= modes.contacts[i].anchor;
    }
  }
  if (coupled) couple_reactions();
  returned();
  rows_fresh = true;
}

void AssembledSystem::Work::add_rows(int slot, int row, const Mat6& H) {
  if (blocks)
    blocks->add_rows(chain.body(slot), row, motion(slot), H);
  else
    chain.add_rows(slot, row, H, G);
}

// W: where a contact slides, the friction beside the force of its row.
void AssembledSystem::Work::couple_reactions() {
  const auto add_friction = [this](int slot, int row, const Mat6& H) {
    if (blocks)
      blocks->add_reaction(chain.body(slot), row, motion(slot), H);
    else
      chain.add_rows(slot, row, H, W);
  };
  if (blocks)
    blocks->couple();
  else
    W = G;
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (contact_row[i] < 0) continue;
    const double ratio = friction_ratio(int(i));
    if (ratio == 0) continue;
    const Rows& r = contact(int(i));
    add_friction(contact_slots[i].A, contact_row[i], ratio * r.H_A.row(1));
    add_friction(contact_slots[i].B, contact_row[i], ratio * r.H_B.row(1));
  }
}

namespace {

// H^T lambda as wrenches on both markers.
class JointReaction final : public PairWrench {
 public:
  JointReaction(const JointEntry& entry, double t, const Vec& lambda, Space space)
      : entry_(entry), t_(t), lambda_(lambda), space_(space) {}
  void operator()(const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    Rows rows;
    rows.resize(entry_.rows, space_);
    entry_.joint->rows(t_, A, B, rows);
    on_A = rows.H_A.transpose() * lambda_.segment(entry_.row, entry_.rows);
    on_B = rows.H_B.transpose() * lambda_.segment(entry_.row, entry_.rows);
  }
  bool depends_on_velocity() const override { return false; }

 private:
  const JointEntry& entry_;
  double t_;
  const Vec& lambda_;
  Space space_;
};

class ForceWrench final : public PairWrench {
 public:
  ForceWrench(const Force& force, double t) : force_(force), t_(t) {}
  void operator()(const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    force_.wrench(t_, A, B, on_A, on_B);
  }
  bool depends_on_velocity() const override { return true; }

 private:
  const Force& force_;
  double t_;
};

}  // namespace

// S += c_m M + c_d D + c_k K + c_1 1, D and K of M a - f + W^T lambda.
void AssembledSystem::Work::add_tangent(Blend c, const Vec& a, const Vec& lambda, Mat& S) {
  ++counts.jacobian_evaluations;
  if (c.c_1 != 0) S.diagonal().head(sizes.nv).array() += c.c_1;
  const Matrix whole = Matrix::onto(S);
  for (const BodyEntry& entry : model->bodies) {
    Matrix target = whole.from(entry.v0, entry.v0);
    called(entry.name, "tangent");
    const auto q_body = q.segment(entry.q0, entry.nq);
    const auto v_body = v.segment(entry.v0, entry.nv);
    const auto a_body = a.segment(entry.v0, entry.nv);
    if (carried_stress && entry.carried_stress && c.c_m == 0 && c.c_d == 0) {
      entry.carried_stress->add_tangent_with_stress_from(t, q_body, carried_stress->q.segment(entry.q0, entry.nq),
                                                         carried_stress->dq.segment(entry.v0, entry.nv), c.c_k, target);
      continue;
    }
    if (entry.tangent) {
      entry.tangent->add_tangent(t, q_body, v_body, a_body, c, target);
      continue;
    }
    entry.body->mass(t, q_body, target);
    if (c.c_m != 1) {
      Mat M_body = Mat::Zero(entry.nv, entry.nv);
      Matrix alone = Matrix::onto(M_body);
      entry.body->mass(t, q_body, alone);
      target.add(0, 0, M_body, c.c_m - 1);
    }
    Mat block;
    if (c.c_d != 0) {
      velocity_differences(
          v_body,
          [&](const Vec& moved, Vec& out) {
            out.setZero(entry.nv);
            entry.body->force(t, q_body, moved, out);
          },
          block);
      target.add(0, 0, block, -c.c_d);
    }
    if (c.c_k != 0) {
      Mat M_body;
      tangent_differences(
          entry, q_body,
          [&](const Vec& moved, Vec& out) {
            out.setZero(entry.nv);
            entry.body->force(t, moved, v_body, out);
            M_body.setZero(entry.nv, entry.nv);
            Matrix alone = Matrix::onto(M_body);
            entry.body->mass(t, moved, alone);
            out = M_body * a_body - out;
          },
          block);
      target.add(0, 0, block, c.c_k);
    }
  }
  for (std::size_t i = 0; i < force_slots.size(); ++i) {
    called(model->forces[i].name, "wrench");
    add_pair_tangent(chain, force_slots[i].A, force_slots[i].B, t, q, v, ForceWrench(*model->forces[i].force, t),
                     -c.c_k, -c.c_d, S);
  }
  for (std::size_t i = 0; i < joint_slots.size() && c.c_k != 0; ++i) {
    called(model->joints[i].name, "rows");
    if (model->joints[i].tangent) {
      add_exact_reaction(i, lambda, c.c_k, S);
      continue;
    }
    add_pair_tangent(chain, joint_slots[i].A, joint_slots[i].B, t, q, v,
                     JointReaction(model->joints[i], t, lambda, model->world.space), c.c_k, 0, S);
  }
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (!modes.contacts[i].closed) continue;
    if (surfaces[i]) {
      const SurfaceContact& pressed = surface(i);
      pressed.add_tangent(chain, contact_slots[i].A, c.c_k, c.c_d, S);
      if (c.c_k != 0) chain.add_reaction_derivative(contact_slots[i].A, t, q, -pressed.on_sphere(), c.c_k, S);
      continue;
    }
    const auto [A, B] = contact_slots[i];
    const Rows& r = contact(int(i));
    const double ratio = friction_ratio(int(i));
    // Force of the contact per unit of pressure, along the normal and beside it.
    Wrench push_A = r.H_A.row(0), push_B = r.H_B.row(0);
    if (ratio != 0) push_A += ratio * r.H_A.row(1).transpose(), push_B += ratio * r.H_B.row(1).transpose();
    const auto add = [&](int row, double weight, const Wrench& w_A, const Wrench& w_B) {
      chain.add_pair(A, A, w_A * r.H_A.row(row), weight, S), chain.add_pair(A, B, w_A * r.H_B.row(row), weight, S);
      chain.add_pair(B, A, w_B * r.H_A.row(row), weight, S), chain.add_pair(B, B, w_B * r.H_B.row(row), weight, S);
    };
    double pull = 0;  // W^T lambda of the row, or -f of the law
    if (contact_row[i] >= 0) {
      pull = lambda(contact_row[i]);
    } else {
      const double rate = contact_rate(int(i), 0), approach = modes.contacts[i].approach_speed;
      const ContactForce* law = model->contacts[i].force;
      pull = -law->normal(r.g(0), rate, approach);
      const auto [by_gap, by_rate] = law->slope(r.g(0), rate, approach);
      add(0, -(c.c_k * by_gap + c.c_d * by_rate), push_A, push_B);
    }
    if (const double damping = c.c_d * -pull * friction_damping(int(i)); damping != 0)
      add(1, damping, r.H_A.row(1), r.H_B.row(1));
    if (c.c_k == 0) continue;
    push_A *= pull, push_B *= pull;
    if (const int row = stick_row[i]; row >= 0)
      push_A += lambda(row) * r.H_A.row(1).transpose(), push_B += lambda(row) * r.H_B.row(1).transpose();
    chain.add_reaction_derivative(A, t, q, push_A, c.c_k, S);
    chain.add_reaction_derivative(B, t, q, push_B, c.c_k, S);
  }
  returned();
}

// S += c d(G^T lambda)/dq of a joint that knows how its wrenches turn with the markers.
void AssembledSystem::Work::add_exact_reaction(std::size_t joint, const Vec& lambda, double c, Mat& S) {
  const JointEntry& entry = model->joints[joint];
  const auto [slot_A, slot_B] = joint_slots[joint];
  const Motion &A = motion(slot_A), &B = motion(slot_B);
  const Vec6 own = lambda.segment(entry.row, entry.rows);
  const auto twist = A.V.size();
  for (Mat6* block : {&wrench_by.AA, &wrench_by.AB, &wrench_by.BA, &wrench_by.BB}) block->setZero(twist, twist);
  entry.tangent->add_reaction_tangent(t, A, B, own, wrench_by);
  chain.add_pair(slot_A, slot_A, wrench_by.AA, c, S);
  chain.add_pair(slot_A, slot_B, wrench_by.AB, c, S);
  chain.add_pair(slot_B, slot_A, wrench_by.BA, c, S);
  chain.add_pair(slot_B, slot_B, wrench_by.BB, c, S);
  rows.resize(entry.rows, model->world.space);
  entry.joint->rows(t, A, B, rows);
  chain.add_reaction_derivative(slot_A, t, q, rows.H_A.transpose() * own, c, S);
  chain.add_reaction_derivative(slot_B, t, q, rows.H_B.transpose() * own, c, S);
}

}  // namespace trammel::model
