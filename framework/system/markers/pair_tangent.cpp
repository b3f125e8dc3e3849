#include <cmath>

#include "system/markers/numeric_derivative.hpp"
#include "system/markers/pair_tangent.hpp"

namespace trammel::model {

namespace {

// Displaces the marker's pose by the small twist component i (linear first, then rotation about a world axis).
void displace(const Motion& from, int i, double s, Motion& to) {
  const auto dim = from.x.size();
  to.x = from.x;
  to.R = from.R;
  to.angle = from.angle;
  if (i < dim) {
    to.x(i) += s;
    return;
  }
  Mat3 turn = Mat3::Identity(dim, dim);
  const double c = std::cos(s), sine = std::sin(s);
  if (dim == 2) {
    to.angle += s;
    turn << c, -sine, sine, c;
  } else {
    const int axis = i - 3, j = (axis + 1) % 3, k = (axis + 2) % 3;
    turn(j, j) = turn(k, k) = c;
    turn(j, k) = -sine;
    turn(k, j) = sine;
  }
  to.R = turn * from.R;
}

}  // namespace

void add_wrench_tangent(MarkerMotions& chain, std::span<const int> slots, double t, const Vec& q, const Vec& v,
                        const MarkerWrenches& wrenches, double c_k, double c_d, Matrix& S) {
  const std::size_t n = slots.size();
  std::vector<Motion> now(n), probe;
  std::vector<const Motion*> seen(n);
  for (std::size_t k = 0; k < n; ++k) now[k] = chain.motion(slots[k], t, q, v);
  probe = now;
  for (std::size_t k = 0; k < n; ++k) seen[k] = &probe[k];
  const auto twist = now[0].V.size();
  std::vector<Wrench> plus(n), minus(n);
  std::vector<Mat6> D(n);
  const auto evaluate = [&](std::vector<Wrench>& on) {
    for (Wrench& w : on) w.setZero(twist);
    wrenches(seen, on);
  };

  // D[k]: derivative of the wrench on marker k by component i of what `move` changes.
  const auto difference = [&](std::size_t moved, auto&& move) {
    for (Mat6& block : D) block.setZero(twist, twist);
    for (int i = 0; i < twist; ++i) {
      const double s = move(probe[moved], i, 1);
      evaluate(plus);
      move(probe[moved], i, -1);
      evaluate(minus);
      probe[moved] = now[moved];
      for (std::size_t k = 0; k < n; ++k) D[k].col(i) = (plus[k] - minus[k]) / (2 * s);
    }
  };

  for (std::size_t moved = 0; moved < n; ++moved) {
    if (chain.body(slots[moved]) < 0) continue;
    if (c_k != 0) {
      difference(moved, [&](Motion& m, int i, double sign) {
        const double s = difference_step(i < m.x.size() ? now[moved].x(i) : 1.0);
        displace(now[moved], i, sign * s, m);
        return s;
      });
      for (std::size_t k = 0; k < n; ++k) chain.add_pair(slots[k], slots[moved], D[k], c_k, S);
    }
    const bool turns = c_k != 0 && !now[moved].V.isZero(0);
    if (!wrenches.depends_on_velocity() || (c_d == 0 && !turns)) continue;
    difference(moved, [&](Motion& m, int i, double sign) {
      const double s = difference_step(now[moved].V(i));
      m.V = now[moved].V;
      m.V(i) += sign * s;
      return s;
    });
    for (std::size_t k = 0; k < n; ++k) {
      if (c_d != 0) chain.add_pair(slots[k], slots[moved], D[k], c_d, S);
      if (turns) chain.add_rate_pair(slots[k], slots[moved], D[k], t, q, v, c_k, S);
    }
  }
  if (c_k == 0) return;
  evaluate(plus);
  for (std::size_t k = 0; k < n; ++k) chain.add_reaction_derivative(slots[k], t, q, plus[k], c_k, S);
}

}  // namespace trammel::model
