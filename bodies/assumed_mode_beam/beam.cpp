#include "beam.hpp"

#include <cmath>

#include <fmt/format.h>

namespace trammel::beam {

namespace {

Eigen::Matrix2d rotation(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

}  // namespace

AssumedModeBeam::AssumedModeBeam() {
  velocity = Eigen::Vector2d::Zero();
}

void AssumedModeBeam::prepare(const World& world) {
  if (world.space != Space::planar)
    throw ParameterError("type", "assumed_mode_beam is planar; expected \"space\": \"planar\"");
  if (int(hinge.has_value()) + int(clamped.has_value()) + int(free.has_value()) != 1)
    throw ParameterError("mount", "give exactly one of hinge, clamped, free, e.g. \"mount\": {\"hinge\": [0, 0]}");
  if (coupling == Coupling::none && free)
    throw ParameterError("coupling", "none needs a root that is held; use linear or full with mount free");
  if (clamped && !(torque.is_constant() && torque(0) == 0))
    throw ParameterError("torque", "a clamped beam cannot be driven; use mount hinge");
  if (clamped && angular_velocity != 0) throw ParameterError("angular_velocity", "a clamped beam cannot turn");
  if (!free && velocity.norm() != 0) throw ParameterError("velocity", "only a free root has one; use mount free");
  check_amplitudes("initial.axial", axial, axial_modes);
  check_amplitudes("initial.transverse", transverse, transverse_modes);
  check_amplitudes("initial.axial_rate", axial_rate, axial_modes);
  check_amplitudes("initial.transverse_rate", transverse_rate, transverse_modes);
  for (const auto& [name, x] : extra_markers) {
    if (!(x >= 0 && x <= length))
      throw ParameterError("markers", fmt::format("\"{}\" is at x = {}, expected 0 to {} (length)", name, x, length));
    if (name == "root" || name == "tip")
      throw ParameterError("markers",
                           fmt::format("\"{}\" exists already, at x = {}", name, name == "root" ? 0.0 : length));
  }

  gravity_ = world.gravity;
  n_ = 0;
  if (free) i_o_ = 0, n_ = 2;
  if (!clamped) i_theta_ = n_++;
  i_A_ = n_;
  i_B_ = n_ + axial_modes;
  n_ += axial_modes + transverse_modes;

  const int N = transverse_modes;
  shape_.L = length;
  shape_.hub_radius = hub_radius;
  for (int i = 1; i <= axial_modes; ++i) shape_.axial.emplace_back(i, length);
  for (int i = 1; i <= N; ++i) shape_.transverse.emplace_back(i, length);
  const bool foreshortening = coupling == Coupling::full;
  // Products of four mode slopes have up to 4 N half waves: 5.5 points each were found enough for round-off.
  const int points = int(std::ceil(5.5 * std::max(axial_modes, N))) + 4;
  const Quadrature rule = gauss_legendre(points, 0, length);
  const double line_density = density * area;
  table_.emplace(shape_, rule.x, line_density * rule.weight, foreshortening);

  Vec marker_x(2 + Eigen::Index(extra_markers.size()));
  marker_x(0) = 0, marker_x(1) = length;
  marker_names_ = {"root", "tip"};
  for (std::size_t i = 0; i < extra_markers.size(); ++i) {
    marker_names_.push_back(extra_markers[i].first);
    marker_x(2 + Eigen::Index(i)) = extra_markers[i].second;
  }
  markers_.emplace(shape_, marker_x, Vec::Zero(marker_x.size()), foreshortening);
  outline_.emplace(shape_, Vec::LinSpaced(outline_stations, 0, length), Vec::Zero(outline_stations), foreshortening);

  const ShapeTable& s = *table_;
  const int n = s.stations();
  double w_phi[most_stations], w_x[most_stations];
  mass_ = line_density * length;
  for (int g = 0; g < n; ++g) w_x[g] = s.weight()[g] * s.X0()[g];
  S0_ = total(n, w_x);
  I0_ = dot(n, w_x, s.X0());
  Sx_.resize(axial_modes), Dx_.resize(axial_modes), K1_.resize(axial_modes);
  Sy_.resize(N), Dy_.resize(N), K2_.resize(N);
  Mxy_.resize(axial_modes, N);
  D_.assign(std::size_t(axial_modes), Mat::Zero(N, N));
  F_.assign(std::size_t(N), Mat::Zero(N, N));
  for (int i = 0; i < axial_modes; ++i) {
    for (int g = 0; g < n; ++g) w_phi[g] = s.weight()[g] * s.phi_x(i)[g];
    Sx_(i) = total(n, w_phi);
    Dx_(i) = dot(n, w_phi, s.X0());
    for (int j = 0; j < N; ++j) Mxy_(i, j) = dot(n, w_phi, s.phi_y(j));
    for (int j = 0; foreshortening && j < N; ++j)
      for (int m = 0; m < N; ++m) D_[std::size_t(i)](j, m) = dot(n, w_phi, s.H(j, m));
    const double l = shape_.axial[std::size_t(i)].wave_number();
    K1_(i) = youngs_modulus * area * l * l * length / 2;
  }
  for (int i = 0; i < N; ++i) {
    for (int g = 0; g < n; ++g) w_phi[g] = s.weight()[g] * s.phi_y(i)[g];
    Sy_(i) = total(n, w_phi);
    Dy_(i) = dot(n, w_phi, s.X0());
    for (int j = 0; foreshortening && j < N; ++j)
      for (int m = 0; m < N; ++m) F_[std::size_t(i)](j, m) = dot(n, w_phi, s.H(j, m));
    K2_(i) = youngs_modulus * second_moment * std::pow(shape_.transverse[std::size_t(i)].wave_number(), 4) * length;
  }

  observable_names_ = {"angle", "angular_velocity", "tip_axial", "tip_transverse"};
  for (const char* name : {"axial", "transverse", "axial_rate", "transverse_rate"})
    for (int i = 1; i <= (name[0] == 'a' ? axial_modes : N); ++i)
      observable_names_.push_back(fmt::format("{}_{}", name, i));
}

void AssumedModeBeam::check_amplitudes(const char* name, const std::vector<double>& given, int modes) const {
  if (given.empty() || int(given.size()) == modes) return;
  throw ParameterError(name,
                       fmt::format("found {} numbers, expected {} (the number of modes) or none", given.size(), modes));
}

void AssumedModeBeam::initial(Out q, Out v) const {
  q.setZero();
  v.setZero();
  if (i_o_ >= 0) q.segment<2>(i_o_) = *free, v.segment<2>(i_o_) = velocity;
  if (i_theta_ >= 0) q(i_theta_) = angle, v(i_theta_) = angular_velocity;
  const auto fill = [](const std::vector<double>& from, int at, Out to) {
    for (std::size_t i = 0; i < from.size(); ++i) to(at + Eigen::Index(i)) = from[i];
  };
  fill(axial, i_A_, q), fill(transverse, i_B_, q);
  fill(axial_rate, i_A_, v), fill(transverse_rate, i_B_, v);
}

Eigen::Vector2d AssumedModeBeam::gravity_in_beam(double theta) const {
  return rotation(theta).transpose() * gravity_;
}

Eigen::Vector2d AssumedModeBeam::origin(In q) const {
  if (i_o_ >= 0) return q.segment<2>(i_o_);
  return hinge ? *hinge : *clamped;
}

void AssumedModeBeam::add_local_mass(In q, Local& M) const {
  switch (coupling) {
    case Coupling::full:
      return add_mass<true>(q, M);
    case Coupling::linear:
      return add_mass<false>(q, M);
    case Coupling::none:
      return add_uncoupled_mass(M);
  }
}

void AssumedModeBeam::mass(double, In q, Matrix& M) const {
  Local local = Local::Zero(n_, n_);
  add_local_mass(q, local);
  M.add(0, 0, local);
}

void AssumedModeBeam::force(double t, In q, In v, Out f) const {
  switch (coupling) {
    case Coupling::full:
      add_force<true>(q, v, f);
      break;
    case Coupling::linear:
      add_force<false>(q, v, f);
      break;
    case Coupling::none:
      add_uncoupled_force(q, f);
      break;
  }
  if (i_theta_ >= 0) f(i_theta_) += torque(t);
}

void AssumedModeBeam::add_tangent(double, In q, In v, In a, Blend c, Matrix& S) const {
  Local local = Local::Zero(n_, n_);
  switch (coupling) {
    case Coupling::full:
      add_tangent_of<true>(q, v, a, c, local);
      break;
    case Coupling::linear:
      add_tangent_of<false>(q, v, a, c, local);
      break;
    case Coupling::none:
      add_uncoupled_tangent(q, c, local);
      break;
  }
  S.add(0, 0, local);
}

// M = int J^T J dm. In the beam's axes the columns of J are
//     o: R^T,   theta: (-Y, X),   A_i: (Phi_x,i, 0),   B_i: (-p_i, Phi_y,i).
template <bool foreshortening>
void AssumedModeBeam::add_mass(In q, Local& M) const {
  const ShapeTable& s = *table_;
  const int n = s.stations(), na = axial_modes, N = transverse_modes;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_;
  Row p[foreshortening ? most_modes : 1];
  alignas(64) double X[most_stations], Y[most_stations], row[most_stations];
  positions<foreshortening>(s, na, N, A, B, p, X, Y);

  double P[most_modes] = {};  // int p_i dm
  for (int i = 0; i < N; ++i) {
    if constexpr (foreshortening) {
      for (int g = 0; g < n; ++g) row[g] = s.weight()[g] * p[i][g];
      for (int j = 0; j <= i; ++j) M(i_B_ + i, i_B_ + j) = dot(n, row, p[j]);
      for (int j = 0; j < na; ++j) {
        double coupled = 0;
        for (int m = 0; m < N; ++m) coupled += D_[std::size_t(j)](m, i) * B[m];
        M(i_B_ + i, i_A_ + j) = -coupled;
      }
      if (i_theta_ >= 0) M(i_B_ + i, i_theta_) = dot(n, row, Y);
      if (i_o_ >= 0) P[i] = total(n, row);
    }
    M(i_B_ + i, i_B_ + i) += mass_;
  }
  for (int i = 0; i < na; ++i) M(i_A_ + i, i_A_ + i) = mass_ / 2;

  if (i_theta_ >= 0) {
    for (int g = 0; g < n; ++g) row[g] = s.weight()[g] * X[g];
    double inertia = hub_inertia + dot(n, row, X);
    for (int j = 0; j < N; ++j) M(i_B_ + j, i_theta_) += dot(n, row, s.phi_y(j));
    const double SX = i_o_ >= 0 ? total(n, row) : 0;
    for (int g = 0; g < n; ++g) row[g] = s.weight()[g] * Y[g];
    inertia += dot(n, row, Y);
    M(i_theta_, i_theta_) = inertia;
    for (int i = 0; i < na; ++i) {
      double coupled = 0;
      for (int j = 0; j < N; ++j) coupled += Mxy_(i, j) * B[j];
      M(i_A_ + i, i_theta_) = -coupled;
    }
    if (i_o_ >= 0) {
      const Eigen::Matrix2d R = rotation(theta(q));
      M(i_o_, i_o_) = M(i_o_ + 1, i_o_ + 1) = mass_;
      M.block<1, 2>(i_theta_, i_o_) = (R * Eigen::Vector2d(-total(n, row), SX)).transpose();
      for (int i = 0; i < na; ++i) M.block<1, 2>(i_A_ + i, i_o_) = (R * Eigen::Vector2d(Sx_(i), 0)).transpose();
      for (int i = 0; i < N; ++i) M.block<1, 2>(i_B_ + i, i_o_) = (R * Eigen::Vector2d(-P[i], Sy_(i))).transpose();
    }
  }
  for (int j = 1; j < n_; ++j)
    for (int i = 0; i < j; ++i) M(i, j) = M(j, i);
}

// f = -int J^T (alpha - gravity) dm - K with the acceleration at v' = 0
//     alpha_1 = -Bd^T H Bd - 2 w ud_y - w^2 X,    alpha_2 = 2 w ud_x - w^2 Y.
template <bool foreshortening>
void AssumedModeBeam::add_force(In q, In v, Out f) const {
  const ShapeTable& s = *table_;
  const int n = s.stations(), na = axial_modes, N = transverse_modes;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_, *Ad = v.data() + i_A_, *Bd = v.data() + i_B_;
  const double w = omega(v);
  const double angle_now = theta(q);
  const Eigen::Vector2d gravity = gravity_in_beam(angle_now);
  Row p[foreshortening ? most_modes : 1];
  alignas(64) double X[most_stations], Y[most_stations], u_x[most_stations], u_y[most_stations];
  alignas(64) double square[most_stations];
  positions<foreshortening>(s, na, N, A, B, p, X, Y);
  combine_axial(s, na, Ad, u_x);
  combine_transverse(s, N, Bd, u_y);
  if constexpr (foreshortening) {
    for (int i = 0; i < N; ++i) add_scaled(n, -Bd[i], p[i], u_x);
    foreshortening_square(s, N, Bd, square);
  }

  // u_x and u_y become the weighted accelerations.
  const double* weight = s.weight();
  double* a1 = u_y;
  double* a2 = u_x;
#pragma omp simd
  for (int g = 0; g < n; ++g) {
    const double bending = foreshortening ? square[g] : 0;
    const double first = -bending - 2 * w * u_y[g] - w * w * X[g] - gravity(0);
    const double second = 2 * w * u_x[g] - w * w * Y[g] - gravity(1);
    a1[g] = weight[g] * first;
    a2[g] = weight[g] * second;
  }
  for (int i = 0; i < na; ++i) f(i_A_ + i) -= dot(n, s.phi_x(i), a1) + K1_(i) * A[i];
  for (int i = 0; i < N; ++i) {
    f(i_B_ + i) -= dot(n, s.phi_y(i), a2) + K2_(i) * B[i];
    if constexpr (foreshortening) f(i_B_ + i) += dot(n, p[i], a1);
  }
  if (i_theta_ >= 0) f(i_theta_) += dot(n, Y, a1) - dot(n, X, a2);
  if (i_o_ >= 0) f.segment<2>(i_o_) -= rotation(angle_now) * Eigen::Vector2d(total(n, a1), total(n, a2));
}

// The derivative of int J^T alpha dm + K by a, v and q, blended. alpha now holds the accelerations a too. With
//     k1 = c_m - c_k w^2,   k2 = 2 w c_d + c_k w',   d = H Bd,   t = H (2 c_d Bd + c_k B'')
// the blended derivatives U of alpha by each coordinate are
//     theta: (-c_m Y - 2 c_d (ud_y + w X) + c_k b_2,  c_m X + 2 c_d (ud_x - w Y) - c_k b_1)
//     A_j:   (k1 Phi_x, k2 Phi_x)        B_j: (-k1 p - k2 Phi_y - t,  k1 Phi_y - k2 p - 2 w c_k d)
// where b = R^T (o'' - gravity); J^T's own derivative by q adds the terms with alpha.
template <bool foreshortening>
void AssumedModeBeam::add_tangent_of(In q, In v, In a, Blend c, Local& S) const {
  const ShapeTable& s = *table_;
  const int n = s.stations(), na = axial_modes, N = transverse_modes;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_, *Ad = v.data() + i_A_, *Bd = v.data() + i_B_;
  const double *Add = a.data() + i_A_, *Bdd = a.data() + i_B_;
  const double w = omega(v), w_dot = omega(a), angle_now = theta(q);
  Eigen::Vector2d b = -gravity_in_beam(angle_now);
  if (i_o_ >= 0) b += rotation(angle_now).transpose() * a.segment<2>(i_o_);
  const double k1 = c.c_m - c.c_k * w * w, k2 = 2 * w * c.c_d + c.c_k * w_dot;

  Row p[foreshortening ? most_modes : 1], t[foreshortening ? most_modes : 1];
  alignas(64) double X[most_stations], Y[most_stations], u_x[most_stations], u_y[most_stations];
  alignas(64) double a1[most_stations], a2[most_stations], U1[most_stations], U2[most_stations], row[most_stations];
  alignas(64) double square[most_stations];
  const double* weight = s.weight();
  positions<foreshortening>(s, na, N, A, B, p, X, Y);
  combine_axial(s, na, Ad, u_x);
  combine_transverse(s, N, Bd, u_y);
  combine_axial(s, na, Add, a1);
  combine_transverse(s, N, Bdd, a2);
  double tau[most_modes];
  if constexpr (foreshortening) {
    for (int i = 0; i < N; ++i) {
      add_scaled(n, -Bd[i], p[i], u_x);
      add_scaled(n, -Bdd[i], p[i], a1);
      tau[i] = 2 * c.c_d * Bd[i] + c.c_k * Bdd[i];
    }
    foreshortening_square(s, N, Bd, square);
    foreshortening_slope(s, N, tau, t);
  }
#pragma omp simd
  for (int g = 0; g < n; ++g) {
    const double bending = foreshortening ? square[g] : 0;
    const double first = a1[g] - w_dot * Y[g] - bending - 2 * w * u_y[g] - w * w * X[g] + b(0);
    const double second = a2[g] + w_dot * X[g] + 2 * w * u_x[g] - w * w * Y[g] + b(1);
    a1[g] = weight[g] * first;
    a2[g] = weight[g] * second;
    U1[g] = weight[g] * (-c.c_m * Y[g] - 2 * c.c_d * (u_y[g] + w * X[g]) + c.c_k * b(1));
    U2[g] = weight[g] * (c.c_m * X[g] + 2 * c.c_d * (u_x[g] - w * Y[g]) - c.c_k * b(0));
  }

  // By A: rows A, and B through D.
  for (int i = 0; i < na; ++i) S(i_A_ + i, i_A_ + i) += k1 * mass_ / 2 + c.c_k * K1_(i);
  for (int i = 0; i < na; ++i)
    for (int j = 0; j < N; ++j) {
      double by_B = k2 * Mxy_(i, j), by_A = k2 * Mxy_(i, j);
      if constexpr (foreshortening)
        for (int m = 0; m < N; ++m) {
          const double D = D_[std::size_t(i)](m, j);
          by_B += D * (k1 * B[m] + tau[m]);
          by_A -= D * k1 * B[m];
        }
      S(i_A_ + i, i_B_ + j) -= by_B;
      S(i_B_ + j, i_A_ + i) += by_A;
    }

  // By B: rows B.
  for (int i = 0; i < N; ++i) {
    S(i_B_ + i, i_B_ + i) += k1 * mass_ + c.c_k * K2_(i);
    if constexpr (foreshortening) {
      for (int g = 0; g < n; ++g) row[g] = weight[g] * p[i][g];
      for (int j = 0; j < N; ++j) {
        double E = 0, E_transposed = 0, Ed = 0;
        for (int m = 0; m < N; ++m) {
          E += F_[std::size_t(i)](m, j) * B[m];
          Ed += F_[std::size_t(i)](m, j) * Bd[m];
          E_transposed += F_[std::size_t(j)](m, i) * B[m];
        }
        double H_alpha = 0;
        if (c.c_k != 0) H_alpha = dot(n, s.H(i, j), a1);
        S(i_B_ + i, i_B_ + j) +=
            k1 * dot(n, row, p[j]) + dot(n, row, t[j]) + k2 * (E_transposed - E) - 2 * w * c.c_k * Ed - c.c_k * H_alpha;
      }
    }
  }
  if (i_theta_ < 0) return;

  // By theta, and row theta.
  S(i_theta_, i_theta_) += c.c_m * hub_inertia + dot(n, X, U2) - dot(n, Y, U1);
  for (int i = 0; i < na; ++i) S(i_A_ + i, i_theta_) += dot(n, s.phi_x(i), U1);
  for (int i = 0; i < N; ++i) {
    S(i_B_ + i, i_theta_) += dot(n, s.phi_y(i), U2);
    if constexpr (foreshortening) S(i_B_ + i, i_theta_) -= dot(n, p[i], U1);
  }
  // weights of Phi_x,j, of Phi_y,j and of p_j in row theta
  alignas(64) double by_axial[most_stations], by_phi[most_stations], by_p[most_stations], by_t[most_stations],
      by_d[most_stations];
#pragma omp simd
  for (int g = 0; g < n; ++g) {
    const double wX = weight[g] * X[g], wY = weight[g] * Y[g];
    by_axial[g] = -k1 * wY + k2 * wX + c.c_k * a2[g];
    by_phi[g] = k2 * wY + k1 * wX - c.c_k * a1[g];
    by_p[g] = k1 * wY - k2 * wX - c.c_k * a2[g];
    by_t[g] = wY;
    by_d[g] = -2 * w * c.c_k * wX;
  }
  for (int j = 0; j < na; ++j) S(i_theta_, i_A_ + j) += dot(n, s.phi_x(j), by_axial);
  for (int j = 0; j < N; ++j) {
    double sum = dot(n, s.phi_y(j), by_phi);
    if constexpr (foreshortening) {
      sum += dot(n, p[j], by_p) + dot(n, t[j], by_t);
      if (w * c.c_k != 0)
        for (int m = 0; m < N; ++m) sum += Bd[m] * dot(n, s.H(j, m), by_d);
    }
    S(i_theta_, i_B_ + j) += sum;
  }
  if (i_o_ < 0) return;

  // Rows and columns of the origin: R times the integral of U, and J^T R^T.
  const Eigen::Matrix2d R = rotation(angle_now);
  const auto place = [&](int column, double U_1, double U_2) {
    S.block<2, 1>(i_o_, column) += R * Eigen::Vector2d(U_1, U_2);
  };
  const auto place_row = [&](int r, double J_1, double J_2) {
    S.block<1, 2>(r, i_o_) += c.c_m * (R * Eigen::Vector2d(J_1, J_2)).transpose();
  };
  S(i_o_, i_o_) += c.c_m * mass_;
  S(i_o_ + 1, i_o_ + 1) += c.c_m * mass_;
  place(i_theta_, total(n, U1) - c.c_k * total(n, a2), total(n, U2) + c.c_k * total(n, a1));
  place_row(i_theta_, -dot(n, weight, Y), dot(n, weight, X));
  for (int j = 0; j < na; ++j) {
    place(i_A_ + j, k1 * Sx_(j), k2 * Sx_(j));
    place_row(i_A_ + j, Sx_(j), 0);
  }
  for (int j = 0; j < N; ++j) {
    double P = 0, T = 0, d = 0;
    if constexpr (foreshortening) {
      P = dot(n, weight, p[j]);
      T = dot(n, weight, t[j]);
      for (int m = 0; m < N; ++m) d += Bd[m] * dot(n, weight, s.H(j, m));
    }
    place(i_B_ + j, -k1 * P - k2 * Sy_(j) - T, k1 * Sy_(j) - k2 * P - 2 * w * c.c_k * d);
    place_row(i_B_ + j, -P, Sy_(j));
  }
}

void AssumedModeBeam::add_uncoupled_mass(Local& M) const {
  for (int i = 0; i < axial_modes; ++i) M(i_A_ + i, i_A_ + i) = mass_ / 2;
  for (int i = 0; i < transverse_modes; ++i) M(i_B_ + i, i_B_ + i) = mass_;
  if (i_theta_ < 0) return;
  M(i_theta_, i_theta_) = hub_inertia + I0_;
  for (int i = 0; i < transverse_modes; ++i) M(i_theta_, i_B_ + i) = M(i_B_ + i, i_theta_) = Dy_(i);
}

void AssumedModeBeam::add_uncoupled_force(In q, Out f) const {
  const auto A = q.segment(i_A_, axial_modes), B = q.segment(i_B_, transverse_modes);
  const Eigen::Vector2d gravity = gravity_in_beam(theta(q));
  f.segment(i_A_, axial_modes) += gravity(0) * Sx_ - K1_.cwiseProduct(A);
  f.segment(i_B_, transverse_modes) += gravity(1) * Sy_ - K2_.cwiseProduct(B);
  if (i_theta_ >= 0) f(i_theta_) += gravity(1) * (S0_ + Sx_.dot(A)) - gravity(0) * Sy_.dot(B);
}

void AssumedModeBeam::add_uncoupled_tangent(In q, Blend c, Local& S) const {
  const auto A = q.segment(i_A_, axial_modes), B = q.segment(i_B_, transverse_modes);
  const Eigen::Vector2d gravity = gravity_in_beam(theta(q));
  add_uncoupled_mass(S);
  S *= c.c_m;
  for (int i = 0; i < axial_modes; ++i) S(i_A_ + i, i_A_ + i) += c.c_k * K1_(i);
  for (int i = 0; i < transverse_modes; ++i) S(i_B_ + i, i_B_ + i) += c.c_k * K2_(i);
  if (i_theta_ < 0) return;
  S(i_theta_, i_theta_) += c.c_k * (gravity(0) * (S0_ + Sx_.dot(A)) + gravity(1) * Sy_.dot(B));
  for (int i = 0; i < axial_modes; ++i) {
    S(i_theta_, i_A_ + i) -= c.c_k * gravity(1) * Sx_(i);
    S(i_A_ + i, i_theta_) -= c.c_k * gravity(1) * Sx_(i);
  }
  for (int i = 0; i < transverse_modes; ++i) {
    S(i_theta_, i_B_ + i) += c.c_k * gravity(0) * Sy_(i);
    S(i_B_ + i, i_theta_) += c.c_k * gravity(0) * Sy_(i);
  }
}

double AssumedModeBeam::potential(In q) const {
  const ShapeTable& s = *table_;
  const int n = s.stations();
  Eigen::Vector2d moment;  // int (X, Y) dm
  if (coupling == Coupling::none) {
    moment << S0_ + Sx_.dot(q.segment(i_A_, axial_modes)), Sy_.dot(q.segment(i_B_, transverse_modes));
  } else {
    Row p[most_modes];
    alignas(64) double X[most_stations], Y[most_stations];
    const double *A = q.data() + i_A_, *B = q.data() + i_B_;
    if (coupling == Coupling::full)
      positions<true>(s, axial_modes, transverse_modes, A, B, p, X, Y);
    else
      positions<false>(s, axial_modes, transverse_modes, A, B, p, X, Y);
    moment << dot(n, s.weight(), X), dot(n, s.weight(), Y);
  }
  return -gravity_.dot(mass_ * origin(q) + rotation(theta(q)) * moment);
}

Energy AssumedModeBeam::energy(double, In q, In v) const {
  Local M = Local::Zero(n_, n_);
  add_local_mass(q, M);
  Energy e;
  e.kinetic = 0.5 * v.dot(M * v);
  e.potential = potential(q);
  for (int i = 0; i < axial_modes; ++i) e.elastic += 0.5 * K1_(i) * q(i_A_ + i) * q(i_A_ + i);
  for (int i = 0; i < transverse_modes; ++i) e.elastic += 0.5 * K2_(i) * q(i_B_ + i) * q(i_B_ + i);
  return e;
}

Power AssumedModeBeam::power(double t, In, In v) const {
  return {.supplied = omega(v) * torque(t)};
}

}  // namespace trammel::beam
