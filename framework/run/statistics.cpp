#include "run/statistics.hpp"

#include <stdexcept>

namespace trammel::simulate {

void Statistics::note_sizes(double t, Sizes now) {
  if (!sizes.empty() && sizes.back().sizes == now) return;
  if (sizes.size() < most_sizes)
    sizes.push_back({t, now});
  else
    ++sizes_left_out;
}

void Statistics::archive(Archive& a) {
  a("steps", steps), a("contact_steps", contact_steps), a("rejected", rejected), a("locating_steps", locating_steps);
  a("events", events), a("impacts", impacts), a("touches", touches);
  a("smallest_step", smallest_step), a("largest_step", largest_step);
  a("largest_g", largest.position), a("largest_g_dot", largest.velocity), a("largest_g_ddot", largest.acceleration);
  a("sizes_left_out", sizes_left_out);
  Vec flat(Eigen::Index(4 * sizes.size()));
  for (std::size_t i = 0; i < sizes.size(); ++i)
    flat.segment<4>(Eigen::Index(4 * i)) << sizes[i].t, sizes[i].sizes.nq, sizes[i].sizes.nv, sizes[i].sizes.nc;
  a("sizes", flat);
  if (flat.size() % 4 != 0) throw std::length_error("sizes");
  sizes.clear();
  for (Eigen::Index i = 0; i + 3 < flat.size(); i += 4)
    sizes.push_back({flat[i], {int(flat[i + 1]), int(flat[i + 2]), int(flat[i + 3])}});
}

}  // namespace trammel::simulate
