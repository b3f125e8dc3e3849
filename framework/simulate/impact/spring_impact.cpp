#include "simulate/impact/spring_impact.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {

using complementarity::ContactSolution;
using complementarity::LcpOutcome;

namespace {

// Of the largest rate: slips that count as 0, in the plane and in space. In space the direction of a slip turns the
// faster the slower it is.
constexpr double no_slip = 1e-11, no_slip_in_space = 1e-9;
// Of the largest rate: a larger rate left at the end of an unfinished impact is reported.
constexpr double worth_reporting = 1e-3;

}  // namespace

SpringImpact::SpringImpact(std::vector<SpringContact> contacts, const Mat& A, const Vec& u, int tangents)
    : A_(A), u_before_(u), t_(tangents), n_(Eigen::Index(contacts.size())), m_(u.size()) {
  double softest = 0;
  for (const SpringContact& c : contacts) {
    contacts_.push_back({c});
    softest = std::max(softest, A(c.normal, c.normal));
  }
  if (softest > 0) k_ = 1 / softest;
  v_ = u.size() > 0 ? u.lpNorm<Eigen::Infinity>() : 0;
  slow_ = (t_ == 1 ? no_slip : no_slip_in_space) * v_;
  x_.setZero(n_), P_.setZero(m_), admissible_.setZero(m_), lost_friction_.setZero(n_), lost_normal_.setZero(n_),
      compressed_.setZero(n_);
}

ContactSolution SpringImpact::run() {
  if (v_ == 0) return {LcpOutcome::solved, 0};
  u_ = rates();
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (u_[contacts_[i].normal] < -tolerance * v_) press(i);
  bool ended = false;
  for (int phase = 0; !ended && phase < most_phases; ++phase) {
    begin_phase();
    ended = finished() || wedged();
    if (ended) break;
    if (!advance_to_event()) break;
    handle_events();
  }
  const double left = std::max(fastest_approach() / v_, x_.norm() / v_);
  cut_short_ = !ended && left > worth_reporting;
  return close();
}

bool SpringImpact::finished() const {
  const Vec u = rates();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const int n = contacts_[i].normal;
    if (u[n] < -negligible * v_ || std::sqrt(k_ * A_(n, n)) * x_[Eigen::Index(i)] > negligible * v_) return false;
  }
  return true;
}

// True if springs balance each other or friction: nothing changes any more.
bool SpringImpact::wedged() {
  derivative(state(), dy_);
  for (const Contact& c : contacts_) {
    const double rate = u_[c.normal] / v_;
    if (rate < -still || (c.presses && rate > still)) return false;
  }
  return (A_ * f_).lpNorm<Eigen::Infinity>() <= still * v_;
}

void SpringImpact::press(std::size_t i) {
  contacts_[i].presses = contacts_[i].compresses = true;
  contacts_[i].x_0 = x_[Eigen::Index(i)];
}

void SpringImpact::end_compression(std::size_t i) {
  Contact& c = contacts_[i];
  const auto at = Eigen::Index(i);
  const double stored = k_ / 2 * (x_[at] * x_[at] - c.x_0 * c.x_0);
  compressed_[at] += stored;
  lost_normal_[at] += (1 - c.e * c.e) * stored;
  x_[at] = std::sqrt(c.x_0 * c.x_0 + c.e * c.e * (x_[at] * x_[at] - c.x_0 * c.x_0));
  c.compresses = false;
  c.presses = x_[at] > 0;
  // Removes the rest of the rate: an event is located to a few units of `tolerance`.
  if (A_(c.normal, c.normal) > 0 && std::abs(u_[c.normal]) <= 10 * negligible * v_)
    P_[c.normal] = std::max(0.0, P_[c.normal] - u_[c.normal] / A_(c.normal, c.normal));
}

void SpringImpact::handle_normal(std::size_t i) {
  Contact& c = contacts_[i];
  if (!c.presses) return press(i);
  if (c.compresses) return end_compression(i);
  if (u_[c.normal] < -tolerance * v_) press(i);
  if (x_[Eigen::Index(i)] <= tolerance * v_) x_[Eigen::Index(i)] = 0, c.presses = c.compresses = false;
}

void SpringImpact::handle_events() {
  all_margins(state(), margins_);
  std::vector<std::size_t> stuck;
  bool gave_way = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (contacts_[i].mode == Tangent::sticks) stuck.push_back(i);
    if (contacts_[i].mode == Tangent::sticks && margins_[i].tangent < -tolerance) gave_way = true;
    if (margins_[i].normal() < -tolerance) handle_normal(i);
  }
  u_ = rates();
  choose_tangents();
  const auto sticks = [this](std::size_t i) { return contacts_[i].mode == Tangent::sticks; };
  if (gave_way && std::all_of(stuck.begin(), stuck.end(), sticks)) force_slip();
}

}  // namespace trammel::simulate
