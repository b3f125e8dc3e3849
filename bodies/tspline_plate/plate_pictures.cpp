// Output of the plate: observables, outline, stresses over its elements.
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "tspline_plate/plate.hpp"

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
  if (observable == 5) return double(mesh_->basis.elements().size());
  const auto marker = std::size_t(observable - 6) / 3;
  return von_mises(face(stress(*mesh_, section, marker_points_[marker].point, q), (observable - 6) % 3));
}

std::string_view TsplinePlate::unit(int observable) const {
  if (observable == 3 || observable == 4) return "J";
  return observable == 5 ? "1" : "Pa";
}

namespace {

constexpr double same_corner = 1e-6;  // distance in the parameters, in which a patch has the size 1

// Corners are numbered patch by patch, four in each, as in `corners`. The path over edges and seams from one corner to
// another, both included.
std::vector<int> way(const Multipatch& basis, const std::vector<Seam>& seams, int from, int to) {
  const auto place_of = [&](int corner) {
    const Box<double> range = basis.range(corner / 4);
    const Corner& c = corners[corner % 4];
    return Eigen::Vector2d(edges[c.u_edge].high ? range.high[0] : range.low[0],
                           edges[c.v_edge].high ? range.high[1] : range.low[1]);
  };
  std::vector<int> before(std::size_t(4 * basis.patches()), -1), reached = {to};
  before[std::size_t(to)] = to;
  const auto reach = [&](int corner, int via) {
    if (before[std::size_t(corner)] >= 0) return;
    before[std::size_t(corner)] = via;
    reached.push_back(corner);
  };
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const int at = reached[k];
    for (const int beside : {at ^ 1, at ^ 2}) reach(beside, at);
    for (const Seam& seam : seams)
      for (const Eigen::Vector2d& there : other_sides(basis, seam, place_of(at))) {
        const int patch = basis.patch_at(there.x());
        for (int c = 4 * patch; c < 4 * patch + 4; ++c)
          if ((place_of(c) - there).norm() < same_corner) reach(c, at);
      }
  }
  std::vector<int> result = {from};
  while (result.back() != to) result.push_back(before[std::size_t(result.back())]);
  return result;
}

}  // namespace

// A grid as one polyline: of each patch the lines v = const in alternating directions, then the lines u = const back to
// the start; along edges to the next patch.
void TsplinePlate::shape(double, In q, Mat& points) const {
  constexpr int lines = 9, steps = 16;
  std::vector<Vector3> drawn;
  const auto draw = [&](int patch, double s, double t) {
    const auto [low, high] = mesh_->basis.range(patch);
    drawn.push_back(
        place(*mesh_, surface_point(*mesh_, low[0] + s * (high[0] - low[0]), low[1] + t * (high[1] - low[1])), q).r);
  };
  for (int patch = 0; patch < mesh_->basis.patches(); ++patch) {
    if (patch > 0) {
      const std::vector<int> corner = way(mesh_->basis, seams_, 4 * (patch - 1), 4 * patch);
      for (std::size_t k = 1; k < corner.size(); ++k)
        for (int step = 1; corner[k] / 4 == corner[k - 1] / 4 && step <= steps; ++step) {
          const auto between = [&](int bit) {
            const double a = corner[k - 1] & bit ? 1 : 0, b = corner[k] & bit ? 1 : 0;
            return a + (b - a) * step / steps;
          };
          draw(corner[k] / 4, between(1), between(2));
        }
    }
    for (int line = 0; line < lines; ++line)
      for (int k = 0; k <= steps; ++k)
        draw(patch, double(line % 2 == 0 ? k : steps - k) / steps, double(line) / (lines - 1));
    for (int line = lines - 1; line >= 0; --line)
      for (int k = 0; k <= steps; ++k)
        draw(patch, double(line) / (lines - 1), double(line % 2 == 0 ? steps - k : k) / steps);
  }
  points.resize(3, Eigen::Index(drawn.size()));
  for (std::size_t k = 0; k < drawn.size(); ++k) points.col(Eigen::Index(k)) = drawn[k];
}

// Each element from inside: at a double knot the stress jumps from one to the next.
void TsplinePlate::fields_at(double, In q, In, std::vector<FieldPatch>& patches) const {
  constexpr int along = 5;
  constexpr double inside = 1e-9;  // of the element
  const Section section{thickness, youngs_modulus, poissons_ratio};
  const std::vector<Box<double>> boxes = mesh_->basis.elements();
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

namespace {

// Points of a mesh of faces, each once: neighbouring elements share those of their common edge.
class FacePoints {
 public:
  int at(double u, double v) {
    const auto [found, added] = index_.try_emplace({u, v}, int(places_.size()));
    if (added) places_.emplace_back(u, v);
    return found->second;
  }
  const std::vector<Eigen::Vector2d>& places() const { return places_; }

 private:
  std::map<std::pair<double, double>, int> index_;
  std::vector<Eigen::Vector2d> places_;
};

}  // namespace

// Two faces along each side of an element; in fine meshes an element is a face.
void TsplinePlate::faces(double, In q, FaceMesh& mesh) const {
  constexpr std::size_t fine = 200;  // elements
  const std::vector<Box<double>> boxes = mesh_->basis.elements();
  const int cuts = boxes.size() < fine ? 2 : 1;
  FacePoints points;
  mesh.quads.clear();
  for (const auto& [low, high] : boxes)
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; j < cuts; ++j) {
        const auto at = [&](int di, int dj) {
          return points.at(low[0] + (high[0] - low[0]) * (i + di) / cuts,
                           low[1] + (high[1] - low[1]) * (j + dj) / cuts);
        };
        const int outline = (j == 0) | (i + 1 == cuts) << 1 | (j + 1 == cuts) << 2 | (i == 0) << 3;
        mesh.quads.push_back({{at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, outline});
      }
  const Section section{thickness, youngs_modulus, poissons_ratio};
  const auto count = Eigen::Index(points.places().size());
  mesh.points.resize(3, count), mesh.values.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Vector2d& uv = points.places()[std::size_t(k)];
    const SurfacePoint point = surface_point(*mesh_, uv.x(), uv.y());
    mesh.points.col(k) = place(*mesh_, point, q).r;
    mesh.values(k) = von_mises(stress(*mesh_, section, point, q).top);
  }
}

}  // namespace trammel::plate
