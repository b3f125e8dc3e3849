#include "system/markers/reaction_tangent.hpp"

#include "system/markers/pair_tangent.hpp"

namespace trammel::model {

namespace {

// H^T lambda as wrenches on the markers.
class Reaction final : public MarkerWrenches {
 public:
  Reaction(const Constraint& constraint, double t, const Vec6& lambda, Space space)
      : constraint_(constraint), t_(t), lambda_(lambda), space_(space) {}
  void operator()(Motions markers, std::span<Wrench> on) const override {
    Rows rows;
    rows.resize(int(lambda_.size()), space_, int(markers.size()));
    constraint_.rows_between(t_, markers, rows);
    for (std::size_t k = 0; k < on.size(); ++k) on[k] = rows.H(int(k)).transpose() * lambda_;
  }
  bool depends_on_velocity() const override { return false; }

 private:
  const Constraint& constraint_;
  double t_;
  const Vec6& lambda_;
  Space space_;
};

}  // namespace

void add_reaction_tangent(const ConstraintReaction& reaction, MarkerMotions& markers, double t, const Vec& q,
                          const Vec& v, double c, Matrix& S) {
  const auto& [constraint, exact, slots, lambda] = reaction;
  const Motion& A = markers.motion(slots[0], t, q, v);
  const Space space = A.x.size() == 2 ? Space::planar : Space::spatial;
  if (!exact) return add_wrench_tangent(markers, slots, t, q, v, Reaction(constraint, t, lambda, space), c, 0, S);
  const Motion& B = markers.motion(slots[1], t, q, v);
  const auto twist = A.V.size();
  PairTangent by;
  for (Mat6* block : {&by.AA, &by.AB, &by.BA, &by.BB}) block->setZero(twist, twist);
  exact->add_reaction_tangent(t, A, B, lambda, by);
  markers.add_pair(slots[0], slots[0], by.AA, c, S);
  markers.add_pair(slots[0], slots[1], by.AB, c, S);
  markers.add_pair(slots[1], slots[0], by.BA, c, S);
  markers.add_pair(slots[1], slots[1], by.BB, c, S);
  Rows rows;
  rows.resize(constraint.row_count(space), space);
  const Motion* const both[] = {&A, &B};
  constraint.rows_between(t, both, rows);
  markers.add_reaction_derivative(slots[0], t, q, rows.H_A.transpose() * lambda, c, S);
  markers.add_reaction_derivative(slots[1], t, q, rows.H_B.transpose() * lambda, c, S);
}

}  // namespace trammel::model
