// Explicit Runge-Kutta methods on the first-order form of a System,
//
//     q' = N(q) v,     v' = a(t, q, v) from M a + W^T lambda = f,  G a = gamma - 2 delta (G v + g_t) - epsilon^2 g
//
// which treat q as numbers. Stages are projected onto the manifold before the system is evaluated (this extends the
// field beyond the manifold and does not reduce the order), and so is the result.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <trammel/integrator.hpp>
#include <trammel/methods/error_along_rows.hpp>

namespace trammel {

// The derivative of (q, v) at a point, and the multipliers there.
struct Slope {
  Vec q, v, lambda;
};

// A Butcher tableau. `a` stores the rows i = 1 .. stages-1 one after the other; row i has i entries.
struct Tableau {
  int stages;
  const double* c;
  const double* a;
  const double* b;
};

class RungeKutta {
 public:
  static constexpr const char* diverged = "the step left the finite numbers: too large for an explicit method";
  static constexpr const char* out_of_range =
      "the step begins where accelerations leave the range of numbers: lengths and speeds stay below 1e60";

  explicit RungeKutta(const Tableau& tableau);

  Stabilisation baumgarte;
  // The extension of the field F(y), y = (q, v), to points off the rows:
  //  - baumgarte: by the terms above;
  //  - projected: F(Pi(y)), where Pi projects positions and then velocities onto the rows with the least kinetic
  //    energy. Steps end on the rows, and errors of the stages do not affect the accelerations. (Stages lie off the
  //    rows by d = O(h^2). Near a change of rank, where redundant rows differ by an angle theta, this makes the
  //    accelerations wrong by d / theta^2, and a smaller step does not help.) It needs two factorisations per stage.
  //  - null_space: the equations of the quasi-velocities u, with an M-orthonormal basis N of null(G) at the start,
  //        u = N^T M v,   v = N u + M^-1 G^T y with y from G(t, q) v + g_t = 0,   u' = N^T M a,   and q likewise.
  //    The u of a sum of slopes is the sum of their u, so N is never formed: a sum is projected onto the rows along
  //    M^-1 G^T, with the same factors in the whole step. It needs one more factorisation per step. If there is no such
  //    v nearby, as beyond a change of rank, the step uses the projected slopes.
  enum class Rows { baumgarte, projected, null_space };
  Rows rows = Rows::baumgarte;
  bool projects() const { return rows != Rows::baumgarte; }
  static std::vector<std::pair<std::string, Rows>> rows_choices() {
    return {{"baumgarte", Rows::baumgarte}, {"projected", Rows::projected}, {"null_space", Rows::null_space}};
  }
  static constexpr const char* rows_doc =
      "baumgarte: stabilised off the rows; projected: every stage on them; null_space: by quasi-velocities";

  // Computes the slope at a point. False: there is none, because the numbers exceed the range of any model.
  [[nodiscard]] bool evaluate(System& s, double t, const Vec& q, const Vec& v, Slope& slope);
  // Computes the slope at the start of a motion. It is empty if there is none; then every step from there is rejected.
  void begin(System& s, const State& now, Slope& slope);
  // The point where the last slope was evaluated; it lies on the rows if projects().
  void taken_at(Vec& q, Vec& v) const { q = on_manifold_, v = held_v_; }
  // Removes the part of dv across the rows at that point (error_along_rows.hpp).
  void put_along_rows(System& s, Vec& dv) { along_rows_.project(s, dv); }
  // Calls `trial`, an Outcome(), which evaluates all slopes of a step from `now`: first in the null space of the step's
  // start; if that fails, again with projected slopes.
  template <class Trial>
  Outcome within_step(System& s, const State& now, Trial&& trial) {
    by_null_space_ = keep_null_space(s, now);
    if (by_null_space_) {
      const Outcome outcome = trial();
      kept_ = false;
      if (outcome) return outcome;
    }
    by_null_space_ = false;
    return trial();
  }

  // One step; `first` is the slope at `now`. next.a and next.lambda belong to the step's end. Rejected if `first` is
  // empty.
  Outcome step(System& s, const State& now, const Slope& first, double h, State& next);

  // --- The last step. Its slopes: those of the stages, that of the end, then those added by add_stage ---
  int slopes() const { return filled_; }
  double h() const { return h_; }
  // Makes the step from `now` to `next` the last step, by repeating it if another one was tried since. False: it was
  // rejected.
  [[nodiscard]] bool recall(System& s, const State& now, const State& next);
  // Adds the slope at now.t + c h; `row` has one weight per existing slope. False: there is none, and nothing is added.
  [[nodiscard]] bool add_stage(System& s, const State& now, double c, const double* row);
  // h sum_i weights[i] k_i over the first n slopes.
  void combine(const double* weights, int n, Vec& dq, Vec& dv) const;
  // The norm of a local error at the step's end, e (numbers of q) and e_v: whole, or without the part of e_v across the
  // rows.
  using Part = ErrorAlongRows::Part;
  double norm(System& s, const State& now, const State& next, const Vec& e, Vec& e_v, Part part,
              const Tolerance& tolerance);
  // The error by `estimate`, a double(Part), whole or along the rows (error_along_rows.hpp).
  template <class Estimate>
  double error(const State& now, const State& next, Estimate&& estimate) {
    return projects() ? along_rows_.judge(now, next, estimate) : estimate(Part::whole);
  }
  void forget() { along_rows_.forget(); }  // to be called where a motion begins
  void archive(Archive& archive) { along_rows_.archive(archive); }
  // Dense output at theta in [0, 1], in Hairer's nested form: the cubic Hermite polynomial plus, for each row of
  // `terms`, a term of higher degree with the coefficient h sum_i row[i] k_i over all slopes.
  void interpolate(const System& s, const State& now, const State& next, double theta,
                   std::initializer_list<const double*> terms, State& at);
  // The same by a shorter step, for a dense output that lacks a slope. Gives NaN if that step is rejected, too.
  void step_inside(System& s, const State& now, const State& next, double theta, State& at);

 private:
  class OntoRows;
  Outcome all_stages(System& s, const State& now, double h, State& next);
  Outcome end(System& s, State& next);
  [[nodiscard]] bool keep_null_space(System& s, const State& now);  // false: nothing to keep
  [[nodiscard]] bool onto_rows(System& s, double t);                // on_manifold_ and held_v_

  Tableau tableau_;
  std::vector<Slope> k_;
  int filled_ = 0;
  double h_ = 0;
  bool kept_ = false;           // the factors of the rows belong to the step's start
  bool by_null_space_ = false;  // the last step used the null space
  Vec dq_, dv_, q_, v_, on_manifold_, held_v_, right_, zero_, no_force_, change_, mu_, embedded_, e_q_;
  State repeated_;
  ErrorAlongRows along_rows_;
};

// Converts a local error e (numbers of q) to increments: the end's q (-) that of the embedded method, q - e.
void error_increment(const System& s, const Vec& q, const Vec& e, Vec& embedded, Vec& increment);

}  // namespace trammel
