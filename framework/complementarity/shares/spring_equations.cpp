#include "complementarity/shares/spring_equations.hpp"

#include <utility>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

using Eigen::Index;

// Of the largest row: what a row adds to those it follows from. It could be carried by forces without bounds only.
constexpr double round_off_of_rows = 1e-11;

Eigen::ColPivHouseholderQR<Mat> decomposed(const Mat& rows) {
  Eigen::ColPivHouseholderQR<Mat> qr(rows);
  qr.setThreshold(round_off_of_rows);
  return qr;
}

// Only independent rows are kept.
void make_independent(SpringEquations& p) {
  const Eigen::ColPivHouseholderQR<Mat> qr = decomposed(p.E);
  const Mat Q = first_columns_of_q(qr, qr.rank());
  const Vec all = p.lambda;
  p.E = Q.transpose() * p.E;
  p.lambda = Q.transpose() * p.lambda;
  p.missed = all.isZero(0) ? 0 : (all - Q * p.lambda).norm() / all.norm();
}

}  // namespace

Mat self_stress(const Mat& E_n) {
  const Eigen::ColPivHouseholderQR<Mat> qr = decomposed(E_n.transpose());
  return last_columns_of_q(qr, E_n.cols() - qr.rank());
}

SpringEquations spring_equations(const SpringSet& set, const std::vector<SharingContact>& contacts, const Mat& E,
                                 const Mat& Z, const Vec& lambda) {
  SpringEquations p;
  std::vector<Index> force_of(contacts.size(), -1), slack_of(contacts.size(), -1);  // columns
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (set[i] == Spring::parts || set[i] == Spring::touches) continue;
    SharingContact own = contacts[i];
    const auto take = [&p](Index& column) {
      p.columns.push_back(column);
      column = Index(p.columns.size()) - 1;
    };
    if (own.normal >= 0) take(own.normal), force_of[i] = own.normal;
    for (Index& k : own.tangents) take(k);
    p.contacts.push_back(std::move(own));
  }
  Index columns = Index(p.columns.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (set[i] == Spring::presses || set[i] == Spring::touches || contacts[i].normal < 0) continue;
    SharingContact& slack = p.contacts.emplace_back();
    slack.normal = slack_of[i] = columns++, slack.carries = false;
  }
  p.E = Mat::Zero(E.rows() + Z.cols(), columns);
  p.E.topLeftCorner(E.rows(), Index(p.columns.size())) = E(Eigen::all, p.columns);
  Index row = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].normal < 0) continue;
    if (force_of[i] >= 0) p.E.col(force_of[i]).tail(Z.cols()) = Z.row(row).transpose();
    if (slack_of[i] >= 0) p.E.col(slack_of[i]).tail(Z.cols()) = -Z.row(row).transpose();
    ++row;
  }
  p.lambda = Vec::Zero(p.E.rows());
  p.lambda.head(lambda.size()) = lambda;
  p.slack_of = slack_of;
  make_independent(p);
  return p;
}

Vec SpringEquations::forces_of_all(const Vec& own, Index count) const {
  Vec F = Vec::Zero(count);
  F(columns) = own.head(Index(columns.size()));
  return F;
}

void SpringEquations::unload_slacks() {
  for (SharingContact& c : contacts)
    if (c.normal >= Index(columns.size())) c.carries = true;
}

}  // namespace trammel::complementarity
