#include "system/point/contact_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/decompositions.hpp>

#include "complementarity/spring_motion.hpp"

namespace trammel::model {
namespace {

// relative to the resultants: residual that counts as carried where the last admissible forces are about to vanish.
// More than lacks at the event of their end (critical_force in simulate/event): otherwise round-off decides there
// whether they are still those of the springs, and so which loads joints have.
constexpr double carried = 1e-8;

}  // namespace

void ContactLoads::lay_out(const Modes& modes) {
  modes_ = &modes;
  places_.assign(modes.contacts.size(), {});
  groups_.assign(modes.shared.size(), {});
  for (std::size_t g = 0; g < groups_.size(); ++g) lay_out_group(int(g));
}

void ContactLoads::lay_out_group(int group) {
  const SharedRows& rows = modes_->shared[std::size_t(group)];
  std::vector<ContactDirection> all = rows.basis;
  all.insert(all.end(), rows.implied.begin(), rows.implied.end());
  for (std::size_t k = 0; k < all.size(); ++k) {
    Place& place = places_[std::size_t(all[k].contact)][std::size_t(all[k].row)];
    place.group = group, place.index = int(k);
  }
  Group& g = groups_[std::size_t(group)];
  for (std::size_t k = 0; k < all.size(); ++k) {
    const int contact = all[k].contact;
    if (shares_as_spring(contact, group)) continue;
    const auto of_contact = [contact](const Member& m) { return m.contact == contact; };
    auto member = std::find_if(g.members.begin(), g.members.end(), of_contact);
    if (member == g.members.end()) {
      member = g.members.emplace(member);
      member->contact = contact;
    }
    member->columns[std::size_t(all[k].row)] = Eigen::Index(g.directions.size());
    g.directions.push_back(Eigen::Index(k));
  }
  form_resultants(group);
}

bool ContactLoads::sliding_shares() const {
  return std::any_of(modes_->shared.begin(), modes_->shared.end(),
                     [](const SharedRows& s) { return !s.sliding.empty(); });
}

void ContactLoads::form_resultants(int group) {
  Group& g = groups_[std::size_t(group)];
  if (g.directions.empty()) return;
  const SharedRows& rows = modes_->shared[std::size_t(group)];
  const Mat of_members = rows.resultants()(Eigen::all, g.directions);
  const Eigen::ColPivHouseholderQR<Mat> qr(of_members);
  g.E = first_columns_of_q(qr, qr.rank()).transpose() * of_members;
}

bool ContactLoads::shares_as_spring(int contact, int group) const {
  const std::vector<int>& sliding = modes_->shared[std::size_t(group)].sliding;
  if (std::find(sliding.begin(), sliding.end(), contact) != sliding.end()) return true;
  const Place& normal = place({contact, 0});
  return normal.group == group && shares(normal).isZero(0);
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
  Vec resultants(basis_size(group));
  for (int k = 0; k < int(resultants.size()); ++k) resultants[k] = -lambda(row_of_basis(group, k));
  Group& g = groups_[std::size_t(group)];
  g.forces = modes_->shared[std::size_t(group)].share * resultants;
  if (!g.members.empty()) g.resultants = g.E * g.shared();
}

double ContactLoads::scale(const Group& group) const {
  double largest = group.forces.size() > 0 ? group.forces.lpNorm<Eigen::Infinity>() : 0;
  for (const Member& m : group.members)
    if (m.columns[0] < 0) largest = std::max(largest, m.bounds.given);
  return largest;
}

// The least distance of a contact's force from zero and from the side of its friction cone.
double ContactLoads::slack(const Group& group) const {
  const Vec forces = group.shared();
  double least = std::numeric_limits<double>::infinity();
  for (const Member& m : group.members) {
    const double N = m.columns[0] >= 0 ? forces[m.columns[0]] : m.bounds.given;
    if (m.columns[0] >= 0) least = std::min(least, N);
    double T = 0;
    for (const Eigen::Index k : {m.columns[1], m.columns[2]})
      if (k >= 0) T = std::hypot(T, forces[k]);
    if (m.columns[1] >= 0 || m.columns[2] >= 0) least = std::min(least, m.bounds.coefficient * N - T);
  }
  return least;
}

// The contacts in the form of complementarity/shares/admissible_forces.hpp.
std::vector<complementarity::SharingContact> ContactLoads::sharing(const Group& group) const {
  std::vector<complementarity::SharingContact> contacts;
  for (const Member& m : group.members) {
    auto& contact = contacts.emplace_back();
    contact.normal = m.columns[0];
    contact.coefficient = m.bounds.coefficient;
    contact.given = m.bounds.given;
    contact.spring = modes_->contacts[std::size_t(m.contact)].spring;
    contact.push = modes_->contacts[std::size_t(m.contact)].push;
    for (const Eigen::Index k : {m.columns[1], m.columns[2]})
      if (k >= 0) contact.tangents.push_back(k);
  }
  return contacts;
}

// False: no admissible forces have these resultants.
bool ContactLoads::share_admissibly(Group& group, const Sharing& sharing) {
  if (sharing.contacts.empty()) return true;
  const Vec resultants = sharing.E * group.forces(sharing.directions);
  Vec shared;
  const double missed = complementarity::admissible_forces(sharing.contacts, sharing.E, resultants, shared);
  if (!(missed <= carried * resultants.norm())) return false;
  group.forces(sharing.directions) = shared;
  return true;
}

// False: no such forces have these resultants.
bool ContactLoads::share_as_springs(Group& group) {
  if (group.members.empty()) return true;
  Vec shared;
  if (!complementarity::forces_as_springs(sharing(group), group.E, group.resultants, carried, shared)) return false;
  group.forces(group.directions) = shared;
  return true;
}

// Of springs that have followed their loads so far. False: they are not known, or do not carry these resultants.
bool ContactLoads::share_as_pushed(Group& group) {
  const auto known = [this](const Member& m) {
    return m.columns[0] < 0 || modes_->contacts[std::size_t(m.contact)].push.has_value();
  };
  if (group.members.empty() || !std::all_of(group.members.begin(), group.members.end(), known)) return false;
  const auto motion = complementarity::follow_loads(sharing(group), group.E, group.resultants);
  if (!motion || !motion->carries(group.resultants)) return false;
  group.forces(group.directions) = motion->F;
  return true;
}

std::vector<ContactDirection> ContactLoads::members(int group) const {
  const SharedRows& rows = modes_->shared[std::size_t(group)];
  const Eigen::Index n = basis_size(group);
  std::vector<ContactDirection> all;
  for (const Eigen::Index k : groups_[std::size_t(group)].directions)
    all.push_back(k < n ? rows.basis[std::size_t(k)] : rows.implied[std::size_t(k - n)]);
  return all;
}

ContactLoads::Sharing ContactLoads::with_sliding(int group, const Mat& E) const {
  const Group& g = groups_[std::size_t(group)];
  Sharing all{sharing(g), g.directions, E};
  for (const int contact : modes_->shared[std::size_t(group)].sliding) {
    complementarity::SharingContact& sliding = all.contacts.emplace_back();
    sliding.normal = Eigen::Index(all.directions.size());
    sliding.spring = modes_->contacts[std::size_t(contact)].spring;
    all.directions.push_back(place({contact, 0}).index);
  }
  return all;
}

bool ContactLoads::solve_with_sliding(int group, const Mat& E) {
  return share_admissibly(groups_[std::size_t(group)], with_sliding(group, E));
}

void ContactLoads::solve_beyond_cones(int group) {
  Group& g = groups_[std::size_t(group)];
  Vec shared;
  complementarity::spare_load(sharing(g), g.E, g.resultants, &shared);
  g.forces(g.directions) = shared;
}

double ContactLoads::spare_load_with_sliding(int group, const Mat& E) const {
  const Sharing all = with_sliding(group, E);
  return complementarity::spare_load(all.contacts, E, E * groups_[std::size_t(group)].forces(all.directions));
}

double ContactLoads::spare_load(int group) const {
  const Group& g = groups_[std::size_t(group)];
  return complementarity::spare_load(sharing(g), g.E, g.resultants);
}

double ContactLoads::spare_load_as_springs(int group) const {
  const Group& g = groups_[std::size_t(group)];
  if (g.members.empty()) return std::numeric_limits<double>::infinity();  // all slide
  return as_springs(group, {sharing(g), g.directions, g.E}).spare_load;
}

double ContactLoads::spare_load_as_springs_with_sliding(int group, const Mat& E) const {
  return as_springs(group, with_springs_that_slide(group, E)).spare_load;
}

// Members, then those that slide.
std::vector<int> ContactLoads::contacts_of(int group) const {
  std::vector<int> all;
  for (const Member& m : groups_[std::size_t(group)].members) all.push_back(m.contact);
  const std::vector<int>& sliding = modes_->shared[std::size_t(group)].sliding;
  all.insert(all.end(), sliding.begin(), sliding.end());
  return all;
}

// The columns of the normal forces' own directions.
Mat ContactLoads::push(int group, const Sharing& all) const {
  std::vector<Eigen::Index> normals;
  for (const complementarity::SharingContact& c : all.contacts)
    if (c.normal >= 0) normals.push_back(all.directions[std::size_t(c.normal)]);
  return modes_->shared[std::size_t(group)].resultants()(Eigen::all, normals);
}

// Sliding contacts have an event of their own when they are unloaded: they do not count in the spare load.
ContactLoads::Sharing ContactLoads::with_springs_that_slide(int group, const Mat& E) const {
  Sharing all = with_sliding(group, E);
  for (std::size_t i = groups_[std::size_t(group)].members.size(); i < all.contacts.size(); ++i)
    all.contacts[i].carries = false;
  return all;
}

ContactLoads::AsSprings ContactLoads::as_springs(int group, Sharing all) const {
  const Vec resultants = all.E * groups_[std::size_t(group)].forces(all.directions);
  AsSprings result;
  result.spare_load =
      complementarity::spare_load_as_springs(all.contacts, all.E, push(group, all), resultants, &result.forces);
  const auto motion = complementarity::follow_loads(all.contacts, all.E, resultants);
  if (motion) {
    if (!motion->carries(resultants)) result.spare_load = std::min(result.spare_load, -motion->missed);
    result.forces = motion->F;
  }
  result.contacts = std::move(all.contacts);
  return result;
}

std::vector<ContactSpring> ContactLoads::springs_of(int group, const Sharing& all, double round_off) const {
  const Vec resultants = all.E * groups_[std::size_t(group)].forces(all.directions);
  const auto motion = complementarity::follow_loads(all.contacts, all.E, resultants);
  std::optional<complementarity::SpringsThatHold> found;
  if (!motion)
    found = complementarity::find_springs(all.contacts, all.E, push(group, all), resultants, round_off);
  else if (motion->carries(resultants))
    found = motion->springs();
  const std::vector<int> who = contacts_of(group);
  std::vector<ContactSpring> springs;
  for (std::size_t i = 0; i < all.contacts.size(); ++i)
    springs.push_back({who[i], found ? found->set[i] : complementarity::Spring::locked,
                       found && !slides(group) ? found->push[i] : std::nullopt});
  return springs;
}

std::vector<ContactSpring> ContactLoads::find_springs(int group, double round_off) const {
  const Group& g = groups_[std::size_t(group)];
  if (g.members.empty()) return {};  // all slide
  return springs_of(group, {sharing(g), g.directions, g.E}, round_off);
}

std::vector<ContactSpring> ContactLoads::find_springs_with_sliding(int group, const Mat& E, double round_off) const {
  return springs_of(group, with_springs_that_slide(group, E), round_off);
}

std::vector<ContactSpring> ContactLoads::springs_pushed_by(int group, const Vec& N) const {
  const Group& g = groups_[std::size_t(group)];
  Vec of_members(Eigen::Index(g.members.size()));
  for (std::size_t i = 0; i < g.members.size(); ++i) of_members[Eigen::Index(i)] = N[g.members[i].contact];
  const auto pushes = complementarity::pushes_of(sharing(g), g.E, of_members);
  std::vector<ContactSpring> springs;
  for (std::size_t i = 0; i < pushes.size(); ++i)
    if (const auto& push = pushes[i])
      springs.push_back(
          {g.members[i].contact, *push > 0 ? complementarity::Spring::presses : complementarity::Spring::parts, push});
  return springs;
}

std::vector<Carried> ContactLoads::carried_as_springs(int group, const Mat& E) const {
  const Group& g = groups_[std::size_t(group)];
  const AsSprings springs =
      as_springs(group, slides(group) ? with_springs_that_slide(group, E) : Sharing{sharing(g), g.directions, g.E});
  const std::vector<int> who = contacts_of(group);
  std::vector<Carried> all;
  for (std::size_t i = 0; i < springs.contacts.size(); ++i) {
    const complementarity::SharingContact& c = springs.contacts[i];
    double T = 0;
    for (const Eigen::Index k : c.tangents) T = std::hypot(T, springs.forces[k]);
    all.push_back({who[i], c.normal >= 0 ? std::max(0.0, springs.forces[c.normal]) : c.given, T});
  }
  return all;
}

}  // namespace trammel::model
