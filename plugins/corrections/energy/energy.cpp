// Corrects the kinetic energy to the value of the balance, T* = E_start + supplied - dissipated - U(q), by the change
// of least kinetic energy that preserves the velocity rows and, on request, the momenta:
//
//     v = v_t + v_r + n     v_t: of least T with G v_t = G v (= -g_t if v satisfies the rows);   v_r + n in null(G)
//     v' = v_t + v_r + s n,   s^2 = (T* - T(v_t) - T(v_r))/T(n)
//
// Without a velocity correction, v_t contains the velocity of moving rows and the violation of the rows. If it were
// scaled with the rest, a violation would grow exponentially, by a factor at every turning point, where s is not close
// to 1.
//
// v_r is 0 ("keeps": "direction"), or the part of v in rigid-body motions of the whole system that the rows permit
// ("momentum"). The parts are orthogonal in M, so that the sum of energies is exact and n has no momentum. If v_t = 0
// and v_r = 0, v' = s v. This is the special non-holonomic constraint of Chen Xiangyang, Chinese J. Comput. Mech. 19,
// 74-77 (2002), eq. 8, in its M-weighted form.
//
// Near a turning point T(n) is small, and the noise of T would give a large change. The correction is skipped if T(n)
// is below `least` times the largest kinetic energy of the run, and if T* < T(v_t) + T(v_r).
#include <algorithm>
#include <cmath>

#include <Eigen/SVD>

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>
#include <trammel/rigid_motions.hpp>

namespace {

using namespace trammel;

constexpr double round_off = 1e-20;  // of an energy, relative to T or to the energy of the motion before
// Relative to 1 and the velocities: rates of the rows that are round-off of G v.
constexpr double no_rate = 1e-14;
// Rates of rows that a motion of size 1 does not move: round-off, and this many times |g| if the rows are violated.
constexpr double not_moved = 1e-9, by_violation = 10;

class EnergyCorrection final : public Correction, public NeedsMomentum {
 public:
  enum class Keeps { direction, momentum };
  double least = 1e-4;
  Keeps keeps = Keeps::direction;

  bool corrects(Level level) const override { return level == Level::energy; }
  bool needs_momentum() const override { return keeps == Keeps::momentum; }

  Outcome apply(Level, System& s, const Step& step, State& state) override {
    s.move_to(state.t, state.q, state.v);
    const Energy energy = s.energy();
    largest_ = std::max(largest_, energy.kinetic);
    const double due = step.energy - energy.potential - energy.elastic;
    n_ = state.v;
    double carried = 0;  // T(v_t) + T(v_r)
    if (moves_rows(s, state)) {
      if (!find_carried(s)) return Outcome::reject("the energy's correction cannot solve for what moves the rows");
      n_ -= v_t_;
      carried += kinetic(s, v_t_);
    }
    if (keeps == Keeps::momentum) {
      if (!find_free_motions(s, state))
        return Outcome::reject("the energy's correction keeps momentum, and the system does not give its own");
      v_r_ = free_ * (free_.transpose() * mass_times(s, n_));
      n_ -= v_r_;
      carried += kinetic(s, v_r_);
    }
    const double free = kinetic(s, n_), enough = std::max(least * largest_, round_off * energy.kinetic);
    if (!(free > enough) || !(due - carried > enough)) return Outcome::accept();
    state.v += (std::sqrt((due - carried) / free) - 1) * n_;
    return Outcome::accept();
  }

  void archive(Archive& archive) override { archive("largest_kinetic", largest_); }

 private:
  // Computes rates_ = -G v; false: they are round-off.
  bool moves_rows(System& s, const State& state) {
    if (s.sizes().nc == 0) return false;
    rates_.setZero(s.sizes().nc);
    s.add_rows_times(-1, state.v, rates_);
    return !rates_.isZero(no_rate * (1 + state.v.lpNorm<Eigen::Infinity>()));
  }
  bool find_carried(System& s) {
    zero_.setZero(s.sizes().nv);
    s.factorise({}, zero_, zero_rows_.setZero(rates_.size()), Factors::projection);
    return s.correct(zero_, rates_, v_t_, multipliers_, Factors::projection);
  }

  // Columns of free_: the motions as one rigid body with G r = 0, orthonormal in M. False: the system cannot give them.
  bool find_free_motions(System& s, const State& state) {
    auto* const bodies = dynamic_cast<HasRigidMotions*>(&s);
    if (!bodies || !bodies->rigid_motions(state.t, state.q, free_)) return false;
    orthonormalise(s);
    if (s.sizes().nc == 0) return true;
    Mat moved(s.sizes().nc, free_.cols());
    for (Eigen::Index j = 0; j < free_.cols(); ++j) {
      Gr_.setZero(moved.rows());
      s.add_rows_times(1, free_.col(j), Gr_);
      moved.col(j) = Gr_;
    }
    // A row that is violated by g acts between points that are g apart, so a permitted rotation r has |G r| up to g.
    const double held =
        std::max(not_moved, by_violation * s.g().lpNorm<Eigen::Infinity>()) * free_.cwiseAbs().maxCoeff();
    const Eigen::JacobiSVD<Mat> svd(moved, Eigen::ComputeFullV);
    const auto rank = (svd.singularValues().array() > held).count();
    free_ = (free_ * svd.matrixV().rightCols(free_.cols() - rank)).eval();
    return true;
  }
  // Gram-Schmidt, twice; rotations without effect (of a single point) are dropped.
  void orthonormalise(System& s) {
    Eigen::Index found = 0;
    for (Eigen::Index j = 0; j < free_.cols(); ++j) {
      Vec r = free_.col(j);
      const double before = r.dot(mass_times(s, r));
      for (int twice = 0; twice < 2; ++twice)
        r -= free_.leftCols(found) * (free_.leftCols(found).transpose() * mass_times(s, r));
      const double left = r.dot(mass_times(s, r));
      if (left > round_off * before) free_.col(found++) = r / std::sqrt(left);
    }
    free_.conservativeResize(Eigen::NoChange, found);
  }

  const Vec& mass_times(System& s, const Vec& v) {
    Mv_.setZero(v.size());
    s.add_mass_times(1, v, Mv_);
    return Mv_;
  }
  double kinetic(System& s, const Vec& v) { return 0.5 * v.dot(mass_times(s, v)); }

  double largest_ = 0;  // [J]
  Mat free_;
  Vec n_, v_t_, v_r_, rates_, Gr_, zero_, zero_rows_, multipliers_, Mv_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::correction<EnergyCorrection>("energy", "energy: velocities scaled to what the balance asks for")
        .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77")
        .parameter("least", &EnergyCorrection::least,
                   {.min = 0, .max = 1, .doc = "no correction below this part of the largest kinetic energy"})
        .choice("keeps", &EnergyCorrection::keeps,
                {{"direction", EnergyCorrection::Keeps::direction}, {"momentum", EnergyCorrection::Keeps::momentum}},
                {.doc = "direction: all of the velocity is scaled; momentum: what moves the system as one rigid body, "
                        "and no row forbids, is not"}))
