// The plate takes over a finer mesh: control points, displacements and velocities by one and the same operator, so that the
// surface, its motion and with them momentum and energies stay what they were. Accelerations do not (they satisfy the
// equations tested with the old functions only); whoever integrates solves for them anew.
#include <fmt/format.h>

#include "plate.hpp"

namespace trammel::plate {

namespace {

class MeshTransfer final : public Transfer {
 public:
  MeshTransfer(Elimination old, Elimination fresh, Sparse points)
      : old_(std::move(old)), fresh_(std::move(fresh)), points_(std::move(points)) {}

  void q(In old, Out fresh) const override { move(old, fresh); }
  void v(In old, Out fresh) const override { move(old, fresh); }

 private:
  // To all displacements, to the new control points, and back to the coordinates that are kept, components themselves.
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

std::unique_ptr<Transfer> TsplinePlate::refine_elements_in(const std::vector<Box<double>>& boxes) {
  TMesh fine = mesh_->basis.mesh();
  plate::refine(fine, boxes, closure);
  auto op = refinement_operator(mesh_->basis, TsplineBasis(fine));
  ControlNet net{std::move(fine), std::move(op.weights), op.points * mesh_->points};
  Elimination old = mesh_->coordinates;
  take(std::move(net));
  refinements_.push_back(boxes);
  return std::make_unique<MeshTransfer>(std::move(old), mesh_->coordinates, std::move(op.points));
}

bool TsplinePlate::due(double t, In, In, const RefineCause& cause) const {
  if (!refinements_.empty()) return false;
  if (refine_at) return cause.contact.empty() && t >= *refine_at;
  return !refine_on.empty() && cause.contact == refine_on;
}

std::unique_ptr<Transfer> TsplinePlate::refine(double t, In q, In v, const RefineCause& cause) {
  if (!due(t, q, v, cause)) return nullptr;
  const TMesh& mesh = mesh_->basis.mesh();
  const auto faces = mesh.elements();
  std::vector<Box<double>> boxes;
  for (double e : refine_elements) boxes.push_back(mesh.parameters(faces[std::size_t(e)]));
  return refine_elements_in(boxes);
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
  take(first_net());
  refinements_.clear();
  for (const Vec& step : steps) {
    std::vector<Box<double>> boxes;
    for (Eigen::Index k = 0; k + 4 <= step.size(); k += 4)
      boxes.push_back({{step(k), step(k + 1)}, {step(k + 2), step(k + 3)}});
    refine_elements_in(boxes);
  }
}

}  // namespace trammel::plate
