// The plate takes over a finer mesh: control points, displacements and velocities by one and the same operator, so that the
// surface, its motion and with them momentum and energies stay what they were. Accelerations do not (they satisfy the
// equations tested with the old functions only); whoever integrates solves for them anew.
#include <algorithm>

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

// In the reference, from the nearest parameters of each element.
std::vector<Box<double>> TsplinePlate::elements_near(const Eigen::Vector2d& at) const {
  const Vec rest = Vec::Zero(mesh_->coordinates.coordinates());
  const auto reference = [&](double u, double v) { return place(*mesh_, surface_point(*mesh_, u, v), rest).r; };
  const Vector3 struck = reference(at.x(), at.y());
  std::vector<Box<double>> result;
  for (const Box<double>& box : splittable_.elements()) {
    const double u = std::clamp(at.x(), box.low[0], box.high[0]), v = std::clamp(at.y(), box.low[1], box.high[1]);
    if ((reference(u, v) - struck).norm() <= *refine_near) result.push_back(box);
  }
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

// Named elements are split once; those that the plate finds by itself as often as the levels allow.
std::vector<Box<double>> TsplinePlate::chosen(double t, In q, const RefineCause& cause) const {
  const bool step = cause.contact.empty();
  if (indicator != Indicator::none) return step ? indicated(q, cause.pressure) : std::vector<Box<double>>{};
  const bool struck = !step && cause.contact == refine_on;
  if (refine_near) return struck ? elements_near(cause.at) : std::vector<Box<double>>{};
  const bool now = refinements_.empty() && (refine_at ? step && t >= *refine_at : struck);
  if (!now) return {};
  const auto all = element_boxes(mesh_->basis.mesh());
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
