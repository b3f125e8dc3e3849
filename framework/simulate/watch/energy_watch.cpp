#include "simulate/watch/energy_watch.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace trammel::simulate {

void EnergyWatch::start(const Energy& initial) {
  start_ = initial;
  moved_ = initial.kinetic;
}

// A method that is unstable at its step may return finite but meaningless numbers for long. Its energy shows this
// because it goes on growing; that of a damping method overshoots once and falls (HHT-alpha at h omega = 1e5: by 5e4).
EnergyWatch::Judgement EnergyWatch::look(const Energy& energy, bool at_end) {
  const double relative = relative_drift(energy);
  if (!std::isfinite(relative))
    return {Verdict::not_finite,
            "the energy left the range of numbers: lengths, speeds, masses or stiffnesses are too large, or the "
            "solution diverged"};
  const bool grows = at_end || relative >= drift_before_;
  drift_before_ = std::max(relative, least_divergence);
  if (relative <= unexplained) return {Verdict::explained, ""};
  if (relative >= least_divergence && grows)
    return {Verdict::diverged, fmt::format("the solution diverged: its energy changed by {:.3g} J that no force "
                                           "supplied or took, {:.3g} times what moved. The step may be too long for "
                                           "the method",
                                           drift(energy), relative)};
  if (!at_end) return {Verdict::unexplained, ""};
  return {Verdict::unexplained,
          fmt::format("the method itself changed the energy by {:.3g} J, {:.2g} times all that moved; shorter steps "
                      "change less",
                      drift(energy), relative)};
}

void EnergyWatch::take_moved(const Energy& energy, const Ledger::Totals& totals) {
  const double changed = std::abs(start_.elastic) + std::abs(energy.potential - start_.potential) +
                         std::abs(totals.supplied) + std::abs(ledger_.refinements()) + totals.dissipated;
  moved_ = std::max(moved_, start_.kinetic + changed);
  const bool falls = system_.model().world.gravity.norm() > 0;
  if (!falls && system_.sizes().nv > 0) most_work_ = std::max(most_work_, work_over_length());
}

// A small addend keeps round-off of a system at rest from counting. The work of the forces costs an evaluation, so it
// is asked for only where it decides.
double EnergyWatch::relative_drift(const Energy& energy) {
  take_moved(energy, ledger_.totals());
  constexpr double round_off = 1e-12;  // of energies, which count from a place that may be far off
  const double change = std::abs(drift(energy)), moved = moved_ + round_off * std::abs(ledger_.energy_start());
  none_ = little(0);
  const double without_work = change / (moved + none_);
  return without_work > unexplained ? change / (moved + little(std::max(most_work_, work_over_length())))
                                    : without_work;
}

// [J] Energy that counts as none in this scene: 1e-8 of the energy of its masses at its speed, which a fall through its
// length gives, or of `work` if that is more; a nanojoule if there is neither. That is ten times the energy of a fall
// through the last digits of a scene: a contact that is closed at the start may be off by those, and the stabilisation
// of its row closes it in steps of any length. A fall during the shortest step counts as none too: a base whose law
// begins with 1e-78 m has no speed to compare with, but the first event is located by steps.
double EnergyWatch::little(double work) {
  constexpr double part = 1e-8, nanojoule = 1e-9;
  if (system_.sizes().nv == 0) return nanojoule;
  const double speed = std::max(scale_.scene().speed, scale_.scene().motion);
  const Vec rates = system_.coordinate_sizes().levers.cwiseInverse();  // of a speed of 1 m/s
  Vec momenta = Vec::Zero(rates.size());
  system_.add_mass_times(1, rates, momenta);
  const double mass = momenta.cwiseProduct(rates).lpNorm<Eigen::Infinity>();
  const double energy = std::max(mass * speed * speed, work);
  const double fall = shortest_step_ * system_.model().world.gravity.norm();  // [m/s]
  return energy > 0 ? std::max(part * energy, mass * fall * fall) : nanojoule;
}

// [J] The largest work of a present force over the scene's length. Without gravity, what loads hold at rest has no
// speed, and a load that fades away later may be all that gives the scene a size: the largest in records so far counts.
double EnergyWatch::work_over_length() {
  const Vec rates = system_.coordinate_sizes().levers.cwiseInverse();
  return system_.f().cwiseProduct(rates).lpNorm<Eigen::Infinity>() * scale_.scene().length();
}

void EnergyWatch::archive(Archive& a) {
  a("start_kinetic", start_.kinetic), a("start_potential", start_.potential), a("start_elastic", start_.elastic);
  a("most_moved", moved_), a("drift_before", drift_before_);
  a("most_work", most_work_);
}

}  // namespace trammel::simulate
