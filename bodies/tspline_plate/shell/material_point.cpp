#include "tspline_plate/shell/material_point.hpp"

#include <Eigen/Geometry>

namespace trammel::plate {

namespace {

constexpr double least_sine = 1e-12;  // of the angle between the tangents: below it they give no area

}  // namespace

Matrix3 plane_stress(const Section& s) {
  const double nu = s.poissons_ratio, c = s.youngs_modulus / (1 - nu * nu);
  return Matrix3{{c, nu * c, 0}, {nu * c, c, 0}, {0, 0, (1 - nu) / 2 * c}};
}

bool ReferencePoint::set(const Vectors5& reference, const Section& section) {
  Y = reference;
  const Vector3 A1 = Y.row(0), A2 = Y.row(1), cross = A1.cross(A2);
  area = cross.norm();
  if (!(area > least_sine * A1.norm() * A2.norm())) return false;
  N = cross / area;

  const double A11 = A1.dot(A1), A22 = A2.dot(A2), A12 = A1.dot(A2), det = area * area;
  const Vector3 dual1 = (A22 * A1 - A12 * A2) / det, dual2 = (A11 * A2 - A12 * A1) / det;
  const Vector3 e1 = A1.normalized(), e2 = N.cross(e1);
  const double t11 = e1.dot(dual1), t12 = e1.dot(dual2), t21 = e2.dot(dual1), t22 = e2.dot(dual2);
  T << t11 * t11, t12 * t12, t11 * t12, t21 * t21, t22 * t22, t21 * t22, 2 * t11 * t21, 2 * t12 * t22,
      t11 * t22 + t12 * t21;

  const double h = section.thickness;
  const Matrix3 C = T.transpose() * plane_stress(section) * T;
  membrane = h * C;
  bending = h * h * h / 12 * C;
  return true;
}

void deform(const ReferencePoint& reference, const Vectors5& d, DeformedPoint& at) {
  at.y = reference.Y + d;
  const Vector3 A1 = reference.Y.row(0), A2 = reference.Y.row(1), d1 = d.row(0), d2 = d.row(1);
  const Vector3 a1 = at.y.row(0), a2 = at.y.row(1);

  // |a_1 x a_2| - |A_1 x A_2| and n - N without cancellation.
  const Vector3 change = A1.cross(d2) + d1.cross(a2);
  const double area0 = reference.area;
  at.area = (area0 * reference.N + change).norm();
  const double growth = change.dot(2 * area0 * reference.N + change) / (at.area + area0);
  const Vector3 tilt = (change - growth * reference.N) / at.area;
  at.n = reference.N + tilt;

  const double a11 = a1.dot(a1), a22 = a2.dot(a2), a12 = a1.dot(a2), det = at.area * at.area;
  at.metric[0] = a22 / det, at.metric[1] = a11 / det, at.metric[2] = -a12 / det;
  at.dual[0] = at.metric[0] * a1 + at.metric[2] * a2;
  at.dual[1] = at.metric[2] * a1 + at.metric[1] * a2;

  at.eps << A1.dot(d1) + 0.5 * d1.dot(d1), A2.dot(d2) + 0.5 * d2.dot(d2), A1.dot(d2) + A2.dot(d1) + d1.dot(d2);
  for (int k = 0; k < 3; ++k) {
    const Vector3 C = reference.Y.row(2 + k), c = at.y.row(2 + k);
    const double f = k == 2 ? 2 : 1;
    at.kappa(k) = -f * (C.dot(tilt) + Vector3(d.row(2 + k)).dot(at.n));
    at.christoffel[0](k) = c.dot(at.dual[0]);
    at.christoffel[1](k) = c.dot(at.dual[1]);
  }
}

void add_gradient(const DeformedPoint& at, const Strain& N, const Strain& M, Vectors5& g) {
  const Vector3 a1 = at.y.row(0), a2 = at.y.row(1), w(M(0), M(1), 2 * M(2));
  g.row(0) += N(0) * a1 + N(2) * a2 + w.dot(at.christoffel[0]) * at.n;
  g.row(1) += N(1) * a2 + N(2) * a1 + w.dot(at.christoffel[1]) * at.n;
  for (int k = 0; k < 3; ++k) g.row(2 + k) -= w(k) * at.n;
}

namespace {

constexpr int plane_i[6] = {0, 1, 2, 0, 0, 1}, plane_j[6] = {0, 1, 2, 1, 2, 2};

}  // namespace

void add_hessian(const ReferencePoint& reference, const DeformedPoint& at, const Strain& N, const Strain& M,
                 double factor, Planes& H) {
  // The part along n n^T: K^T (bending) K with rows K_k = -f_k (-G^1_k, -G^2_k, delta_k) n, and the turning of n.
  double k[3][5];
  for (int r = 0; r < 3; ++r) {
    const double f = r == 2 ? 2 : 1;
    k[r][0] = f * at.christoffel[0](r), k[r][1] = f * at.christoffel[1](r);
    for (int c = 0; c < 3; ++c) k[r][2 + c] = r == c ? -f : 0;
  }
  double Dk[3][5];
  for (int r = 0; r < 3; ++r)
    for (int q = 0; q < 5; ++q)
      Dk[r][q] =
          reference.bending(r, 0) * k[0][q] + reference.bending(r, 1) * k[1][q] + reference.bending(r, 2) * k[2][q];
  double along_n[5][5];
  for (int p = 0; p < 5; ++p)
    for (int q = 0; q < 5; ++q) along_n[p][q] = k[0][p] * Dk[0][q] + k[1][p] * Dk[1][q] + k[2][p] * Dk[2][q];

  const Vector3 w(M(0), M(1), 2 * M(2));
  const double S[2] = {w.dot(at.christoffel[0]), w.dot(at.christoffel[1])};
  const double curvature = w(0) * at.y.row(2).dot(at.n) + w(1) * at.y.row(3).dot(at.n) + w(2) * at.y.row(4).dot(at.n);
  along_n[0][0] += at.metric[0] * curvature;
  along_n[1][1] += at.metric[1] * curvature;
  along_n[0][1] += at.metric[2] * curvature;
  along_n[1][0] += at.metric[2] * curvature;

  const Matrix3& D = reference.membrane;
  for (int plane = 0; plane < 6; ++plane) {
    const int i = plane_i[plane], j = plane_j[plane];
    double* h = H[plane];
    const double nn = factor * at.n(i) * at.n(j);
    for (int p = 0; p < 5; ++p)
      for (int q = 0; q < 5; ++q) h[5 * p + q] += nn * along_n[p][q];

    // Membrane: rows of E are (a_1, 0), (0, a_2), (a_2, a_1).
    const double i1 = at.y(0, i), i2 = at.y(1, i), j1 = at.y(0, j), j2 = at.y(1, j);
    double m00 = i1 * (D(0, 0) * j1 + D(0, 2) * j2) + i2 * (D(2, 0) * j1 + D(2, 2) * j2);
    double m01 = i1 * (D(0, 1) * j2 + D(0, 2) * j1) + i2 * (D(2, 1) * j2 + D(2, 2) * j1);
    double m10 = i2 * (D(1, 0) * j1 + D(1, 2) * j2) + i1 * (D(2, 0) * j1 + D(2, 2) * j2);
    double m11 = i2 * (D(1, 1) * j2 + D(1, 2) * j1) + i1 * (D(2, 1) * j2 + D(2, 2) * j1);
    if (i == j) m00 += N(0), m11 += N(1), m01 += N(2), m10 += N(2);
    // n turns: (a_a, a_b) -= S^a a^b n^T + S^b n a^a T, and (c_k, a_b) += w_k a^b n^T with its transpose.
    const double ni = at.n(i), nj = at.n(j);
    const double di[2] = {at.dual[0](i), at.dual[1](i)}, dj[2] = {at.dual[0](j), at.dual[1](j)};
    m00 -= S[0] * (di[0] * nj + ni * dj[0]);
    m11 -= S[1] * (di[1] * nj + ni * dj[1]);
    m01 -= S[0] * di[1] * nj + S[1] * ni * dj[0];
    m10 -= S[1] * di[0] * nj + S[0] * ni * dj[1];
    h[0] += factor * m00, h[1] += factor * m01, h[5] += factor * m10, h[6] += factor * m11;
    for (int c = 0; c < 3; ++c)
      for (int b = 0; b < 2; ++b) {
        h[5 * (2 + c) + b] += factor * w(c) * di[b] * nj;
        h[5 * b + 2 + c] += factor * w(c) * ni * dj[b];
      }
  }
}

}  // namespace trammel::plate
