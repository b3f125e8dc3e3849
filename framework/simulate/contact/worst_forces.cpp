#include "simulate/contact/worst_forces.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "linear/dense/eps.hpp"

namespace trammel::simulate {
namespace {

constexpr const char* names[] = {"pull", "beyond_cone", "along_slip", "overloaded", "unbalanced"};

std::size_t island_number(double archived) {
  if (!(archived >= 0 && archived < std::numeric_limits<int>::max())) throw std::out_of_range("island");
  return std::size_t(archived);
}

}  // namespace

int contact_number(double archived, std::size_t contacts) {
  if (!(archived >= 0 && archived < double(contacts))) throw std::out_of_range("contact");
  return int(archived);
}

void WorstForces::take_force(std::size_t island, double force) {
  double& largest = largest_[island];
  largest = std::max(largest, force);
}

void WorstForces::raise(Violation kind, std::size_t island, const Worst& found) {
  Worst& worst = of_kind_[std::size_t(kind)][island];
  if (found.force > worst.force) worst = found;
}

double WorstForces::beside_largest(std::size_t island, double force) const {
  const auto largest = largest_.find(island);
  if (largest != largest_.end() && largest->second > 0) return force / largest->second;
  return std::numeric_limits<double>::infinity();
}

std::optional<WorstForces::Worst> WorstForces::worst(Violation kind) const {
  std::optional<Worst> worst;
  double most = eps;
  for (const auto& [island, found] : of_kind_[std::size_t(kind)]) {
    const double part = beside_largest(island, found.force);
    if (part > most) most = part, worst = found;
  }
  return worst;
}

void WorstForces::archive(Archive& a, std::size_t contacts) {
  for (std::size_t kind = 0; kind < of_kind_.size(); ++kind) {
    Vec flat(Eigen::Index(4 * of_kind_[kind].size()));
    Eigen::Index k = 0;
    for (const auto& [island, worst] : of_kind_[kind]) {
      flat.segment<4>(k) << double(island), worst.contact, worst.t, worst.force;
      k += 4;
    }
    a(names[kind], flat);
    of_kind_[kind].clear();
    for (k = 0; k + 3 < flat.size(); k += 4)
      of_kind_[kind][island_number(flat[k])] = {contact_number(flat[k + 1], contacts), flat[k + 2], flat[k + 3]};
  }
  Vec flat(Eigen::Index(2 * largest_.size()));
  Eigen::Index k = 0;
  for (const auto& [island, force] : largest_) {
    flat.segment<2>(k) << double(island), force;
    k += 2;
  }
  a("largest_forces", flat);
  largest_.clear();
  for (k = 0; k + 1 < flat.size(); k += 2) largest_[island_number(flat[k])] = flat[k + 1];
}

}  // namespace trammel::simulate
