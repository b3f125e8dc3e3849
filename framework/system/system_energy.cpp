#include <cmath>

#include "system/parts.hpp"

namespace trammel::model {

namespace {

constexpr double round_off_of_motion = 1e-14;  // of V_t, of the terms of V - J v

}  // namespace

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
      if (std::abs(V_t) > round_off_of_motion * size) power += wrench.data()[i] * V_t;
    }
  });
  return power;
}

}  // namespace

// Along the motion d(energy)/dt equals the power of all wrenches on coordinates. Their power on V_t of markers (a base
// that follows a law) leaves the system there and counts as supplied with the opposite sign.
class AssembledSystem::PowerByCause {
 public:
  PowerByCause(Parts& parts, Balance& sum) : p_(parts), at_(parts.at), contacts_(parts.contacts), sum_(sum) {
    sum.drives = sum.dampers = sum.contacts = sum.constraints = sum.markers = 0;
    sum.friction.setZero(contacts_.count());
  }

  void add_bodies() {
    for (const BodyEntry& entry : p_.model().bodies) {
      at_.called(entry.origin, "power");
      add(entry.body->power(at_.t, at_.q_of(entry), at_.v_of(entry)));
    }
  }

  void add_forces() {
    for (std::size_t i = 0; i < at_.forces.size(); ++i) {
      const ForceEntry& entry = p_.model().forces[i];
      const int A = at_.forces[i].A, B = at_.forces[i].B;
      at_.called(entry.origin, "power");
      add(entry.force->power(at_.t, at_.motion(A), at_.motion(B)));
      if (!may_follow_law(A) && !may_follow_law(B)) continue;
      at_.called(entry.origin, "wrench");
      Wrench on_A = Wrench::Zero(twist_size(p_.model().world.space)), on_B = on_A;
      entry.force->wrench(at_.t, at_.motion(A), at_.motion(B), on_A, on_B);
      add_moved_by_law(A, on_A);
      add_moved_by_law(B, on_B);
    }
  }

  void add_contacts(const Vec& lambda) {
    for (int i = 0; i < contacts_.count(); ++i) {
      if (!contacts_.mode(i).closed) continue;
      if (contacts_.on_surface(i))
        add_surface(i);
      else if (!contacts_.entry(i).force)
        add_sliding(i, lambda);
      else
        add_compliant(i);
    }
  }

  // Rows of joints and bodies supply lambda . g_t; their power on velocities that violate them is an error of the
  // method.
  void add_rows(const Vec& lambda, int held) {
    Vec& reaction = p_.right;
    reaction.setZero(at_.v.size());
    p_.rows.add_reaction(1, lambda, reaction);
    sum_.constraints = -reaction.dot(at_.v);
    sum_.constraints += lambda.head(held).dot(p_.rows.g_dot().head(held));
    for (int i = 0; i < contacts_.count(); ++i)
      if (!contacts_.entry(i).force) sum_.constraints += sum_.friction(i);
  }

 private:
  void add(const Power& power) {
    sum_.drives += power.supplied;
    sum_.dampers += power.dissipated;
  }

  bool may_follow_law(int slot) const { return at_.markers.body(slot) >= 0 && !at_.markers.linear(slot); }
  void add_moved_by_law(int slot, const Wrench& wrench) {
    if (may_follow_law(slot))
      sum_.markers -= power_of_law(at_.motion(slot), at_.v, at_.markers.first_velocity(slot), wrench);
  }

  void add_surface(int i) {
    const SurfaceContact& pressed = contacts_.surface(i);
    sum_.contacts += pressed.sums().damping;
    sum_.friction(i) = pressed.sums().friction;
    if (const auto marker = pressed.on_marker()) add_moved_by_law(marker->slot, marker->wrench);
  }

  Tangential slip(int i) { return contacts_.entry(i).friction ? contacts_.slip(i) : Tangential(Tangential::Zero()); }

  // The friction of a rigid contact or of a joint that slides, by the load that the friction law uses, which need not
  // be that of a spring. Resting and frictionless contacts have none. The power of the rows themselves is in
  // `add_rows`.
  void add_sliding(int i, const Vec& lambda) {
    const double per_load = contacts_.friction_ratio(i).dot(slip(i));
    if (contacts_.in_joint(i))
      sum_.friction(i) = -p_.friction.load(i, lambda) * per_load;
    else if (per_load != 0)
      sum_.friction(i) = -p_.shares.force_along({i, 0}, lambda) * per_load;
  }

  // The damping part of the law is its force minus its value at rest.
  void add_compliant(int i) {
    const Rows& r = contacts_.rows(i);
    const Tangential ratio = contacts_.friction_ratio(i);
    const ContactForce* law = contacts_.entry(i).force;
    const double gap = r.g(0), rate = contacts_.rate(i, 0), approach = contacts_.mode(i).approach_speed;
    at_.called(contacts_.entry(i).origin, "normal");
    const double normal = law->normal(gap, rate, approach);
    sum_.contacts -= (normal - law->normal(gap, 0, approach)) * rate;
    const Tangential friction = ratio * normal + p_.resting.force(i);
    sum_.friction(i) = -friction.dot(slip(i));
    const Slots& slots = contacts_.slots(i);
    for (int k = 0; k < slots.count; ++k) add_moved_by_law(slots[k], pressed_by(r.H(k), normal, friction));
  }

  Parts& p_;
  Point& at_;
  ContactsAtPoint& contacts_;
  Balance& sum_;
};

const AssembledSystem::Balance& AssembledSystem::balance(const Vec& lambda) {
  Parts& p = *parts_;
  if (sizes().nc > 0) p.evaluate_rows();  // loads of joints depend on it
  PowerByCause power(p, p.power);
  power.add_bodies();
  power.add_forces();
  if (!p.resting.none()) {
    Vec a, unused;
    accelerate({}, a, unused);
  }
  power.add_contacts(lambda);
  if (const int held = held_rows(); sizes().nc > 0) power.add_rows(lambda, held);
  p.at.returned();
  return p.power;
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
