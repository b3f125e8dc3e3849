// The plate adopts a finer mesh. One operator transfers control points, displacements and velocities, so that the
// surface, its motion, momentum and energies do not change. Accelerations do (the old ones satisfy the equations tested
// with the old functions only); the integrator solves for them again.
#include <algorithm>
#include <limits>

#include "tspline_plate/plate.hpp"

namespace trammel::plate {

namespace {

class MeshTransfer final : public Transfer {
 public:
  MeshTransfer(Elimination old, Elimination fresh, Sparse points)
      : old_(std::move(old)), fresh_(std::move(fresh)), points_(std::move(points)) {}

  void q(In old, Out fresh) const override { move(old, fresh); }
  void v(In old, Out fresh) const override { move(old, fresh); }

 private:
  // Transfers all displacements: from the coordinates to the old control points, to the new ones, and to the kept
  // coordinates, which are components of them.
  void move(In old, Out fresh) const {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
    Vec u(3 * points_.cols());
    old_.expand(old, u);
    const Rows moved = points_ * Eigen::Map<const Rows>(u.data(), points_.cols(), 3);
    for (std::size_t k = 0; k < fresh_.kept().size(); ++k)
      fresh(Eigen::Index(k)) = moved(fresh_.kept()[k] / 3, fresh_.kept()[k] % 3);
  }

  Elimination old_, fresh_;
  Sparse points_;
};

}  // namespace

namespace {

void cross(std::vector<TMesh>& meshes, const std::vector<Box<double>>& boxes, const std::vector<Closure>& closures) {
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const auto& u = meshes[k].knots(0);
    std::vector<Box<double>> inside;
    std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(inside),
                 [&](const Box<double>& box) { return box.low[0] >= u.front() && box.high[0] <= u.back(); });
    if (!inside.empty()) refine(meshes[k], inside, closures[k]);
  }
}

// An element that is split at a seam adds a knot to the edge, which the other side must add too and may pass on. Lines
// that were not in the middle of an element may keep the sides different; the seam then refuses the mesh.
void divide_alike(std::vector<TMesh>& meshes, const std::vector<Seam>& seams, const std::vector<Closure>& closures) {
  for (std::size_t round = 0; round < 2 * meshes.size() + 8; ++round) {
    std::vector<Box<double>> more;
    for (const Seam& seam : seams)
      for (const Box<double>& box : behind(seam, meshes[std::size_t(seam.a.patch)], meshes[std::size_t(seam.b.patch)]))
        if (std::find(more.begin(), more.end(), box) == more.end()) more.push_back(box);
    if (more.empty()) return;
    cross(meshes, more, closures);
  }
}

// Operators of the patches as blocks.
Sparse in_blocks(const std::vector<Sparse>& blocks) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index row = 0, column = 0;
  for (const Sparse& block : blocks) {
    for (Eigen::Index i = 0; i < block.rows(); ++i)
      for (Sparse::InnerIterator entry(block, i); entry; ++entry)
        entries.emplace_back(int(row + i), int(column + entry.col()), entry.value());
    row += block.rows(), column += block.cols();
  }
  Sparse result(row, column);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

std::unique_ptr<Transfer> TsplinePlate::refine_elements_in(const std::vector<Box<double>>& boxes) {
  const Multipatch& coarse = mesh_->basis;
  std::vector<TMesh> meshes;
  std::vector<Closure> closures;
  for (int k = 0; k < coarse.patches(); ++k) {
    meshes.push_back(coarse.patch(k).mesh());
    closures.push_back(given(k).closure);
  }
  cross(meshes, boxes, closures);
  divide_alike(meshes, seams_, closures);
  std::vector<ControlNet> nets;
  std::vector<Sparse> operators;
  for (int k = 0; k < coarse.patches(); ++k) {
    const TsplineBasis& old = coarse.patch(k);
    const Points points = mesh_->points.middleRows(coarse.first_function(k), old.size());
    TMesh& fine = meshes[std::size_t(k)];
    if (fine.elements().size() == old.mesh().elements().size()) {
      operators.emplace_back(old.size(), old.size());
      operators.back().setIdentity();
      nets.push_back({std::move(fine), old.weights(), points});
      continue;
    }
    auto op = refinement_operator(old, TsplineBasis(fine));
    nets.push_back({std::move(fine), std::move(op.weights), op.points * points});
    operators.push_back(std::move(op.points));
  }
  Elimination before = mesh_->coordinates;
  take(nets);
  refinements_.push_back(boxes);
  return std::make_unique<MeshTransfer>(std::move(before), mesh_->coordinates, in_blocks(operators));
}

