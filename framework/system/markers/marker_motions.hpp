// Evaluates the markers and maps wrenches and rows at markers to entries of the system's vectors and matrices by their
// Jacobians. A marker with several users is evaluated once per point, one with a single joint at each use.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <typeindex>
#include <vector>

#include "linear/dense/prefetch.hpp"
#include "model/call_site.hpp"
#include "model/model.hpp"
#include "system/markers/coordinate_sizes.hpp"
#include "system/markers/twist_rows.hpp"

namespace trammel::model {

class MarkerMotions {
 public:
  // While a body computes motions, `site` names it.
  MarkerMotions(const Model& model, CallSite& site);

  // A slot is the index of a marker in use.
  int slot(MarkerRef marker);
  // A slot for a point of a body's surface: the nearest one to another point, which `nearest` finds once per point of
  // the system, or one whose motion the caller fills.
  int surface_slot(int body);
  Motion& surface_motion(int slot);
  const Motion& nearest(int slot, const Vec3& to, double t, const Vec& q, const Vec& v);
  bool on_surface(int slot) const { return slots_[std::size_t(slot)].surface; }
  int slots() const { return int(slots_.size()); }
  void new_point() { ++point_; }
  // Markers keep their positions; velocities and accelerations from laws of time count as 0. For v = 0 only.
  void hold_still(bool still) { still_ = still, ++point_; }
  bool held_still() const { return still_; }
  const Motion& motion(int slot, double t, const Vec& q, const Vec& v);
  // The same for temporary use as marker k of a joint: the next call may overwrite the result.
  const Motion& motion_in_passing(int slot, std::size_t k, double t, const Vec& q, const Vec& v);
  void prefetch(int slot) const { numerics::prefetch(&kept_[std::size_t(slot)], 256); }  // its position and velocity
  // Sizes from the initial state of the model, computed once.
  const CoordinateSizes& sizes();
  Motion motion_at_zero(int slot) const;  // q = 0, v = 0, t = 0
  const Motion& last_motion(int slot) const { return kept_[std::size_t(slot)].motion; }
  int first_velocity(int slot) const { return slots_[std::size_t(slot)].v0; }
  int body(int slot) const { return slots_[std::size_t(slot)].marker.body; }  // -1: ground
  bool linear(int slot) const { return slots_[std::size_t(slot)].linear; }    // of a body with LinearMarkers

  // f += c J^T wrench
  void add_wrench(int slot, const Wrench& wrench, double c, Vec& f) const;
  // G(row + i, :) += (H J)_i with J of this motion
  void add_rows(int slot, const Motion& motion, int row, const RowsOf& H, Mat& G) const;
  // S(dofs, dofs') += c J^T D J' for a twist x twist matrix D between two slots
  void add_pair(int slot, int other, const Mat6& D, double c, Matrix& S);
  // S(dofs, body') += c J^T D d(J' v)/dq between two slots: the twist of the other changes with its body's place
  void add_rate_pair(int slot, int other, const Mat6& D, double t, const Vec& q, const Vec& v, double c, Matrix& S);
  // S += c d(J^T F)/dq of the marker's body
  void add_reaction_derivative(int slot, double t, const Vec& q, const Wrench& F, double c, Matrix& S);

 private:
  // 56 bytes each, contiguous: the data that are used at each point.
  struct Slot {
    const Body* body = nullptr;  // null: the ground
    MarkerRef marker;
    int q0 = 0, v0 = 0, nq = 0, nv = 0;  // of the body
    int begin = -1, end = -1;            // linear: range of J in entries_; -1: not computed
    long long point = -1;                // of the stored motion
    int uses = 0;
    short shared = -1;  // in shared_
    bool surface = false, linear = false;
  };
  struct Kept {
    Vec3 x_0;  // linear: x at q = 0
    Motion motion;
  };
  // The non-zero entries of constant J, contiguous for all markers in the order of their first use.
  struct Entry {
    int row, dof;
    double value;
  };
  Slot& add_slot(MarkerRef marker);
  Vec3 start_of(MarkerRef marker, Motion& m) const;
  void measure();
  void measure(int body, double L, double extent);
  void evaluate(const Slot& slot, double t, const Vec& q, const Vec& v, Motion& motion) const;
  void evaluate_linear(int slot, const Vec& q, const Vec& v);
  void keep_linear(int slot);
  // The same for a matrix of this body only.
  void add_to_body(int slot, double t, const Vec& q, const Wrench& F, double c, Matrix& of_body);

  template <class Call>
  void ask(int body, const char* name, Call call) const {
    call_inside(site_, model_.bodies[std::size_t(body)].origin, name, [&] { return call(), true; });
  }

  const Model& model_;
  CallSite& site_;
  std::vector<Slot> slots_;
  std::deque<Kept> kept_;  // by slot; references to motions remain valid
  // Motions of bodies with SharedMotion, by class, for the markers of one joint at a time: one motion per marker would
  // exceed the cache for many bodies.
  std::map<std::type_index, short> class_;
  std::deque<std::array<Motion, Rows::most_markers>> shared_;
  std::vector<Entry> entries_;
  std::vector<std::vector<int>> known_;  // slot or -1, by body (the ground first) and marker
  long long point_ = 0;
  bool still_ = false;
  std::optional<CoordinateSizes> sizes_;
  std::vector<Vec> q_start_, v_start_;  // by body
  Motion probe_;                        // for the differences
  Vec v_zero_;
  Mat block_, pair_, turning_;
};

}  // namespace trammel::model
