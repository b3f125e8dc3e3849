#include "complementarity/shares/carrying_rows.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {

using Eigen::Index;
using Tangent = ContactRole::Tangent;

namespace {

// Relative to the largest pivot of E. Where rows that carry come to depend on each other, F may stay finite, but share
// does not, and its round-off would be as large as F. The rows are then taken to be this far from that state, which
// changes F by as little.
constexpr double least_carried = 1e-8;

// The contact that a row of A belongs to.
std::vector<std::size_t> contacts_of_rows(const std::vector<ContactPoint>& points) {
  std::vector<std::size_t> contacts;
  const auto add = [&contacts](int row, std::size_t contact) {
    if (row >= int(contacts.size())) contacts.resize(std::size_t(row) + 1);
    contacts[std::size_t(row)] = contact;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].normal >= 0) add(points[i].normal, i);
    for (int k = 0; k < points[i].tangents && points[i].tangent >= 0; ++k) add(points[i].tangent + k, i);
  }
  return contacts;
}

}  // namespace

Mat least_norm_shares(const Mat& shares) {
  const Index n = shares.cols();
  const Mat one = Mat::Identity(n, n), M = one + shares.transpose() * shares;
  const Mat alone = Eigen::LLT<Mat>(M).solve(one);
  Mat share(n + shares.rows(), n);
  share << alone, shares * alone;
  return share;
}

Mat least_norm_shares(const Mat& resultants, const std::vector<bool>& idle) {
  std::vector<Index> carrying;
  for (std::size_t k = 0; k < idle.size(); ++k)
    if (!idle[k]) carrying.push_back(Index(k));
  Mat share = Mat::Zero(resultants.cols(), resultants.rows());
  if (resultants.rows() == 0) return share;  // the rows follow from the joints' rows alone
  const Mat transposed = resultants(Eigen::all, carrying).transpose();
  const Eigen::ColPivHouseholderQR<Mat> qr(transposed);  // E P = (Q R)^T
  const Index n = resultants.rows();
  Mat R = qr.matrixR().topRows(n);
  for (Index k = 0; k < n; ++k)
    R(k, k) = std::copysign(std::max(std::abs(R(k, k)), least_carried * qr.maxPivot()), R(k, k));
  const Mat permuted = qr.colsPermutation().transpose();
  const Mat along_Q = R.triangularView<Eigen::Upper>().transpose().solve(permuted);
  share(carrying, Eigen::all) = first_columns_of_q(qr, n) * along_Q;
  return share;
}

double force_as_spring(const Mat& among, const Vec& resultants) {
  return Eigen::CompleteOrthogonalDecomposition<Mat>(among).solve(resultants)[among.cols() - 1];
}

CarryingRows carrying_rows(const std::vector<ContactPoint>& points, const Mat& A,
                           const std::vector<ContactRole>& roles) {
  std::vector<Index> carrying, idle;
  const std::vector<std::size_t> contact_of = contacts_of_rows(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& p = points[i];
    if (roles[i].closed && p.normal >= 0) (roles[i].idle ? idle : carrying).push_back(p.normal);
    for (int k = 0; k < p.tangents && roles[i].tangent == Tangent::sticks; ++k) carrying.push_back(p.tangent + k);
  }
  CarryingRows result;
  result.rows = find_basis(A, carrying, idle);
  const auto& [basis, implied, K] = result.rows;
  Mat shares = K;  // of the carrying contacts
  for (std::size_t i = 0; i < implied.size(); ++i)
    if (std::find(idle.begin(), idle.end(), implied[i]) != idle.end()) shares.row(Index(i)).setZero();
  const Index n = Index(basis.size());
  result.share = least_norm_shares(shares);
  result.indeterminate.assign(points.size(), false);
  for (Index i = 0; i < K.rows(); ++i) {
    result.indeterminate[contact_of[std::size_t(implied[std::size_t(i)])]] = true;
    for (Index j = 0; j < n; ++j)
      if (K(i, j) != 0) result.indeterminate[contact_of[std::size_t(basis[std::size_t(j)])]] = true;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    result.sliding_shares = result.sliding_shares ||
                            (result.indeterminate[i] && points[i].normal >= 0 && roles[i].tangent == Tangent::slides);
  return result;
}

namespace {

// Contacts connected by dependent rows: trees, each identified by its root.
class Ties {
 public:
  explicit Ties(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t(0)); }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void tie(std::size_t i, std::size_t j) { parent_[root(i)] = root(j); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<SharingGroup> sharing_groups(const std::vector<ContactPoint>& points, const std::vector<ContactRole>& roles,
                                         const CarryingRows& carrying) {
  const auto& [basis, implied, K] = carrying.rows;
  const std::vector<std::size_t> contact_of = contacts_of_rows(points);
  Ties ties(points.size());
  for (std::size_t i = 0; i < implied.size(); ++i)
    for (std::size_t j = 0; j < basis.size(); ++j)
      if (K(Index(i), Index(j)) != 0) ties.tie(contact_of[std::size_t(implied[i])], contact_of[std::size_t(basis[j])]);
  std::vector<SharingGroup> groups;
  for (std::size_t root = 0; root < points.size(); ++root) {
    SharingGroup group;
    std::vector<Index> of_basis, of_implied, of_both;
    for (std::size_t j = 0; j < basis.size(); ++j)
      if (ties.root(contact_of[std::size_t(basis[j])]) == root)
        of_basis.push_back(Index(j)), group.basis.push_back(basis[j]);
    for (std::size_t i = 0; i < implied.size(); ++i)
      if (ties.root(contact_of[std::size_t(implied[i])]) == root)
        of_implied.push_back(Index(i)), group.implied.push_back(implied[i]);
    if (of_implied.empty()) continue;
    of_both = of_basis;
    for (const Index i : of_implied) of_both.push_back(Index(basis.size()) + i);
    group.K = K(of_implied, of_basis);
    group.share = carrying.share(of_both, of_basis);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (ties.root(i) == root && carrying.indeterminate[i] && points[i].normal >= 0 &&
          roles[i].tangent == Tangent::slides)
        group.sliding.push_back(i);
    groups.push_back(std::move(group));
  }
  return groups;
}

std::optional<SharingGroup> group_with_idle(const Mat& A, const std::vector<Index>& rows,
                                            const std::vector<Index>& idle) {
  const auto has_no_share = [&](Index row) { return std::find(idle.begin(), idle.end(), row) != idle.end(); };
  std::vector<Index> carrying;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(carrying), [&](Index row) { return !has_no_share(row); });
  RowBasis best = find_basis(A, rows);
  if (find_basis(A, carrying).basis.size() != best.basis.size()) return {};
  std::vector<bool> is_idle;
  for (const auto* part : {&best.basis, &best.implied})
    for (const Index row : *part) is_idle.push_back(has_no_share(row));
  SharingGroup group;
  group.share = least_norm_shares(best.resultants(), is_idle);
  group.basis = std::move(best.basis), group.implied = std::move(best.implied), group.K = std::move(best.K);
  return group;
}

}  // namespace trammel::complementarity
