// The system's point: t, q, v, and the motions of its markers. All other parts are evaluated at this point.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/call_site.hpp"
#include "model/model.hpp"
#include "system/contact_geometry/contact_geometry.hpp"
#include "system/markers/marker_motions.hpp"

namespace trammel::model {

// Slots of the markers of one joint, force or contact, A first.
struct Slots {
  int A = 0, B = 0, C = 0, D = 0, count = 2;
  int operator[](int k) const { return k == 0 ? A : k == 1 ? B : k == 2 ? C : D; }
  std::array<int, Rows::most_markers> all() const { return {A, B, C, D}; }
};
Slots slots_from(const std::vector<int>& slots);

using Seen = std::array<const Motion*, Rows::most_markers>;  // null: no such marker

struct Point {
  explicit Point(std::shared_ptr<const Model> model);
  Point(const Point&) = delete;  // `markers` refers to `site`
  Point& operator=(const Point&) = delete;

  bool move_to(double t, const Vec& q, const Vec& v);  // false: it is there already
  void hold_still(bool still);

  auto q_of(const BodyEntry& body) const { return q.segment(body.q0, body.nq); }
  auto v_of(const BodyEntry& body) const { return v.segment(body.v0, body.nv); }
  ContactGeometry::Point here() const { return {t, q, v, number}; }

  const Motion& motion(int slot) { return markers.motion(slot, t, q, v); }
  Seen motions(const Slots& slots);
  Seen motions_in_passing(const Slots& slots);  // valid until the next such call
  // Evaluates n rows between the first `count` of these markers.
  void evaluate(const Constraint& constraint, int n, const Seen& motions, int count, Rows& into) const;
  void add_row_force(const Slots& slots, const Rows& r, int row, double c, Vec& f) const;  // f += c J^T H^T
  // Calls use(entry, index in v) for the entries of this row of G.
  template <class Use>
  void for_each_entry(const Slots& slots, const Rows& r, int row, Use&& use) {
    for (int k = 0; k < slots.count; ++k) {
      if (markers.body(slots[k]) < 0) continue;
      const Motion& m = motion(slots[k]);
      const int v0 = markers.first_velocity(slots[k]);
      for_each_column({r.H(k), row, 1}, m.J,
                      [&](Eigen::Index j, const double* along, auto) { use(*along, v0 + m.dofs[std::size_t(j)]); });
    }
  }
  void prefetch(const BodyEntry& body) const;

  void called(const plugin::Origin& component, const char* call) { site = {&component, call}; }
  void returned() { site.origin = nullptr; }

  std::shared_ptr<const Model> model;
  CallSite site;  // must precede `markers`
  MarkerMotions markers;
  // Slots of forces lie next to each other in memory, because with many bodies most joints' markers are not evaluated.
  std::vector<Slots> forces, joints;

  double t = 0;
  Vec q, v;
  long long number = 0;         // counts the points
  long long configuration = 0;  // counts changes of t, q and modes, on which M and G depend
};

}  // namespace trammel::model
