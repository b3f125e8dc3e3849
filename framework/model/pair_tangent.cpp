#include <cmath>

#include "model/assembly.hpp"
#include "model/numeric_derivative.hpp"

namespace trammel::model {

namespace {

// The marker's pose moved by the small twist component i (linear first, then rotation about a world axis).
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

void add_pair_tangent(MarkerChain& chain, int slot_A, int slot_B, double t, const Vec& q, const Vec& v,
                      const PairWrench& wrench, double c_k, double c_d, Mat& S) {
  const std::array<int, 2> slots = {slot_A, slot_B};
  std::array<Motion, 2> now;
  for (std::size_t k = 0; k < 2; ++k) now[k] = chain.motion(slots[k], t, q, v);
  const auto twist = now[0].V.size();
  std::array<Wrench, 2> plus, minus;
  std::array<Mat6, 2> D;

  const auto difference = [&](std::size_t moved, auto&& move, double weight) {
    for (Mat6& block : D) block.setZero(twist, twist);
    std::array<Motion, 2> probe = now;
    for (int i = 0; i < twist; ++i) {
      const double s = move(probe[moved], i, 1);
      for (Wrench& w : plus) w.setZero(twist);
      wrench(probe[0], probe[1], plus[0], plus[1]);
      move(probe[moved], i, -1);
      for (Wrench& w : minus) w.setZero(twist);
      wrench(probe[0], probe[1], minus[0], minus[1]);
      probe[moved] = now[moved];
      for (std::size_t k = 0; k < 2; ++k) D[k].col(i) = (plus[k] - minus[k]) / (2 * s);
    }
    for (std::size_t k = 0; k < 2; ++k) chain.add_pair(slots[k], slots[moved], D[k], weight, S);
  };

  for (std::size_t moved = 0; moved < 2; ++moved) {
    if (chain.body(slots[moved]) < 0) continue;
    if (c_k != 0) {
      const auto pose = [&](Motion& m, int i, double sign) {
        const double s = difference_step(i < m.x.size() ? now[moved].x(i) : 1.0);
        displace(now[moved], i, sign * s, m);
        return s;
      };
      difference(moved, pose, c_k);
    }
    if (c_d != 0 && wrench.depends_on_velocity()) {
      const auto velocity = [&](Motion& m, int i, double sign) {
        const double s = difference_step(now[moved].V(i));
        m.V = now[moved].V;
        m.V(i) += sign * s;
        return s;
      };
      difference(moved, velocity, c_d);
    }
  }
  if (c_k == 0) return;
  std::array<Wrench, 2> w;
  for (Wrench& each : w) each.setZero(twist);
  wrench(now[0], now[1], w[0], w[1]);
  for (std::size_t k = 0; k < 2; ++k) chain.add_reaction_derivative(slots[k], t, q, w[k], c_k, S);
}

}  // namespace trammel::model
