// What a checkpoint holds of a run, so that it goes on bit by bit as if it had never stopped.
#include <algorithm>

#include <fmt/format.h>

#include "simulate/simulator.hpp"

namespace trammel::simulate {
namespace {

void archive_tangential(Archive& a, const std::string& name, model::ContactMode& mode) {
  const auto numbers = [&](const char* what, auto& x) {
    Vec flat = Eigen::Map<const Vec>(x.data(), x.size());
    a(name + what, flat);
    if (flat.size() == x.size()) std::copy(flat.begin(), flat.end(), x.data());
  };
  numbers("direction", mode.direction);
  a(name + "slow", mode.slow);
  numbers("anchor", mode.anchor);
  numbers("rolled_from", mode.rolled_from);
}

void archive_directions(Archive& a, const std::string& name, std::vector<model::ContactDirection>& directions) {
  Vec flat(Eigen::Index(2 * directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i)
    flat.segment<2>(Eigen::Index(2 * i)) << directions[i].contact, directions[i].row;
  a(name, flat);
  directions.clear();
  for (Eigen::Index i = 0; i + 1 < flat.size(); i += 2) directions.push_back({int(flat[i]), int(flat[i + 1])});
}

void archive_contacts(Archive& a, const std::string& name, std::vector<int>& contacts) {
  Vec flat(Eigen::Index(contacts.size()));
  std::copy(contacts.begin(), contacts.end(), flat.begin());
  a(name, flat);
  contacts.assign(flat.begin(), flat.end());
}

void archive_matrix(Archive& a, const std::string& name, Mat& matrix, std::size_t rows, std::size_t columns) {
  Vec flat = Eigen::Map<const Vec>(matrix.data(), matrix.size());
  a(name, flat);
  if (flat.size() == Eigen::Index(rows * columns))
    matrix = Eigen::Map<const Mat>(flat.data(), Eigen::Index(rows), Eigen::Index(columns));
}

void archive_shared(Archive& a, std::vector<model::SharedRows>& shared) {
  int groups = int(shared.size());
  a("shared_rows", groups);
  shared.resize(std::size_t(std::max(0, groups)));
  for (std::size_t g = 0; g < shared.size(); ++g) {
    model::SharedRows& group = shared[g];
    const std::string name = fmt::format("shared_rows_{}_", g);
    archive_directions(a, name + "basis", group.basis);
    archive_directions(a, name + "implied", group.implied);
    archive_matrix(a, name + "K", group.K, group.implied.size(), group.basis.size());
    archive_matrix(a, name + "share", group.share, group.basis.size() + group.implied.size(), group.basis.size());
    archive_contacts(a, name + "sliding", group.sliding);
  }
}

}  // namespace

// Bodies first: those that are refined decide the sizes of all that follows.
void Simulator::archive(JsonArchive& a) {
  archive_bodies(a);
  archive_state(a);
  turns_.archive(a);
  JsonArchive integrator = a.nested("integrator");
  integrator_.archive(integrator);
  for (std::size_t i = 0; i < corrections_.size(); ++i) {
    JsonArchive correction = a.nested(fmt::format("correction_{}", i));
    corrections_[i].correction->archive(correction);
  }
}

void Simulator::archive_bodies(JsonArchive& a) {
  if (!refinement_.possible()) return;
  for (const model::BodyEntry& entry : system_.model().bodies) {
    if (!entry.refinable) continue;
    JsonArchive body = a.nested("body_" + entry.name);
    entry.refinable->archive(body);
  }
  if (a.reading()) refinement_.lay_out();
}

void Simulator::archive_state(Archive& a) {
  a("start_kinetic", energy_start_.kinetic), a("start_potential", energy_start_.potential);
  a("start_elastic", energy_start_.elastic);
  a("t", now_.t), a("q", now_.q), a("v", now_.v), a("a", now_.a), a("lambda", now_.lambda);
  model::Modes modes = system_.modes();
  for (std::size_t i = 0; i < modes.contacts.size(); ++i) {
    const std::string name = fmt::format("contact_{}_", i);
    a(name + "closed", modes.contacts[i].closed);
    a(name + "approach_speed", modes.contacts[i].approach_speed);
    a(name + "offset", modes.contacts[i].offset);
    int friction = int(modes.contacts[i].friction);
    a(name + "friction", friction);
    modes.contacts[i].friction = model::ContactMode::Friction(friction);
    archive_tangential(a, name, modes.contacts[i]);
  }
  archive_shared(a, modes.shared);
  if (modes != system_.modes()) system_.set_modes(modes);
  scale_.archive(a);
  audit_.archive(a);
  a("hold_until", hold_until_), a("step_limit", step_limit_), a("drift_before", drift_before_);
  a("most_kinetic", most_kinetic_);
  a("records", records_), a("last_row", last_row_), a("window_start", window_start_),
      a("window_events", window_events_), a("standing", standing_);
  model::Counts& counts = system_.counts();
  a("residual_evaluations", counts.residual_evaluations), a("jacobian_evaluations", counts.jacobian_evaluations);
  a("factorizations", counts.factorizations), a("newton_iterations", counts.newton_iterations);
  free_control_.archive(a, "step_");
  contact_control_.archive(a, "contact_step_");
  ledger_.archive(a);
  statistics_.archive(a);
  location_.archive(a);
  modes_.impact_warnings().archive(a);
  theories_.archive(a);
}

}  // namespace trammel::simulate
