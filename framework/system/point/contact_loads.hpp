// Forces of closed contacts from the multipliers: the positions of their rows in g, and how dependent contacts share
// forces.
//
//     F = -lambda of its row;   for shared rows F = share (-lambda of the basis)
//
// If such a force pulls or leaves a friction cone, dependent contacts carry the same resultants by other forces, as
// long as there are any: where nothing slides, by those whose normals press as springs do
// (complementarity/shares/springs_at_rest.hpp), otherwise by any (admissible_forces.hpp). Exceptions are sliding
// contacts, whose share as springs determines their friction and so the motion, and idle ones: the others share the
// rest of the resultants. If they cannot, sliding contacts take part along the directions of their forces, n + p t, by
// forces that leave the motion unchanged. If even these do not exist, at the instant of the event that follows, the
// forces that leave their cones least are taken.
#pragma once

#include <array>
#include <vector>

#include <trammel/types.hpp>

#include "complementarity/shares/spare_load.hpp"
#include "complementarity/shares/springs_at_rest.hpp"
#include "system/point/contact_modes.hpp"

namespace trammel::model {

class ContactLoads {
 public:
  // The place of one direction of a contact in the multipliers.
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
  // What holds a group, the worst first.
  enum class Held { beyond_cones, with_sliding, by_any_forces, as_springs };
  // The forces of all contacts of a group. beyond_cones: there are no admissible ones.
  template <class BoundsOf>
  [[nodiscard]] Held solve(int group, const Vec& lambda, BoundsOf&& bounds) {
    prepare(group, lambda, bounds);
    Group& g = groups_[std::size_t(group)];
    if (!slides(group) && share_as_pushed(g)) return Held::as_springs;
    if (slack(g) >= -round_off * scale(g) || (!slides(group) && share_as_springs(g))) return Held::as_springs;
    return share_admissibly(g, {sharing(g), g.directions, g.E}) ? Held::by_any_forces : Held::beyond_cones;
  }
  // To be called then: includes sliding contacts. E: the motion caused by the forces of the members, then by that of
  // each sliding contact along n + p t. False: there are still no admissible forces.
  [[nodiscard]] bool solve_with_sliding(int group, const Mat& E);
  // To be called then: the forces that leave their cones least, which hold until the event that follows.
  void solve_beyond_cones(int group);
  double load(const Place& place) const { return groups_[std::size_t(place.group)].forces[place.index]; }
  // True if its row depends on others of its group at present.
  bool depends(const Place& place) const {
    const SharedRows& rows = modes_->shared[std::size_t(place.group)];
    return place.index >= rows.K.cols() || !rows.K.col(place.index).isZero(0);
  }
  // True if it slides or is idle.
  bool shares_as_spring(int contact, int group) const;
  // [N] How much each of the other contacts can be unloaded, after `prepare`: complementarity/shares/spare_load.hpp.
  double spare_load(int group) const;
  double spare_load_with_sliding(int group, const Mat& E) const;
  // The same for forces as springs: complementarity/shares/springs_at_rest.hpp.
  double spare_load_as_springs(int group) const;
  double spare_load_as_springs_with_sliding(int group, const Mat& E) const;
  // The springs that hold from here on: `find_springs` there. The first uses members only, the second also those that
  // slide; all are locked if none hold.
  std::vector<ContactSpring> find_springs(int group, double round_off) const;
  std::vector<ContactSpring> find_springs_with_sliding(int group, const Mat& E, double round_off) const;
  // Springs pushed by the normal forces N [N] (by contact of the system) of a group at rest, after `prepare`:
  // complementarity::pushes_of. Nothing where none is known.
  std::vector<ContactSpring> springs_pushed_by(int group, const Vec& N) const;
  // Normal force and friction [N] of each contact, those that slide included, from such forces. E is not used where
  // nothing slides.
  std::vector<Carried> carried_as_springs(int group, const Mat& E) const;
  std::vector<ContactDirection> members(int group) const;
  bool sliding_shares() const;      // some shares affect the motion
  void form_resultants(int group);  // to be called after its K has changed
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
    Vec forces;                            // of all contacts [N]
    Vec resultants;                        // of the members [N]
    Vec shared() const { return forces(directions); }
  };
  // Contacts whose forces may change, the places of these forces in (basis, implied), and their resultants.
  struct Sharing {
    std::vector<complementarity::SharingContact> contacts;
    std::vector<Eigen::Index> directions;
    Mat E;
  };
  static constexpr double round_off = 1e-12;  // relative to the forces
  Eigen::Index basis_size(int group) const { return Eigen::Index(modes_->shared[std::size_t(group)].basis.size()); }
  void lay_out_group(int group);
  void begin(int group, const Vec& lambda);
  bool share_admissibly(Group& group, const Sharing& sharing);
  bool share_as_springs(Group& group);
  bool share_as_pushed(Group& group);
  bool slides(int group) const { return !modes_->shared[std::size_t(group)].sliding.empty(); }
  Sharing with_sliding(int group, const Mat& E) const;
  Sharing with_springs_that_slide(int group, const Mat& E) const;
  struct AsSprings {
    double spare_load = 0;
    std::vector<complementarity::SharingContact> contacts;
    Vec forces;  // [N] in their columns
  };
  std::vector<int> contacts_of(int group) const;
  Mat push(int group, const Sharing& all) const;
  AsSprings as_springs(int group, Sharing all) const;
  std::vector<ContactSpring> springs_of(int group, const Sharing& all, double round_off) const;
  double slack(const Group& group) const;
  std::vector<complementarity::SharingContact> sharing(const Group& group) const;
  double scale(const Group& group) const;

  const Modes* modes_ = nullptr;
  std::vector<std::array<Place, 3>> places_;  // by contact
  std::vector<Group> groups_;
};

}  // namespace trammel::model
