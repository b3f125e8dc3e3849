// The plate's mass, forces, energies and tangent, cell by cell.
#include <Eigen/Geometry>

#include "tspline_plate/plate.hpp"

namespace trammel::plate {

namespace {

constexpr int most_components = 3 * most_functions;

// Adds a cell's block, given for the displacements of its functions, in its coordinates.
void add_block(const Cell& cell, const double* block, Matrix& S) {
  const int size = 3 * cell.functions;
  using View = Eigen::Map<const Mat>;
  if (cell.plain) {
    S.add(cell.dofs, View(block, size, size));
    return;
  }
  const auto n = int(cell.dofs.size());
  if (n == 0) return;
  double held[most_components * most_components];
  std::fill_n(held, n * n, 0.0);
  for (const Cell::Local& column : cell.terms)
    for (const Cell::Local& row : cell.terms)
      held[column.dof * n + row.dof] += row.factor * column.factor * block[column.component * size + row.component];
  S.add(cell.dofs, View(held, n, n));
}

}  // namespace

// Axes are independent unless an edge holds a direction of its own.
void TsplinePlate::mass(double, In, Matrix& M) const {
  int dofs[most_functions];
  using View = Eigen::Map<const Mat, 0, Eigen::OuterStride<>>;
  for (const Cell& cell : mesh_->cells) {
    const int n = cell.functions;
    if (cell.plain) {
      for (int axis_ = 0; axis_ < 3; ++axis_) {
        for (int I = 0; I < n; ++I) dofs[I] = cell.dofs[std::size_t(3 * I + axis_)];
        M.add(std::span(dofs, std::size_t(n)), View(cell.mass.data(), n, n, Eigen::OuterStride<>(cell.padded)));
      }
      continue;
    }
    for (const Cell::Local& column : cell.terms)
      for (const Cell::Local& row : cell.terms) {
        if (row.component % 3 != column.component % 3) continue;
        const double m = cell.mass[std::size_t(column.component / 3 * cell.padded + row.component / 3)];
        M.add(cell.dofs[std::size_t(row.dof)], cell.dofs[std::size_t(column.dof)], row.factor * column.factor * m);
      }
  }
}

void TsplinePlate::add_loads(double t, In q, Out f) const {
  f += dead_factor(t) * dead_force_;
  for (const MomentEdge& e : moment_edges_)
    add_edge_moment(*mesh_, edges[e.edge], e.points, given(e.patch).edge_moment(e.edge)(t), q, f);
  const double p = pressure(t);
  if (p == 0) return;
  CellVectors u, of_cell;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u);
    std::fill_n(of_cell, 3 * cell.padded, 0.0);
    add_pressure(cell, u, p, of_cell);
    scatter(cell, of_cell, 1, f);
  }
}

void TsplinePlate::force(double t, In q, In v, Out f) const {
  CellVectors u, rate, of_cell;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u);
    std::fill_n(of_cell, 3 * cell.padded, 0.0);
    if (damped()) gather(cell, v, rate);
    add_elastic(cell, u, damped() ? &rate : nullptr, stiffness_damping, &of_cell, nullptr);
    if (mass_damping > 0)
      for (int axis_ = 0; axis_ < 3; ++axis_)
        for (int I = 0; I < cell.functions; ++I)
          for (int J = 0; J < cell.functions; ++J)
            of_cell[axis_ * cell.padded + I] +=
                mass_damping * cell.mass[std::size_t(I * cell.padded + J)] * rate[axis_ * cell.padded + J];
    scatter(cell, of_cell, -1, f);
  }
  f += weight_force_;
  add_loads(t, q, f);
}

CellEnergy TsplinePlate::strain_energy(In q) const {
  CellEnergy energy;
  CellVectors u;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u);
    add_elastic(cell, u, nullptr, 0, nullptr, &energy);
  }
  return energy;
}

namespace {

double twice_kinetic(const Cell& cell, const CellVectors& rate) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int I = 0; I < cell.functions; ++I)
      for (int J = 0; J < cell.functions; ++J)
        sum +=
            rate[axis * cell.padded + I] * cell.mass[std::size_t(I * cell.padded + J)] * rate[axis * cell.padded + J];
  return sum;
}

}  // namespace

