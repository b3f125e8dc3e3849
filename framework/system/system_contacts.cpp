// Contact quantities for the Simulator: gaps, rates, accelerations, forces, and the response to impulses.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "complementarity/contact_forces.hpp"
#include "complementarity/shares/independent_rows.hpp"
#include "system/assembly.hpp"

namespace trammel::model {

double AssembledSystem::gap(int contact) {
  return work_->contact(contact).g(0);
}

double AssembledSystem::coordinate(ContactDirection d) {
  return work_->contact(d.contact).g(d.row);
}

double AssembledSystem::gap_rate(int contact) {
  return work_->contact_rate(contact, 0);
}

double AssembledSystem::rate(ContactDirection d) {
  return work_->contact_rate(d.contact, d.row);
}

double AssembledSystem::acceleration(ContactDirection d, const Vec& a) {
  return work_->contact_acceleration(d.contact, d.row, a);
}

double AssembledSystem::Work::contact_acceleration(int i, int row, const Vec& a) {
  const Rows& r = contact(i);
  double sum = -contact_rows[std::size_t(i)].free(row);
  const Slots& at = contact_slots[std::size_t(i)];
  for (int k = 0; k < at.count; ++k) {
    if (chain.body(at[k]) < 0) continue;
    const Motion& m = motion(at[k]);
    const int v0 = chain.first_velocity(at[k]);
    for_each_column({r.H(k), row, 1}, m.J,
                    [&](Eigen::Index j, const double* along, auto) { sum += *along * a(v0 + m.dofs[std::size_t(j)]); });
  }
  return sum;
}

double AssembledSystem::normal_force(int contact, const Vec& lambda) {
  return work_->force_along({contact, 0}, lambda);
}

Tangential AssembledSystem::friction_force(int contact, const Vec& lambda) {
  Work& w = *work_;
  Tangential T = Tangential::Zero();
  if (w.modes.contacts[std::size_t(contact)].friction == ContactMode::Friction::stick) {
    if (std::find(w.judged.begin(), w.judged.end(), contact) != w.judged.end()) return w.judged_friction.col(contact);
    for (int k = 0; k < w.tangents(contact); ++k) T[k] = w.force_along({contact, 1 + k}, lambda);
    return T;
  }
  if (!w.model->contacts[std::size_t(contact)].friction) return T;
  return w.friction_ratio(contact) * normal_force(contact, lambda);
}

AssembledSystem::Sharing AssembledSystem::sharing(int contact) const {
  const Work& w = *work_;
  Sharing sharing;
  for (int k = 0; k < 3; ++k) {
    const ContactLoads::Place& place = w.loads.place({contact, k});
    if (place.group < 0) continue;
    sharing.shared = true;
    sharing.group = place.group;
    sharing.as_spring = w.loads.shares_as_spring(contact, place.group);
    sharing.idle = sharing.idle || (k == 0 && w.loads.shares(place).isZero(0));
  }
  return sharing;
}

double AssembledSystem::spare_load(int group, const Vec& lambda) {
  Work& w = *work_;
  const ContactLoads& loads = w.shared_rows(group, lambda);
  const double spare = loads.spare_load(group);
  if (spare >= 0 || w.modes.shared[std::size_t(group)].sliding.empty()) return spare;
  return std::max(spare, loads.spare_load_with_sliding(group, w.moved_with_sliding(group)));
}

double AssembledSystem::largest_load(int group, const Vec& lambda) {
  return work_->shared_rows(group, lambda).largest_load(group);
}

double AssembledSystem::spring_force(int contact, const Vec& lambda) {
  Work& w = *work_;
  w.follow_shares();
  const ContactLoads::Place& place = w.loads.place({contact, 0});
  const SharedRows& shared = w.modes.shared[std::size_t(place.group)];
  const auto n = int(shared.basis.size());
  double sum = 0;
  for (int k = 0; k < n; ++k)
    sum += shared.K(place.index - n, k) * w.loads.spring(shared.basis[std::size_t(k)], lambda);
  return sum;
}

double AssembledSystem::departure(int group, const Vec& a) {
  double most = 0;
  for (const ContactDirection& d : work_->modes.shared[std::size_t(group)].implied)
    most = std::max(most, std::abs(acceleration(d, a)));
  return most;
}

std::vector<int> AssembledSystem::Work::contacts_of_row(ContactDirection d) const {
  std::vector<int> contacts = {d.contact};
  const int group = loads.place(d).group;
  if (group < 0 || modes.shared[std::size_t(group)].sliding.empty()) return contacts;
  for (const auto* directions : {&modes.shared[std::size_t(group)].basis, &modes.shared[std::size_t(group)].implied})
    for (const ContactDirection& other : *directions)
      if (other.contact != d.contact && other.row == 0) contacts.push_back(other.contact);
  return contacts;
}

ContactLoads::Bounds AssembledSystem::Work::bounds(int contact, const Vec& lambda) {
  const ContactEntry& entry = model->contacts[std::size_t(contact)];
  ContactLoads::Bounds bounds;
  if (entry.coulomb) bounds.coefficient = entry.coulomb->static_coefficient();
  if (loads.place({contact, 0}).group < 0) bounds.given = std::max(0.0, force_along({contact, 0}, lambda));
  return bounds;
}

const ContactLoads& AssembledSystem::Work::shared_rows(int group, const Vec& lambda) {
  follow_shares();
  shared_at[std::size_t(group)] = {};
  loads.prepare(group, lambda, [&](int contact) { return bounds(contact, lambda); });
  return loads;
}

// As many combinations of velocities as are independent.
Mat AssembledSystem::Work::moved_with_sliding(int group) {
  std::vector<ContactDirection> all = loads.members(group);
  const auto members = Eigen::Index(all.size());
  const std::vector<int>& sliding = modes.shared[std::size_t(group)].sliding;
  for (const int contact : sliding)
    for (int k = 0; k <= tangents(contact); ++k) all.push_back({contact, k});
  Mat jump, A;
  impulse_response(all, jump, A);
  Mat moved(jump.rows(), members + Eigen::Index(sliding.size()));
  moved.leftCols(members) = jump.leftCols(members);
  Eigen::Index column = members, from = members;
  for (const int contact : sliding) {
    const Eigen::Index n = tangents(contact);
    moved.col(column++) = jump.col(from) + jump.middleCols(from + 1, n) * friction_ratio(contact).head(n);
    from += 1 + n;
  }
  return complementarity::independent_rows(moved);
}

const ContactLoads& AssembledSystem::Work::shared_loads(int group, const Vec& lambda) {
  follow_shares();
  SharedAt& at = shared_at[std::size_t(group)];
  if (at.point == point && at.configuration == configuration && at.lambda.size() == lambda.size() &&
      at.lambda == lambda)
    return loads;
  const bool found = loads.solve(group, lambda, [&](int contact) { return bounds(contact, lambda); });
  if (!found && !modes.shared[std::size_t(group)].sliding.empty())
    loads.solve_with_sliding(group, moved_with_sliding(group));
  at = {point, configuration, lambda};
  return loads;
}

double AssembledSystem::Work::force_along(ContactDirection d, const Vec& lambda) {
  const ContactLoads::Place& place = loads.place(d);
  if (d.row == 0 && in_joint(d.contact)) return bearing_load(d.contact, lambda);
  if (place.group >= 0) return shared_loads(place.group, lambda).load(place);
  if (place.row >= 0) return -lambda(place.row);
  const auto i = std::size_t(d.contact);
  const ContactForce* law = model->contacts[i].force;
  if (d.row > 0 || !law || !modes.contacts[i].closed) return 0;
  if (on_surface(i)) return surface(i).sums().normal;
  return law->normal(contact(d.contact).g(0), contact_rate(d.contact, 0), modes.contacts[i].approach_speed);
}

int AssembledSystem::tangents(int contact) const {
  return work_->tangents(contact);
}

Tangential AssembledSystem::slip(int contact) {
  return work_->slip(contact);
}

Tangential AssembledSystem::slip_acceleration(int contact, const Vec& a) {
  Tangential s = Tangential::Zero();
  for (int k = 0; k < tangents(contact); ++k) s[k] = work_->contact_acceleration(contact, 1 + k, a);
  return s;
}

Vec3 AssembledSystem::along_tangents(int contact, const Tangential& x) {
  Work& w = *work_;
  const auto i = std::size_t(contact);
  return w.geometries[i]->along_tangents(x, w.motion(w.contact_slots[i].B));
}

Eigen::Matrix3d AssembledSystem::Work::seen_from_B(int i) {
  const Slots& at = contact_slots[std::size_t(i)];
  return motion(at.B).R.transpose() * motion(at.A).R;
}

Tangential AssembledSystem::Work::displacement(int i) {
  const ContactMode& mode = modes.contacts[std::size_t(i)];
  const ContactGeometry& geometry = *geometries[std::size_t(i)];
  Tangential x = geometry.coordinates_from(mode.anchor, contact(i));
  if (geometry.rolls()) x += geometry.rolled(seen_from_B(i) * mode.rolled_from.transpose());
  return x;
}

void AssembledSystem::anchor(int contact, ContactMode& mode) {
  Work& w = *work_;
  const Rows& r = w.contact(contact);
  for (int k = 0; k < w.tangents(contact); ++k) mode.anchor[k] = r.g(1 + k);
  if (w.geometries[std::size_t(contact)]->rolls()) mode.rolled_from = w.seen_from_B(contact);
}

void AssembledSystem::step_taken() {
  Work& w = *work_;
  if (w.model->world.space == Space::planar) return;
  for (std::size_t i = 0; i < w.modes.contacts.size(); ++i) {
    ContactMode& mode = w.modes.contacts[i];
    if (!mode.closed || mode.friction == ContactMode::Friction::none || w.tangents(int(i)) == 1) continue;
    if (mode.friction == ContactMode::Friction::slide) {
      const Tangential s = w.slip(int(i));
      if (s.dot(mode.direction) > mode.slow) mode.direction = s.normalized();
    } else if (w.geometries[i]->rolls()) {
      anchor(int(i), mode);
      w.rows_fresh = false;
      ++w.configuration;
    }
  }
}

void AssembledSystem::impulse_response(const std::vector<ContactDirection>& directions, Mat& jump, Mat& delassus) {
  work_->impulse_response(directions, jump, delassus);
}

void AssembledSystem::Work::impulse_response(const std::vector<ContactDirection>& directions, Mat& jump,
                                             Mat& delassus) {
  evaluate_rows();
  const auto n = Eigen::Index(directions.size());
  const auto respond = with_joints_held();
  Mat N = Mat::Zero(sizes.nv, n);
  jump.resize(sizes.nv, n);
  Vec dv, column;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ContactDirection d = directions[std::size_t(i)];
    const Rows& r = contact(d.contact);
    const Slots& at = contact_slots[std::size_t(d.contact)];
    for (int k = 0; k < at.count; ++k) motion(at[k]);
    column.setZero(sizes.nv);
    add_row_force(at, r, d.row, 1, column);
    N.col(i) = column;
    respond(column, dv);
    jump.col(i) = dv;
  }
  delassus.noalias() = N.transpose() * jump;
  clear_held(N, jump, delassus);
}

