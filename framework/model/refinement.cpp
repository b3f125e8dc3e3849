#include "model/refinement.hpp"

namespace trammel::model {
namespace {

JoinedTransfer::Segment segment(const BodyEntry& entry) {
  return {entry.q0, entry.nq, entry.v0, entry.nv};
}

}  // namespace

void JoinedTransfer::q(In old, Out fresh) const {
  for (const Part& part : parts_) {
    const auto from = old.segment(part.old.q0, part.old.nq);
    auto to = fresh.segment(part.fresh.q0, part.fresh.nq);
    part.transfer ? part.transfer->q(from, to) : void(to = from);
  }
}

void JoinedTransfer::v(In old, Out fresh) const {
  for (const Part& part : parts_) {
    const auto from = old.segment(part.old.v0, part.old.nv);
    auto to = fresh.segment(part.fresh.v0, part.fresh.nv);
    part.transfer ? part.transfer->v(from, to) : void(to = from);
  }
}

std::unique_ptr<JoinedTransfer> refine(Model& model, double t, const Vec& q, const Vec& v,
                                       const std::vector<int>& asked, const std::vector<RefineCause>& causes,
                                       std::vector<int>& refined) {
  refined.clear();
  std::vector<JoinedTransfer::Part> parts;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const int i = asked[k];
    const BodyEntry& entry = model.bodies[std::size_t(i)];
    if (!entry.refinable) continue;
    auto transfer = entry.refinable->refine(t, q.segment(entry.q0, entry.nq), v.segment(entry.v0, entry.nv), causes[k]);
    if (!transfer) continue;
    parts.resize(model.bodies.size());
    parts[std::size_t(i)].transfer = std::move(transfer);
    refined.push_back(i);
  }
  if (parts.empty()) return nullptr;
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].old = segment(model.bodies[i]);
  model.lay_out();
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].fresh = segment(model.bodies[i]);
  return std::make_unique<JoinedTransfer>(std::move(parts));
}

}  // namespace trammel::model
