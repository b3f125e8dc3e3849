// Statics: equilibria under growing loads, one after another.
//
//     r(t, q, lambda) = -f(t, q) + G^T lambda = 0,    g(t, q) = 0        everything at rest, t the load parameter
//
// Everything in the scene that depends on t is scaled by it: "pressure": "=1e5*t", a law of a joint, a table. Contacts
// push as described in resting_contacts.hpp, without friction.
//
// The polynomial through the last equilibria predicts a load step; Newton's method corrects it, K dq + G^T dlambda =
// -r, G dq = -g, with stresses extrapolated linearly in bodies that offer it (CarriedStress). It has converged when |r|
// <= tolerance * load and g is round-off, or when dq is; the load is the largest |f| at the start configuration, or
// |G^T lambda|, so far. A step that fails is halved repeatedly; the parts grow again while they converge easily.
//
// Soft motions may be lost in the round-off of stiff ones: a strip 10^4 times as long as wide is 10^16 times softer in
// bending along its length than across, beyond the digits of K. Forces keep these digits. If all else fails and a
// motion without resistance is found, each Newton increment is computed with differences of r along it, by Anderson
// acceleration of steps with the factors of K + shift M, which are accurate except for the softest motions. Parts of a
// load step are halved as before. This has converged when dq is small, or is round-off that decreases no further; the
// remaining r is recorded, and a warning is given.
//
// Past a limit point the load must fall. With arc length t is an unknown, and a step has the length ds along the path's
// tangent n (Riks 1979, normal plane):
//     n_q . (q - q_last) / nv + s^2 n_t (t - t_last) = ds,   s^2 = |dq/dt|^2 / nv at the start.
// The length is that of the load step at the start and shrinks near limit points. Each step is recorded, until t has
// passed the end; one load step then returns to it.
#pragma once

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "run/settings.hpp"
#include "simulate/contact/resting_contacts.hpp"
#include "simulate/watch/theory_watch.hpp"
#include "simulate/watch/turn_counts.hpp"

namespace trammel::simulate {

// The cost of one recorded equilibrium.
struct LoadStep {
  double t = 0;
  int iterations = 0;     // of Newton's method, those of failed attempts included
  int parts = 0;          // equilibria that were passed on the way, itself included
  double unbalanced = 0;  // |r| over the load
  double by_forces = 0;   // largest displacement of the last increment, if it was computed by forces; 0 if by K
};

class LoadPath {
 public:
  LoadPath(model::AssembledSystem& system, const Settings& settings, const State& start);

  // Computes the next equilibrium; the first one is at the start. Throws RunFailed if there is none; the last one is
  // kept.
  void advance();
  bool at_end() const { return !passed_.empty() && passed_.back().t == settings_.until; }
  const State& state() const { return state_; }
  const std::vector<LoadStep>& steps() const { return steps_; }
  std::vector<std::string> warnings() const { return theories_.warnings(); }

 private:
  struct Point {
    double t;
    Vec q, lambda;
  };
  struct Arc {
    Vec n_q;
    double n_t, length;
  };
  double mean_count() const {
    return std::max(1.0, double(zero_.size()));
  }  // coordinates: |q|^2 / n is their mean square
  enum class Failure { none, too_many_iterations, singular, diverged };

  void begin();
  void by_load(double t);
  void by_arc();
  bool begin_arcs(const Vec& q_by_t, double step);
  Arc arc_along(const Vec& q_by_t) const;
  void take_arc(Arc arc, const Vec& lambda_by_t, double longest);
  bool solve_from_rest(Point& first);
  bool turn_to_forces(const Point& from);
  Failure solve(Point& trial, const Arc* arc);
  Failure balance_with_contacts(Point& trial, const Arc* arc);
  Failure balance(Point& trial, const Arc* arc);  // with the contacts' rows as they are
  Failure balance_by_forces(Point& trial);
  Failure correct_by_forces(const Point& at, Vec& dq, Vec& dlambda);
  Vec reaction(const Point& at);    // G^T lambda, with the system at `at` and its f and g evaluated
  bool unbalance(const Point& at);  // computes r_ and the system's g; true: in equilibrium
  bool correct(Point& at, const Arc* arc, const Vec& from, Vec& dq);
  bool along_t(const Point& at, Vec& q_by_t, Vec& lambda_by_t);
  bool along_t_with_factors(const Point& at, Vec& q_by_t, Vec& lambda_by_t);
  Point predict(double t) const;
  void keep(Point point);
  [[noreturn]] void fail(double t, Failure why);

  model::AssembledSystem& system_;
  const Settings& settings_;
  State state_;
  Vec start_, zero_;
  RestingContacts contacts_;
  TurnCounts turns_;
  TheoryWatch theories_;
  std::deque<Point> passed_;  // the last equilibria, newest last
  std::vector<LoadStep> steps_;
  LoadStep now_;
  double load_ = 0;    // scale of r
  double extent_ = 0;  // largest displacement so far: scale of dq
  double part_ = 0;    // of t in the next part of a load step, or length of the next arc
  double s2_ = 0;
  Arc last_arc_;
  bool by_forces_ = false;
  Vec r_;
};

}  // namespace trammel::simulate