// Directions that the joints fix: their remaining response is round-off.
void AssembledSystem::Work::clear_held(const Mat& N, Mat& jump, Mat& delassus) {
  constexpr double round_off = 1e-12;
  const Vec masses = mass_diagonal();
  for (Eigen::Index i = 0; i < N.cols(); ++i) {
    const double alone = N.col(i).cwiseAbs2().cwiseQuotient(masses).sum();
    if (delassus(i, i) > round_off * alone) continue;
    jump.col(i).setZero();
    delassus.row(i).setZero();
    delassus.col(i).setZero();
  }
}

double AssembledSystem::highest_frequency(const std::vector<ContactDirection>& directions) {
  if (directions.empty()) return 0;
  Work& w = *work_;
  Mat jump, delassus;
  impulse_response(directions, jump, delassus);
  const Vec no_a = Vec::Zero(w.sizes.nv), no_lambda = Vec::Zero(w.sizes.nc);
  Mat K = Mat::Zero(w.sparse ? 0 : w.sizes.nv, w.sparse ? 0 : w.sizes.nv), KX;
  if (w.sparse)
    KX = sparse_tangent({0, 0, 1}, no_a, no_lambda) * jump;
  else
    add_tangent({0, 0, 1}, no_a, no_lambda, K), KX = K * jump;
  Mat MX = Mat::Zero(jump.rows(), jump.cols());
  Vec column;
  for (Eigen::Index i = 0; i < jump.cols(); ++i) {
    column.setZero(jump.rows());
    w.add_mass_times(1, jump.col(i), column);
    MX.col(i) = column;
  }
  double highest = 0;
  for (Eigen::Index i = 0; i < jump.cols(); ++i) {
    const double stiffness = jump.col(i).dot(KX.col(i)), mass = jump.col(i).dot(MX.col(i));
    if (stiffness > 0 && mass > 0) highest = std::max(highest, std::sqrt(stiffness / mass));
  }
  return highest;
}

