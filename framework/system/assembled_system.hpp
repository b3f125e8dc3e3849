// The System of a Model in a given set of contact modes: assembles M, f, g, G and the iteration matrix and solves.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include <trammel/rigid_motions.hpp>
#include <trammel/system.hpp>

#include "model/call_site.hpp"
#include "model/model.hpp"
#include "system/equations/storage.hpp"
#include "system/markers/coordinate_sizes.hpp"
#include "system/point/contact_modes.hpp"
#include "system/point/counts.hpp"
#include "system/point/not_solvable.hpp"

namespace trammel::numerics {
class BlockSigns;
}

namespace trammel::model {

struct CarriedFrom;  // see tangent.hpp

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
  // Sets which contacts are closed and which stick; changes sizes().nc. The rows are those of bodies and joints, those
  // of contacts that have locked, then for each contact the row of the gap (closed Restitution contacts) and those of
  // the tangents (sticking ones), except rows that are implied by others.
  void set_modes(const Modes& modes);
  void lay_out();  // after a new layout of the model: discards all results, keeps modes and counts
  const Modes& modes() const;
  // in g; -1: it has no row (open, sliding, implied by other rows, or compliant)
  int row(ContactDirection direction) const;
  int held_rows() const;               // number of first rows in g: bodies, joints, locked contacts
  void initial(Vec& q, Vec& v) const;  // from the bodies' parameters
  // For statics: v = 0 at all points, markers that follow a law of time are at rest at their position, and contacts
  // stick by rows whatever their friction law. Set the modes again afterwards.
  void hold_still(bool still);
  // For statics: factorise({0, 0, 1}, 0, lambda), except that bodies with CarriedStress use the stresses at
  // `carried.from` plus their linear change by `carried.dq` in K. This applies to this call only; every other K is
  // exact.
  void factorise_with_stress(const CarriedFrom& carried, const Vec& lambda);

  // These functions refer to the point of the last move_to. Each evaluates only what it needs.
  double gap(int contact);
  double gap_rate(int contact);
  double rate(ContactDirection direction);                        // [m/s] of the gap, or slip velocity
  double acceleration(ContactDirection direction, const Vec& a);  // [m/s^2] for an acceleration of the system
  double coordinate(ContactDirection direction);                  // [m] gap, or position along the tangent
  // Dependent contacts share their resultants like equal springs. If these forces would be tensile or outside a
  // friction cone, they share by the least admissible forces, if there are any.
  double normal_force(int contact, const Vec& lambda);        // [N] >= 0 compressive; for a joint: load of its bearings
  Tangential friction_force(int contact, const Vec& lambda);  // [N] on A
  // Whether and how a contact shares rows in the current modes.
  struct Sharing {
    bool shared = false;     // its normal, or a tangent that sticks, depends on rows of other contacts
    bool as_spring = false;  // it slides or is idle: its share affects the motion
    bool idle = false;       // closed, but without load in the present distribution of forces
    int group = -1;          // in modes().shared
  };
  Sharing sharing(int contact) const;
  // [N] for each contact of a group: by how much it can be unloaded until no admissible forces give the same
  // resultants; negative if there are none already.
  double spare_load(int group, const Vec& lambda);
  // The same for forces as springs (complementarity/shares/springs_at_rest.hpp), by those that ContactMode::spring
  // says.
  double spare_load_as_springs(int group, const Vec& lambda);
  // The springs of a group that hold from here on, up to `round_off` [N]; all are locked if none do.
  std::vector<ContactSpring> find_springs(int group, const Vec& lambda, double round_off);
  // The springs of a group at rest that press with the normal forces N [N] (by contact) from before it came to rest;
  // none where no contact can be wedged in.
  std::vector<ContactSpring> springs_pushed_by(int group, const Vec& lambda, const Vec& N);
  // Such forces of a group; those that leave their cones least, if there are none.
  std::vector<Carried> carried_as_springs(int group, const Vec& lambda);
  double largest_load(int group, const Vec& lambda);  // [N] the largest of their forces
  // [m/s^2] the largest acceleration along the implied directions for an acceleration of the system: 0 as long as they
  // are implied.
  double departure(int group, const Vec& a);
  // How many times the rates of the rows in g appear in an implied one.
  double leverage(int group);
  // The largest part of an implied row that does not follow from the basis, by the rates of a motion that the joints
  // permit, relative to those of one that they do not hold: 0 as long as they are implied.
  double off_span(int group);
  // The multipliers of bodies and joints that act beside the forces of the contacts, as these share them: forces along
  // implied rows add to those of the joints from which the rows follow. Rows of contacts are as in lambda.
  Vec reactions(const Vec& lambda);
  // [N] of an idle contact: its force if it shared as a spring; it starts to carry when this rises through 0.
  double spring_force(int contact, const Vec& lambda);
  Tangential slip(int contact);                             // [m/s]; of contacts with friction
  Tangential slip_acceleration(int contact, const Vec& a);  // [m/s^2]
  // in the plane and of a joint one number; in space in world axes
  Vec3 along_tangents(int contact, const Tangential& x);
  int tangents(int contact) const;  // 1 in the plane and of a joint, 2 in space
  // stores the present coordinates along the tangents, at which the contact sticks
  void anchor(int contact, ContactMode& mode);
  // To be called after a step was accepted, with the system at its end. In space slip is measured from its direction
  // there, and the rolling of a round body from its orientation there. (Rolling in space is no function of the
  // configuration. Within a step the rotation replaces it to second order, with exact rates.)
  void step_taken();
  // Velocity jump by impulses on contacts with active bilateral rows (M dv + G_b^T L_b = sum_i n_i L_i): column i of
  // `jump` is dv for a unit impulse along directions[i], and delassus(i, j) the change of the rate of directions[i] by
  // a unit impulse along directions[j].
  void impulse_response(const std::vector<ContactDirection>& directions, Mat& jump, Mat& delassus);
  // [1/s] The largest beta of `accelerate` so far: beta^2 times the round-off of g is in its accelerations and forces.
  double stabilised_by() const;
  // True if rows were redundant at the last `accelerate`: lambda is not unique.
  bool redundant() const;
  // Signs of the determinant of the equations for the forces at the last `accelerate`, by groups of rows that act on
  // each other: one changes where sliding friction leaves its rows no solution (Painleve's critical state).
  void find_signs(numerics::BlockSigns& signs) const;
  // [rad/s] The highest initial frequency after impulses along the given directions: with the response x to one of
  // them, omega^2 = x K x / x M x (Rayleigh's quotient; K: stiffness, with active bilateral rows). 0: no restoring
  // force.
  double highest_frequency(const std::vector<ContactDirection>& directions);

