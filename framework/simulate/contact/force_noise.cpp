#include "simulate/contact/force_noise.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {
namespace {

// [m/s^2] What the rounding of places becomes where rows are stabilised.
double shaking(const model::AssembledSystem& system, const Scale& scale) {
  const double beta = system.stabilised_by();
  return beta * beta * scale.resolution();
}

double no_acceleration(const model::AssembledSystem& system, const Scale& scale) {
  return std::max(scale.no_acceleration(), shaking(system, scale));
}

}  // namespace

Judged judge_forces(model::AssembledSystem& system, const std::vector<model::ContactDirection>& directions,
                    const Vec& F, const ContactScale& scale) {
  Mat jump, D;
  system.impulse_response(directions, jump, D);
  Judged judged{F.cwiseAbs(), Vec::Zero(F.size()), Vec::Zero(F.size())};
  for (Eigen::Index i = 0; i < F.size(); ++i) {
    if (!(D(i, i) > 0)) continue;  // nothing can move along it
    judged.scale[i] = D.row(i).cwiseAbs().dot(F.cwiseAbs()) / D(i, i);
    const Scale of_contact = scale.of(directions[std::size_t(i)].contact);
    judged.noise[i] = no_acceleration(system, of_contact) / D(i, i);
    judged.speed[i] = std::sqrt(D(i, i) * judged.scale[i] * of_contact.length());
  }
  return judged;
}

double friction_noise(model::AssembledSystem& system, const ContactScale& scale, int contact) {
  std::vector<model::ContactDirection> along;
  for (int k = 1; k <= system.tangents(contact); ++k) along.push_back({contact, k});
  Mat jump, delassus;
  system.impulse_response(along, jump, delassus);
  const double least = delassus.diagonal().minCoeff();
  return least > 0 ? no_acceleration(system, scale.of(contact)) / least : 0;
}

double force_noise(model::AssembledSystem& system, const ContactScale& scale,
                   const std::vector<model::ContactDirection>& directions) {
  Mat jump, delassus;
  system.impulse_response(directions, jump, delassus);
  const double most = delassus.cwiseAbs().rowwise().sum().maxCoeff();
  double nothing = 0, shaken = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Scale own = scale.of(directions[i].contact);
    nothing = std::max(nothing, own.no_acceleration());
    const double D = delassus(Eigen::Index(i), Eigen::Index(i));
    if (D > 0) shaken = std::max(shaken, shaking(system, own) / D);
  }
  return most > 0 ? std::max(nothing / most, shaken) : 0;
}

}  // namespace trammel::simulate
