// Explicit Runge-Kutta methods on the first-order form of a System,
//
//     q' = N(q) v,     v' = a(t, q, v) from M a + W^T lambda = f,  G a = gamma - 2 delta (G v + g_t) - epsilon^2 g
//
// treating q as numbers: stages are put back onto the manifold before anything is evaluated there (an extension of the
// field off the manifold, so the order stays), and so is the result.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <trammel/methods/error_along_rows.hpp>
#include <trammel/integrator.hpp>

namespace trammel {

// The derivative of (q, v) at a point, and the multipliers there.
struct Slope {
  Vec q, v, lambda;
};

// A Butcher tableau. `a` holds its rows i = 1 .. stages-1 one after the other, row i with i entries.
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
  // How the field goes on off the rows:
  //  - baumgarte: by the terms above;
  //  - projected: as F(Pi(y)) with Pi the change of least kinetic energy, of positions and then of velocities, onto the rows. Steps
  //    end there, and errors of the stages do not reach the accelerations: they lie off the rows by d = O(h^2), and where redundant
  //    rows meet at an angle theta, near a change of their rank, d makes accelerations wrong by d / theta^2, which no shorter
  //    step cures. It takes two factorisations a stage.
  //  - null_space: as the equations of the quasi-velocities u, with an M-orthonormal basis N of null(G) where the step began,
  //        u = N^T M v,   v = N u + M^-1 G^T y with y from G(t, q) v + g_t = 0,   u' = N^T M a,   q on the rows likewise.
  //    Slopes are added up, so the u of a sum is the sum of the u: N is never formed, a sum is put back onto the rows along
  //    M^-1 G^T, whose factors serve the whole step. It takes one factorisation more a step. Where no such v is near, as beyond
  //    a change of rank, the step's slopes are the projected ones.
  enum class Rows { baumgarte, projected, null_space };
  Rows rows = Rows::baumgarte;
  bool projects() const { return rows != Rows::baumgarte; }
  static std::vector<std::pair<std::string, Rows>> rows_choices() {
    return {{"baumgarte", Rows::baumgarte}, {"projected", Rows::projected}, {"null_space", Rows::null_space}};
  }
  static constexpr const char* rows_doc =
      "baumgarte: stabilised off the rows; projected: every stage on them; null_space: by quasi-velocities";

  // The slope at a point. False: beyond the range of any model; there is none.
  [[nodiscard]] bool evaluate(System& s, double t, const Vec& q, const Vec& v, Slope& slope);
  // That where a motion begins; empty where there is none, and every step from there is rejected.
  void begin(System& s, const State& now, Slope& slope);
  // Where that slope was taken, which is on the rows if it `projects`.
  void taken_at(Vec& q, Vec& v) const { q = on_manifold_, v = held_v_; }
  // Leaves out what of dv is across the rows there (error_along_rows.hpp).
  void put_along_rows(System& s, Vec& dv) { along_rows_.project(s, dv); }
  // Calls `trial`, an Outcome(), that evaluates what a step from `now` needs: all of it in the step's own null space, or if that
  // does not reach, all of it projected.
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

  // One step; `first` is the slope at `now`. next.a and next.lambda are those at the step's end. Rejected if `first` is empty.
  Outcome step(System& s, const State& now, const Slope& first, double h, State& next);

  // --- of the last step: its slopes are those of its stages, of its end, then those added here ---
  int slopes() const { return filled_; }
  double h() const { return h_; }
  // Makes the step from `now` to `next` the last one: repeats it if another was tried since. False: it was refused.
  [[nodiscard]] bool recall(System& s, const State& now, const State& next);
  // The slope at now.t + c h; `row` has a weight for each slope so far. False: there is none, and it is not added.
  [[nodiscard]] bool add_stage(System& s, const State& now, double c, const double* row);
  // h sum_i weights[i] k_i over the first n slopes.
  void combine(const double* weights, int n, Vec& dq, Vec& dv) const;
  // The norm of a local error at the step's end, of e, numbers of q, and e_v: of the whole, or without e_v's part across the rows.
  using Part = ErrorAlongRows::Part;
  double norm(System& s, const State& now, const State& next, const Vec& e, Vec& e_v, Part part,
              const Tolerance& tolerance);
  // The error as `estimate`, a double(Part), tells (error_along_rows.hpp).
  template <class Estimate>
  double error(const State& now, const State& next, Estimate&& estimate) {
    return projects() ? along_rows_.judge(now, next, estimate) : estimate(Part::whole);
  }
  void forget() { along_rows_.forget(); }  // where a motion begins
  void archive(Archive& archive) { along_rows_.archive(archive); }
  // The step's interior at theta in [0, 1], in Hairer's nested form: the cubic Hermite polynomial and, row by row, terms
  // of higher degree h sum_i row[i] k_i over all slopes.
  void interpolate(const System& s, const State& now, const State& next, double theta,
                   std::initializer_list<const double*> terms, State& at);
  // The same by a step to there, for a dense output that lacks a slope. NaN where that is refused, too.
  void step_inside(System& s, const State& now, const State& next, double theta, State& at);

 private:
  Outcome all_stages(System& s, const State& now, double h, State& next);
  Outcome end(System& s, State& next);
  [[nodiscard]] bool keep_null_space(System& s, const State& now);  // false: nothing to keep
  [[nodiscard]] bool onto_rows(System& s, double t);                // on_manifold_ and held_v_

  Tableau tableau_;
  std::vector<Slope> k_;
  int filled_ = 0;
  double h_ = 0;
  bool kept_ = false;           // the rows' factors are those of the step's start
  bool by_null_space_ = false;  // the last step was
  Vec dq_, dv_, q_, v_, on_manifold_, held_v_, right_, zero_, no_force_, change_, mu_, embedded_, e_q_;
  State repeated_;
  ErrorAlongRows along_rows_;
};

// The same local error (numbers of q) as increments: the end's q less that of the embedded method.
void error_increment(const System& s, const Vec& q, const Vec& e, Vec& embedded, Vec& increment);

}  // namespace trammel
