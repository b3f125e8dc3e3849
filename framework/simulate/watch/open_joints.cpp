#include "simulate/watch/open_joints.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnose/row_offsets.hpp"

namespace trammel::simulate {
namespace {

constexpr double apart = 0.1;  // relative to the size, and to 1 rad
constexpr std::size_t most_told = 3;

// [m] The diagonal of the box around the markers of each body.
std::vector<double> extents(model::AssembledSystem& system) {
  std::vector<double> all;
  for (int body = 0; body < int(system.model().bodies.size()); ++body) {
    const int markers = int(system.model().bodies[std::size_t(body)].body->markers().size());
    double extent = 0;
    if (markers > 0) {
      Vec3 low = system.motion({body, 0}).x, high = low;
      for (int marker = 1; marker < markers; ++marker) {
        const Vec3& x = system.motion({body, marker}).x;
        low = low.cwiseMin(x), high = high.cwiseMax(x);
      }
      extent = (high - low).norm();
    }
    all.push_back(extent);
  }
  return all;
}

}  // namespace

// [m] The largest distance of the other markers from the first.
double OpenJoints::distance(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers) {
  double largest = 0;
  if (markers.empty()) return largest;
  const Vec3 x = system.motion(markers.front()).x;
  for (const model::MarkerRef marker : markers) largest = std::max(largest, (system.motion(marker).x - x).norm());
  return largest;
}

void OpenJoints::measure(model::AssembledSystem& system, double otherwise, double round_off) {
  joints_.clear();
  const std::vector<double> extent = extents(system);
  const model::Model& model = system.model();
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (const model::BodyEntry& body = model.bodies[i]; body.rows > 0)
      joints_.push_back({{"bodies." + body.name, body.row, body.rows}, {}, extent[i]});
  for (const model::JointEntry& joint : model.joints) {
    // Violations of its rows do not count as its size.
    double size = distance(system, joint.markers) - system.g().segment(joint.row, joint.rows).norm();
    for (const model::MarkerRef marker : joint.markers)
      if (marker.body >= 0) size = std::max(size, extent[std::size_t(marker.body)]);
    joints_.push_back({{"joints." + joint.name, joint.row, joint.rows}, joint.markers, size});
  }
  // A point that is computed in two ways has no length, only the round-off of its place. If everything is in one point,
  // nothing has a length; then 1 m is used.
  for (Joint& joint : joints_)
    if (!(joint.size > round_off)) joint.size = otherwise > round_off ? otherwise : 1;
}

std::string OpenJoints::description(model::AssembledSystem& system, const State& state) const {
  struct Open {
    const std::string* path;
    double part;  // of what is allowed
    RowOffset row;
  };
  std::vector<Open> open;
  const Vec& g = system.g();
  for (const Joint& joint : joints_) {
    // Most joints are far from it. The g of a row is at least half of its violation.
    const double said = g.segment(joint.rows.first, joint.rows.count).lpNorm<Eigen::Infinity>();
    if (!(said > 0.5 * apart * std::min(1.0, joint.size))) continue;
    Open worst{&joint.rows.path, 0, {}};
    for (const RowOffset& row : row_offsets(system, joint.rows, state)) {
      const double off = std::abs(row.position);
      const double size = row.angle ? 1 : std::max(joint.size, distance(system, joint.markers) - off);
      if (off > worst.part * size) worst.part = off / size, worst.row = row;
    }
    if (worst.part > apart) open.push_back(worst);
  }
  std::stable_sort(open.begin(), open.end(), [](const Open& a, const Open& b) { return a.part > b.part; });
  std::string text;
  for (std::size_t i = 0; i < std::min(open.size(), most_told); ++i)
    text += fmt::format("{}{} by {:.3g} {}", i == 0 ? "" : ", ", *open[i].path, std::abs(open[i].row.position),
                        open[i].row.angle ? "rad" : "m");
  if (open.size() > most_told) text += fmt::format(" and {} more", open.size() - most_told);
  return text;
}

}  // namespace trammel::simulate
