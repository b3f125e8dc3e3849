#include "modes/nearest_steady.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <trammel/decompositions.hpp>

#include "system/on_rows/onto_rows.hpp"
#include "system/on_rows/tangent_space.hpp"

namespace trammel::simulate {
namespace {

using Eigen::Vector3d;

constexpr int most_unknowns = 120;  // of dense differences
constexpr int most_newton_steps = 20;
constexpr double balanced = 1e-11;          // of the forces
constexpr double near = 0.1;                // relative change of velocities
constexpr double without_effect = 1e-7;     // pivots of J, of its largest: far above the noise of its differences
constexpr double phases[] = {0, 0.7, 1.9};  // of a coordinate's size at the largest velocity

double largest(const Vec& x) {
  return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0;
}

// z = (y, u, w): increments of q and v along the rows' tangent space, in the coordinates' sizes, and of Omega; u and w
// in parts of the largest velocity.
class Nearest {
 public:
  Nearest(model::AssembledSystem& system, const FlatTurning& flat, const State& s, const Vector3d& rate)
      : system_(system), flat_(flat), s_(s), rate_(rate) {
    system_.move_to(s.t, s.q, s.v);
    const TangentSpace space = tangent_space(system_);
    Z_ = space.Z, sizes_ = space.sizes, speed_ = sizes_.largest(s.v);
    const Vec force = system_.f();
    Vec momentum = Vec::Zero(s.v.size());
    system_.add_mass_times(1, s.v, momentum);
    work_ = std::max(sizes_.largest_work(force), share_of_momentum * sizes_.largest_work(momentum) * speed_);
  }

  std::optional<State> operator()() {
    const bool planar = system_.model().world.space == Space::planar;
    const Eigen::Index m = Z_.cols(), n = 2 * m + (planar ? 1 : 3);
    if (n > most_unknowns || !(work_ > 0)) return {};
    Vec z = Vec::Zero(n);
    for (int i = 0; i < most_newton_steps; ++i) {
      const Vec r = unbalanced(z);
      if (!r.allFinite()) return {};
      if (largest(r) <= balanced) return state_at(z);
      Mat J(r.size(), n);
      const double h = model::difference_step(1, sizes_.place);
      for (Eigen::Index j = 0; j < n; ++j) {
        const Vec step = h * Vec::Unit(n, j);
        J.col(j) = (unbalanced(z + step) - unbalanced(z - step)) / (2 * h);
      }
      if (!J.allFinite()) return {};
      Eigen::CompleteOrthogonalDecomposition<Mat> least;
      least.setThreshold(without_effect);
      least.compute(J);
      z -= least.solve(r);
      if (!(largest(z.tail(n - m)) < near)) return {};
    }
    return {};
  }

 private:
  State state_at(const Vec& z) {
    const Eigen::Index m = Z_.cols();
    State s = s_;
    system_.retract(s_.q, Z_ * z.head(m), s.q);
    s.v += speed_ * (Z_ * z.segment(m, m));
    const Vec still = Vec::Zero(s.v.size());
    if (!onto_rows(system_, s, [&](const State&, const Vec&) { return still; }))
      s.v.setConstant(std::numeric_limits<double>::quiet_NaN());
    return s;
  }

  Vec unbalanced(const Vec& z) {
    const State s = state_at(z);
    const Eigen::Index turning = z.size() - 2 * Z_.cols();
    const Vector3d rate = rate_ + speed_ * (turning == 1 ? Vector3d(0, 0, z(z.size() - 1)) : Vector3d(z.tail<3>()));
    const TurningFrame frame(system_.model(), flat_, s, rate);
    Vec all(Eigen::Index(std::size(phases)) * s.v.size()), a, lambda;
    Eigen::Index at = 0;
    for (const double phase : phases) {
      const State later = frame.after(phase / speed_);
      if (!later.v.allFinite()) return Vec::Constant(all.size(), std::numeric_limits<double>::quiet_NaN());
      system_.move_to(later.t, later.q, later.v);
      system_.accelerate({}, a, lambda);
      Vec force = Vec::Zero(s.v.size());
      const Vec apart = TurningFrame(system_.model(), flat_, later, rate).turned(later.v) - a;
      system_.add_mass_times(1 / work_, apart, force);
      all.segment(at, force.size()) = force.cwiseProduct(sizes_.of);
      at += force.size();
    }
    return all;
  }

  model::AssembledSystem& system_;
  const FlatTurning& flat_;
  const State& s_;
  Vector3d rate_;
  double speed_ = 0, work_ = 0;
  model::CoordinateSizes sizes_;
  Mat Z_;
};

}  // namespace

std::optional<State> nearest_steady(model::AssembledSystem& system, const FlatTurning& flat, const State& state,
                                    const Vector3d& rate) {
  return Nearest(system, flat, state, rate)();
}

bool onto_rows(model::AssembledSystem& system, State& s, std::function<Vec(const State&, const Vec&)> along) {
  constexpr double off = 1e-10;  // relative to the coordinates' sizes: less than the search distinguishes
  system.move_to(s.t, s.q, s.v);
  const model::CoordinateSizes sizes = system.coordinate_sizes();
  // Rows are in metres, or in radians for angles.
  const double allowed = off * std::min(1.0, sizes.length) * sizes.place;
  return model::positions_onto_rows(system, s, {.allowed = allowed, .most = 10, .along = std::move(along)}) &&
         model::velocities_onto_rows(system, s);
}

}  // namespace trammel::simulate
