// The System of a Model in a given set of contact modes: assembles M, f, g, G and the iteration matrix and solves.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include <trammel/rigid_motions.hpp>
#include <trammel/system.hpp>

#include "model/call_site.hpp"
#include "model/model.hpp"
#include "plugin/guard.hpp"
#include "system/contact_modes.hpp"

namespace trammel::model {

// How often the expensive things were done.
struct Counts {
  long long residual_evaluations = 0;  // evaluations of f
  long long jacobian_evaluations = 0;  // of the iteration matrix
  long long factorizations = 0;
  // Of implicit methods: points at which increments were solved for by the iteration matrix. Several solutions at one point (rows
  // of velocity and of position, a look at the round-off) are one iteration; solutions for rows alone, without a residual, are none.
  long long newton_iterations = 0;
};

// The equations of motion have no solution at a point: a fault of the scene, not of a plugin that asked for it.
class NotSolvable : public std::runtime_error, public plugin::PassesThroughPlugins {
 public:
  using std::runtime_error::runtime_error;
};

// Dense matrices; sparse M and S with dense rows, for bodies of many coordinates; or blocks by bodies with sparse factorisations, for
// many bodies tied by rows. automatic: by what is measured to be quicker (storage_for).
enum class Storage { automatic, dense, sparse, blocks };
Storage storage_for(const Model& model);

// Where the stresses of a CarriedStress tangent come from: those at `from`, carried on linearly by the increment dq.
struct CarriedFrom {
  const Vec& from;
  const Vec& dq;
};

class AssembledSystem final : public System, public HasRigidMotions {
 public:
  explicit AssembledSystem(std::shared_ptr<const Model> model, Storage storage = Storage::automatic);
  ~AssembledSystem() override;

  Sizes sizes() const override;
  void rate(const Vec& q, const Vec& v, Vec& q_dot) const override;
  void normalise(Vec& q) const override;
  void retract(const Vec& q, const Vec& dq, Vec& q_new) const override;
  void difference(const Vec& q1, const Vec& q0, Vec& dq) const override;
  void move_to(double t, const Vec& q, const Vec& v) override;
  const Vec& f() override;
  const Vec& g() override;
  const Vec& g_dot() override;
  void add_mass_times(double c, const Vec& a, Vec& r) override;
  void add_reaction(double c, const Vec& lambda, Vec& r) override;
  void add_rows_times(double c, const Vec& x, Vec& rc) override;
  void add_rows_force(double c, const Vec& mu, Vec& r) override;
  Energy energy() override;  // of all bodies, forces and closed compliant contacts
  void accelerate(Stabilisation, Vec& a, Vec& lambda) override;
  void factorise(Blend, const Vec& a, const Vec& lambda, Factors kept = Factors::iteration) override;
  [[nodiscard]] bool correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda,
                             Factors kept = Factors::iteration) override;

  [[nodiscard]] bool rigid_motions(double t, const Vec& q, Mat& r) override;

  // --- for the Simulator ---
  const Model& model() const;
  // Which contacts are closed and stick; changes sizes().nc. Rows: the bodies' and joints', those of contacts that have
  // locked, then contact by contact that of the gap (closed Restitution contacts) and those of the tangents (sticking ones),
  // without those that are implied by others.
  void set_modes(const Modes& modes);
  void lay_out();  // the model was laid out anew: forgets all that was evaluated, keeps the modes and counts
  const Modes& modes() const;
  int row(ContactDirection direction) const;  // in g; -1: open, sliding, implied by other rows, or compliant
  int held_rows() const;                      // the first of g: of bodies, joints and contacts that have locked
  void initial(Vec& q, Vec& v) const;         // from the bodies' parameters
  // For statics: points have v = 0, markers that a law of time moves stand still where they are, and contacts stick by rows,
  // however their friction decides. Modes are to be set anew afterwards.
  void hold_still(bool still);
  // For statics: factorise({0, 0, 1}, 0, lambda), but in bodies with CarriedStress K has the stresses at `carried.from`
  // carried on linearly by `carried.dq`. It is a part of this call alone: every other K is exact.
  void factorise_with_stress(const CarriedFrom& carried, const Vec& lambda);

