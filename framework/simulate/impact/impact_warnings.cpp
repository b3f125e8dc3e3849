#include "simulate/impact/impact_warnings.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulate/impact/spring_impact.hpp"

namespace trammel::simulate {
namespace {

// Error of solutions, relative to the work that impulses and rates of an impact can do.
constexpr double round_off = 1e-9;

double work_at_most(const TouchingContact& c) {
  return 0.5 * (c.impulse * (std::abs(c.before) + std::abs(c.after)) +
                c.friction.norm() * (c.slip_before.norm() + c.slip_after.norm()));
}

// Sums over the contacts of an island.
struct Work {
  double gain = 0, at_most = 0, of_rest = 0;
  bool creates(double kinetic) const {
    return gain > round_off * at_most + of_rest && gain > std::numeric_limits<double>::epsilon() * kinetic;
  }
};

// The rate that steps have left in a contact at rest does no work by a law of impacts.
double energy_gained(const TouchingContact& c, double at_rest) {
  const bool kept = c.was_closed && std::abs(c.after - c.before) <= at_rest;
  return -c.energy_lost() - (kept ? c.impulse * 0.5 * (c.before + c.after) : 0);
}

}  // namespace

void ImpactWarnings::check(double t, double kinetic, double at_rest, const std::vector<TouchingContact>& touching,
                           bool cut_short) {
  if (cut_short && cut_short_++ == 0) first_cut_ = t;
  std::map<std::size_t, Work> islands;
  for (const TouchingContact& c : touching) {
    Work& work = islands[c.island];
    work.gain += energy_gained(c, at_rest), work.at_most += work_at_most(c);
    work.of_rest += (std::abs(c.impulse) + c.friction.norm()) * at_rest;
  }
  std::erase_if(islands, [&](const auto& island) { return !island.second.creates(kinetic); });
  if (islands.empty()) return;
  double gain = 0;
  for (const auto& [number, work] : islands) gain += work.gain;
  ++gains_;
  total_ += gain;
  if (gain <= largest_) return;
  largest_ = gain, kinetic_ = kinetic, time_ = t;
  contacts_.clear();
  for (const TouchingContact& c : touching)
    if (c.impulse > 0 && islands.contains(c.island)) contacts_.push_back(c.contact);
}

std::vector<std::string> ImpactWarnings::lines(const model::Model& model) const {
  std::vector<std::string> all;
  if (gains_ > 0) {
    std::vector<std::string_view> names;
    for (const int i : contacts_) names.push_back(model.contacts[std::size_t(i)].name);
    const std::string part =
        kinetic_ > 0 ? fmt::format(", {:.3g} % of the kinetic energy", 100 * largest_ / kinetic_) : "";
    const std::string what =
        fmt::format("{:.3g} J{} at t = {:.9g} s through {}", largest_, part, time_, fmt::join(names, ", "));
    const std::string who =
        gains_ == 1 ? "an impact created energy: " + what
                    : fmt::format("{} impacts created energy: {:.3g} J in all, the largest {}", gains_, total_, what);
    all.push_back(who + "; \"impact_law\": \"energetic\" never does, nor does \"restitution\": 0");
  }
  if (cut_short_ > 0)
    all.push_back(
        fmt::format("{} of the impacts had not ended after {} changes of their contacts and {} ended without "
                    "restitution, the first at t = {:.9g} s",
                    cut_short_, SpringImpact::most_phases, cut_short_ == 1 ? "was" : "were", first_cut_));
  return all;
}

void ImpactWarnings::archive(Archive& a, std::size_t count) {
  a("impact_gains", gains_), a("impact_gain_total", total_), a("impact_gain_largest", largest_);
  a("impact_gain_kinetic", kinetic_), a("impact_gain_time", time_);
  a("impacts_cut_short", cut_short_), a("impact_first_cut", first_cut_);
  Vec contacts(Eigen::Index(contacts_.size()));
  for (std::size_t i = 0; i < contacts_.size(); ++i) contacts[Eigen::Index(i)] = contacts_[i];
  a("impact_gain_contacts", contacts);
  contacts_.clear();
  for (const double i : contacts) {
    if (!(i >= 0 && i < double(count))) throw std::out_of_range("impact_gain_contacts");
    contacts_.push_back(int(i));
  }
}

}  // namespace trammel::simulate
