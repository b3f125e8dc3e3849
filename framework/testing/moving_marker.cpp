// Poses, twists and accelerations of markers from their coordinates. In space
//
//     omega = alpha' e_x + beta' b + gamma' c,   b = R_x e_y,   c = R_x R_y e_z
//     omega' = alpha'' e_x + beta'' b + gamma'' c + alpha' beta' e_x x b + gamma' (alpha' e_x + beta' b) x c
//
// for the angles alpha, beta, gamma about x, y, z. Source: Shabana, Dynamics of Multibody Systems, section 2.6.
#include <Eigen/Geometry>
#include <cmath>

#include <trammel/testing/markers.hpp>

namespace trammel {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

struct Axes {
  Vector3d a, b, c;
};
Axes axes(const Vec& q) {
  const Eigen::Matrix3d R_x(AngleAxisd(q(3), Vector3d::UnitX()));
  return {Vector3d::UnitX(), R_x * Vector3d::UnitY(), R_x * AngleAxisd(q(4), Vector3d::UnitY()) * Vector3d::UnitZ()};
}

Eigen::Matrix2d planar_rotation(double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

}  // namespace

Motion marker_at(const Vec& q, const Vec& v) {
  const bool planar = q.size() == 3;
  Motion m;
  m.x = q.head(planar ? 2 : 3);
  m.V = v;
  m.bias = Vec6::Zero(v.size());
  if (planar) {
    m.angle = q(2);
    m.R = planar_rotation(q(2));
  } else {
    m.R = (AngleAxisd(q(3), Vector3d::UnitX()) * AngleAxisd(q(4), Vector3d::UnitY()) *
           AngleAxisd(q(5), Vector3d::UnitZ()))
              .toRotationMatrix();
    const auto [a, b, c] = axes(q);
    m.V.tail<3>() = v(3) * a + v(4) * b + v(5) * c;
  }
  return m;
}

Motion displaced(const Motion& m, const Vec6& by) {
  Motion moved = m;
  const auto n = m.x.size();
  moved.x += by.head(n);
  if (n == 2) {
    moved.angle += by(2);
    moved.R = planar_rotation(moved.angle);
  } else if (const Vector3d turn = by.tail<3>(); turn.norm() > 0) {
    moved.R = AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * m.R;
  }
  return moved;
}

Vec about_origin(const Vec& wrench, const Vec3& x) {
  Vec moved = wrench;
  if (x.size() == 2)
    moved(2) += x(0) * wrench(1) - x(1) * wrench(0);
  else
    moved.tail<3>() += Vector3d(x).cross(Vector3d(wrench.head<3>()));
  return moved;
}

Motion MovingMarker::at(double t) const {
  Vec q(Eigen::Index(laws_.size())), v = q;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Law& l = laws_[std::size_t(i)];
    q(i) = l.p + l.u * t + l.a * std::sin(l.w * t + l.phi);
    v(i) = l.u + l.a * l.w * std::cos(l.w * t + l.phi);
  }
  return marker_at(q, v);
}

Vec6 MovingMarker::acceleration(double t) const {
  const auto n = Eigen::Index(laws_.size());
  Vec q(n), v(n);
  Vec6 a(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Law& l = laws_[std::size_t(i)];
    const double phase = l.w * t + l.phi;
    q(i) = l.p + l.u * t + l.a * std::sin(phase);
    v(i) = l.u + l.a * l.w * std::cos(phase);
    a(i) = -l.a * l.w * l.w * std::sin(phase);
  }
  if (n == 6) {
    const auto [e, b, c] = axes(q);
    a.tail<3>() = Vector3d(a(3) * e + a(4) * b + a(5) * c + v(3) * v(4) * e.cross(b) +
                           v(5) * Vector3d(v(3) * e + v(4) * b).cross(c));
  }
  return a;
}

std::vector<MovingMarker> moving_markers(Space space, int count) {
  const MovingPair pair = moving_pair(space);
  std::vector<MovingMarker> all = {pair.a, pair.b};
  const auto add = [&](double x, double y, double phase) {
    std::vector<MovingMarker::Law> laws(std::size_t(twist_size(space)));
    for (std::size_t i = 0; i < laws.size(); ++i)
      laws[i] = {i == 0 ? x : i == 1 ? y : 0.2 * phase, 0.1 * phase, 0.4, 1.3 + 0.2 * double(i), phase * double(i + 1)};
    all.emplace_back(std::move(laws));
  };
  add(0.9, -1.1, 0.8);
  add(-0.8, 1.2, 1.7);
  all.resize(std::size_t(count), pair.a);
  return all;
}

MovingPair moving_pair(Space space) {
  if (space == Space::planar)
    return {MovingMarker({{0.3, 0.2, 0.5, 2.1, 0.4}, {-0.2, 0.4, 0.3, 1.7, 1.1}, {0.5, 1.3, 0.6, 2.6, 0.2}}),
            MovingMarker({{1.4, -0.3, 0.4, 1.9, 0.9}, {0.8, 0.1, 0.5, 2.3, 0.3}, {-0.7, 0.8, 0.9, 1.6, 2.0}})};
  return {MovingMarker({{0.3, 0.2, 0.5, 2.1, 0.4},
                        {-0.2, 0.4, 0.3, 1.7, 1.1},
                        {0.5, 0.3, 0.6, 1.6, 0.2},
                        {0.2, 0.4, 0.3, 1.9, 0.7},
                        {-0.3, 0.2, 0.2, 2.2, 1.3},
                        {0.4, 0.5, 0.3, 1.4, 0.1}}),
          MovingMarker({{1.4, -0.3, 0.4, 1.9, 0.9},
                        {0.8, 0.1, 0.5, 2.3, 0.3},
                        {1.7, 0.2, 0.4, 1.6, 2.0},
                        {-0.1, 0.3, 0.4, 1.5, 0.5},
                        {0.3, -0.2, 0.3, 2.4, 1.9},
                        {-0.2, 0.4, 0.2, 1.8, 0.6}})};
}

}  // namespace trammel
