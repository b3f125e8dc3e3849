#include "complementarity/spare_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace trammel::complementarity {
namespace {

using Eigen::Index;
using Block = Eigen::VectorBlock<Vec>;
using ConstBlock = Eigen::VectorBlock<const Vec>;

constexpr int most_iterations = 50;
constexpr double accurate = 1e-12;  // residuals and gap, of numbers of the order of 1

// The cone x_0 >= |x_1|; its product is the Jordan algebra's.
double J_norm(const ConstBlock& x) {
  const double tail = x.tail(x.size() - 1).norm();
  return std::sqrt(std::max(0.0, (x[0] - tail) * (x[0] + tail)));
}

Vec product(const ConstBlock& x, const ConstBlock& y) {
  Vec p(x.size());
  p[0] = x.dot(y);
  p.tail(x.size() - 1) = x[0] * y.tail(x.size() - 1) + y[0] * x.tail(x.size() - 1);
  return p;
}

// x with product(x, y) = p
Vec quotient(const ConstBlock& p, const ConstBlock& y) {
  const Index n = y.size() - 1;
  const double norm = J_norm(y) * J_norm(y);
  Vec x(n + 1);
  x[0] = (y[0] * p[0] - y.tail(n).dot(p.tail(n))) / norm;
  x.tail(n) = (p.tail(n) - x[0] * y.tail(n)) / y[0];
  return x;
}

// The largest step along d that stays in the cone.
double longest(const ConstBlock& x, const ConstBlock& d) {
  const Index n = x.size() - 1;
  const double a = d[0] * d[0] - d.tail(n).squaredNorm(), b = x[0] * d[0] - x.tail(n).dot(d.tail(n)),
               c = J_norm(x) * J_norm(x);
  double step = d[0] < 0 ? -x[0] / d[0] : 1e300;
  const double discriminant = b * b - a * c;
  if (discriminant >= 0) {  // a t^2 + 2 b t + c = 0
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    for (const double t : {a != 0 ? q / a : -1.0, q != 0 ? c / q : -1.0})
      if (t > 0) step = std::min(step, t);
  }
  return step;
}

// minimise -s,   G x + u s = lambda,   x in the cones;   its dual: G^T y + z = 0,  u . y = -1,  z in the cones.
class InteriorPoint {
 public:
  InteriorPoint(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda) {
    Index rows = E.rows() + 1, columns = 1;  // s + x_0 = most
    cones_.push_back({0, 1});
    for (const SharingContact& c : contacts) {
      const Index tangents = c.coefficient > 0 ? Index(c.tangents.size()) : 0;
      cones_.push_back({columns, 1 + tangents});
      columns += 1 + tangents;
      rows += c.normal < 0;
    }
    G_.setZero(rows, columns);
    u_.setZero(rows);
    lambda_.setZero(rows);
    lambda_.head(E.rows()) = lambda;
    Index given = E.rows();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const SharingContact& c = contacts[i];
      const auto [first, size] = cones_[i + 1];
      for (Index k = 1; k < size; ++k)
        G_.col(first + k).head(E.rows()) = c.coefficient * E.col(c.tangents[std::size_t(k - 1)]);
      if (c.normal >= 0) {
        G_.col(first).head(E.rows()) = E.col(c.normal);
        u_.head(E.rows()) += E.col(c.normal);
      } else {
        G_(given, first) = u_[given] = 1;
        lambda_[given++] = c.given;
      }
    }
    size_ = std::max(lambda_.lpNorm<Eigen::Infinity>(), 1e-300);
    lambda_ /= size_;
    G_(given, 0) = u_[given] = 1, lambda_[given] = most;
    x_.setZero(columns);
    for (const auto& [first, size] : cones_) x_[first] = 1;
    z_ = scaled_ = x_;
    y_.setZero(rows);
  }

  // Ends at round-off, which grows once it is reached.
  double solve() {
    double least = std::numeric_limits<double>::infinity(), best = 0;
    for (int i = 0; i < most_iterations; ++i) {
      primal_ = lambda_ - G_ * x_ - s_ * u_;
      dual_ = -G_.transpose() * y_ - z_;
      free_ = -1 - u_.dot(y_);
      const double gap = x_.dot(z_), off = std::max({primal_.norm(), dual_.norm(), std::abs(free_), gap});
      if (off < least) least = off, best = s_;
      if (off < accurate || !(off < 1e3 * least) || !step(gap / double(cones_.size()))) break;
    }
    return best * size_;
  }

