#include "model/contact_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::model {
namespace {

constexpr double round_off = 1e-12;  // of the forces

}  // namespace

void ContactLoads::lay_out(const Modes& modes) {
  modes_ = &modes;
  places_.assign(modes.contacts.size(), {});
  groups_.clear();
  for (std::size_t g = 0; g < modes.shared.size(); ++g) {
    const SharedRows& shared = modes.shared[g];
    Group& group = groups_.emplace_back();
    const auto add = [&](const ContactDirection& d, std::size_t index) {
      Place& place = places_[std::size_t(d.contact)][std::size_t(d.row)];
      place.group = int(g), place.index = int(index);
      auto member = std::find_if(group.members.begin(), group.members.end(),
                                 [&](const Member& m) { return m.contact == d.contact; });
      if (member == group.members.end()) {
        member = group.members.emplace(member);
        member->contact = d.contact;
      }
      member->columns[std::size_t(d.row)] = Eigen::Index(index);
    };
    for (std::size_t k = 0; k < shared.basis.size(); ++k) add(shared.basis[k], k);
    for (std::size_t k = 0; k < shared.implied.size(); ++k) add(shared.implied[k], shared.basis.size() + k);
  }
}

double ContactLoads::spring(ContactDirection d, const Vec& lambda) const {
  const Place& at = place(d);
  if (at.group < 0) return at.row >= 0 ? -lambda(at.row) : 0;
  const auto by = shares(at);
  double sum = 0;
  for (int k = 0; k < int(by.size()); ++k) sum -= by[k] * lambda(row_of_basis(at.group, k));
  return sum;
}

void ContactLoads::begin(int group, const Vec& lambda) {
  Group& g = groups_[std::size_t(group)];
  g.resultants.resize(basis_size(group));
  for (int k = 0; k < int(g.resultants.size()); ++k) g.resultants[k] = -lambda(row_of_basis(group, k));
  g.forces = modes_->shared[std::size_t(group)].share * g.resultants;
}

double ContactLoads::scale(const Group& group) const {
  double largest = group.forces.size() > 0 ? group.forces.lpNorm<Eigen::Infinity>() : 0;
  for (const Member& m : group.members)
    if (m.columns[0] < 0) largest = std::max(largest, m.bounds.given);
  return largest;
}

// The least distance of a contact's force from pulling and from the side of its cone.
double ContactLoads::slack(const Group& group) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Member& m : group.members) {
    const double N = m.columns[0] >= 0 ? group.forces[m.columns[0]] : m.bounds.given;
    if (m.columns[0] >= 0) least = std::min(least, N);
    double T = 0;
    for (const Eigen::Index k : {m.columns[1], m.columns[2]})
      if (k >= 0) T = std::hypot(T, group.forces[k]);
    if (m.columns[1] >= 0 || m.columns[2] >= 0) least = std::min(least, m.bounds.coefficient * N - T);
  }
  return least;
}

// The contacts as complementarity/admissible_forces.hpp knows them.
std::vector<complementarity::SharingContact> ContactLoads::sharing(const Group& group) const {
  std::vector<complementarity::SharingContact> contacts;
  for (const Member& m : group.members) {
    auto& contact = contacts.emplace_back();
    contact.normal = m.columns[0];
    contact.coefficient = m.bounds.coefficient;
    contact.given = m.bounds.given;
    for (const Eigen::Index k : {m.columns[1], m.columns[2]})
      if (k >= 0) contact.tangents.push_back(k);
  }
  return contacts;
}

Mat ContactLoads::resultants(int group) const {
  const SharedRows& shared = modes_->shared[std::size_t(group)];
  const Eigen::Index n = basis_size(group);
  Mat E(n, n + shared.K.rows());
  E << Mat::Identity(n, n), shared.K.transpose();
  return E;
}

void ContactLoads::share_admissibly(int group) {
  Group& g = groups_[std::size_t(group)];
  const bool as_springs = modes_->shared[std::size_t(group)].sliding || slack(g) >= -round_off * scale(g);
  if (as_springs) return;
  // Those that miss the resultants least, where none have them: until the event that follows from it.
  complementarity::admissible_forces(sharing(g), resultants(group), g.resultants, g.forces);
}

double ContactLoads::spare_load(int group) const {
  const Group& g = groups_[std::size_t(group)];
  return complementarity::spare_load(sharing(g), resultants(group), g.resultants);
}

}  // namespace trammel::model
