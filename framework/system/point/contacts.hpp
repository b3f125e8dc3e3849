// The contacts at the point: gap, rates, slip, and the ratio of friction to normal force, in the present modes.
// SharedRowsAtPoint has the forces of closed contacts by multipliers.
#pragma once

#include <memory>
#include <vector>

#include "system/contact_geometry/surface_contact.hpp"
#include "system/point/contact_loads.hpp"
#include "system/point/point.hpp"

namespace trammel::model {

class ContactsAtPoint {
 public:
  explicit ContactsAtPoint(Point& at);
  ContactsAtPoint(const ContactsAtPoint&) = delete;  // `loads` refers to `modes`
  ContactsAtPoint& operator=(const ContactsAtPoint&) = delete;

  void set_modes(const Modes& modes);  // `loads` then needs the rows

  int count() const { return int(slots_.size()); }
  const ContactEntry& entry(int i) const { return at_.model->contacts[std::size_t(i)]; }
  const ContactMode& mode(int i) const { return modes.contacts[std::size_t(i)]; }
  ContactGeometry& geometry(int i) const { return *geometries_[std::size_t(i)]; }
  const Slots& slots(int i) const { return slots_[std::size_t(i)]; }
  int tangents(int i) const { return geometry(i).tangents(); }
  bool in_joint(int i) const { return entry(i).joint.has_value(); }
  bool locks(int i) const;  // closed permanently: its row counts as a joint's

  const Rows& rows(int i);                            // of its geometry
  double rate(int i, int row);                        // [m/s]
  double acceleration(int i, int row, const Vec& a);  // [m/s^2]
  Tangential slip(int i);                             // [m/s]
  Tangential friction_ratio(int i);                   // F_t / F_n while sliding; 0 if rows or nothing hold it
  Eigen::Matrix2d friction_damping(int i);            // -d(F_t / F_n)/d(slip velocity) [s/m]
  double law_normal(int i);                           // [N] by its ContactForce
  Tangential displacement(int i);                     // coordinates along the tangents, from the mode's anchor
  void anchor(int i, ContactMode& mode);              // stores the present coordinates along the tangents in the mode
  // At the end of a step in space: slip is measured from its present direction, rolling from the present orientation.
  // True: rows have changed.
  bool follow_slip();

  // null: the contact acts at one point
  SurfaceContact* surface_of(int i) const { return surfaces_[std::size_t(i)].contact; }
  bool on_surface(int i) const { return surface_of(i) != nullptr; }
  SurfaceContact& surface(int i);  // evaluated at this point
  bool presses_surface(int i, int body) const;

  // Contacts whose force the multiplier of this row contributes to: its own contact, and sliding contacts in its group.
  std::vector<int> acting_with(ContactDirection d) const;
  // Calls use(direction, row in g) in the order of rows, except for contacts that have locked.
  template <class Use>
  void for_each_row(Use&& use) const {
    for (int i = 0; i < count(); ++i)
      for (int k = 0; k < 3; ++k)
        if (const int row = loads.place({i, k}).row; row >= 0) use(ContactDirection{i, k}, row);
  }

  Modes modes;
  ContactLoads loads;  // positions of the contacts' rows in g, and the forces of closed contacts

 private:
  struct OfContact {
    long long point = -1;
    Rows rows;
    Vec6 rate, free;  // for each row: g_dot, and gamma minus the markers' bias
  };
  struct Surface {
    SurfaceContact* contact = nullptr;
    long long point = -1;
  };
  void evaluate(int i, OfContact& into);
  SlipDirection slip_direction(int i);
  Eigen::Matrix3d seen_from_B(int i);  // orientation of A in axes of B
  template <class Call>
  double ask_friction(int i, const char* name, Call call);

  Point& at_;
  std::vector<std::unique_ptr<ContactGeometry>> geometries_;  // by contact
  std::vector<Slots> slots_;
  std::vector<OfContact> rows_;
  std::vector<Surface> surfaces_;
};

}  // namespace trammel::model
