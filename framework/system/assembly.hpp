// The data of an AssembledSystem between calls: the current point, the results there, and the factors.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "linear/frontal_iteration_kkt.hpp"
#include "linear/kkt.hpp"
#include "system/assembled_system.hpp"
#include "system/body_blocks.hpp"
#include "system/constant_rows.hpp"
#include "system/contact_geometry/surface_contact.hpp"
#include "system/contact_loads.hpp"
#include "system/markers/marker_motions.hpp"
#include "system/markers/pair_tangent.hpp"
#include "system/markers/reaction_tangent.hpp"

namespace trammel::model {

struct AssembledSystem::Work {
  Work(std::shared_ptr<const Model> m, Storage storage);

  // Markers of one joint, force or contact, A first.
  struct Slots {
    int A = 0, B = 0, C = 0, D = 0, count = 2;
    int operator[](int k) const { return k == 0 ? A : k == 1 ? B : k == 2 ? C : D; }
    std::array<int, Rows::most_markers> all() const { return {A, B, C, D}; }
  };
  struct ContactRows {
    long long point = -1;
    Rows rows;
    Vec6 rate, free;  // for each row: g_dot, and gamma minus the markers' bias
  };
  // The stored factorisations: those of System::Factors, and that for accelerations at the point.
  enum Store : std::size_t { iteration, projection, at_point };
  // M or the identity alone has a cheaper, symmetric factorisation.
  struct Kept {
    bool symmetric = false;  // of M or the identity alone
    numerics::MassKkt mass;
    bool mass_factorised = false;  // for constant mass matrices: once
    numerics::IterationKkt iteration;
    numerics::FrontalIterationKkt sparse;  // used instead with sparse storage
  };

  void move_to(double t_new, const Vec& q_new, const Vec& v_new);
  const Motion& motion(int slot) { return chain.motion(slot, t, q, v); }
  using Seen = std::array<const Motion*, Rows::most_markers>;  // null: no such marker
  Seen motions(const Slots& at);
  Seen motions_in_passing(const Slots& at);  // valid until the next such call

  void order_joints();
  void reserve_contacts();
  void lay_out_blocks();   // their rows, for the contacts' modes
  void evaluate_bodies();  // mass and what bodies add to f
  void prefetch_body(std::size_t body);
  void evaluate_mass();
  void sum_mass();  // with sparse storage
  // r += c M a; and, after evaluate_rows, rc += c G x, r += c G^T y, r += c W^T y.
  void add_mass_times(double c, const Vec& a, Vec& r);
  Vec mass_diagonal();
  void add_rows_times(double c, const Vec& x, Vec& rc);
  void add_rows_force(double c, const Vec& y, Vec& r);
  void add_reaction(double c, const Vec& y, Vec& r);
  Eigen::SparseMatrix<double, Eigen::RowMajor> sparse_rows();
  const Vec& force();
  void evaluate_rows();  // g, g_dot, gamma, G, W
  void evaluate_constant_rows();
  void place_constant_rows();
  void evaluate_own_rows(const BodyEntry& entry);
  // adds n rows between the first `count` of these markers
  void evaluate_constraint(const Constraint& constraint, int n, const Seen& motions, int count, Rows& into) const;
  // Rows first .. first + n - 1 of r between these markers become the rows from `row` on of g, g_dot, gamma and G.
  void place_rows(const Rows& r, const Slots& at, const Seen& motions, Eigen::Index first, Eigen::Index n, int row);
  void add_row_force(const Slots& at, const Rows& r, int row, double c, Vec& f) const;  // f += c J^T H^T
  void couple_reactions();

