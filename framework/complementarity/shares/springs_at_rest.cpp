#include "complementarity/shares/springs_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trammel/decompositions.hpp>

#include "complementarity/shares/pressing_forces.hpp"
#include "complementarity/shares/spare_load.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Index;

constexpr int most_rounds = 10;
// Of the largest force: a normal force up to this is none, and friction may exceed its bound by this.
constexpr double no_force_of_springs = 1e-10;
// Of that of the springs: the bodies' compliance. Each round leaves about this part of what was missed.
constexpr double part_of_compliance = 1e-3;
constexpr double round_off_of_resultants = 1e-14;

// The contacts that press, the columns of their forces, and the equations of these.
struct Pressing {
  std::vector<SharingContact> contacts;
  std::vector<Index> columns;
  Mat E;
  Vec lambda;
};

// Only independent rows are kept.
void make_independent(Mat& E, Vec& lambda) {
  const Eigen::ColPivHouseholderQR<Mat> qr(E);
  const Mat Q = first_columns_of_q(qr, qr.rank());
  E = Q.transpose() * E;
  lambda = Q.transpose() * lambda;
}

std::vector<Index> normals_of(const std::vector<SharingContact>& contacts) {
  std::vector<Index> normals;
  for (const SharingContact& c : contacts)
    if (c.normal >= 0) normals.push_back(c.normal);
  return normals;
}

// Columns: the normal forces that are in balance with each other.
Mat self_stress(const Mat& E_n) {
  const Mat transposed = E_n.transpose();
  const Eigen::ColPivHouseholderQR<Mat> qr(transposed);
  return last_columns_of_q(qr, transposed.rows() - qr.rank());
}

// Springs between bodies that yield a little, N = max(0, E_n^T y) with E_n N = r - compliance y, found by pivoting;
// r is raised until they carry the resultants (method of multipliers).
Vec pressing_springs(const Mat& E_n, const Vec& resultants) {
  const double compliance = part_of_compliance * E_n.squaredNorm() / double(std::max<Index>(1, E_n.cols()));
  const Mat A = E_n.transpose() * E_n + compliance * Mat::Identity(E_n.cols(), E_n.cols());
  Vec N = Vec::Zero(E_n.cols()), r = resultants;
  for (int round = 0; round < most_rounds; ++round) {
    const Vec b = -E_n.transpose() * r;
    if (pressing_forces(A, b, N) != LcpOutcome::solved) break;
    const Vec missed = resultants - E_n * N;
    if (missed.norm() <= round_off_of_resultants * resultants.norm()) break;
    r += missed;
  }
  return N;
}

// F with the normal forces that springs have beside its friction.
Vec with_normals_of_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& F) {
  const std::vector<Index> normals = normals_of(contacts);
  const Mat E_n = E(Eigen::all, normals);
  const Vec resultants = E_n * F(normals).cwiseMax(0);
  Vec springs = F;
  springs(normals) = pressing_springs(E_n, resultants);
  return springs;
}

double largest(const std::vector<SharingContact>& contacts, const Vec& F) {
  double most = F.lpNorm<Eigen::Infinity>();
  for (const SharingContact& c : contacts)
    if (c.normal < 0) most = std::max(most, c.given);
  return most;
}

std::vector<bool> that_press(const std::vector<SharingContact>& contacts, const Vec& F) {
  const double least = no_force_of_springs * largest(contacts, F);
  std::vector<bool> press;
  for (const SharingContact& c : contacts) press.push_back((c.normal >= 0 ? F[c.normal] : c.given) > least);
  return press;
}

bool in_cones(const std::vector<SharingContact>& contacts, const Vec& F) {
  const double least = no_force_of_springs * largest(contacts, F);
  return std::all_of(contacts.begin(), contacts.end(), [&](const SharingContact& c) {
    double T = 0;
    for (const Index k : c.tangents) T = std::hypot(T, F[k]);
    const double N = c.normal >= 0 ? F[c.normal] : c.given;
    return N >= -least && T <= c.coefficient * N + least;
  });
}

