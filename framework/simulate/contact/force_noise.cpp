#include "simulate/contact/force_noise.hpp"

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

}  // namespace trammel::simulate
