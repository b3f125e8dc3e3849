#include "system/equations/resting_friction.hpp"

#include <algorithm>

#include "complementarity/contact_forces.hpp"
#include "system/point/not_solvable.hpp"

namespace trammel::model {

namespace {

// Part of a force along a tangent: what the rows' reactions leave of it is round-off below this.
constexpr double held = 1e-9;

}  // namespace

void RestingFriction::lay_out(std::vector<int> contacts) {
  resting_ = std::move(contacts);
  forces_.setZero(2, contacts_.count());
}

bool RestingFriction::decides(int contact) const {
  return std::find(resting_.begin(), resting_.end(), contact) != resting_.end();
}

// The problem of Zhang and Wang 2017, (32)-(39), with A = W_T^T P W_T, where P is the inverse of the mass on the null
// space of the rows. A direction that rows hold already, as beside a foot that sticks by rows, has no friction: its
// column of P W_T is round-off.
void RestingFriction::add_to(Vec& a, Vec& lambda) {
  const int nv = at_.model->sizes.nv, nc = rows_.count();
  const Eigen::Index m = contacts_.tangents(resting_.front()), n = m * Eigen::Index(resting_.size());
  Mat response(nv, n), reaction(nc, n), columns = Mat::Zero(nv, n);
  Vec b(n), column, x, y, left, T, a_t;
  std::vector<complementarity::ContactPoint> points;
  for (Eigen::Index k = 0; k < n; ++k) {
    const int i = resting_[std::size_t(k / m)], row = 1 + int(k % m);
    column.setZero(nv);
    at_.add_row_force(contacts_.slots(i), contacts_.rows(i), row, 1, column);
    columns.col(k) = column;
    if (!factors_.solve(FactorsAtPoint::at_point, column, Vec::Zero(nc), x, y))
      throw NotSolvable("the friction of the feet at rest was not found");
    response.col(k) = x, reaction.col(k) = y;
    b[k] = contacts_.acceleration(i, row, a);
    left = column;
    rows_.add_reaction(-1, y, left);
    if (left.norm() <= held * column.norm()) columns.col(k).setZero(), response.col(k).setZero(), b[k] = 0;
    if (row > 1) continue;
    points.push_back({.tangent = int(k),
                      .tangents = int(m),
                      .kind = complementarity::ContactPoint::Tangent::resting,
                      .coefficient = contacts_.entry(i).coulomb->static_coefficient(),
                      .given = contacts_.law_normal(i)});
  }
  if (complementarity::solve_contacts(points, columns.transpose() * response, b, T, a_t).outcome !=
      complementarity::LcpOutcome::solved)
    throw NotSolvable("the friction of the feet at rest was not found");
  a.noalias() += response * T;
  lambda.noalias() += reaction * T;
  for (Eigen::Index k = 0; k < n; ++k) forces_(k % m, resting_[std::size_t(k / m)]) = T[k];
}

}  // namespace trammel::model
