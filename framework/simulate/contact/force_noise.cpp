#include "simulate/contact/force_noise.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {

Judged judge_forces(model::AssembledSystem& system, const std::vector<model::ContactDirection>& directions,
                    const Vec& F, const ContactScale& scale) {
  Mat jump, D;
  system.impulse_response(directions, jump, D);
  Judged judged{F.cwiseAbs(), Vec::Zero(F.size()), Vec::Zero(F.size())};
  for (Eigen::Index i = 0; i < F.size(); ++i) {
    if (!(D(i, i) > 0)) continue;  // nothing can move along it
    judged.scale[i] = D.row(i).cwiseAbs().dot(F.cwiseAbs()) / D(i, i);
    const Scale of_contact = scale.of(directions[std::size_t(i)].contact);
    judged.noise[i] = of_contact.no_acceleration() / D(i, i);
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
  return least > 0 ? scale.of(contact).no_acceleration() / least : 0;
}

double force_noise(model::AssembledSystem& system, const ContactScale& scale,
                   const std::vector<model::ContactDirection>& directions) {
  Mat jump, delassus;
  system.impulse_response(directions, jump, delassus);
  const double most = delassus.cwiseAbs().rowwise().sum().maxCoeff();
  double nothing = 0;
  for (const model::ContactDirection& d : directions)
    nothing = std::max(nothing, scale.of(d.contact).no_acceleration());
  return most > 0 ? nothing / most : 0;
}

}  // namespace trammel::simulate
