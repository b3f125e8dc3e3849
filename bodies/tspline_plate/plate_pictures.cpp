// What the plate shows of itself: observables, outline, stresses over its elements.
#include <algorithm>

#include "plate.hpp"

namespace trammel::plate {

StressState TsplinePlate::stress_at(double u, double v, In q) const {
  return stress(*mesh_, {thickness, youngs_modulus, poissons_ratio}, surface_point(*mesh_, u, v), q);
}

double TsplinePlate::observe(int observable, double, In q, In) const {
  const Section section{thickness, youngs_modulus, poissons_ratio};
  const auto face = [](const auto& of, int which) { return which == 0 ? of.top : which == 1 ? of.middle : of.bottom; };
  if (observable < 3) return face(largest_stress(*mesh_, section, q), observable);
  if (observable == 3) return strain_energy(q).membrane;
  if (observable == 4) return strain_energy(q).bending;
  if (observable == 5) return double(mesh_->basis.mesh().elements().size());
  const auto marker = std::size_t(observable - 6) / 3;
  return von_mises(face(stress(*mesh_, section, marker_points_[marker].point, q), (observable - 6) % 3));
}

// A grid drawn in one go: lines v = const to and fro, then lines u = const.
void TsplinePlate::shape(double, In q, Mat& points) const {
  constexpr int lines = 9, steps = 16;
  const auto &u = mesh_->basis.mesh().knots(0), &v = mesh_->basis.mesh().knots(1);
  points.resize(3, 2 * lines * (steps + 1));
  Eigen::Index column = 0;
  for (int direction = 0; direction < 2; ++direction)
    for (int line = 0; line < lines; ++line)
      for (int k = 0; k <= steps; ++k) {
        const double across = double(line) / (lines - 1), along = double(line % 2 == 0 ? k : steps - k) / steps;
        const double s = direction == 0 ? along : across, t = direction == 0 ? across : along;
        const SurfacePoint at =
            surface_point(*mesh_, u.front() + s * (u.back() - u.front()), v.front() + t * (v.back() - v.front()));
        points.col(column++) = place(*mesh_, at, q).r;
      }
}

// Each element from inside: at a double knot the stress jumps from one to the next.
void TsplinePlate::fields_at(double, In q, In, std::vector<FieldPatch>& patches) const {
  constexpr int along = 5;
  constexpr double inside = 1e-9;  // of the element
  const Section section{thickness, youngs_modulus, poissons_ratio};
  const std::vector<Box<double>> boxes = element_boxes(mesh_->basis.mesh());
  patches.resize(boxes.size());
  for (std::size_t e = 0; e < boxes.size(); ++e) {
    const auto& [low, high] = boxes[e];
    FieldPatch& patch = patches[e];
    patch.along = along;
    patch.points.resize(3, along * along), patch.values.resize(3, along * along);
    const auto at = [&](int direction, int k) {
      const double part = std::clamp(double(k) / (along - 1), inside, 1 - inside);
      return low[std::size_t(direction)] + part * (high[std::size_t(direction)] - low[std::size_t(direction)]);
    };
    for (int k = 0; k < along * along; ++k) {
      const SurfacePoint point = surface_point(*mesh_, at(0, k % along), at(1, k / along));
      const StressState s = stress(*mesh_, section, point, q);
      patch.points.col(k) = place(*mesh_, point, q).r;
      patch.values.col(k) << von_mises(s.top), von_mises(s.middle), von_mises(s.bottom);
    }
  }
}

}  // namespace trammel::plate
