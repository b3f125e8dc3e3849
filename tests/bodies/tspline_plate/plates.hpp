// Plates for tests, and a plain static solver for them.
#pragma once

#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <Eigen/SparseLU>
#include <nlohmann/json.hpp>

#include "tspline_plate/plate.hpp"

namespace trammel::plate::test {

inline const nlohmann::json& reference() {
  static const nlohmann::json data =
      nlohmann::json::parse(std::ifstream(TRAMMEL_SOURCE_DIR "/tests/data/plate/plate.json"));
  return data;
}

inline World space(double gravity = 0) {
  return {Space::spatial, Eigen::Vector3d(0, 0, -gravity)};
}

// A rectangle of sides a x b in the plane z = 0; set the rest, then prepare.
inline std::unique_ptr<TsplinePlate> rectangle_plate(double a, double b, const std::string& elements, double h,
                                                     double E, double nu, double density = 1) {
  auto plate = std::make_unique<TsplinePlate>();
  plate->sole_patch.along_u = Eigen::Vector3d(a, 0, 0), plate->sole_patch.along_v = Eigen::Vector3d(0, b, 0);
  plate->sole_patch.elements = elements;
  plate->thickness = h, plate->youngs_modulus = E, plate->poissons_ratio = nu, plate->density = density;
  return plate;
}

// "parameter: message" of what `prepare` refuses, or "accepted".
inline std::string refusal(TsplinePlate& plate) {
  try {
    plate.prepare(space());
  } catch (const ParameterError& e) {
    return e.parameter() + ": " + e.what();
  }
  return "accepted";
}

inline Joined joining(const std::string& from, const std::string& to, Continuity continuity = Continuity::C1) {
  Joined joined;
  joined.from = from, joined.to = to, joined.continuity = continuity;
  return joined;
}

inline Vec rest(const TsplinePlate& plate) {
  return Vec::Zero(plate.coordinates().nq());
}

inline Mat stiffness(const TsplinePlate& plate, const Vec& q) {
  Mat K = Mat::Zero(q.size(), q.size());
  Matrix into = Matrix::onto(K);
  plate.add_tangent(0, q, rest(plate), rest(plate), {0, 0, 1}, into);
  return K;
}

inline Vec force_at(const TsplinePlate& plate, const Vec& q) {
  Vec f = Vec::Zero(q.size());
  plate.force(0, q, Vec::Zero(q.size()), f);
  return f;
}

inline Vec solve(const Mat& K, const Vec& f) {
  const Eigen::SparseMatrix<double> sparse = K.sparseView();
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(sparse);
  return lu.solve(f);
}

// Newton's method for force(q) = 0 from q; the number of iterations, or -1. `load` sets the scale of the residual.
inline int equilibrium(const TsplinePlate& plate, Vec& q, double load, double tolerance = 1e-9, int most = 60) {
  for (int k = 0; k < most; ++k) {
    const Vec f = force_at(plate, q);
    if (!f.allFinite()) return -1;
    if (f.norm() < tolerance * load) return k;
    q += solve(stiffness(plate, q), f);
  }
  return -1;
}

inline Eigen::Vector3d point_of(const TsplinePlate& plate, double u, double v, const Vec& q) {
  return place(plate.mesh(), surface_point(plate.mesh(), u, v), q).r;
}

// Coordinates whose control points move by `displacement(P)`.
inline Vec moved(const TsplinePlate& plate,
                 const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& displacement) {
  Vec q = rest(plate);
  const auto& kept = plate.mesh().coordinates.kept();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Eigen::Vector3d P = plate.mesh().points.row(kept[k] / 3);
    q(Eigen::Index(k)) = displacement(P)(kept[k] % 3);
  }
  return q;
}

// Something smooth and not small, the same at every call.
inline Vec wavy(const TsplinePlate& plate, double size, double phase = 0) {
  return moved(plate, [=](const Eigen::Vector3d& P) -> Eigen::Vector3d {
    return size * Eigen::Vector3d(std::sin(2 * P.x() + P.y() + phase), std::cos(3 * P.y() - P.x() + phase),
                                  std::sin(3 * P.x() + phase) * std::cos(2 * P.y()));
  });
}

}  // namespace trammel::plate::test
