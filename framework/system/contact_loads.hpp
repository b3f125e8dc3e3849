// Forces of closed contacts from the multipliers: the positions of their rows in g, and how dependent contacts share
// forces.
//
//     F = -lambda of its row;   of shared rows F = share (-lambda of the basis)
//
// If this gives tension or leaves a friction cone, dependent contacts carry the same resultants by other, admissible
// forces (complementarity/shares/admissible_forces.hpp), if there are any. Exceptions are sliding contacts, whose
// friction and motion follow from their share as springs, and idle ones. The other contacts share the remaining
// resultants.
#pragma once

#include <array>
#include <vector>

#include <trammel/types.hpp>

#include "complementarity/shares/spare_load.hpp"
#include "system/contact_modes.hpp"

namespace trammel::model {

class ContactLoads {
 public:
  // The position of one direction of a contact.
  struct Place {
    int row = -1;    // in g
    int group = -1;  // in Modes::shared
    int index = -1;  // in (basis, implied) of the group
  };
  void lay_out(const Modes& modes);
  void set_row(ContactDirection d, int row) { places_[std::size_t(d.contact)][std::size_t(d.row)].row = row; }
  const Place& place(ContactDirection d) const { return places_[std::size_t(d.contact)][std::size_t(d.row)]; }
  bool is_implied(ContactDirection d) const {
    return place(d).group >= 0 && place(d).index >= basis_size(place(d).group);
  }

  // The force along a direction if contacts share like equal springs [N].
  double spring(ContactDirection d, const Vec& lambda) const;
  // The derivatives of `spring` by the resultants of the basis, and the rows of the basis.
  auto shares(const Place& place) const { return modes_->shared[std::size_t(place.group)].share.row(place.index); }
  int row_of_basis(int group, int k) const {
    return place(modes_->shared[std::size_t(group)].basis[std::size_t(k)]).row;
  }

  // Data of a contact at the current point that determine whether forces are admissible.
  struct Bounds {
    double coefficient = 0;  // of static friction
    double given = 0;        // [N] normal force if it is not a multiplier
  };
  // Computes the resultants of a group and its spring forces; `bounds(contact)` gives the Bounds.
  template <class BoundsOf>
  void prepare(int group, const Vec& lambda, BoundsOf&& bounds) {
    begin(group, lambda);
    for (Member& member : groups_[std::size_t(group)].members) member.bounds = bounds(member.contact);
  }
  // The forces of all contacts of a group.
  template <class BoundsOf>
  void solve(int group, const Vec& lambda, BoundsOf&& bounds) {
    prepare(group, lambda, bounds);
    share_admissibly(groups_[std::size_t(group)]);
  }
  double load(const Place& place) const { return groups_[std::size_t(place.group)].forces[place.index]; }
  // True if it slides or is idle.
  bool shares_as_spring(int contact, int group) const;
  // [N] by how much each other contact can be unloaded, after `prepare`: complementarity/shares/spare_load.hpp.
  double spare_load(int group) const;
  bool sliding_shares() const;      // true if shares of sliding contacts affect the motion
  void form_resultants(int group);  // to be called after a change of its K
  double largest_load(int group) const { return scale(groups_[std::size_t(group)]); }

 private:
  struct Member {
    int contact = 0;
    std::array<Eigen::Index, 3> columns = {-1, -1, -1};  // of its directions in Group::directions
    Bounds bounds;
  };
  struct Group {
    std::vector<Member> members;           // contacts that do not share as springs
    std::vector<Eigen::Index> directions;  // of the members, in (basis, implied)
    Mat E;                                 // maps the members' forces to their independent resultants
    Vec forces;                            // of all [N]
    Vec resultants;                        // of the members [N]
    Vec shared() const { return forces(directions); }
  };
  Eigen::Index basis_size(int group) const { return Eigen::Index(modes_->shared[std::size_t(group)].basis.size()); }
  void lay_out_group(int group);
  void begin(int group, const Vec& lambda);
  void share_admissibly(Group& group);
  double slack(const Group& group) const;
  std::vector<complementarity::SharingContact> sharing(const Group& group) const;
  double scale(const Group& group) const;

  const Modes* modes_ = nullptr;
  std::vector<std::array<Place, 3>> places_;  // by contact
  std::vector<Group> groups_;
};

}  // namespace trammel::model