  // Joints with friction (joint_friction.cpp).
  struct Bearing {
    int contact = 0;
    long long point = -1;
    Bearings at = {};
    Mat6 loads = {};        // derivatives of the bearings' loads by the joint's multipliers [1]
    Vec6 load_by_row = {};  // dN/dlambda at the multipliers for which W is formed
  };
  void reserve_bearings();
  const JointEntry& joint_of(int contact) const;
  Bearing& bearing(int contact);                        // at this point
  double bearing_load(int contact, const Vec& lambda);  // N [N]
  bool slides_in_bearing(int contact);                  // with friction
  void bear_nothing();                                  // W with unloaded bearings
  bool bear(const Vec& lambda);                         // W at these multipliers; false: W^T lambda did not change
  [[noreturn]] void fail_without_loads();
  void add_slip_tangent(int contact, Blend c, const Vec& lambda, Matrix& S);

  const Rows& contact(int i);
  void evaluate_contact(int i, ContactRows& into);
  bool on_surface(std::size_t i) const { return surfaces[i].contact != nullptr; }
  bool in_joint(int i) const { return !bearing_of.empty() && bearing_of[std::size_t(i)] >= 0; }
  SurfaceContact& surface(std::size_t i);  // at this point, of a contact that has one
  bool presses_surface(std::size_t i, int body) const;
  ContactGeometry::Point here() const { return {t, q, v, point}; }
  double contact_rate(int i, int row);
  double contact_acceleration(int i, int row, const Vec& a);
  void judge_friction(Vec& a, Vec& lambda);  // adds that of `judged`
  int tangents(int i) const { return geometries[std::size_t(i)]->tangents(); }
  Tangential slip(int i);
  SlipDirection slip_direction(int i);
  template <class Call>
  double ask_friction(int contact, const char* name, Call call);
  Tangential friction_ratio(int i);         // F_t / F_n while sliding; 0 where rows or nothing hold it
  Eigen::Matrix2d friction_damping(int i);  // -d(F_t / F_n)/d(slip velocity) [s/m]
  Eigen::Matrix3d seen_from_B(int i);       // A's orientation
  Tangential displacement(int i);           // g along the tangents, from the mode's anchor
  // S += c_m M + c_d D + c_k K + c_1 1. `carried`: K with those stresses (CarriedStress); null: exact.
  void add_tangent(Blend c, const Vec& a, const Vec& lambda, Matrix& S, const CarriedFrom* carried = nullptr);
  bool factorise_mass(Store store, bool with_friction, double rank_tolerance);
  void factorise_identity(Store store);
  void factorise_tangent(Store store, Blend c, const Vec& a, const Vec& lambda, bool with_friction,
                         const CarriedFrom* carried = nullptr);
  void factorise_sparse(Kept& store, Blend c, const Vec& a, const Vec& lambda, bool sliding,
                        const CarriedFrom* carried);
  void add_rows_to(numerics::SparseSum& sum, bool sliding);  // W^T and G beside S
  bool redundant(Store store) const;                         // true if rows were redundant at the last factorise_mass
  [[nodiscard]] bool solve(Store store, const Vec& b, const Vec& c, Vec& x, Vec& y);
  // A solver for the change of v by impulses, with the joints' rows active.
  std::function<void(const Vec& impulse, Vec& dv)> with_joints_held();

  // Of rows, by what solves with them; after evaluate_rows.
  double violation() const { return g.size() ? g.lpNorm<Eigen::Infinity>() : 0; }
  double rank_tolerance() const { return numerics::rank_tolerance_at(violation()); }

  void called(const plugin::Origin& component, const char* call) { site = {&component, call}; }
  void returned() { site.origin = nullptr; }

