#include "tspline_plate/mesh/tspline_basis.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "tspline_plate/mesh/t_junction.hpp"

namespace trammel::plate {

std::vector<Anchor> anchors(const TMesh& mesh) {
  const EdgeMap& e = mesh.edges();
  std::vector<Anchor> result;
  for (int j = 2; j <= e.lines(1) - 3; ++j)
    for (int i = 2; i <= e.lines(0) - 3; ++i) {
      if (!e.touches(0, i, j) || !e.touches(1, j, i)) continue;
      Anchor anchor{{i, j}, {}, {}};
      for (int d : {0, 1}) {
        const auto a = std::size_t(d);
        const Index2 back = e.next({i, j}, d, -1), forward = e.next({i, j}, d, 1);
        const int lines[] = {e.next(back, d, -1)[a], back[a], anchor.at[a], forward[a], e.next(forward, d, 1)[a]};
        for (std::size_t k = 0; k < 5; ++k) anchor.knots[a][k] = mesh.knot(d, lines[k]);
        anchor.support[a] = {lines[0], lines[4]};
      }
      result.push_back(anchor);
    }
  return result;
}

TsplineBasis::TsplineBasis(TMesh mesh) : TsplineBasis(std::move(mesh), {}) {}

TsplineBasis::TsplineBasis(TMesh mesh, Eigen::VectorXd weights)
    : mesh_(std::move(mesh)), anchors_(plate::anchors(mesh_)), weights_(std::move(weights)) {
  if (weights_.size() == 0) weights_.setOnes(size());
  if (weights_.size() != size())
    throw std::invalid_argument(
        fmt::format("found {} weights, expected {}, one a control point", weights_.size(), size()));
  for (Eigen::Index i = 0; i < weights_.size(); ++i)
    if (!(weights_(i) > 0))
      throw std::invalid_argument(fmt::format("weight {} is {}; expected a number above 0", i, weights_(i)));

  const int units_u = mesh_.edges().lines(0) - 1, units_v = mesh_.edges().lines(1) - 1;
  cell_of_unit_.assign(std::size_t(units_u * units_v), -1);
  for (const Box<int>& face : extended(mesh_).faces(degree)) {
    const Box<double> area = mesh_.parameters(face);
    if (area.low[0] == area.high[0] || area.low[1] == area.high[1]) continue;
    for (int j = face.low[1]; j < face.high[1]; ++j)
      for (int i = face.low[0]; i < face.high[0]; ++i) cell_of_unit_[std::size_t(j * units_u + i)] = int(cells_.size());
    cells_.push_back({area, {}});
  }

  for (int f = 0; f < size(); ++f) {
    const Anchor& a = anchors_[std::size_t(f)];
    for (int j = a.support[1][0]; j < a.support[1][1]; ++j)
      for (int i = a.support[0][0]; i < a.support[0][1]; ++i) {
        const int c = cell_of_unit_[std::size_t(j * units_u + i)];
        if (c < 0) continue;
        auto& functions = cells_[std::size_t(c)].functions;
        if (functions.empty() || functions.back() != f) functions.push_back(f);
      }
  }

  coefficients_.reserve(cells_.size());
  for (const BezierCell& cell : cells_) {
    auto& of_cell = coefficients_.emplace_back();
    for (int f : cell.functions) {
      Coefficients& c = of_cell.emplace_back();
      for (std::size_t d : {0, 1})
        c[d] =
            bernstein_coefficients(anchors_[std::size_t(f)].knots[d], cell.parameters.low[d], cell.parameters.high[d]);
    }
  }
}

int TsplineBasis::cell_at(double u, double v) const {
  const auto line = [this](int d, double x) {
    const auto& k = mesh_.knots(d);
    const int i = int(std::upper_bound(k.begin(), k.end(), x) - k.begin()) - 1;
    // The last line that is followed by a piece of non-zero length.
    const int last = int(std::lower_bound(k.begin(), k.end(), k.back()) - k.begin()) - 1;
    return std::clamp(i, degree, last);
  };
  return cell_of_unit_[std::size_t(line(1, v) * (mesh_.edges().lines(0) - 1) + line(0, u))];
}

namespace {

// Value, first and second derivative by x of a cubic in Bernstein form on [a, b].
struct Jet {
  double value, first, second;
};

struct BernsteinPoint {
  double s, t, scale;  // t = (x - a) / (b - a), s = 1 - t
  BernsteinPoint(double x, double a, double b) : s((b - x) / (b - a)), t((x - a) / (b - a)), scale(1 / (b - a)) {}
  double value(const std::array<double, 4>& c) const {
    return s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
  }
  Jet jet(const std::array<double, 4>& c) const {
    const double d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2];
    return {value(c), 3 * scale * (s * s * d0 + 2 * s * t * d1 + t * t * d2),
            6 * scale * scale * (s * (d1 - d0) + t * (d2 - d1))};
  }
};

}  // namespace

void TsplineBasis::blending(int cell, double u, double v, Eigen::VectorXd& B) const {
  const Box<double>& box = cells_[std::size_t(cell)].parameters;
  const BernsteinPoint at_u(u, box.low[0], box.high[0]), at_v(v, box.low[1], box.high[1]);
  const auto& coefficients = coefficients_[std::size_t(cell)];
  B.resize(Eigen::Index(coefficients.size()));
  for (std::size_t f = 0; f < coefficients.size(); ++f)
    B(Eigen::Index(f)) = at_u.value(coefficients[f][0]) * at_v.value(coefficients[f][1]);
}

void TsplineBasis::evaluate(int cell, double u, double v, ShapeValues& out) const {
  const Box<double>& box = cells_[std::size_t(cell)].parameters;
  const BernsteinPoint at_u(u, box.low[0], box.high[0]), at_v(v, box.low[1], box.high[1]);
  const auto& coefficients = coefficients_[std::size_t(cell)];
  const auto& functions = cells_[std::size_t(cell)].functions;
  const auto n = Eigen::Index(coefficients.size());
  for (auto* x : {&out.R, &out.R_u, &out.R_v, &out.R_uu, &out.R_vv, &out.R_uv}) x->resize(n);
  for (Eigen::Index f = 0; f < n; ++f) {
    const Coefficients& c = coefficients[std::size_t(f)];
    const Jet a = at_u.jet(c[0]), b = at_v.jet(c[1]);
    const double w = weights_(functions[std::size_t(f)]);
    out.R(f) = w * a.value * b.value;
    out.R_u(f) = w * a.first * b.value;
    out.R_v(f) = w * a.value * b.first;
    out.R_uu(f) = w * a.second * b.value;
    out.R_vv(f) = w * a.value * b.second;
    out.R_uv(f) = w * a.first * b.first;
  }
  // R = A / W: differentiate A = R W.
  const double W = out.R.sum(), W_u = out.R_u.sum(), W_v = out.R_v.sum();
  const double W_uu = out.R_uu.sum(), W_vv = out.R_vv.sum(), W_uv = out.R_uv.sum();
  out.R /= W;
  out.R_u = (out.R_u - W_u * out.R) / W;
  out.R_v = (out.R_v - W_v * out.R) / W;
  out.R_uu = (out.R_uu - 2 * W_u * out.R_u - W_uu * out.R) / W;
  out.R_vv = (out.R_vv - 2 * W_v * out.R_v - W_vv * out.R) / W;
  out.R_uv = (out.R_uv - W_u * out.R_v - W_v * out.R_u - W_uv * out.R) / W;
}

}  // namespace trammel::plate
