// Energetic restitution for any number of contacts with friction: each contact is a spring, and positions are frozen
// while the springs push.
//
//     u = u- + A P       rates of gaps and slips [m/s], P impulses [N s], A the Delassus matrix, frozen
//     dP_n/dtau = F = k x,   dx/dtau = -u_n     where x > 0 or u_n < 0 (it presses);   F = 0 elsewhere
//     dP_t/dtau = T          |T| <= mu_0 F where s = 0 (it sticks),  T = -mu F s/|s| elsewhere
//
// Where a compression ends (u_n reaches 0), a part 1 - e^2 of the work that this compression has stored is lost and the
// spring keeps the rest: k x^2/2 becomes k x_0^2/2 + e^2 k (x^2 - x_0^2)/2, where x_0 is the compression at its begin.
// A contact that is pressed again compresses again. The impact ends when no spring pushes and no gap closes.
//
// All springs have the same stiffness k; P does not depend on its value. For a single contact this is Stronge's
// hypothesis (Proc. R. Soc. A 431, 169 (1990)), since the rates follow from P_n alone: Routh's construction in the
// plane, the hodograph of Keller in space (J. Appl. Mech. 53, 1 (1986)). For several contacts it is the distributing
// law of Liu, Zhao, Brogliato (Proc. R. Soc. A 464, 3193 (2008)) for equal linear springs, with one difference: the
// loss happens at the end of compression, so that springs do not become stiff as e becomes small.
//
// Guarantee, for any number of contacts, friction and dependent rows: the work of each normal force is -(1 - e^2) times
// the work of its compressions and friction takes energy only, so the energy never grows. The normal forces are given
// at each instant, so friction always has a solution (Painleve's paradox does not arise). Springs that friction or
// other contacts keep compressed when all has come to rest give nothing back. Some impacts do not end, as where walls
// without clearance return a body for ever; an impact without restitution, which takes energy only, ends them.
//
// Between events (a rate, slip or spring reaches 0, or friction its bound) the course is a smooth differential
// equation. Midpoint steps extrapolated to order 12 (Gragg, Bulirsch, Stoer) follow it to round-off.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "complementarity/contact_forces.hpp"

namespace trammel::simulate {

struct SpringContact {
  int normal = 0;    // index into A
  int tangent = -1;  // of the first tangent; -1: frictionless
  double e = 0;
  double mu_0 = 0, mu = 0;
};

class SpringImpact {
 public:
  // `u`: rates before the impact. `tangents`: of a contact, 1 or 2.
  SpringImpact(std::vector<SpringContact> contacts, const Mat& A, const Vec& u, int tangents);

  // `no_solution`: gaps close on bodies that cannot give way.
  [[nodiscard]] complementarity::ContactSolution run();

  const Vec& impulses() const { return P_; }
  // The same impulses, except that the forces of contacts that stick together are chosen inside their friction cones.
  const Vec& admissible_impulses() const { return admissible_; }
  Vec rates() const { return u_before_ + A_ * P_; }
  // By contact [J]: the energy that its spring took in all compressions; the losses there in the normal direction and
  // by friction.
  const Vec& compressed() const { return compressed_; }
  const Vec& lost_normal() const { return lost_normal_; }
  const Vec& lost_friction() const { return lost_friction_; }
  // [J] Work of normal forces taken at the end, counted as lost: the energy of springs that friction or others keep
  // compressed, and the work that ended the last approaches.
  double taken_at_end() const { return taken_at_end_; }
  bool cut_short() const { return cut_short_; }  // ended without restitution, after `most_phases`
  // Events of the course, and trials to locate them.
  int events() const { return events_; }
  int trials() const { return trials_; }
  static constexpr int most_phases = 1000;

 private:
  // Of the largest rate: how far an event's margin may be below 0; rates that count as 0 at the end; rates that count
  // as 0 for wedged contacts.
  static constexpr double tolerance = 1e-13, negligible = 1e-12, still = 1e-9;
  enum class Tangent { none, sticks, slides };
  struct Contact : SpringContact {
    bool presses = false, compresses = false;
    double x_0 = 0;  // compression where this compression began
    Tangent mode = Tangent::none;
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // of its slip, kept while the slip is too slow to have one
    bool slid = false;                                    // its slip has been faster than that
  };

  bool finished() const;
  bool wedged();
  void begin_phase();
  bool advance_to_event();  // false: there is none
  void handle_events();
  void handle_normal(std::size_t i);
  void press(std::size_t i);
  void end_compression(std::size_t i);
  void choose_tangents();
  std::vector<std::size_t> choose_sliding(Vec& F, Vec& f);
  Vec beginning_slips(const std::vector<std::size_t>& resting, const Vec& F, const Vec& f) const;
  void hold_sticking();
  void force_slip();
  [[nodiscard]] complementarity::ContactSolution close();
  complementarity::ContactSolution end_approaches(double yields);
  double fastest_approach() const;
  void share_sticking_forces();

  // The course: state y = (x, P, work lost to friction).
  void derivative(const Vec& y, Vec& dy);
  void forces(const Vec& y, const Vec& u, Vec& f) const;
  double extrapolate(const Vec& y, double h, Vec& y_end);
  bool dips_within(const Vec& y, double h, const Vec& y_end);
  double locate(const Vec& y, double h, Vec& y_end);
  bool midpoint(const Vec& y, double h, int n, Vec& y_end);
  bool turned_from(const Vec& u) const;
  void take(const Vec& y);
  Vec state() const;

  // Events are negative margins: of a contact, those of its spring, its rate and its friction. A margin that the
  // contact does not have in its mode is infinite.
  static constexpr double no_event = std::numeric_limits<double>::infinity();
  struct Margins {
    double spring = no_event, rate = no_event, tangent = no_event;
    double normal() const { return std::min(spring, rate); }
  };
  Vec event_functions(const Vec& y);  // all margins
  void all_margins(const Vec& y, std::vector<Margins>& margins);
  Vec accelerations(const std::vector<Eigen::Index>& rows, const Vec& f) const;
  bool some_forces_hold(const Vec& f) const;

  bool rubs(const Contact& c) const { return c.presses && c.mu_0 > 0 && c.tangent >= 0; }
  using Slip = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;  // without memory of its own from the heap
  Slip slip(const Contact& c, const Vec& u) const { return u.segment(c.tangent, t_); }
  std::vector<Eigen::Index> sticking_rows() const;
  std::vector<complementarity::ContactPoint> resting_points(const Vec& F, const std::vector<std::size_t>& resting,
                                                            const std::vector<bool>& let_go) const;

  std::vector<Contact> contacts_;
  Mat A_;
  Vec u_before_;
  int t_;
  Eigen::Index n_ = 0, m_ = 0;
  double v_ = 0, k_ = 1,
         slow_ = 0;  // [m/s] largest rate; stiffness, here for a period of 2 pi; slips below this have no direction
  Vec x_, P_, admissible_, lost_friction_, lost_normal_, compressed_;
  // Forces of sticking contacts: f_S = hold_ f.
  std::vector<Eigen::Index> sticking_;
  Mat hold_;
  bool dependent_ = false;
  double h_ = 0.5;
  int standing_ = 0;  // events in a row at one instant
  double taken_at_end_ = 0;
  bool cut_short_ = false;
  int events_ = 0, trials_ = 0;
  Vec u_, f_, dy_, middle_;
  mutable Vec held_;
  std::vector<Margins> margins_;
};

}  // namespace trammel::simulate
