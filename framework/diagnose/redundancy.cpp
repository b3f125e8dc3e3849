#include "diagnose/redundancy.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <trammel/decompositions.hpp>

#include "linear/sparse/dependent_rows.hpp"

namespace trammel::simulate {

namespace {

// Rows with angles replaced by displacements at their levers, so that the rank does not depend on the size of the
// mechanism.
Eigen::SparseMatrix<double, Eigen::RowMajor> rows_without_levers(model::AssembledSystem& system) {
  return system.sparse_rows() * system.coordinate_sizes().levers.cwiseInverse().asDiagonal();
}

}  // namespace

std::vector<RedundantRows> redundant_rows(model::AssembledSystem& system, const State& state) {
  system.move_to(state.t, state.q, state.v);
  const std::vector<int> dependent = numerics::dependent_rows(rows_without_levers(system), rank_tolerance);
  std::vector<RedundantRows> found;
  auto row = dependent.begin();
  for (const model::RowGroup& group : row_groups(system.model())) {
    RedundantRows here{group.path, {}, group.count};
    for (; row != dependent.end() && *row < group.first + group.count; ++row) here.rows.push_back(*row - group.first);
    if (!here.rows.empty()) found.push_back(std::move(here));
  }
  return found;
}

std::string description(const RedundantRows& here) {
  std::vector<int> numbers;
  for (const int row : here.rows) numbers.push_back(row + 1);
  return fmt::format("{}: row{} {} of {} follow{} from the rows before", here.path, numbers.size() > 1 ? "s" : "",
                     fmt::join(numbers, ", "), here.of, numbers.size() > 1 ? "" : "s");
}

namespace {

// By row: true if some self-stress, G^T lambda = 0, has a component in it.
std::vector<bool> in_self_stress(const Mat& G) {
  Eigen::ColPivHouseholderQR<Mat> qr;
  qr.setThreshold(rank_tolerance);
  const Mat columns = G.transpose();
  qr.compute(columns);
  const Eigen::Index rank = qr.rank(), spare = G.rows() - rank;
  Mat stress(G.rows(), spare);
  stress.topRows(rank) = qr.matrixR().topRightCorner(rank, spare);
  qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(stress.topRows(rank));
  stress.bottomRows(spare) = -Mat::Identity(spare, spare);
  const Mat by_row = qr.colsPermutation() * stress;
  std::vector<bool> takes_part;
  for (Eigen::Index i = 0; i < G.rows(); ++i) takes_part.push_back(by_row.row(i).lpNorm<1>() > rank_tolerance);
  return takes_part;
}

}  // namespace

void check_bearing_loads(model::AssembledSystem& system, const State& state, const scene::Value& root,
                         scene::Problems& problems) {
  const auto& contacts = system.model().contacts;
  const auto rubs = [](const model::ContactEntry& contact) { return contact.joint.has_value(); };
  if (std::none_of(contacts.begin(), contacts.end(), rubs) || redundant_rows(system, state).empty()) return;
  const std::vector<bool> uncertain = in_self_stress(Mat(rows_without_levers(system)));
  for (const model::ContactEntry& contact : contacts) {
    if (!contact.joint) continue;
    const model::JointEntry& joint = system.model().joints[std::size_t(contact.joint->joint)];
    const auto first = uncertain.begin() + joint.row;
    if (std::none_of(first, first + joint.rows, [](bool part) { return part; })) continue;
    if (const scene::Value* friction = root.at_path(contact.path() + ".friction"))
      problems.warning(friction->problem(
          "joints repeat each other's rows ('trammel explain' names them), so that many reactions of this one are "
          "possible: its friction is that of the least; leave out what repeats, or use compliant joints (bushing)"));
  }
}

}  // namespace trammel::simulate
