#include <cmath>

#include "system/parts.hpp"

namespace trammel::model {

Energy AssembledSystem::energy() {
  Point& at = parts_->at;
  ContactsAtPoint& contacts = parts_->contacts;
  Energy sum;
  for (const BodyEntry& entry : model().bodies) {
    at.called(entry.origin, "energy");
    const Energy e = entry.body->energy(at.t, at.q_of(entry), at.v_of(entry));
    sum.kinetic += e.kinetic;
    sum.potential += e.potential;
    sum.elastic += e.elastic;
  }
  for (std::size_t i = 0; i < at.forces.size(); ++i) {
    const ForceEntry& entry = model().forces[i];
    at.called(entry.origin, "potential");
    sum.elastic += entry.force->potential(at.t, at.motion(at.forces[i].A), at.motion(at.forces[i].B));
  }
  for (int i = 0; i < contacts.count(); ++i) {
    const ContactForce* law = contacts.entry(i).force;
    if (!law || !contacts.mode(i).closed) continue;
    at.called(contacts.entry(i).origin, "potential");
    sum.elastic +=
        contacts.on_surface(i) ? contacts.surface(i).sums().potential : law->potential(contacts.rows(i).g(0));
  }
  at.returned();
  return sum;
}

namespace {

// w . V_t: the power of a wrench on a marker by the part V_t = V - J v of its motion that a law of time prescribes; it
// does not act on coordinates. A remainder of V at round-off counts as 0.
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

// Along the motion d(energy)/dt equals the power of all wrenches on coordinates. Their power on V_t of markers (a base
// that follows a law) leaves the system there and counts as supplied with the opposite sign.
const AssembledSystem::Balance& AssembledSystem::balance(const Vec& lambda) {
  Parts& p = *parts_;
  Point& at = p.at;
  ContactsAtPoint& contacts = p.contacts;
  Balance& sum = p.power;
  sum.drives = sum.dampers = sum.contacts = sum.constraints = sum.markers = 0;
  sum.friction.setZero(contacts.count());
  const auto may_follow_law = [&](int slot) { return at.chain.body(slot) >= 0 && !at.chain.linear(slot); };
  const auto moved_by_law = [&](int slot, const Wrench& wrench) {
    if (may_follow_law(slot)) sum.markers -= power_of_law(at.motion(slot), at.v, at.chain.first_velocity(slot), wrench);
  };
  for (const BodyEntry& entry : model().bodies) {
    at.called(entry.origin, "power");
    const Power power = entry.body->power(at.t, at.q_of(entry), at.v_of(entry));
    sum.drives += power.supplied;
    sum.dampers += power.dissipated;
  }
  for (std::size_t i = 0; i < at.forces.size(); ++i) {
    const ForceEntry& entry = model().forces[i];
    const int A = at.forces[i].A, B = at.forces[i].B;
    at.called(entry.origin, "power");
    const Power power = entry.force->power(at.t, at.motion(A), at.motion(B));
    sum.drives += power.supplied;
    sum.dampers += power.dissipated;
    if (!may_follow_law(A) && !may_follow_law(B)) continue;
    at.called(entry.origin, "wrench");
    Wrench on_A = Wrench::Zero(twist_size(model().world.space)), on_B = on_A;
    entry.force->wrench(at.t, at.motion(A), at.motion(B), on_A, on_B);
    moved_by_law(A, on_A);
    moved_by_law(B, on_B);
  }
  if (!p.resting.none()) {
    Vec a, unused;
    accelerate({}, a, unused);
  }
  for (int i = 0; i < contacts.count(); ++i) {
    if (!contacts.mode(i).closed) continue;
    if (contacts.on_surface(i)) {
      const SurfaceContact& pressed = contacts.surface(i);
      sum.contacts += pressed.sums().damping;
      sum.friction(i) = pressed.sums().friction;
      if (const auto marker = pressed.on_marker()) moved_by_law(marker->slot, marker->wrench);
      continue;
    }
    const Rows& r = contacts.rows(i);
    const Tangential ratio = contacts.friction_ratio(i);
    const Tangential slip = contacts.entry(i).friction ? contacts.slip(i) : Tangential(Tangential::Zero());
    if (contacts.entry(i).restitution) {
      // The power of its rows is computed below. Only sliding friction is counted here, by the force that the friction
      // law uses, which need not be that of a spring. Resting and frictionless contacts have none.
      if (const double per_force = ratio.dot(slip); per_force != 0)
        sum.friction(i) = -p.shares.force_along({i, 0}, lambda) * per_force;
      continue;
    }
    if (contacts.in_joint(i)) {  // the same
      sum.friction(i) = -p.friction.load(i, lambda) * ratio.dot(slip);
      continue;
    }
    const ContactForce* law = contacts.entry(i).force;
    const double gap = r.g(0), rate = contacts.rate(i, 0), approach = contacts.mode(i).approach_speed;
    at.called(contacts.entry(i).origin, "normal");
    // The damping part of the law: its force minus its value at rest.
    const double normal = law->normal(gap, rate, approach);
    sum.contacts -= (normal - law->normal(gap, 0, approach)) * rate;
    const Tangential friction = ratio * normal + p.resting.force(i);
    sum.friction(i) = -friction.dot(slip);
    const Slots& slots = contacts.slots(i);
    for (int k = 0; k < slots.count; ++k) moved_by_law(slots[k], pressed_by(r.H(k), normal, friction));
  }
  if (const int held = held_rows(); sizes().nc > 0) {
    p.evaluate_rows();
    Vec& reaction = p.right;
    reaction.setZero(at.v.size());
    p.rows.add_reaction(1, lambda, reaction);
    sum.constraints = -reaction.dot(at.v);
    // Rows of joints and bodies supply lambda . g_t; their power on velocities that violate them is an error of the
    // method.
    sum.constraints += lambda.head(held).dot(p.rows.g_dot().head(held));
    for (int i = 0; i < contacts.count(); ++i)
      if (!contacts.entry(i).force) sum.constraints += sum.friction(i);
  }
  at.returned();
  return sum;
}

namespace {

bool rubs(const ContactEntry& entry, const ContactMode& mode) {
  const bool on_surface = entry.surface && entry.surface->friction;
  return mode.closed && (entry.friction || on_surface) && mode.friction != ContactMode::Friction::stick;
}

}  // namespace

bool AssembledSystem::rubs() const {
  for (std::size_t i = 0; i < modes().contacts.size(); ++i)
    if (model::rubs(model().contacts[i], modes().contacts[i])) return true;
  return false;
}

bool AssembledSystem::rubs_by_reactions() const {
  for (std::size_t i = 0; i < modes().contacts.size(); ++i)
    if (!model().contacts[i].force && model::rubs(model().contacts[i], modes().contacts[i])) return true;
  return false;
}

}  // namespace trammel::model
