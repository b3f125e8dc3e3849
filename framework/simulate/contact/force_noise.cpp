#include "simulate/contact/force_noise.hpp"

namespace trammel::simulate {

Judged judge_forces(model::AssembledSystem& system, const std::vector<model::ContactDirection>& directions,
                    const Vec& F, const ContactScale& scale) {
  Mat jump, D;
  system.impulse_response(directions, jump, D);
  Judged judged{F.cwiseAbs(), Vec::Zero(F.size())};
  for (Eigen::Index i = 0; i < F.size(); ++i) {
    if (!(D(i, i) > 0)) continue;  // nothing can move along it
    judged.scale[i] = D.row(i).cwiseAbs().dot(F.cwiseAbs()) / D(i, i);
    judged.noise[i] = scale.of(directions[std::size_t(i)].contact).no_acceleration() / D(i, i);
  }
  return judged;
}

}  // namespace trammel::simulate