Pressing only(const std::vector<bool>& press, const std::vector<SharingContact>& contacts, const Mat& E,
              const Vec& lambda) {
  Pressing p;
  std::vector<Index> normals;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!press[i]) continue;
    SharingContact own = contacts[i];
    const auto take = [&p](Index& column) {
      p.columns.push_back(column);
      column = Index(p.columns.size()) - 1;
    };
    if (own.normal >= 0) take(own.normal), normals.push_back(own.normal);
    for (Index& k : own.tangents) take(k);
    p.contacts.push_back(std::move(own));
  }
  const Mat carry = E(Eigen::all, p.columns), E_n = carry(Eigen::all, normals), Z = self_stress(E_n);
  p.E = Mat::Zero(carry.rows() + Z.cols(), carry.cols());
  p.E.topRows(carry.rows()) = carry;
  for (std::size_t i = 0; i < normals.size(); ++i) p.E.col(normals[i]).tail(Z.cols()) = Z.row(Index(i)).transpose();
  p.lambda = Vec::Zero(p.E.rows());
  p.lambda.head(lambda.size()) = lambda;
  make_independent(p.E, p.lambda);
  return p;
}

Vec among_all(const Pressing& p, const Vec& own, Index columns) {
  Vec F = Vec::Zero(columns);
  F(p.columns) = own;
  return F;
}

bool carries(const Mat& E, const Vec& F, const Vec& lambda, double carried) {
  return (E * F - lambda).norm() <= carried * lambda.norm();
}

bool have_self_stress(const std::vector<SharingContact>& contacts, const Mat& E) {
  const Mat E_n = E(Eigen::all, normals_of(contacts));
  return E_n.cols() > 1 && self_stress(E_n).cols() > 0;
}

// The spare load of forces as springs, the contacts that press with it, and forces that have it.
struct Found {
  double spare = -std::numeric_limits<double>::infinity();
  Pressing pressing;
  Vec F;
};

// Begins with forces F. Of the sets of contacts that come up until one comes up again, the one that can spare most.
Found search(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec F) {
  Found best;
  std::vector<std::vector<bool>> seen;
  for (int round = 0; round < most_rounds; ++round) {
    seen.push_back(that_press(contacts, with_normals_of_springs(contacts, E, F)));
    if (std::count(seen.begin(), seen.end(), seen.back()) > 1) break;
    if (std::none_of(seen.back().begin(), seen.back().end(), [](bool presses) { return presses; })) {
      if (round == 0) best = {-lambda.norm(), {}, Vec::Zero(E.cols())};  // nothing carries
      break;
    }
    Pressing pressing = only(seen.back(), contacts, E, lambda);
    Vec own;
    const double spare = spare_load(pressing.contacts, pressing.E, pressing.lambda, &own);
    F = among_all(pressing, own, E.cols());
    if (spare > best.spare) best = {spare, std::move(pressing), F};
  }
  return best;
}

}  // namespace

bool forces_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, double carried,
                       Vec& F) {
  admissible_forces(contacts, E, lambda, F);
  if (!carries(E, F, lambda, carried)) return false;
  if (!have_self_stress(contacts, E)) return true;
  const Vec springs = with_normals_of_springs(contacts, E, F);
  if (in_cones(contacts, springs)) {
    F = springs;
    return true;
  }
  const Found found = search(contacts, E, lambda, F);
  if (!(found.spare >= -carried * largest(contacts, found.F))) return false;
  if (found.pressing.columns.empty()) return true;  // nothing is to be carried
  Vec own;
  admissible_forces(found.pressing.contacts, found.pressing.E, found.pressing.lambda, own);
  F = among_all(found.pressing, own, E.cols());
  return carries(E, F, lambda, carried);
}

double spare_load_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec* F) {
  if (!have_self_stress(contacts, E)) return spare_load(contacts, E, lambda, F);
  Vec begin;
  if (const double most = spare_load(contacts, E, lambda, &begin); most < 0) {
    if (F) *F = begin;
    return most;
  }
  const Found found = search(contacts, E, lambda, std::move(begin));
  if (F) *F = found.F;
  return found.spare;
}

}  // namespace trammel::complementarity