  // At the point of the last move_to. Each evaluates only what it needs.
  double gap(int contact);
  double gap_rate(int contact);
  double rate(ContactDirection direction);                        // [m/s] of the gap, or slip velocity
  double acceleration(ContactDirection direction, const Vec& a);  // [m/s^2] for an acceleration of the system
  double coordinate(ContactDirection direction);                  // [m] gap, or place along the tangent
  // Where rows are shared: as equal springs would share, or if those would pull or leave a friction cone, the least forces that do
  // not, if there are any.
  double normal_force(int contact, const Vec& lambda);        // [N] >= 0 pushes; of a joint the load of its bearings
  Tangential friction_force(int contact, const Vec& lambda);  // [N] on A
  // How contacts share rows at the current modes.
  struct Sharing {
    bool shared = false;     // its normal, or a tangent that sticks
    bool as_spring = false;  // it slides or is idle: its share decides the motion
    bool idle = false;       // closed, but it carries nothing while those it shares with carry as they do
    int group = -1;          // in modes().shared
  };
  Sharing sharing(int contact) const;
  // [N] how much further each contact of a group could be unloaded before no forces that they can exert carry what they carry;
  // negative where none do.
  double spare_load(int group, const Vec& lambda);
  double largest_load(int group, const Vec& lambda);  // of their forces [N]
  // [m/s^2] the largest acceleration along a direction that is implied, by an acceleration of the system: 0 while it is.
  double departure(int group, const Vec& a);
  // [N] of an idle contact: what it would carry as a spring among those that carry; it begins to where this rises through 0.
  double spring_force(int contact, const Vec& lambda);
  Tangential slip(int contact);                             // [m/s]; of contacts with friction
  Tangential slip_acceleration(int contact, const Vec& a);  // [m/s^2]
  Vec3 along_tangents(int contact, const Tangential& x);              // along the tangent; in space in world axes
  int tangents(int contact) const;                          // 1, or 2 in space but for a joint's
  void anchor(int contact, ContactMode& mode);              // what holds it at this place
  // A step has become the solution, and the system is at its end: slip is measured from its direction there, in space, and
  // what a round body rolls from its place there. Rolling in space is no function of the configuration; within a step the
  // rotation stands for it to the second order, and joins the rates exactly.
  void step_taken();
  // Velocity jump by impulses on contacts, bilateral rows held (M dv + G_b^T L_b = sum_i n_i L_i): column i of `jump`
  // is dv for a unit impulse along directions[i], and delassus(i, j) the change of the rate of directions[i] by a unit
  // along directions[j].
  void impulse_response(const std::vector<ContactDirection>& directions, Mat& jump, Mat& delassus);
  // Rows depended on each other at the last `accelerate`: lambda is one choice of many.
  bool redundant() const;
  // [rad/s] What an impulse along a direction sets in motion, x = response, swings back with omega^2 = x K x / x M x at
  // first (Rayleigh's quotient; K the stiffness, bilateral rows held): the highest of them. 0: none swings back.
  double highest_frequency(const std::vector<ContactDirection>& directions);

  struct Balance {           // power of what energy() does not hold, by cause [W]
    double drives = 0;       // supplied by bodies' drives and loads
    double dampers = 0;      // dissipated in bodies and forces
    double contacts = 0;     // dissipated in compliant contacts
    double constraints = 0;  // supplied by time-dependent rows: lambda . g_t; by contacts' rows -lambda . G v
    double markers = 0;      // supplied by forces and contacts at markers that move by a law of time
    Vec friction;            // dissipated in sliding, contact by contact
  };
  const Balance& balance(const Vec& lambda);  // valid until the next call
  // Whether something slides with friction, however slowly now: its power may be 0 at both ends of a step and not between.
  bool rubs() const;
  bool rubs_by_reactions() const;                              // by a normal force that is a multiplier
  void constraint_acceleration(const Vec& a, Vec& r);          // G a - gamma
  Eigen::SparseMatrix<double, Eigen::RowMajor> sparse_rows();  // G, without entries that are 0
  // S += c_m M + c_d D + c_k K + c_1 1, the matrix that `factorise` takes (nv x nv).
  void add_tangent(Blend c, const Vec& a, const Vec& lambda, Mat& S);
  Eigen::SparseMatrix<double> sparse_tangent(Blend c, const Vec& a, const Vec& lambda);

  const Motion& motion(MarkerRef marker);     // at the current point
  const Motion& contact_marker(int contact);  // of its A; of a surface the deepest point
  // Largest pressure of the closed contacts of a body on each patch of its surface [Pa]; empty: none has closed.
  std::vector<double> surface_pressure(int body);
  bool has_surface_contact(int body) const;  // which has closed
  // How far a surface in contact with a plane lies behind it, all of it [m]; negative: it does not, or there is none.
  double all_behind_plane(int contact);
  const CallSite& last_call() const;
  // Finds the first component whose answer at the current point is not finite; component is null if all are.
  CallSite find_not_finite();
  const Counts& counts() const;
  Counts& counts();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace trammel::model
