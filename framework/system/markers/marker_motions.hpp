// Markers on their way into the system: each body marker that several things use is evaluated once per point, one that a single joint
// uses whenever that asks, and wrenches and rows at markers become entries of the system's vectors and matrices through its Jacobian.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <typeindex>
#include <vector>

#include "linear/dense/prefetch.hpp"
#include "model/call_site.hpp"
#include "model/model.hpp"
#include "system/markers/twist_rows.hpp"

namespace trammel::model {

class MarkerMotions {
 public:
  // Bodies that are asked for motions are named at `site` meanwhile.
  MarkerMotions(const Model& model, CallSite& site);

  // Slots stand for markers that are in use.
  int slot(MarkerRef marker);
  // A point of a body's surface: the one nearest to some other point, which `nearest` finds once per point of the system, or one
  // whose motion is filled in from outside.
  int surface_slot(int body);
  Motion& surface_motion(int slot);
  const Motion& nearest(int slot, const Vec3& to, double t, const Vec& q, const Vec& v);
  bool on_surface(int slot) const { return slots_[std::size_t(slot)].surface; }
  int slots() const { return int(slots_.size()); }
  void new_point() { ++point_; }
  // Markers keep their places, and what a law of time gives them of velocity and acceleration counts as 0; for v = 0 only.
  void hold_still(bool still) { still_ = still, ++point_; }
  bool held_still() const { return still_; }
  const Motion& motion(int slot, double t, const Vec& q, const Vec& v);
  // The same for one look at it, as marker k of a joint: it may be another's on the next call.
  const Motion& motion_in_passing(int slot, std::size_t k, double t, const Vec& q, const Vec& v);
  void prefetch(int slot) const { numerics::prefetch(&kept_[std::size_t(slot)], 256); }  // its place and velocity
  Motion motion_at_zero(int slot) const;                                                 // q = 0, v = 0, t = 0
  const Motion& last_motion(int slot) const { return kept_[std::size_t(slot)].motion; }
  int first_velocity(int slot) const { return slots_[std::size_t(slot)].v0; }
  int body(int slot) const { return slots_[std::size_t(slot)].marker.body; }  // -1: ground
  bool linear(int slot) const { return slots_[std::size_t(slot)].linear; }    // of a body with LinearMarkers

  // f += c J^T wrench
  void add_wrench(int slot, const Wrench& wrench, double c, Vec& f) const;
  // G(row + i, :) += (H J)_i, J of this motion
  void add_rows(int slot, const Motion& motion, int row, const RowsOf& H, Mat& G) const;
  // S(dofs, dofs') += c J^T D J' for a twist x twist matrix D between two slots
  void add_pair(int slot, int other, const Mat6& D, double c, Matrix& S);
  // S += c d(J^T F)/dq of the marker's body
  void add_reaction_derivative(int slot, double t, const Vec& q, const Wrench& F, double c, Matrix& S);

 private:
  // 56 bytes each, next to each other: what many of them are asked for at each point.
  struct Slot {
    const Body* body = nullptr;  // null: the ground
    MarkerRef marker;
    int q0 = 0, v0 = 0, nq = 0, nv = 0;  // of the body
    int begin = -1, end = -1;            // linear: of J in entries_; not known yet
    long long point = -1;                // of the motion kept
    int uses = 0;
    short shared = -1;  // in shared_
    bool surface = false, linear = false;
  };
  struct Kept {
    Vec3 x_0;  // linear: x at q = 0
    Motion motion;
  };
  // Of a constant J what is not 0: next to each other for all markers, in the order in which they were first asked for.
  struct Entry {
    int row, dof;
    double value;
  };
  Slot& add_slot(MarkerRef marker);
  void evaluate(const Slot& slot, double t, const Vec& q, const Vec& v, Motion& motion) const;
  void evaluate_linear(int slot, const Vec& q, const Vec& v);
  void keep_linear(int slot);
  void add_numeric_reaction_derivative(int slot, double t, const Vec& q, const Wrench& F, double c, Matrix& S);

  template <class Call>
  void ask(int body, const char* name, Call call) const {
    call_inside(site_, model_.bodies[std::size_t(body)].origin, name, [&] { return call(), true; });
  }

  const Model& model_;
  CallSite& site_;
  std::vector<Slot> slots_;
  std::deque<Kept> kept_;  // of each slot; references to motions stay valid
  // Of bodies with SharedMotion, class by class: for the markers of one joint at a time. Kept for 10,000 links they are 14 MB, which
  // pass through the cache with every evaluation.
  std::map<std::type_index, short> class_;
  std::deque<std::array<Motion, Rows::most_markers>> shared_;
  std::vector<Entry> entries_;
  std::vector<std::vector<int>> known_;  // slot or -1, by body (the ground first) and marker
  long long point_ = 0;
  bool still_ = false;
  Motion probe_;  // for the differences
  Vec v_zero_;
  Mat block_, pair_;
};

}  // namespace trammel::model