// In the reference: the nearest parameters in an element of the same patch; in another patch those of the nearest point
// of a grid.
double TsplinePlate::distance(const Eigen::Vector2d& from, const Box<double>& element) const {
  const Vec rest = Vec::Zero(mesh_->coordinates.coordinates());
  const auto reference = [&](double u, double v) { return place(*mesh_, surface_point(*mesh_, u, v), rest).r; };
  const Vector3 struck = reference(from.x(), from.y());
  const auto& [low, high] = element;
  if (mesh_->basis.patch_at(from.x()) == mesh_->basis.patch_at(low[0]))
    return (reference(std::clamp(from.x(), low[0], high[0]), std::clamp(from.y(), low[1], high[1])) - struck).norm();
  constexpr int pieces = 8;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= pieces; ++i)
    for (int j = 0; j <= pieces; ++j)
      least = std::min(
          least,
          (reference(low[0] + (high[0] - low[0]) * i / pieces, low[1] + (high[1] - low[1]) * j / pieces) - struck)
              .norm());
  return least;
}

std::vector<Box<double>> TsplinePlate::elements_near(const Eigen::Vector2d& at) const {
  std::vector<Box<double>> result;
  for (const Box<double>& box : splittable_.elements())
    if (distance(at, box) <= *refine_near) result.push_back(box);
  return result;
}

std::vector<Box<double>> TsplinePlate::indicated(In q, std::span<const double> contact_pressure) const {
  const bool pressed = indicator == Indicator::contact_pressure;
  if (pressed && contact_pressure.empty()) return {};
  std::vector<char> marked(splittable_.elements().size(), 0);
  CellVectors u;
  for (std::size_t c = 0; c < mesh_->cells.size(); ++c) {
    const int element = splittable_.element_of(int(c));
    if (element < 0 || marked[std::size_t(element)]) continue;
    if (!pressed) gather(mesh_->cells[c], q, u);
    marked[std::size_t(element)] =
        (pressed ? contact_pressure[c] : indicate(indicator, mesh_->cells[c], u)) > *refine_threshold;
  }
  std::vector<Box<double>> result;
  for (std::size_t e = 0; e < marked.size(); ++e)
    if (marked[e]) result.push_back(splittable_.elements()[e]);
  return result;
}

// Elements given by the scene are split once; those chosen by the plate as often as the levels allow.
std::vector<Box<double>> TsplinePlate::chosen(double t, In q, const RefineCause& cause) const {
  const bool step = cause.contact.empty();
  if (indicator != Indicator::none) return step ? indicated(q, cause.pressure) : std::vector<Box<double>>{};
  const bool struck = !step && cause.contact == refine_on;
  if (refine_near) return struck ? elements_near(cause.at) : std::vector<Box<double>>{};
  const bool now = refinements_.empty() && (refine_at ? step && t >= *refine_at : struck);
  if (!now) return {};
  const auto all = mesh_->basis.elements();
  std::vector<Box<double>> named;
  for (double e : refine_elements) named.push_back(all[std::size_t(e)]);
  return named;
}

bool TsplinePlate::due(double t, In q, In, const RefineCause& cause) const {
  return !chosen(t, q, cause).empty();
}

std::unique_ptr<Transfer> TsplinePlate::refine(double t, In q, In, const RefineCause& cause) {
  const auto boxes = chosen(t, q, cause);
  return boxes.empty() ? nullptr : refine_elements_in(boxes);
}

void TsplinePlate::archive(Archive& archive) {
  std::vector<Vec> steps;
  for (const auto& boxes : refinements_) {
    Vec& step = steps.emplace_back(4 * Eigen::Index(boxes.size()));
    for (std::size_t k = 0; k < boxes.size(); ++k)
      step.segment<4>(4 * Eigen::Index(k)) << boxes[k].low[0], boxes[k].low[1], boxes[k].high[0], boxes[k].high[1];
  }
  const std::size_t before = steps.size();
  archive("refinements", steps);
  if (steps.size() == before) return;
  take(first_nets());
  refinements_.clear();
  for (const Vec& step : steps) {
    std::vector<Box<double>> boxes;
    for (Eigen::Index k = 0; k + 4 <= step.size(); k += 4)
      boxes.push_back({{step(k), step(k + 1)}, {step(k + 2), step(k + 3)}});
    refine_elements_in(boxes);
  }
}

}  // namespace trammel::plate
