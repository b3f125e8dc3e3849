#include "system/point/point.hpp"

#include "linear/dense/prefetch.hpp"

namespace trammel::model {

Slots slots_from(const std::vector<int>& slots) {
  Slots all{.count = int(slots.size())};
  int* const places[] = {&all.A, &all.B, &all.C, &all.D};
  for (std::size_t k = 0; k < slots.size(); ++k) *places[k] = slots[k];
  return all;
}

Point::Point(std::shared_ptr<const Model> m) : model(std::move(m)), markers(*model, site) {
  const auto slots_of = [&](const std::vector<MarkerRef>& refs) {
    std::vector<int> each;
    for (const MarkerRef& ref : refs) each.push_back(markers.slot(ref));
    return slots_from(each);
  };
  for (const ForceEntry& entry : model->forces) forces.push_back(slots_of({entry.A, entry.B}));
  for (const JointEntry& entry : model->joints) joints.push_back(slots_of(entry.markers));
}

bool Point::move_to(double t_new, const Vec& q_new, const Vec& v_new) {
  const bool same_place = number > 0 && t == t_new && q == q_new;
  if (same_place && v == v_new) return false;
  if (!same_place) ++configuration;
  t = t_new;
  q = q_new;
  v = v_new;
  ++number;
  markers.new_point();
  return true;
}

void Point::hold_still(bool still) {
  markers.hold_still(still);
  if (number > 0) ++number;  // otherwise there is no point yet
  ++configuration;
}

Seen Point::motions(const Slots& slots) {
  Seen seen{};
  for (int k = 0; k < slots.count; ++k) seen[std::size_t(k)] = &motion(slots[k]);
  return seen;
}

Seen Point::motions_in_passing(const Slots& slots) {
  Seen seen{};
  for (int k = 0; k < slots.count; ++k)
    seen[std::size_t(k)] = &markers.motion_in_passing(slots[k], std::size_t(k), t, q, v);
  return seen;
}

void Point::evaluate(const Constraint& constraint, int n, const Seen& motions, int count, Rows& into) const {
  into.resize(n, model->world.space, count);
  constraint.rows_between(t, Motions(motions.data(), std::size_t(count)), into);
}

void Point::add_row_force(const Slots& slots, const Rows& r, int row, double c, Vec& sum) const {
  for (int k = 0; k < slots.count; ++k) markers.add_wrench(slots[k], r.H(k).row(row).transpose(), c, sum);
}

// Prefetches the beginning of a body's numbers; only the body knows their extent.
void Point::prefetch(const BodyEntry& body) const {
  constexpr std::size_t as_a_rule = 192;
  numerics::prefetch(body.body.get(), as_a_rule);
}

}  // namespace trammel::model