// Method lcp_every_step: friction of the contacts at rest from the problem of Zhang and Wang 2017, (32)-(39), with
// A = W_T^T P W_T; P: inverse of the mass on the null space of the rows.
void AssembledSystem::Work::judge_friction(Vec& a, Vec& lambda) {
  const Eigen::Index m = tangents(judged.front()), n = m * Eigen::Index(judged.size());
  Mat response(sizes.nv, n), reaction(sizes.nc, n), columns = Mat::Zero(sizes.nv, n);
  Vec b(n), column, x, y, T, a_t;
  std::vector<complementarity::ContactPoint> points;
  for (Eigen::Index k = 0; k < n; ++k) {
    const int i = judged[std::size_t(k / m)], row = 1 + int(k % m);
    const Rows& r = contact(i);
    column.setZero(sizes.nv);
    add_row_force(contact_slots[std::size_t(i)], r, row, 1, column);
    columns.col(k) = column;
    if (!solve(at_point, column, Vec::Zero(sizes.nc), x, y))
      throw NotSolvable("the friction of the feet at rest was not found");
    response.col(k) = x, reaction.col(k) = y;
    b[k] = contact_acceleration(i, row, a);
    if (row > 1) continue;
    const ContactEntry& entry = model->contacts[std::size_t(i)];
    points.push_back(
        {.tangent = int(k),
         .tangents = int(m),
         .kind = complementarity::ContactPoint::Tangent::resting,
         .coefficient = entry.coulomb->static_coefficient(),
         .given = entry.force->normal(r.g(0), contact_rate(i, 0), modes.contacts[std::size_t(i)].approach_speed)});
  }
  if (complementarity::solve_contacts(points, columns.transpose() * response, b, T, a_t).outcome !=
      complementarity::LcpOutcome::solved)
    throw NotSolvable("the friction of the feet at rest was not found");
  a.noalias() += response * T;
  lambda.noalias() += reaction * T;
  for (Eigen::Index k = 0; k < n; ++k) judged_friction(k % m, judged[std::size_t(k / m)]) = T[k];
}

