#include <cmath>

#include "system/assembly.hpp"

namespace trammel::model {

Energy AssembledSystem::energy() {
  Work& w = *work_;
  Energy sum;
  for (const BodyEntry& entry : w.model->bodies) {
    w.called(entry.origin, "energy");
    const Energy e = entry.body->energy(w.t, w.q.segment(entry.q0, entry.nq), w.v.segment(entry.v0, entry.nv));
    sum.kinetic += e.kinetic;
    sum.potential += e.potential;
    sum.elastic += e.elastic;
  }
  for (std::size_t i = 0; i < w.force_slots.size(); ++i) {
    const int A = w.force_slots[i].A, B = w.force_slots[i].B;
    w.called(w.model->forces[i].origin, "potential");
    sum.elastic += w.model->forces[i].force->potential(w.t, w.motion(A), w.motion(B));
  }
  for (std::size_t i = 0; i < w.contact_slots.size(); ++i)
    if (w.model->contacts[i].force && w.modes.contacts[i].closed) {
      w.called(w.model->contacts[i].origin, "potential");
      sum.elastic += w.on_surface(i) ? w.surface(i).sums().potential
                                     : w.model->contacts[i].force->potential(w.contact(int(i)).g(0));
    }
  w.returned();
  return sum;
}

namespace {

// w . V_t: the power of a wrench on a marker with the motion V_t = V - J v prescribed by a law of time, which is no
// power on coordinates. A remainder of V at round-off counts as 0.
double power_of_law(const Motion& marker, const Vec& v, int v0, const Wrench& wrench) {
  double power = 0;
  const Eigen::Index columns = marker.J.cols();
  with_twist(marker.V.size(), [&](auto twist) {
    for (int i = 0; i < twist; ++i) {
      double V_t = marker.V.data()[i], size = std::abs(V_t);
      for (Eigen::Index j = 0; j < columns; ++j) {
        const double part = marker.J.data()[i * columns + j] * v(v0 + marker.dofs[std::size_t(j)]);
        V_t -= part, size += std::abs(part);
      }
      if (std::abs(V_t) > 1e-14 * size) power += wrench.data()[i] * V_t;
    }
  });
  return power;
}

}  // namespace

// Along the motion d(energy)/dt equals the power of all wrenches on coordinates. Their power on markers with V_t (a
// base that follows a law) leaves the system there and counts as supplied with the opposite sign.
const AssembledSystem::Balance& AssembledSystem::balance(const Vec& lambda) {
  Work& w = *work_;
  Balance& sum = w.power;
  sum.drives = sum.dampers = sum.contacts = sum.constraints = sum.markers = 0;
  sum.friction.setZero(Eigen::Index(w.contact_slots.size()));
  const auto may_follow_law = [&](int slot) { return w.chain.body(slot) >= 0 && !w.chain.linear(slot); };
  const auto moved_by_law = [&](int slot, const Wrench& wrench) {
    if (may_follow_law(slot)) sum.markers -= power_of_law(w.motion(slot), w.v, w.chain.first_velocity(slot), wrench);
  };
  for (const BodyEntry& entry : w.model->bodies) {
    w.called(entry.origin, "power");
    const Power p = entry.body->power(w.t, w.q.segment(entry.q0, entry.nq), w.v.segment(entry.v0, entry.nv));
    sum.drives += p.supplied;
    sum.dampers += p.dissipated;
  }
  for (std::size_t i = 0; i < w.force_slots.size(); ++i) {
    const int A = w.force_slots[i].A, B = w.force_slots[i].B;
    w.called(w.model->forces[i].origin, "power");
    const Power p = w.model->forces[i].force->power(w.t, w.motion(A), w.motion(B));
    sum.drives += p.supplied;
    sum.dampers += p.dissipated;
    if (!may_follow_law(A) && !may_follow_law(B)) continue;
    w.called(w.model->forces[i].origin, "wrench");
    w.on_A.setZero(twist_size(w.model->world.space));
    w.on_B.setZero(twist_size(w.model->world.space));
    w.model->forces[i].force->wrench(w.t, w.motion(A), w.motion(B), w.on_A, w.on_B);
    moved_by_law(A, w.on_A);
    moved_by_law(B, w.on_B);
  }
  if (!w.judged.empty()) {
    Vec a, unused;
    accelerate({}, a, unused);
  }
  for (std::size_t i = 0; i < w.contact_slots.size(); ++i) {
    if (!w.modes.contacts[i].closed) continue;
    if (w.on_surface(i)) {
      const SurfaceContact& pressed = w.surface(i);
      sum.contacts += pressed.sums().damping;
      sum.friction(Eigen::Index(i)) = pressed.sums().friction;
      if (const auto marker = pressed.on_marker()) moved_by_law(marker->slot, marker->wrench);
      continue;
    }
    const Rows& r = w.contact(int(i));
    const Tangential ratio = w.friction_ratio(int(i));
    const Tangential slip = w.model->contacts[i].friction ? w.slip(int(i)) : Tangential(Tangential::Zero());
    if (w.model->contacts[i].restitution) {
      // The power of its rows, below, is its whole power except for sliding friction.
      sum.friction(Eigen::Index(i)) = -w.loads.spring({int(i), 0}, lambda) * ratio.dot(slip);
      continue;
    }
    if (w.in_joint(int(i))) {  // likewise
      sum.friction(Eigen::Index(i)) = -w.bearing_load(int(i), lambda) * ratio.dot(slip);
      continue;
    }
    const ContactForce* law = w.model->contacts[i].force;
    const double gap = r.g(0), rate = gap_rate(int(i)), approach = w.modes.contacts[i].approach_speed;
    w.called(w.model->contacts[i].origin, "normal");
    // What the law gives beyond its elastic part, which is its value at rest.
    const double normal = law->normal(gap, rate, approach);
    sum.contacts -= (normal - law->normal(gap, 0, approach)) * rate;
    const Tangential friction = ratio * normal + w.judged_friction.col(Eigen::Index(i));
    sum.friction(Eigen::Index(i)) = -friction.dot(slip);
    const auto& at = w.contact_slots[i];
    for (int k = 0; k < at.count; ++k) {
      moved_by_law(at[k], pressed_by(r.H(k), normal, friction));
    }
  }
  if (w.sizes.nc > 0) {
    w.evaluate_rows();
    Vec& reaction = w.right;
    reaction.setZero(w.sizes.nv);
    w.add_reaction(1, lambda, reaction);
    sum.constraints = -reaction.dot(w.v);
    // Rows of joints and bodies supply lambda . g_t; their power on velocities that violate them is an error of the
    // method.
    sum.constraints += lambda.head(w.held_rows).dot(w.g_dot.head(w.held_rows));
    for (std::size_t i = 0; i < w.contact_slots.size(); ++i)
      if (!w.model->contacts[i].force) sum.constraints += sum.friction(Eigen::Index(i));
  }
  w.returned();
  return sum;
}

namespace {

bool rubs(const ContactEntry& entry, const ContactMode& mode) {
  const bool on_surface = entry.surface && entry.surface->friction;
  return mode.closed && (entry.friction || on_surface) && mode.friction != ContactMode::Friction::stick;
}

}  // namespace

bool AssembledSystem::rubs() const {
  for (std::size_t i = 0; i < work_->modes.contacts.size(); ++i)
    if (model::rubs(work_->model->contacts[i], work_->modes.contacts[i])) return true;
  return false;
}

bool AssembledSystem::rubs_by_reactions() const {
  for (std::size_t i = 0; i < work_->modes.contacts.size(); ++i)
    if (!work_->model->contacts[i].force && model::rubs(work_->model->contacts[i], work_->modes.contacts[i]))
      return true;
  return false;
}

CallSite AssembledSystem::find_not_finite() {
  Work& w = *work_;
  for (const BodyEntry& entry : w.model->bodies) {
    const auto q = w.q.segment(entry.q0, entry.nq);
    const auto v = w.v.segment(entry.v0, entry.nv);
    Vec f = Vec::Zero(entry.nv);
    entry.body->force(w.t, q, v, f);
    if (!f.allFinite()) return {&entry.origin, "force"};
    numerics::SparseSum M;
    Matrix target = Matrix::onto(M);
    M.fill(entry.nv, [&] { entry.body->mass(w.t, q, target); });
    if (!M.matrix().coeffs().allFinite()) return {&entry.origin, "mass"};
    if (entry.rows == 0) continue;
    w.own_rows.resize(entry.rows, entry.nv);
    entry.constrained->own_rows(w.t, q, v, w.own_rows);
    if (!w.own_rows.g.allFinite() || !w.own_rows.G.allFinite() || !w.own_rows.gamma.allFinite())
      return {&entry.origin, "own_rows"};
  }
  for (int slot = 0; slot < w.chain.slots(); ++slot) {
    if (w.chain.body(slot) < 0 || w.chain.on_surface(slot)) continue;
    const Motion& m = w.motion(slot);
    if (!m.x.allFinite() || !m.V.allFinite() || !m.bias.allFinite() || !m.J.allFinite())
      return {&w.model->bodies[std::size_t(w.chain.body(slot))].origin, "motion"};
  }
  for (std::size_t i = 0; i < w.force_slots.size(); ++i) {
    const int A = w.force_slots[i].A, B = w.force_slots[i].B;
    const int twist = twist_size(w.model->world.space);
    w.on_A.setZero(twist);
    w.on_B.setZero(twist);
    w.model->forces[i].force->wrench(w.t, w.motion(A), w.motion(B), w.on_A, w.on_B);
    if (!w.on_A.allFinite() || !w.on_B.allFinite()) return {&w.model->forces[i].origin, "wrench"};
  }
  for (std::size_t i = 0; i < w.joint_slots.size(); ++i) {
    const JointEntry& entry = w.model->joints[i];
    w.evaluate_constraint(*entry.joint, entry.rows, w.motions(w.joint_slots[i]), w.joint_slots[i].count, w.rows);
    if (!w.rows.g.allFinite() || !w.rows.gamma.allFinite()) return {&entry.origin, "rows"};
    for (int k = 0; k < w.joint_slots[i].count; ++k)
      if (!w.rows.H(k).allFinite()) return {&entry.origin, "rows"};
  }
  for (const Work::Bearing& b : w.bearings) {
    const Rows& slip = w.contact(b.contact);
    if (!slip.g.allFinite() || !slip.gamma.allFinite() || !slip.H_A.allFinite() || !slip.H_B.allFinite())
      return {&w.joint_of(b.contact).origin, "slip_row"};
    if (!w.bearing(b.contact).loads.allFinite()) return {&w.joint_of(b.contact).origin, "bearings"};
  }
  return {};
}

}  // namespace trammel::model