  struct Balance {           // power that energy() does not include, by cause [W]
    double drives = 0;       // supplied by bodies' drives and loads
    double dampers = 0;      // dissipated in bodies and forces
    double contacts = 0;     // dissipated in compliant contacts
    double constraints = 0;  // supplied by time-dependent rows: lambda . g_t; by contacts' rows -lambda . G v
    double markers = 0;      // supplied by forces and contacts at markers that move by a law of time
    Vec friction;            // dissipated in sliding, contact by contact
  };
  const Balance& balance(const Vec& lambda);  // valid until the next call
  // True if something slides with friction, at any speed: its power may be 0 at both ends of a step and not in between.
  bool rubs() const;
  bool rubs_by_reactions() const;                              // the normal force of some friction is a multiplier
  void constraint_acceleration(const Vec& a, Vec& r);          // G a - gamma
  Eigen::SparseMatrix<double, Eigen::RowMajor> sparse_rows();  // G, without entries that are 0
  // S += c_m M + c_d D + c_k K + c_1 1, the matrix of `factorise` (nv x nv).
  void add_tangent(Blend c, const Vec& a, const Vec& lambda, Mat& S);
  Eigen::SparseMatrix<double> sparse_tangent(Blend c, const Vec& a, const Vec& lambda);

  const Motion& motion(MarkerRef marker);     // at the current point
  CoordinateSizes coordinate_sizes();         // with `place` of the current point
  const Motion& contact_marker(int contact);  // marker A; for a surface its deepest point
  Vec3 velocity_apart(int contact);           // of marker A relative to marker B
  // Largest pressure of a body's closed contacts on each patch of its surface [Pa]; empty: none is closed.
  std::vector<double> surface_pressure(int body);
  bool has_surface_contact(int body) const;  // a closed one
  // Distance by which the whole surface lies behind the plane that it touches [m]; negative: not the whole surface, or
  // no such contact.
  double all_behind_plane(int contact);
  const CallSite& last_call() const;
  // Finds the first component whose result at the current point is not finite; component is null if all are finite.
  CallSite find_not_finite();
  const Counts& counts() const;
  Counts& counts();

 private:
  struct Parts;
  class PowerByCause;
  std::unique_ptr<Parts> parts_;
};

}  // namespace trammel::model
