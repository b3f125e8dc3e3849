#include "tspline_plate/shell/discretisation.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <trammel/quadrature.hpp>
#include <trammel/simd.hpp>

namespace trammel::plate {

namespace {

constexpr int mass_points = 4;

struct CellRule {
  std::vector<Eigen::Vector2d> at;
  std::vector<double> weight;
};

CellRule rule_on(const Box<double>& box, int n) {
  const Quadrature u = gauss_legendre(n, box.low[0], box.high[0]), v = gauss_legendre(n, box.low[1], box.high[1]);
  CellRule rule;
  for (Eigen::Index b = 0; b < n; ++b)
    for (Eigen::Index a = 0; a < n; ++a) {
      rule.at.emplace_back(u.x(a), v.x(b));
      rule.weight.push_back(u.weight(a) * v.weight(b));
    }
  return rule;
}

Vectors5 tangents_of(const ShapeValues& s, const Points& points, const std::vector<int>& nodes) {
  Vectors5 y = Vectors5::Zero();
  for (std::size_t f = 0; f < nodes.size(); ++f) {
    const auto i = Eigen::Index(f);
    const Eigen::RowVector3d P = points.row(nodes[f]);
    y.row(0) += s.R_u(i) * P;
    y.row(1) += s.R_v(i) * P;
    y.row(2) += s.R_uu(i) * P;
    y.row(3) += s.R_vv(i) * P;
    y.row(4) += s.R_uv(i) * P;
  }
  return y;
}

}  // namespace

std::vector<TsplineBasis> Discretisation::functions_of(const std::vector<ControlNet>& patches) {
  std::vector<TsplineBasis> result;
  for (const ControlNet& net : patches) result.emplace_back(net.mesh, net.weights);
  return result;
}

Points Discretisation::points_of(const std::vector<ControlNet>& patches) {
  Eigen::Index count = 0;
  for (const ControlNet& net : patches) count += net.points.rows();
  Points result(count, 3);
  count = 0;
  for (const ControlNet& net : patches) {
    result.middleRows(count, net.points.rows()) = net.points;
    count += net.points.rows();
  }
  return result;
}

void Discretisation::number_coordinates(Cell& cell) const {
  for (int f = 0; f < cell.functions; ++f)
    for (int axis = 0; axis < 3; ++axis)
      for (const Term& t : coordinates.terms(3 * cell.nodes[std::size_t(f)] + axis)) {
        auto found = std::find(cell.dofs.begin(), cell.dofs.end(), t.component);
        if (found == cell.dofs.end()) found = cell.dofs.insert(found, t.component);
        cell.terms.push_back({3 * f + axis, int(found - cell.dofs.begin()), t.factor});
      }
  cell.plain = int(cell.terms.size()) == 3 * cell.functions && int(cell.dofs.size()) == 3 * cell.functions &&
               std::all_of(cell.terms.begin(), cell.terms.end(),
                           [](const Cell::Local& t) { return t.component == t.dof && t.factor == 1; });
}

void Discretisation::integrate(const PlateData& data) {
  const double surface_density = data.density * data.section.thickness;
  area = Vec::Zero(basis.size());
  for (int c = 0; c < int(basis.cells().size()); ++c) {
    Cell& cell = cells.emplace_back();
    connect(c, cell);
    sample_shapes(c, data, cell);
    integrate_mass(c, surface_density, cell);
  }
  lumped = surface_density * area;
}

void Discretisation::connect(int c, Cell& cell) const {
  const BezierCell& bezier = basis.cells()[std::size_t(c)];
  cell.functions = int(bezier.functions.size());
  if (cell.functions > most_functions)
    throw std::invalid_argument(fmt::format("{} functions overlap in one cell, {} is the most; choose the closure both",
                                            cell.functions, most_functions));
  cell.padded = simd::padded(cell.functions);
  cell.nodes = bezier.functions;
  number_coordinates(cell);
}

// At the quadrature points of the elastic part.
void Discretisation::sample_shapes(int c, const PlateData& data, Cell& cell) const {
  const auto n = std::size_t(cell.padded);
  const CellRule rule = rule_on(basis.cells()[std::size_t(c)].parameters, data.quadrature);
  cell.shape.assign(5 * n * rule.at.size(), 0);
  cell.value.assign(n * rule.at.size(), 0);
  ShapeValues s;
  for (std::size_t p = 0; p < rule.at.size(); ++p) {
    const Eigen::Vector2d& at = rule.at[p];
    basis.evaluate(c, at.x(), at.y(), s);
    const Eigen::VectorXd* rows[] = {&s.R_u, &s.R_v, &s.R_uu, &s.R_vv, &s.R_uv};
    for (std::size_t k = 0; k < 5; ++k) std::copy_n(rows[k]->data(), rows[k]->size(), &cell.shape[(5 * p + k) * n]);
    std::copy_n(s.R.data(), s.R.size(), &cell.value[p * n]);
    ReferencePoint& reference = cell.points.emplace_back();
    if (!reference.set(tangents_of(s, points, cell.nodes), data.section))
      throw std::invalid_argument(
          fmt::format("the surface is degenerate at (u, v) = ({}, {}): its tangents are parallel", at.x(), at.y()));
    cell.weight.push_back(rule.weight[p] * reference.area);
  }
}

// Adds the cell's part to `area` also.
void Discretisation::integrate_mass(int c, double surface_density, Cell& cell) {
  const auto n = std::size_t(cell.padded);
  cell.mass.assign(n * n, 0);
  const CellRule rule = rule_on(basis.cells()[std::size_t(c)].parameters, mass_points);
  ShapeValues s;
  for (std::size_t p = 0; p < rule.at.size(); ++p) {
    basis.evaluate(c, rule.at[p].x(), rule.at[p].y(), s);
    const Vectors5 y = tangents_of(s, points, cell.nodes);
    const double dA = rule.weight[p] * Vector3(y.row(0)).cross(Vector3(y.row(1))).norm();
    for (int i = 0; i < cell.functions; ++i) {
      area(cell.nodes[std::size_t(i)]) += dA * s.R(i);
      for (int j = 0; j < cell.functions; ++j)
        cell.mass[std::size_t(i) * n + std::size_t(j)] += surface_density * dA * s.R(i) * s.R(j);
    }
  }
}

}  // namespace trammel::plate