Energy TsplinePlate::energy(double, In q, In v) const {
  Energy result;
  CellEnergy strain;
  CellVectors u, rate;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u), gather(cell, v, rate);
    add_elastic(cell, u, nullptr, 0, nullptr, &strain);
    result.kinetic += 0.5 * twice_kinetic(cell, rate);
  }
  result.elastic = strain.membrane + strain.bending;
  result.potential = -weight_force_.dot(q) - gravity_.dot(mesh_->points.transpose() * mesh_->lumped);
  return result;
}

// int rho h r x v dA: r and v are in the same functions, so the mass matrix gives it exactly.
Momentum TsplinePlate::momentum(double, In q, In v) const {
  Momentum result{mesh_->lumped.sum(), Vec3::Zero(3), Vec3::Zero(3)};
  CellVectors u, rate;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u), gather(cell, v, rate);
    const int n = cell.padded;
    for (int J = 0; J < cell.functions; ++J) {
      Vector3 moved = Vector3::Zero();  // sum_I m_IJ r_I
      double mass = 0;
      for (int I = 0; I < cell.functions; ++I) {
        const double m = cell.mass[std::size_t(J * n + I)];
        const Vector3 shift(u[I], u[n + I], u[2 * n + I]);
        moved += m * (Vector3(mesh_->points.row(cell.nodes[std::size_t(I)])) + shift);
        mass += m;
      }
      const Vector3 velocity_of_point(rate[J], rate[n + J], rate[2 * n + J]);
      result.linear += mass * velocity_of_point;
      result.angular += moved.cross(velocity_of_point);
    }
  }
  return result;
}

Power TsplinePlate::power(double t, In q, In v) const {
  Power result;
  Vec loads = Vec::Zero(v.size());
  add_loads(t, q, loads);
  result.supplied = loads.dot(v);
  if (!damped()) return result;
  CellVectors u, rate;
  CellEnergy strain;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u), gather(cell, v, rate);
    add_elastic(cell, u, &rate, stiffness_damping, nullptr, &strain);
    result.dissipated += mass_damping * twice_kinetic(cell, rate);
  }
  result.dissipated += strain.dissipated;
  return result;
}

void TsplinePlate::add_tangent(double t, In q, In v, In, Blend c, Matrix& S) const {
  double block[most_components * most_components];
  CellVectors u, rate;
  const bool viscous = stiffness_damping > 0;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u);
    if (viscous) gather(cell, v, rate);
    cell_tangent(cell, u, viscous ? &rate : nullptr, stiffness_damping, c, mass_damping, block);
    add_block(cell, block, S);
  }
  if (c.c_k != 0) add_load_tangent(t, q, c.c_k, S);
}

// The plate is at rest here, so damping has no stress.
void TsplinePlate::add_tangent_with_stress_from(double t, In q, In q_from, In dq, double c, Matrix& S) const {
  double block[most_components * most_components];
  CellVectors u;
  CarriedStrains carried;
  for (const Cell& cell : mesh_->cells) {
    gather(cell, q, u), gather(cell, q_from, carried.from), gather(cell, dq, carried.increment);
    cell_tangent(cell, u, nullptr, 0, {0, 0, c}, 0, block, &carried);
    add_block(cell, block, S);
  }
  add_load_tangent(t, q, c, S);
}

void TsplinePlate::add_load_tangent(double t, In q, double c, Matrix& S) const {
  for (const MomentEdge& e : moment_edges_)
    add_edge_moment_tangent(*mesh_, edges[e.edge], e.points, given(e.patch).edge_moment(e.edge)(t), q, c, S);
  const double p = pressure(t);
  if (p == 0) return;
  double block[most_components * most_components];
  CellVectors u;
  for (const Cell& cell : mesh_->cells) {
    const int size = 3 * cell.functions;
    std::fill_n(block, size * size, 0.0);
    gather(cell, q, u);
    add_pressure_tangent(cell, u, p, c, block);
    add_block(cell, block, S);
  }
}

}  // namespace trammel::plate
