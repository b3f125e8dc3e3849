#include "diagnose/turned_boundaries.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <trammel/natural_boundary.hpp>

#include "system/point/pseudo_random.hpp"

namespace trammel::simulate {
namespace {

constexpr double little = 1e-3;       // a smaller missing part is not reported
constexpr double least_lever = 1e-2;  // of the scene's length
constexpr double beside = 0.1;        // distance in sizes of a coordinate, and of one per second

std::optional<NaturalBoundary::Slow> slow(const model::Model& model, const model::MarkerRef& marker) {
  if (marker.body < 0) return {};
  const auto* body = dynamic_cast<const NaturalBoundary*>(model.bodies[std::size_t(marker.body)].body.get());
  const auto found = body ? body->under_moment(marker.marker) : std::nullopt;
  return found && found->missing > little ? found : std::nullopt;
}

// True if the angular part of a twist or wrench matters compared with its linear part.
bool turns(const Vec6& twist, Eigen::Index dim, double length) {
  const double angles = twist.tail(twist.size() - dim).norm(), places = twist.head(dim).norm();
  return angles > least_lever * length * places;
}

class Turned {
 public:
  Turned(model::AssembledSystem& system, const State& start, double until)
      : system_(system), model_(system.model()), start_(start), until_(until) {
    system_.move_to(start.t, start.q, start.v);
    sizes_ = system_.coordinate_sizes();
  }

  std::vector<std::string> sentences() {
    for (const model::JointEntry& joint : model_.joints)
      for (std::size_t k = 0; k < joint.markers.size(); ++k)
        if (const auto found = slow(model_, joint.markers[k]); found && holds(joint, k))
          say("joints." + joint.name + " holds", joint.markers[k], *found);
    for (const model::ForceEntry& force : model_.forces)
      for (const bool of_A : {true, false})
        if (const auto found = slow(model_, of_A ? force.A : force.B); found && loads(force, of_A))
          say("forces." + force.name + " turns", of_A ? force.A : force.B, *found);
    system_.move_to(start_.t, start_.q, start_.v);
    return std::move(sentences_);
  }

 private:
  bool holds(const model::JointEntry& joint, std::size_t marker) {
    const Space space = model_.world.space;
    std::array<const Motion*, Rows::most_markers> at = {};
    for (std::size_t k = 0; k < joint.markers.size(); ++k) at[k] = &system_.motion(joint.markers[k]);
    Rows rows;
    rows.resize(joint.rows, space, int(joint.markers.size()));
    joint.joint->rows_between(start_.t, Motions(at.data(), joint.markers.size()), rows);
    const Mat6& H = rows.H(int(marker));
    for (Eigen::Index i = 0; i < H.rows(); ++i)
      if (turns(H.row(i).transpose(), dimension(space), sizes_.length)) return true;
    return false;
  }

  bool loads(const model::ForceEntry& force, bool of_A) {
    for (const double part : {0.0, 0.37, 1.0})
      for (const double away : {0.0, beside})
        if (loads(force, of_A, start_.t + part * (until_ - start_.t), away)) return true;
    return false;
  }
  bool loads(const model::ForceEntry& force, bool of_A, double t, double away) {
    const Eigen::Index dim = dimension(model_.world.space), nv = start_.v.size();
    const Vec by = model::pseudo_random(nv, away, 1).cwiseProduct(sizes_.of);
    Vec q;
    system_.retract(start_.q, by, q);
    try {
      system_.move_to(t, q, start_.v + by);
      const Motion A = system_.motion(force.A);  // a copy: the next marker may use the same object
      const Motion& B = system_.motion(force.B);
      Wrench on_A = Wrench::Zero(A.V.size()), on_B = on_A;
      force.force->wrench(t, A, B, on_A, on_B);
      return turns(of_A ? on_A : on_B, dim, sizes_.length);
    } catch (const std::exception&) {
      return false;  // the component throws there
    }
  }

  void say(const std::string& who, const model::MarkerRef& marker, const NaturalBoundary::Slow& slow) {
    const model::BodyEntry& body = model_.bodies[std::size_t(marker.body)];
    const std::string name = fmt::format("{}.{}", body.name, body.body->markers()[std::size_t(marker.marker)]);
    const std::string text = fmt::format(
        "{} {}, where the functions that bodies.{} bends by have no moment: turns by a moment come out {:.1f} % too "
        "small, and twice as many functions halve that; --set bodies.{}.{}=true adds those that have one",
        who, name, body.name, 100 * slow.missing, body.name, slow.setting);
    if (std::find(sentences_.begin(), sentences_.end(), text) == sentences_.end()) sentences_.push_back(text);
  }

  model::AssembledSystem& system_;
  const model::Model& model_;
  const State& start_;
  double until_;
  model::CoordinateSizes sizes_;
  std::vector<std::string> sentences_;
};

bool any_natural_boundary(const model::Model& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(), [](const model::BodyEntry& entry) {
    return dynamic_cast<const NaturalBoundary*>(entry.body.get()) != nullptr;
  });
}

}  // namespace

std::vector<std::string> turned_boundaries(model::AssembledSystem& system, const State& start, double until) {
  if (!any_natural_boundary(system.model())) return {};
  return Turned(system, start, until).sentences();
}

}  // namespace trammel::simulate
