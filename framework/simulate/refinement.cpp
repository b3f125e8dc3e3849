#include "simulate/refinement.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "run/run_failed.hpp"

namespace trammel::simulate {

Refinement::Refinement(std::shared_ptr<model::Model> model, model::AssembledSystem& system)
    : model_(std::move(model)), system_(system) {
  for (std::size_t i = 0; i < model_->bodies.size(); ++i)
    if (model_->bodies[i].refinable) refinable_.push_back(int(i));
}

RefineCause Refinement::cause(const State& state, int contact, int body, std::vector<double>& pressure) {
  RefineCause cause;
  pressure.clear();
  if (contact >= 0) {
    cause.contact = model_->contacts[std::size_t(contact)].name;
    cause.at = place(state, contact, body);
  } else if (system_.has_surface_contact(body)) {
    system_.move_to(state.t, state.q, state.v);
    pressure = system_.surface_pressure(body);
    cause.pressure = pressure;
  }
  return cause;
}

void Refinement::find_due(const State& state, int contact) {
  due_.clear(), causes_.clear();
  pressures_.resize(refinable_.size());
  for (std::size_t k = 0; k < refinable_.size(); ++k) {
    const int i = refinable_[k];
    if (contact >= 0) {
      const model::ContactEntry& touched = model_->contacts[std::size_t(contact)];
      if (i != touched.A.body && i != touched.B.body) continue;
    }
    const model::BodyEntry& entry = model_->bodies[std::size_t(i)];
    const auto q = state.q.segment(entry.q0, entry.nq);
    const auto v = state.v.segment(entry.v0, entry.nv);
    const RefineCause why = cause(state, contact, i, pressures_[k]);
    if (entry.refinable->due(state.t, q, v, why)) due_.push_back(i), causes_.push_back(why);
  }
}

// Nearest point to the marker that touches (a sphere's centre, too), or to the deepest point of the surface that
// touches.
Eigen::Vector2d Refinement::place(const State& state, int contact, int body) {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  const model::BodyEntry& entry = model_->bodies[std::size_t(body)];
  if (!entry.surface) return at;
  system_.move_to(state.t, state.q, state.v);
  Vec3 point, normal;
  entry.surface->nearest(state.t, state.q.segment(entry.q0, entry.nq), system_.contact_marker(contact).x, at, point,
                         normal);
  return at;
}

RefineEvent::Side Refinement::side(const State& state, int body) const {
  const model::BodyEntry& entry = model_->bodies[std::size_t(body)];
  const auto q = state.q.segment(entry.q0, entry.nq);
  const auto v = state.v.segment(entry.v0, entry.nv);
  RefineEvent::Side side{{entry.nq, entry.nv, 0}, entry.body->energy(state.t, q, v), std::nullopt};
  if (entry.momentum) side.momentum = entry.momentum->momentum(state.t, q, v);
  return side;
}

void Refinement::lay_out() {
  model_->lay_out();
  system_.lay_out();
}

const Transfer* Refinement::refine(State& state, int contact) {
  find_due(state, contact);
  if (due_.empty()) return nullptr;
  std::vector<RefineEvent::Side> before;
  for (const int body : due_) before.push_back(side(state, body));
  auto transfer = model::refine(*model_, state.t, state.q, state.v, due_, causes_, refined_);
  if (!transfer) return nullptr;
  transfer_ = std::move(transfer);
  system_.lay_out();

  const Vec q = state.q, v = state.v;
  state.q.resize(model_->sizes.nq);
  state.v.resize(model_->sizes.nv);
  transfer_->q(q, state.q);
  transfer_->v(v, state.v);
  if (!state.q.allFinite() || !state.v.allFinite())
    throw RunFailed(fmt::format("at t = {:.9g} s: the refinement of {} gave numbers that are not finite", state.t,
                                model_->bodies[std::size_t(refined_.front())].name));
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, state.a, state.lambda);

  events_.clear();
  gained_ = 0;
  for (const int body : refined_) {
    const auto i = std::size_t(std::find(due_.begin(), due_.end(), body) - due_.begin());
    events_.push_back({state.t, body, contact < 0 ? "step" : "contacts." + model_->contacts[std::size_t(contact)].name,
                       before[i], side(state, body)});
    gained_ += events_.back().after.energy.total() - before[i].energy.total();
  }
  return transfer_.get();
}

}  // namespace trammel::simulate
