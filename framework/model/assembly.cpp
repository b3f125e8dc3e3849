#include "model/assembly.hpp"

#include <algorithm>

#include "model/numeric_derivative.hpp"

namespace trammel::model {

namespace {

// The wrench of a contact on one of its markers: `normal` along its normal and `friction` along its tangents.
Wrench pressed_by(const Mat6& H, double normal, const Tangential& friction) {
  Wrench wrench = normal * H.row(0).transpose();
  for (Eigen::Index k = 0; k + 1 < H.rows(); ++k)
    if (friction[k] != 0) wrench += friction[k] * H.row(k + 1).transpose();
  return wrench;
}

}  // namespace

AssembledSystem::Work::Work(std::shared_ptr<const Model> m, Storage how)
    : model(std::move(m)), storage(how), chain(*model) {
  if (storage == Storage::blocks || (storage == Storage::automatic && BodyBlocks::worthwhile(*model)))
    blocks.emplace(*model);
  const auto slots_of = [this](const std::vector<MarkerRef>& markers) {
    Slots at{.count = int(markers.size())};
    int* const each[] = {&at.A, &at.B, &at.C, &at.D};
    for (std::size_t k = 0; k < markers.size(); ++k) *each[k] = chain.slot(markers[k]);
    return at;
  };
  for (const JointEntry& entry : model->joints) joint_slots.push_back(slots_of(entry.markers));
  for (const ForceEntry& entry : model->forces) force_slots.push_back(slots_of({entry.A, entry.B}));
  for (const ContactEntry& entry : model->contacts) {
    if (entry.limit)
      contact_slots.push_back(slots_of(entry.limit->markers));
    else if (entry.surface)
      contact_slots.push_back({.A = chain.slot(entry.A), .B = chain.surface_slot(entry.surface->body)});
    else
      contact_slots.push_back(slots_of({entry.A, entry.B}));
    surfaces.emplace_back();
    if (entry.surface) surfaces.back().emplace(Pressed{SurfaceContact(*model, entry)});
  }
  contact_rows.resize(model->contacts.size());
  modes.contacts.resize(model->contacts.size());
  contact_row.assign(model->contacts.size(), -1);
  stick_row.assign(model->contacts.size(), -1);
  sizes = model->sizes;
  held_rows = sizes.nc;
  lay_out_blocks();
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
    if (surfaces[i]) {
      const SurfaceContact& pressed = surface(i);
      chain.add_wrench(contact_slots[i].A, pressed.on_sphere(), 1, f);
      pressed.add_force(f);
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

const Rows& AssembledSystem::Work::contact(int i) {
  ContactRows& cache = contact_rows[std::size_t(i)];
  if (cache.point != point) {
    const Slots& at = contact_slots[std::size_t(i)];
    const int A = at.A, B = at.B;
    called(model->contacts[std::size_t(i)].name, "motion");
    const ContactEntry& entry = model->contacts[std::size_t(i)];
    const bool tangents = entry.friction != nullptr;
    cache.rows.resize(tangents ? dimension(model->world.space) : 1, model->world.space);
    if (entry.limit) {
      evaluate_constraint(*entry.limit->joint, at, cache.rows);
      if (const double side = entry.limit->side; side != 1) {
        for (Vec6* each : {&cache.rows.g, &cache.rows.g_t, &cache.rows.gamma}) *each *= side;
        for (int k = 0; k < at.count; ++k) cache.rows.H(k) *= side;
      }
    } else if (entry.surface) {
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
  const Slots& at = contact_slots[std::size_t(i)];
  double rate = r.g_t(row);
  for (int k = 0; k < at.count; ++k) rate += r.H(k).row(row).dot(motion(at[k]).V);
  return rate;
}

Tangential AssembledSystem::Work::slip(int i) {
  Tangential s = Tangential::Zero();
  for (int k = 0; k < tangents(); ++k) s[k] = contact_rate(i, 1 + k);
  return s;
}

SlipDirection AssembledSystem::Work::slip_direction(int i) {
  const ContactMode& mode = modes.contacts[std::size_t(i)];
  return {slip(i), mode.direction, mode.slow};
}

Tangential AssembledSystem::Work::friction_ratio(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  const ContactMode& mode = modes.contacts[std::size_t(i)];
  if (entry.coulomb && mode.friction == ContactMode::Friction::slide) {
    const Tangential s = slip(i);
    return -entry.coulomb->kinetic_coefficient(s.norm()) * SlipDirection(s, mode.direction, mode.slow).unit();
  }
  if (!entry.smooth) return Tangential::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm();
  return speed > 0 ? Tangential(-entry.smooth->ratio(speed) * (s / speed)) : Tangential(Tangential::Zero());
}

Eigen::Matrix2d AssembledSystem::Work::friction_damping(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  if (entry.coulomb) {
    if (tangents() == 1 || modes.contacts[std::size_t(i)].friction != ContactMode::Friction::slide)
      return Eigen::Matrix2d::Zero();
    return entry.coulomb->kinetic_coefficient(slip(i).norm()) * slip_direction(i).slope();
  }
  if (!entry.smooth) return Eigen::Matrix2d::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm(), slope = entry.smooth->slope(speed);
  if (speed == 0) return slope * Eigen::Matrix2d::Identity();
  const Tangential e = s / speed;
  const double turning = entry.smooth->ratio(speed) / speed;
  return turning * Eigen::Matrix2d::Identity() + (slope - turning) * e * e.transpose();
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
  const auto place = [&](const Rows& r, const Slots& at, int row, Eigen::Index first, Eigen::Index n) {
    for (Eigen::Index i = 0; i < n; ++i) {
      double rate = r.g_t(first + i), free = r.gamma(first + i);
      for (int marker = 0; marker < at.count; ++marker) {
        const Motion& m = motion(at[marker]);
        const Mat6& H = r.H(marker);
        for (Eigen::Index k = 0; k < m.V.size(); ++k) {
          rate += H(first + i, k) * m.V(k);
          free -= H(first + i, k) * m.bias(k);
        }
      }
      g(row + i) = r.g(first + i);
      g_dot(row + i) = rate;
      gamma(row + i) = free;
    }
    for (int marker = 0; marker < at.count; ++marker) {
      const Mat6 H = r.H(marker).middleRows(first, n);
      add_rows(at[marker], row, H);
    }
  };
  for (const BodyEntry& entry : model->bodies)
    if (entry.rows > 0) evaluate_own_rows(entry);
  for (std::size_t i = 0; i < joint_slots.size(); ++i) {
    const JointEntry& entry = model->joints[i];
    called(entry.name, "rows");
    evaluate_constraint(*entry.joint, joint_slots[i], rows);
    place(rows, joint_slots[i], entry.row, 0, entry.rows);
  }
  coupled = false;
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (const int row = contact_row[i]; row >= 0) {
      place(contact(int(i)), contact_slots[i], row, 0, 1);
      g(row) -= modes.contacts[i].offset;
      coupled = coupled || friction_ratio(int(i)) != Tangential::Zero();
    }
    if (const int row = stick_row[i]; row >= 0) {
      place(contact(int(i)), contact_slots[i], row, 1, tangents());
      g.segment(row, tangents()) = displacement(int(i)).head(tangents());
    }
  }
  if (coupled) couple_reactions();
  returned();
  rows_fresh = true;
}

void AssembledSystem::Work::evaluate_own_rows(const BodyEntry& entry) {
  called(entry.name, "own_rows");
  const auto v_body = v.segment(entry.v0, entry.nv);
  own_rows.resize(entry.rows, entry.nv);
  entry.constrained->own_rows(t, q.segment(entry.q0, entry.nq), v_body, own_rows);
  g.segment(entry.row, entry.rows) = own_rows.g;
  g_dot.segment(entry.row, entry.rows).noalias() = own_rows.G * v_body + own_rows.g_t;
  gamma.segment(entry.row, entry.rows) = own_rows.gamma;
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
    const Tangential ratio = friction_ratio(int(i));
    if (ratio == Tangential::Zero()) continue;
    const Rows& r = contact(int(i));
    add_friction(contact_slots[i].A, contact_row[i], pressed_by(r.H_A, 0, ratio).transpose());
    add_friction(contact_slots[i].B, contact_row[i], pressed_by(r.H_B, 0, ratio).transpose());
  }
}

namespace {

// H^T lambda as wrenches on the markers.
class Reaction final : public MarkerWrenches {
 public:
  Reaction(const Constraint& constraint, double t, const Vec6& lambda, Space space)
      : constraint_(constraint), t_(t), lambda_(lambda), space_(space) {}
  void operator()(Motions markers, std::span<Wrench> on) const override {
    Rows rows;
    rows.resize(int(lambda_.size()), space_, int(markers.size()));
    constraint_.rows_between(t_, markers, rows);
    for (std::size_t k = 0; k < on.size(); ++k) on[k] = rows.H(int(k)).transpose() * lambda_;
  }
  bool depends_on_velocity() const override { return false; }

 private:
  const Constraint& constraint_;
  double t_;
  const Vec6& lambda_;
  Space space_;
};

class ForceWrench final : public MarkerWrenches {
 public:
  ForceWrench(const Force& force, double t) : force_(force), t_(t) {}
  void operator()(Motions markers, std::span<Wrench> on) const override {
    force_.wrench(t_, *markers[0], *markers[1], on[0], on[1]);
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
    if (entry.rows > 0 && c.c_k != 0)
      entry.constrained->add_own_rows_derivative(t, q_body, lambda.segment(entry.row, entry.rows), c.c_k, target);
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
    const std::array<int, 2> both = {force_slots[i].A, force_slots[i].B};
    add_wrench_tangent(chain, both, t, q, v, ForceWrench(*model->forces[i].force, t), -c.c_k, -c.c_d, S);
  }
  for (std::size_t i = 0; i < joint_slots.size() && c.c_k != 0; ++i) {
    const JointEntry& entry = model->joints[i];
    called(entry.name, "rows");
    add_reaction_of(*entry.joint, entry.tangent, joint_slots[i], lambda.segment(entry.row, entry.rows), c.c_k, S);
  }
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (!modes.contacts[i].closed) continue;
    if (surfaces[i]) {
      const SurfaceContact& pressed = surface(i);
      pressed.add_tangent(chain, contact_slots[i].A, c.c_k, c.c_d, S);
      if (c.c_k != 0) chain.add_reaction_derivative(contact_slots[i].A, t, q, -pressed.on_sphere(), c.c_k, S);
      continue;
    }
    const Slots& at = contact_slots[i];
    const Rows& r = contact(int(i));
    const Tangential ratio = friction_ratio(int(i));
    // Force of the contact per unit of pressure, along the normal and beside it.
    std::array<Wrench, Rows::most_markers> push;
    for (int k = 0; k < at.count; ++k) push[std::size_t(k)] = pressed_by(r.H(k), 1, ratio);
    const auto add = [&](int row, double weight, auto&& along) {
      for (int k = 0; k < at.count; ++k)
        for (int l = 0; l < at.count; ++l) chain.add_pair(at[k], at[l], along(k) * r.H(l).row(row), weight, S);
    };
    double pull = 0;  // W^T lambda of the row, or -f of the law
    if (contact_row[i] >= 0) {
      pull = lambda(contact_row[i]);
    } else {
      const double rate = contact_rate(int(i), 0), approach = modes.contacts[i].approach_speed;
      const ContactForce* law = model->contacts[i].force;
      pull = -law->normal(r.g(0), rate, approach);
      const auto [by_gap, by_rate] = law->slope(r.g(0), rate, approach);
      add(0, -(c.c_k * by_gap + c.c_d * by_rate), [&](int k) -> const Wrench& { return push[std::size_t(k)]; });
    }
    const Eigen::Matrix2d damping = c.c_d * -pull * friction_damping(int(i));
    for (int m = 0; m < tangents(); ++m)
      for (int n = 0; n < tangents(); ++n)
        if (damping(m, n) != 0) add(1 + n, damping(m, n), [&](int k) -> Wrench { return r.H(k).row(1 + m); });
    if (c.c_k == 0) continue;
    if (const auto& limit = model->contacts[i].limit) {
      add_reaction_of(*limit->joint, limit->tangent, at, Vec6::Constant(1, limit->side * pull), c.c_k, S);
      continue;
    }
    for (int k = 0; k < at.count; ++k) {
      Wrench& w = push[std::size_t(k)];
      w *= pull;
      if (const int row = stick_row[i]; row >= 0)
        for (int m = 0; m < tangents(); ++m) w += lambda(row + m) * r.H(k).row(1 + m).transpose();
      chain.add_reaction_derivative(at[k], t, q, w, c.c_k, S);
    }
  }
  returned();
}

void AssembledSystem::Work::add_reaction_of(const Constraint& constraint, const ReactionTangent* exact, const Slots& at,
                                            const Vec6& lambda, double c, Mat& S) {
  if (!exact) {
    const std::array<int, Rows::most_markers> slots = {at.A, at.B, at.C, at.D};
    const Reaction reaction(constraint, t, lambda, model->world.space);
    return add_wrench_tangent(chain, std::span(slots).first(std::size_t(at.count)), t, q, v, reaction, c, 0, S);
  }
  const Motion &A = motion(at.A), &B = motion(at.B);
  const auto twist = A.V.size();
  for (Mat6* block : {&wrench_by.AA, &wrench_by.AB, &wrench_by.BA, &wrench_by.BB}) block->setZero(twist, twist);
  exact->add_reaction_tangent(t, A, B, lambda, wrench_by);
  chain.add_pair(at.A, at.A, wrench_by.AA, c, S);
  chain.add_pair(at.A, at.B, wrench_by.AB, c, S);
  chain.add_pair(at.B, at.A, wrench_by.BA, c, S);
  chain.add_pair(at.B, at.B, wrench_by.BB, c, S);
  evaluate_constraint(constraint, at, rows);
  chain.add_reaction_derivative(at.A, t, q, rows.H_A.transpose() * lambda, c, S);
  chain.add_reaction_derivative(at.B, t, q, rows.H_B.transpose() * lambda, c, S);
}

}  // namespace trammel::model
