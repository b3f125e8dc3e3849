#include "linear/bodies/body_masses.hpp"

#include <cmath>

namespace trammel::numerics {

namespace {

Eigen::Index velocities(const std::vector<BodyBlock>& bodies) {
  return bodies.empty() ? 0 : bodies.back().v0 + bodies.back().M.rows();
}

}  // namespace

bool BodyMasses::are_of(const std::vector<BodyBlock>& bodies) const {
  return !identity_ && fits(bodies);
}

bool BodyMasses::fits(const std::vector<BodyBlock>& bodies) const {
  return place_.size() == bodies.size() && inverse_.size() == velocities(bodies);
}

void BodyMasses::begin(const std::vector<BodyBlock>& bodies) {
  if (!fits(bodies)) place_.assign(bodies.size(), -1), dense_.clear();
  inverse_.setOnes(velocities(bodies)), inverse_root_.setOnes(velocities(bodies));
}

bool BodyMasses::factorise(const std::vector<BodyBlock>& bodies) {
  begin(bodies);
  identity_ = false;
  bool positive = true;
  for (std::size_t k = 0; k < bodies.size(); ++k) positive &= factorise(bodies[k], place_[k]);
  return positive;
}

void BodyMasses::take_identity(const std::vector<BodyBlock>& bodies) {
  begin(bodies);
  identity_ = true;
}

bool BodyMasses::factorise(const BodyBlock& body, int& place) {
  if (place < 0 && is_diagonal(body.M)) return invert_diagonal(body);
  if (place < 0) {
    place = int(dense_.size());
    dense_.push_back({body.v0, int(body.M.rows()), {}});
  }
  return dense_[std::size_t(place)].factors.compute(body.M);
}

bool BodyMasses::invert_diagonal(const BodyBlock& body) {
  bool positive = true;
  for (Eigen::Index i = 0; i < body.M.rows(); ++i) {
    const double m = body.M(i, i), inverse = inverse_[body.v0 + i] = 1 / m;
    inverse_root_[body.v0 + i] = inverse * std::sqrt(m);
    positive &= m > 0 && std::isfinite(m);
  }
  return positive;
}

void BodyMasses::solve(Vec& x) {
  x.array() *= inverse_.array();
  if (identity_) return;
  for (Dense& body : dense_) body.factors.solve(x.segment(body.v0, body.n));
}

}  // namespace trammel::numerics
