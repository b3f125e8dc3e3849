// The content of a checkpoint: with it a run continues bit by bit as if it had not stopped.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "plugin/breadcrumb.hpp"
#include "plugin/guard.hpp"
#include "simulate/simulator.hpp"

namespace trammel::simulate {
namespace {

// Refuses, before anything is read beyond its end, an archive that no run of this scene has written.
void require(bool fits, const std::string& name) {
  if (!fits) throw std::out_of_range(fmt::format("\"{}\" does not fit", name));
}

int index(double x, std::size_t count, const std::string& name) {
  require(x >= 0 && x < double(count) && x == std::floor(x), name);
  return int(x);
}

void archive_tangential(Archive& a, const std::string& name, model::ContactMode& mode) {
  const auto numbers = [&](const char* what, auto& x) {
    Vec flat = Eigen::Map<const Vec>(x.data(), x.size());
    a(name + what, flat);
    require(flat.size() == x.size(), name + what);
    std::copy(flat.begin(), flat.end(), x.data());
  };
  numbers("direction", mode.direction);
  a(name + "slow", mode.least_slip);
  numbers("anchor", mode.anchor);
  numbers("rolled_from", mode.rolled_from);
}

void archive_push(Archive& a, const std::string& name, std::optional<double>& push) {
  bool known = push.has_value();
  double newtons = push.value_or(0);
  a(name + "push_known", known), a(name + "push", newtons);
  push = known ? std::optional(newtons) : std::nullopt;
}

// The directions of closed contacts.
void archive_directions(Archive& a, const std::string& name, std::vector<model::ContactDirection>& directions,
                        const std::vector<model::ContactMode>& modes, int rows) {
  Vec flat(Eigen::Index(2 * directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i)
    flat.segment<2>(Eigen::Index(2 * i)) << directions[i].contact, directions[i].row;
  a(name, flat);
  require(flat.size() % 2 == 0, name);
  directions.clear();
  for (Eigen::Index i = 0; i < flat.size(); i += 2) {
    directions.push_back({index(flat[i], modes.size(), name), index(flat[i + 1], std::size_t(rows), name)});
    require(modes[std::size_t(directions.back().contact)].closed, name);
  }
}

void archive_contacts(Archive& a, const std::string& name, std::vector<int>& contacts, std::size_t count) {
  Vec flat(Eigen::Index(contacts.size()));
  std::copy(contacts.begin(), contacts.end(), flat.begin());
  a(name, flat);
  contacts.clear();
  for (const double x : flat) contacts.push_back(index(x, count, name));
}

void archive_matrix(Archive& a, const std::string& name, Mat& matrix, std::size_t rows, std::size_t columns) {
  Vec flat = Eigen::Map<const Vec>(matrix.data(), matrix.size());
  a(name, flat);
  require(flat.size() == Eigen::Index(rows * columns), name);
  matrix = Eigen::Map<const Mat>(flat.data(), Eigen::Index(rows), Eigen::Index(columns));
}

void archive_shared(Archive& a, model::Modes& modes, int rows) {
  std::vector<model::SharedRows>& shared = modes.shared;
  int groups = int(shared.size());
  a("shared_rows", groups);
  require(groups >= 0 && std::size_t(groups) <= modes.contacts.size(), "shared_rows");
  shared.resize(std::size_t(groups));
  for (std::size_t g = 0; g < shared.size(); ++g) {
    model::SharedRows& group = shared[g];
    const std::string name = fmt::format("shared_rows_{}_", g);
    archive_directions(a, name + "basis", group.basis, modes.contacts, rows);
    archive_directions(a, name + "implied", group.implied, modes.contacts, rows);
    archive_matrix(a, name + "K", group.K, group.implied.size(), group.basis.size());
    archive_matrix(a, name + "share", group.share, group.basis.size() + group.implied.size(), group.basis.size());
    archive_contacts(a, name + "sliding", group.sliding, modes.contacts.size());
  }
}

// The archive of a component. An exception while writing names the component; one while reading, the checkpoint.
template <class Component>
void archive_component(JsonArchive& a, const std::string& name, const plugin::Origin& origin, double t,
                       Component& component) {
  const plugin::Breadcrumb goes_on(origin, "archive");
  JsonArchive own = a.nested(name);
  if (a.reading()) return component.archive(own);
  plugin::guard(origin, "archive", t, [&] { component.archive(own); });
}

}  // namespace

// Bodies first: refined ones decide the sizes of everything that follows.
void Simulator::archive(JsonArchive& a) {
  archive_bodies(a);
  archive_state(a);
  turns_.archive(a);
  JsonArchive integrator = a.nested("integrator");
  if (a.reading()) integrator.require_lengths(system_.sizes());
  integrator_.archive(integrator);
  for (std::size_t i = 0; i < corrections_.size(); ++i) {
    archive_component(a, fmt::format("correction_{}", i), *corrections_[i].origin, now_.t, *corrections_[i].correction);
  }
}

void Simulator::archive_bodies(JsonArchive& a) {
  if (!refinement_.possible()) return;
  for (const model::BodyEntry& entry : system_.model().bodies) {
    if (!entry.refinable) continue;
    archive_component(a, "body_" + entry.name, entry.origin, now_.t, *entry.refinable);
  }
  if (a.reading()) refinement_.lay_out();
}

void Simulator::archive_state(Archive& a) {
  a("t", now_.t), a("q", now_.q), a("v", now_.v), a("a", now_.a), a("lambda", now_.lambda);
  const model::Model& model = system_.model();
  model::Modes modes = system_.modes();
  for (std::size_t i = 0; i < modes.contacts.size(); ++i) {
    const std::string name = fmt::format("contact_{}_", i);
    a(name + "closed", modes.contacts[i].closed);
    a(name + "approach_speed", modes.contacts[i].approach_speed);
    a(name + "offset", modes.contacts[i].offset);
    int friction = int(modes.contacts[i].friction);
    a(name + "friction", friction);
    require(
        friction == 0 || ((friction == 1 || friction == 2) && model.contacts[i].coulomb && modes.contacts[i].closed),
        name + "friction");
    modes.contacts[i].friction = model::ContactMode::Friction(friction);
    archive_tangential(a, name, modes.contacts[i]);
    int spring = int(modes.contacts[i].spring);
    a(name + "spring", spring);
    require(spring >= 0 && spring <= int(complementarity::Spring::locked), name + "spring");
    modes.contacts[i].spring = complementarity::Spring(spring);
    archive_push(a, name, modes.contacts[i].push);
  }
  archive_shared(a, modes, dimension(model.world.space));
  if (modes != system_.modes()) system_.set_modes(modes);
  require_state_fits();
  scale_.archive(a);
  audit_.archive(a, model.contacts.size());
  thresholds_.archive(a);
  a("hold_until", hold_until_), a("step_limit", step_limit_);
  a("records", records_), a("last_row", last_row_), a("window_start", window_start_),
      a("window_events", window_events_), a("standing", standing_);
  model::Counts& counts = system_.counts();
  a("residual_evaluations", counts.residual_evaluations), a("jacobian_evaluations", counts.jacobian_evaluations);
  a("factorizations", counts.factorizations), a("newton_iterations", counts.newton_iterations);
  free_control_.archive(a, "step_");
  contact_control_.archive(a, "contact_step_");
  ledger_.archive(a);
  energy_.archive(a);
  statistics_.archive(a);
  location_.archive(a);
  modes_.impact_warnings().archive(a, model.contacts.size());
  theories_.archive(a);
  last_motions_.archive(a);
  require(last_motions_.fits(model.contacts.size()), "last_event_contact");
  // In time order, a row is due after each row that was written: exactly one count of rows belongs to this t.
  const double rows_so_far = (now_.t - settings_.start) / settings_.every;
  require(std::abs(double(records_) - rows_so_far) < 3, "records");
}

void Simulator::require_state_fits() const {
  const Sizes& sizes = system_.sizes();
  const auto fits = [](const char* name, const Vec& x, int length) {
    require(x.size() == length && x.allFinite(), name);
  };
  require(std::isfinite(now_.t) && now_.t >= settings_.start, "t");
  fits("q", now_.q, sizes.nq), fits("v", now_.v, sizes.nv), fits("a", now_.a, sizes.nv);
  fits("lambda", now_.lambda, sizes.nc);
}

}  // namespace trammel::simulate