  std::shared_ptr<const Model> model;
  Storage storage;
  bool sparse = false;  // M and S
  CallSite site;        // before `chain`, which names bodies there
  MarkerMotions chain;
  std::vector<std::unique_ptr<ContactGeometry>> geometries;  // by contact
  std::vector<Slots> joint_slots, force_slots, contact_slots;
  std::vector<std::size_t> joint_order;      // sorted by their first bodies, for cache locality
  std::vector<std::size_t> constant_joints;  // not in joint_order: their rows are linear in the coordinates
  std::vector<std::size_t> constrained;      // bodies with their own rows
  Modes modes;
  ContactLoads loads;  // the contacts' rows in g, and their forces
  // The contacts on which a multiplier of this row acts: its own, and sliding ones that share with it, by their
  // friction.
  std::vector<int> contacts_of_row(ContactDirection d) const;
  // Calls use(direction, row in g) in the order of rows, except for contacts that have locked.
  template <class Use>
  void for_each_contact_row(Use&& use) {
    for (int i = 0; i < int(modes.contacts.size()); ++i)
      for (int k = 0; k < 3; ++k)
        if (const int row = loads.place({i, k}).row; row >= 0) use(ContactDirection{i, k}, row);
  }
  double force_along(ContactDirection d,
                     const Vec& lambda);  // [N] of a closed contact that does not slide
  void impulse_response(const std::vector<ContactDirection>& directions, Mat& jump, Mat& delassus);
  void clear_held(const Mat& N, Mat& jump, Mat& delassus);
  // Updates K and the shares of shared rows at this point (shared_rows.cpp); true if some have changed.
  bool follow_shares();
  bool still_implied(const SharedRows& group, const Vec& some);
  void renew_shares(int group);
  Vec some_motion();
  struct Rate {
    double sum = 0, terms = 0;  // terms: sum of the terms' absolute values
  };
  Rate rate_by(ContactDirection d, const Vec& some);
  ContactLoads::Bounds bounds(int contact, const Vec& lambda);     // of its forces where it shares rows
  Mat moved_with_sliding(int group);                               // ContactLoads::solve_with_sliding
  const ContactLoads& shared_rows(int group, const Vec& lambda);   // with the resultants of a group
  const ContactLoads& shared_loads(int group, const Vec& lambda);  // and with its forces
  // Where `loads` has the forces of a group: contacts are asked for theirs one after the other.
  struct SharedAt {
    long long point = -1, configuration = -1;
    Vec lambda;
  };
  std::vector<SharedAt> shared_at;   // by group
  std::vector<int> judged;           // closed contacts at rest whose friction is decided in every evaluation
  Eigen::Matrix2Xd judged_friction;  // [N] by contact, at the last accelerate
  bool coupled = false;              // sliding friction depends on a row's force: W != G
  std::vector<Bearing> bearings;     // of joints with friction
  std::vector<int> bearing_of;       // by contact: index into `bearings`; empty if there are none
  Sizes sizes;
  int held_rows = 0;  // the first rows of g, bilateral in impacts: of bodies, joints and locked contacts

  double t = 0;
  Vec q, v;
  long long point = 0;
  long long iterated_at = -1;   // the point of the last Newton iteration
  long long shares_at = -1;     // the configuration where K and the shares were last updated
  long long configuration = 0;  // counts changes of t, q and modes, on which M and G depend
  bool mass_fresh = false, rows_fresh = false;
  bool bodies_fresh = false, force_fresh = false;  // f contains the bodies' part; f is complete

  Mat M, G, W;
  numerics::SparseSum sparse_mass;  // in place of M, with sparse storage
  Vec f, g, g_dot, gamma;
  std::array<Kept, 3> kept;
  std::optional<BodyBlocks> blocks;  // instead of M, G, W and their factors with many bodies
  ConstantRows constant_rows;
  bool constant_rows_placed = false;  // in G and in `blocks`
  Counts counts;

  // scratch
  Balance power;
  Rows rows;
  BodyRows own_rows;
  std::vector<ContactRows> contact_rows;
  struct Pressed {
    SurfaceContact* contact = nullptr;  // null: it acts at one point
    long long point = -1;
  };
  std::vector<Pressed> surfaces;  // by contact
  Wrench on_A, on_B;
  Vec right, right_rows;
  std::vector<int> row_places;  // column indices and values of a few rows
  std::vector<double> row_numbers;
};

}  // namespace trammel::model
