#include "system/equations/impulse_response.hpp"

#include "linear/kkt.hpp"
#include "linear/sparse_mass_kkt.hpp"
#include "system/point/not_solvable.hpp"
#include "system/point/pseudo_random.hpp"

namespace trammel::model {

void ImpulseResponse::respond(const std::vector<ContactDirection>& directions, Mat& jump, Mat& delassus) {
  const int nv = at_.model->sizes.nv;
  const auto n = Eigen::Index(directions.size());
  const Solver dv_of = with_joints_held();
  Mat N = Mat::Zero(nv, n), momenta(nv, n);
  jump.resize(nv, n);
  Vec dv, on_joints, momentum;
  for (Eigen::Index i = 0; i < n; ++i) {
    N.col(i) = unit_impulse(directions[std::size_t(i)]);
    dv_of(N.col(i), dv, on_joints);
    jump.col(i) = dv;
    momentum.setZero(nv);
    masses_.add_times(1, dv, momentum);
    momenta.col(i) = momentum;
  }
  // N^T P N = (P N)^T M (P N), where P holds the joints. In N^T (P N) terms cancel along directions that joints nearly
  // fix (a tangent that almost passes through an axle), and rows that depend on each other would not look like it.
  delassus.noalias() = jump.transpose() * momenta;
  clear_held(N, jump, delassus);
}

Vec ImpulseResponse::unit_impulse(ContactDirection d) {
  const Slots& slots = contacts_.slots(d.contact);
  for (int k = 0; k < slots.count; ++k) at_.motion(slots[k]);
  Vec impulse = Vec::Zero(at_.model->sizes.nv);
  at_.add_row_force(slots, contacts_.rows(d.contact), d.row, 1, impulse);
  return impulse;
}

Mat ImpulseResponse::held_by_joints(const std::vector<ContactDirection>& directions) {
  const Solver dv_of = with_joints_held();
  Mat multipliers(rows_.held(), Eigen::Index(directions.size()));
  Vec dv, on_joints;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    dv_of(unit_impulse(directions[i]), dv, on_joints);
    multipliers.col(Eigen::Index(i)) = on_joints;
  }
  return multipliers;
}

ImpulseResponse::Solver ImpulseResponse::with_joints_held() {
  masses_.evaluate_mass();
  const int joint_rows = rows_.held();
  const auto solver = [joint_rows](auto&& solve) {
    return [joint_rows, solve](const Vec& impulse, Vec& dv, Vec& on_joints) {
      solve(impulse, Vec(Vec::Zero(joint_rows)), dv, on_joints);
    };
  };
  if (blocks_) {
    const auto held = std::make_shared<numerics::SparseMassKkt>();
    if (!held->factorise(blocks_->bodies(), joint_rows, numerics::SparseMassKkt::Metric::mass))
      throw NotSolvable("the mass matrix is not positive definite");
    return solver(
        [held, this](const Vec& b, const Vec& c, Vec& x, Vec& y) { held->solve(blocks_->bodies(), b, c, x, y); });
  }
  const auto held = std::make_shared<numerics::MassKkt>();
  held->measure_by([&markers = at_.markers]() -> const Vec& { return markers.sizes().levers; });
  const Mat G = rows_.G().topRows(joint_rows);
  if (!(sparse_ ? held->factorise(masses_.sparse(), G, G) : held->factorise(masses_.dense(), G)))
    throw NotSolvable("the mass matrix is not positive definite");
  return solver([held](const Vec& b, const Vec& c, Vec& x, Vec& y) { held->solve(b, c, x, y); });
}

// Clears directions that the joints fix: their remaining response is round-off.
void ImpulseResponse::clear_held(const Mat& N, Mat& jump, Mat& delassus) {
  constexpr double round_off = 1e-12;
  const Vec masses = masses_.diagonal();
  for (Eigen::Index i = 0; i < N.cols(); ++i) {
    const double alone = N.col(i).cwiseAbs2().cwiseQuotient(masses).sum();
    if (delassus(i, i) > round_off * alone) continue;
    jump.col(i).setZero();
    delassus.row(i).setZero();
    delassus.col(i).setZero();
  }
}

Vec ImpulseResponse::sizes_of_motions() {
  return masses_.diagonal().cwiseSqrt().cwiseInverse();
}

Vec ImpulseResponse::some_motion() {
  const Vec weight = masses_.diagonal().cwiseSqrt(), numbers = pseudo_random(at_.model->sizes.nv, 1, 1);
  if (rows_.held() == 0) return numbers.cwiseQuotient(weight);
  Vec some, on_joints;
  with_joints_held()(numbers.cwiseProduct(weight), some, on_joints);
  return some;
}

}  // namespace trammel::model
