#include "tspline_plate/shell/cell_forces.hpp"

#include <algorithm>

#include "tspline_plate/shell/simd_loops.hpp"
#include "tspline_plate/shell/viscous_point.hpp"

namespace trammel::plate {

void gather(const Cell& cell, In of_q, CellVectors& u) {
  std::fill_n(u, 3 * cell.padded, 0.0);
  if (cell.plain) {
    for (int axis = 0; axis < 3; ++axis)
      for (int I = 0; I < cell.functions; ++I) u[axis * cell.padded + I] = of_q(cell.dofs[std::size_t(3 * I + axis)]);
    return;
  }
  for (const Cell::Local& t : cell.terms)
    u[t.component % 3 * cell.padded + t.component / 3] += t.factor * of_q(cell.dofs[std::size_t(t.dof)]);
}

void scatter(const Cell& cell, const CellVectors& f, double factor, Out of_q) {
  for (const Cell::Local& t : cell.terms)
    of_q(cell.dofs[std::size_t(t.dof)]) += factor * t.factor * f[t.component % 3 * cell.padded + t.component / 3];
}

void add_elastic(const Cell& cell, const CellVectors& u, const CellVectors* v, double tau, CellVectors* f,
                 CellEnergy* energy) {
  const int n = cell.padded;
  DeformedPoint at;
  Vectors5 d, rate, g;
  for (std::size_t p = 0; p < cell.points.size(); ++p) {
    const ReferencePoint& reference = cell.points[p];
    const double* shape = &cell.shape[p * 5 * std::size_t(n)];
    const double dA = cell.weight[p];
    interpolate(n, shape, u, d.data());
    deform(reference, d, at);
    Strain N = reference.membrane * at.eps, M = reference.bending * at.kappa;
    if (energy) {
      energy->membrane += 0.5 * dA * N.dot(at.eps);
      energy->bending += 0.5 * dA * M.dot(at.kappa);
    }
    if (v && tau > 0) {
      interpolate(n, shape, *v, rate.data());
      const StrainRate s = strain_rate(at, rate);
      const Strain N_rate = tau * (reference.membrane * s.eps), M_rate = tau * (reference.bending * s.kappa);
      if (energy) energy->dissipated += dA * (N_rate.dot(s.eps) + M_rate.dot(s.kappa));
      N += N_rate, M += M_rate;
    }
    if (!f) continue;
    g.setZero();
    add_gradient(at, N, M, g);
    g *= dA;
    distribute(n, shape, g.data(), *f);
  }
}

namespace {

constexpr int most_points = 36;
constexpr int most_planes = 9;  // xx yy zz xy xz yz, and yx zx zy where damping makes the tangent unsymmetric
constexpr int plane_of[3][3] = {{0, 3, 4}, {6, 1, 5}, {7, 8, 2}};
constexpr int mirrored[3] = {3, 4, 5};  // of the planes 6, 7, 8

}  // namespace

void cell_tangent(const Cell& cell, const CellVectors& u, const CellVectors* v, double tau, Blend c,
                  double mass_damping, double* block, const CarriedStrains* carried) {
  const int n = cell.padded, size = 3 * cell.functions;
  const bool viscous = v && tau > 0;
  const int planes = viscous ? 9 : 6;
  alignas(64) double K[most_planes][most_functions * most_functions];  // K_ij(I, J) by J
  if (c.c_k != 0 || (viscous && c.c_d != 0)) {
    alignas(64) double G[most_planes][5 * most_points * most_functions];
    DeformedPoint at, from;
    Vectors5 d, rate;
    for (std::size_t p = 0; p < cell.points.size(); ++p) {
      const ReferencePoint& reference = cell.points[p];
      const double* shape = &cell.shape[p * 5 * std::size_t(n)];
      interpolate(n, shape, u, d.data());
      deform(reference, d, at);
      Strain N = reference.membrane * at.eps, M = reference.bending * at.kappa;
      if (carried) {
        interpolate(n, shape, carried->from, d.data());
        interpolate(n, shape, carried->increment, rate.data());
        deform(reference, d, from);
        const StrainRate s = strain_rate(from, rate);
        N = reference.membrane * (from.eps + s.eps), M = reference.bending * (from.kappa + s.kappa);
      }
      double H[most_planes][25] = {};
      if (!viscous) {
        add_hessian(reference, at, N, M, c.c_k * cell.weight[p], reinterpret_cast<Planes&>(H));
      } else {
        interpolate(n, shape, *v, rate.data());
        const StrainRate s = strain_rate(at, rate);
        N += tau * (reference.membrane * s.eps), M += tau * (reference.bending * s.kappa);
        add_hessian(reference, at, N, M, c.c_k * cell.weight[p], reinterpret_cast<Planes&>(H));
        for (int plane = 6; plane < 9; ++plane)
          for (int a = 0; a < 5; ++a)
            for (int b = 0; b < 5; ++b) H[plane][5 * a + b] = H[mirrored[plane - 6]][5 * b + a];
        add_viscous(reference, at, rate, tau * cell.weight[p], c.c_d, c.c_k, H);
      }
      for (int plane = 0; plane < planes; ++plane) apply_hessian(n, H[plane], shape, &G[plane][5 * p * std::size_t(n)]);
    }
    const int rows = 5 * int(cell.points.size());
    const double* shape = cell.shape.data();
    for (int plane = 0; plane < planes; ++plane)
      if (!viscous && plane < 3)
        symmetric_product(rows, n, G[plane], shape, K[plane]);
      else
        product(rows, n, G[plane], shape, K[plane]);
    for (int plane = planes; plane < most_planes; ++plane) transpose(n, K[mirrored[plane - 6]], K[plane]);
  } else {
    for (auto& plane : K) std::fill_n(plane, n * n, 0.0);
  }

  const double c_mass = c.c_m + c.c_d * mass_damping;
  for (int J = 0; J < cell.functions; ++J) {
    const double* mass = &cell.mass[std::size_t(J * n)];
    for (int j = 0; j < 3; ++j) {
      const double *x = K[plane_of[0][j]] + J * n, *y = K[plane_of[1][j]] + J * n, *z = K[plane_of[2][j]] + J * n;
      double* column = block + (3 * J + j) * size;
      for (int I = 0; I < cell.functions; ++I) column[3 * I] = x[I], column[3 * I + 1] = y[I], column[3 * I + 2] = z[I];
      for (int I = 0; I < cell.functions; ++I) column[3 * I + j] += c_mass * mass[I];
    }
  }
}

}  // namespace trammel::plate
