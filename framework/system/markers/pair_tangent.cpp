#include <algorithm>
#include <cmath>

#include "system/markers/coordinate_sizes.hpp"
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

// Scales over which wrenches change: the distance of the markers, or the scene's length if they coincide; their speed
// and angular velocity, but at least this length and 1 rad per second.
struct PairSizes {
  double length, speed, spin;
};
PairSizes sizes_of(const std::vector<Motion>& markers, double scene) {
  constexpr double one_point = 1e-6;  // relative to the scene
  double apart = 0, speed = 0, spin = 1;
  for (const Motion& m : markers) {
    const auto dim = m.x.size();
    apart = std::max(apart, (m.x - markers[0].x).norm());
    speed = std::max(speed, m.V.head(dim).norm());
    spin = std::max(spin, m.V.tail(m.V.size() - dim).norm());
  }
  const double length = apart > one_point * scene ? apart : scene;
  return {length, std::max(speed, length), spin};
}

}  // namespace

void add_wrench_tangent(MarkerMotions& markers, std::span<const int> slots, double t, const Vec& q, const Vec& v,
                        const MarkerWrenches& wrenches, double c_k, double c_d, Matrix& S) {
  const std::size_t n = slots.size();
  std::vector<Motion> now(n), probe;
  std::vector<const Motion*> seen(n);
  for (std::size_t k = 0; k < n; ++k) now[k] = markers.motion(slots[k], t, q, v);
  probe = now;
  for (std::size_t k = 0; k < n; ++k) seen[k] = &probe[k];
  const auto twist = now[0].V.size();
  std::vector<Wrench> plus(n), minus(n);
  const auto evaluate = [&](std::vector<Wrench>& on) {
    for (Wrench& w : on) w.setZero(twist);
    wrenches(seen, on);
  };
  const auto turns = [&](std::size_t moved) { return c_k != 0 && !now[moved].V.isZero(0); };
  const auto add_by_pose = [&](std::size_t k, std::size_t moved, const Mat6& D) {
    markers.add_pair(slots[k], slots[moved], D, c_k, S);
  };
  const auto add_by_velocity = [&](std::size_t k, std::size_t moved, const Mat6& D) {
    if (c_d != 0) markers.add_pair(slots[k], slots[moved], D, c_d, S);
    if (turns(moved)) markers.add_rate_pair(slots[k], slots[moved], D, t, q, v, c_k, S);
  };

  PairTangent K, D;
  for (PairTangent* of : {&K, &D})
    for (Mat6* block : {&of->AA, &of->AB, &of->BA, &of->BB}) block->setZero(twist, twist);
  if (n == 2 && wrenches.exact_tangent(seen, K, D)) {
    const auto block = [](const PairTangent& of, std::size_t k, std::size_t moved) -> const Mat6& {
      return k == 0 ? (moved == 0 ? of.AA : of.AB) : (moved == 0 ? of.BA : of.BB);
    };
    for (std::size_t moved = 0; moved < n; ++moved) {
      if (markers.body(slots[moved]) < 0) continue;
      for (std::size_t k = 0; k < n && c_k != 0; ++k) add_by_pose(k, moved, block(K, k, moved));
      for (std::size_t k = 0; k < n; ++k) add_by_velocity(k, moved, block(D, k, moved));
    }
  } else {
    const PairSizes size = sizes_of(now, markers.sizes().length);
    std::vector<Mat6> by(n);
    // by[k]: derivative of the wrench on marker k by component i of the pose or velocity that `move` changes; `move`
    // returns the step.
    const auto difference = [&](std::size_t moved, auto&& move) {
      for (Mat6& block : by) block.setZero(twist, twist);
      for (int i = 0; i < twist; ++i) {
        const double ahead = move(probe[moved], i, 1);
        evaluate(plus);
        const double behind = move(probe[moved], i, -1);
        evaluate(minus);
        probe[moved] = now[moved];
        for (std::size_t k = 0; k < n; ++k) by[k].col(i) = (plus[k] - minus[k]) / (ahead - behind);
      }
    };
    for (std::size_t moved = 0; moved < n; ++moved) {
      if (markers.body(slots[moved]) < 0) continue;
      if (c_k != 0) {
        difference(moved, [&](Motion& m, int i, double sign) {
          const bool place = i < m.x.size();
          const double s = sign * (place ? exact_difference_step(size.length, now[moved].x(i)) : difference_step(1));
          displace(now[moved], i, s, m);
          return place ? m.x(i) : s;
        });
        for (std::size_t k = 0; k < n; ++k) add_by_pose(k, moved, by[k]);
      }
      if (!wrenches.depends_on_velocity() || (c_d == 0 && !turns(moved))) continue;
      difference(moved, [&](Motion& m, int i, double sign) {
        m.V = now[moved].V;
        return m.V(i) += sign * difference_step(i < m.x.size() ? size.speed : size.spin);
      });
      for (std::size_t k = 0; k < n; ++k) add_by_velocity(k, moved, by[k]);
    }
  }
  if (c_k == 0) return;
  evaluate(plus);
  for (std::size_t k = 0; k < n; ++k) markers.add_reaction_derivative(slots[k], t, q, plus[k], c_k, S);
}

}  // namespace trammel::model