const Motion& AssembledSystem::contact_marker(int contact) {
  Work& w = *work_;
  const int slot = w.contact_slots[std::size_t(contact)].A;
  if (w.chain.on_surface(slot)) w.contact(contact);  // computes the nearest point
  return w.motion(slot);
}

bool AssembledSystem::Work::presses_surface(std::size_t i, int body) const {
  const ContactEntry& entry = model->contacts[i];
  return entry.surface && modes.contacts[i].closed && (entry.surface->body == body || entry.surface->other == body);
}

bool AssembledSystem::has_surface_contact(int body) const {
  for (std::size_t i = 0; i < work_->surfaces.size(); ++i)
    if (work_->presses_surface(i, body)) return true;
  return false;
}

std::vector<double> AssembledSystem::surface_pressure(int body) {
  Work& w = *work_;
  std::vector<double> by_patch;
  for (std::size_t i = 0; i < w.surfaces.size(); ++i) {
    if (!w.presses_surface(i, body)) continue;
    by_patch.resize(std::size_t(w.model->bodies[std::size_t(body)].samples->patches()), 0.0);
    w.surface(i).raise_pressure(body, by_patch);
  }
  return by_patch;
}

double AssembledSystem::all_behind_plane(int contact) {
  Work& w = *work_;
  SurfaceContact* surface = w.surfaces[std::size_t(contact)].contact;
  return surface ? surface->all_behind(w.here()) : -1;
}

}  // namespace trammel::model