 private:
  struct Cone {
    Index first, size;
  };

  ConstBlock of(const Vec& v, const Cone& c) const { return v.segment(c.first, c.size); }

  bool step(double mu) {
    scale();
    Vec right = -scaled_;
    if (!direction(right)) return false;
    double reach = std::min({1.0, reach_of(x_, dx_), reach_of(z_, dz_)});
    const double centre = std::pow(1 - reach, 3);
    const Vec dx_scaled = W_inverse_ * dx_, dz_scaled = W_ * dz_;
    for (const Cone& c : cones_) {
      Vec p = -product(of(scaled_, c), of(scaled_, c)) - product(of(dx_scaled, c), of(dz_scaled, c));
      p[0] += centre * mu;
      right.segment(c.first, c.size) = quotient(ConstBlock(p, 0, p.size()), of(scaled_, c));
    }
    if (!direction(right)) return false;
    reach = std::min(1.0, 0.99 * std::min(reach_of(x_, dx_), reach_of(z_, dz_)));
    x_ += reach * dx_, z_ += reach * dz_, y_ += reach * dy_, s_ += reach * ds_;
    return true;
  }

  // W with W z = W^-1 x, symmetric.
  void scale() {
    const Index n = x_.size();
    W_.setZero(n, n), W_inverse_.setZero(n, n);
    for (const Cone& c : cones_) {
      const auto x = of(x_, c), z = of(z_, c);
      const double nx = J_norm(x), nz = J_norm(z), gamma = std::sqrt((1 + x.dot(z) / (nx * nz)) / 2);
      Vec w = x / nx;
      w[0] += z[0] / nz;
      w.tail(c.size - 1) -= z.tail(c.size - 1) / nz;
      w /= 2 * gamma;
      const double eta = std::sqrt(nx / nz);
      auto W = W_.block(c.first, c.first, c.size, c.size);
      W = w * w.transpose() / (1 + w[0]);
      W.row(0) = w.transpose(), W.col(0) = w;
      W.diagonal().tail(c.size - 1).array() += 1;
      auto inverse = W_inverse_.block(c.first, c.first, c.size, c.size);
      inverse = W / eta;
      inverse.row(0).tail(c.size - 1) *= -1, inverse.col(0).tail(c.size - 1) *= -1;
      W *= eta;
    }
    scaled_ = W_ * z_;
  }

  // W^-1 dx + W dz = right, and the linear equations.
  bool direction(const Vec& right) {
    const Index rows = G_.rows();
    const Mat GW = G_ * W_;
    Mat K = Mat::Zero(rows + 1, rows + 1);
    K.topLeftCorner(rows, rows) = GW * GW.transpose();
    K.col(rows).head(rows) = u_, K.row(rows).head(rows) = u_.transpose();
    Vec r(rows + 1);
    r.head(rows) = primal_ - GW * (right - W_ * dual_);
    r[rows] = free_;
    const Eigen::FullPivLU<Mat> lu(K);
    Vec d = lu.solve(r);
    d += lu.solve(r - K * d);
    if (!d.allFinite()) return false;
    dy_ = d.head(rows), ds_ = d[rows];
    dz_ = dual_ - G_.transpose() * dy_;
    dx_ = W_ * (right - W_ * dz_);
    return true;
  }

  double reach_of(const Vec& from, const Vec& along) const {
    double least = 1e300;
    for (const Cone& c : cones_) least = std::min(least, longest(of(from, c), of(along, c)));
    return least;
  }

  std::vector<Cone> cones_;
  Mat G_;
  Vec u_, lambda_;
  double size_ = 1, s_ = 0;
  Vec x_, y_, z_, scaled_;
  Vec primal_, dual_, dx_, dy_, dz_;
  double free_ = 0, ds_ = 0;
  Mat W_, W_inverse_;
};

}  // namespace

double spare_load(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda) {
  return InteriorPoint(contacts, E, lambda).solve();
}

}  // namespace trammel::complementarity
