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
// Sets of contacts that part: all are judged where there are no more, which 8 contacts do not exceed.
constexpr std::size_t most_sets = 255;
constexpr int most_decisions = 100;  // otherwise
// Of the largest force: a normal force up to this is none, and friction may exceed its bound by this.
constexpr double no_force_of_springs = 1e-10;
// Of that of the springs: the bodies' compliance. Each round leaves about this part of what was missed.
constexpr double part_of_compliance = 1e-3;
constexpr double round_off_of_resultants = 1e-14;
// Of the resultants: contacts that press are too few to carry them if they miss more. Of the forces: springs would
// press others if a slack is more negative.
constexpr double not_carried = 1e-9;
constexpr double no_part_in_self_stress = 1e-12;
// Of the largest row: what a row adds to those it follows from. It could be carried by forces without bounds only.
constexpr double round_off_of_rows = 1e-11;
// Of the largest force: sets that can spare as much are as good as any, those that lack as much have no forces.
constexpr double much_to_spare = 0.25, least_spare = -1e6;

// Whether the springs of a contact press. Of one that may do either, force and slack may both be positive.
enum class Spring { presses, parts, either };
using Set = std::vector<Spring>;

// The contacts that press and the columns of their forces; after these, the slacks of the others. Their equations.
struct Pressing {
  std::vector<SharingContact> contacts;
  std::vector<Index> columns;
  std::vector<Index> slack_of;  // by contact: the column of its slack, or -1
  Mat E;
  Vec lambda;
  bool carries = true;  // false: these equations have no solution, whatever the signs of the forces
};

Eigen::ColPivHouseholderQR<Mat> decomposed(const Mat& rows) {
  Eigen::ColPivHouseholderQR<Mat> qr(rows);
  qr.setThreshold(round_off_of_rows);
  return qr;
}

// Only independent rows are kept.
void make_independent(Pressing& p) {
  const Eigen::ColPivHouseholderQR<Mat> qr = decomposed(p.E);
  const Mat Q = first_columns_of_q(qr, qr.rank());
  const Vec all = p.lambda;
  p.E = Q.transpose() * p.E;
  p.lambda = Q.transpose() * p.lambda;
  p.carries = (all - Q * p.lambda).norm() <= not_carried * all.norm();
}

std::vector<Index> normals_of(const std::vector<SharingContact>& contacts) {
  std::vector<Index> normals;
  for (const SharingContact& c : contacts)
    if (c.normal >= 0) normals.push_back(c.normal);
  return normals;
}

// Columns: the normal forces that are in balance with each other.
Mat self_stress(const Mat& E_n) {
  const Eigen::ColPivHouseholderQR<Mat> qr = decomposed(E_n.transpose());
  return last_columns_of_q(qr, E_n.cols() - qr.rank());
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
Vec with_normals_of_springs(const std::vector<SharingContact>& contacts, const Mat& push, const Vec& F) {
  const std::vector<Index> normals = normals_of(contacts);
  const Vec resultants = push * F(normals).cwiseMax(0);
  Vec springs = F;
  springs(normals) = pressing_springs(push, resultants);
  return springs;
}

double largest(const std::vector<SharingContact>& contacts, const Vec& F) {
  double most = F.lpNorm<Eigen::Infinity>();
  for (const SharingContact& c : contacts)
    if (c.normal < 0) most = std::max(most, c.given);
  return most;
}

Set that_press(const std::vector<SharingContact>& contacts, const Vec& F) {
  const double least = no_force_of_springs * largest(contacts, F);
  Set press;
  for (const SharingContact& c : contacts)
    press.push_back((c.normal >= 0 ? F[c.normal] : c.given) > least ? Spring::presses : Spring::parts);
  return press;
}

double friction(const SharingContact& c, const Vec& F) {
  double T = 0;
  for (const Index k : c.tangents) T = std::hypot(T, F[k]);
  return T;
}

bool in_cones(const std::vector<SharingContact>& contacts, const Vec& F) {
  const double least = no_force_of_springs * largest(contacts, F);
  return std::all_of(contacts.begin(), contacts.end(), [&](const SharingContact& c) {
    const double N = c.normal >= 0 ? F[c.normal] : c.given;
    return N >= -least && friction(c, F) <= c.coefficient * N + least;
  });
}

// Z: self-stress of all.
Pressing only(const Set& press, const std::vector<SharingContact>& contacts, const Mat& E, const Mat& Z,
              const Vec& lambda) {
  Pressing p;
  std::vector<Index> force_of(contacts.size(), -1), slack_of(contacts.size(), -1);  // columns
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (press[i] == Spring::parts) continue;
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
    if (press[i] == Spring::presses || contacts[i].normal < 0) continue;
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

Vec with_idle(const Pressing& p, const Vec& own, Index columns) {
  Vec F = Vec::Zero(columns);
  F(p.columns) = own.head(Index(p.columns.size()));
  return F;
}

bool carries(const Mat& E, const Vec& F, const Vec& lambda, double carried) {
  return (E * F - lambda).norm() <= carried * lambda.norm();
}

// Contacts that press against each other hold others by their friction only.
bool may_lock(const std::vector<SharingContact>& contacts, const Mat& push) {
  const auto rubs = [](const SharingContact& c) { return c.coefficient > 0 && !c.tangents.empty(); };
  if (std::none_of(contacts.begin(), contacts.end(), rubs)) return false;
  return push.cols() > 1 && self_stress(push).cols() > 0;
}

// The spare load of forces as springs, up to what is much; the contacts that press with it, and forces that have it.
struct Found {
  double spare = -std::numeric_limits<double>::infinity();
  Pressing pressing;
  Vec F;
  bool consistent = true;  // springs could press so
  bool better_than(const Found& other) const {
    return spare > other.spare || (spare == other.spare && F.norm() < other.F.norm());
  }
};

// Of sets of contacts that press, the one that can spare most.
class Search {
 public:
  Search(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push, const Vec& lambda)
      : contacts_(contacts), E_(E), push_(push), lambda_(lambda), Z_(self_stress(push)) {}

  // The sets that follow from F, and from each other's forces, until one comes up again.
  Found among_followers(Vec F) {
    size_ = largest(contacts_, F);
    for (int round = 0; round < most_rounds; ++round) {
      const Set press = that_press(contacts_, with_normals_of_springs(contacts_, push_, F));
      if (seen(press)) break;
      if (std::none_of(press.begin(), press.end(), [](Spring spring) { return spring == Spring::presses; })) {
        if (round == 0) best_ = {-lambda_.norm(), {}, Vec::Zero(E_.cols()), true};  // nothing carries
        break;
      }
      F = judge(press);
    }
    return best_;
  }

  // If these hold nothing, all sets; of many contacts one that is found by decisions one after the other. If springs
  // press in none of them, those that differ from the first in one contact.
  Found among_all(Vec F) {
    among_followers(std::move(F));
    if (best_.spare >= -not_carried * size_) return std::move(best_);
    const std::vector<std::size_t> parting = that_may_part();
    if (count_sets(parting.size()) <= most_sets)
      judge_all(Set(contacts_.size(), Spring::presses), parting, 0, Z_.cols());
    else
      judge_some(parting);
    if (best_.F.size() == 0) judge_neighbours();
    return std::move(best_);
  }

 private:
  bool seen(const Set& press) const { return std::find(seen_.begin(), seen_.end(), press) != seen_.end(); }

  // Those with a part in a self-stress.
  std::vector<std::size_t> that_may_part() const {
    std::vector<std::size_t> all;
    Index row = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (contacts_[i].normal >= 0 && Z_.row(row++).norm() > no_part_in_self_stress) all.push_back(i);
    return all;
  }

  std::size_t count_sets(std::size_t contacts) const {
    std::size_t sets = 1, of_size = 1;
    for (std::size_t k = 0; k < std::min(contacts, std::size_t(Z_.cols())); ++k) {
      of_size = of_size * (contacts - k) / (k + 1);
      sets += of_size;
      if (sets > most_sets) break;
    }
    return sets;
  }

  // At most `more` of the contacts from parting[first] on part: slacks x >= 0 with given Z^T x exist only if they do
  // with no more of them than columns of Z (Caratheodory).
  void judge_all(Set press, const std::vector<std::size_t>& parting, std::size_t first, Index more) {
    if (!seen(press)) judge_those_of(press);
    if (more == 0) return;
    for (std::size_t k = first; k < parting.size(); ++k) {
      press[parting[k]] = Spring::parts;
      judge_all(press, parting, k + 1, more - 1);
      press[parting[k]] = Spring::presses;
    }
  }

  // Of contacts that may press some have no force: without these more can be spared.
  void judge_those_of(const Set& may_press) {
    const Found found = judged(may_press, -not_carried * size_);
    if (!(found.spare >= -not_carried * size_)) return;
    keep_if_better(found);
    const Set press = that_press(contacts_, found.F);
    if (!seen(press)) judge(press);
  }

  void judge_some(const std::vector<std::size_t>& parting) {
    Set set(contacts_.size(), Spring::presses);
    for (const std::size_t i : parting) set[i] = Spring::either;
    int left = most_decisions;
    (void)decide_one_by_one(set, left);
  }

  // In the least forces of contacts that may do either, the one whose force and slack are both the largest is to do
  // what the larger one says, until there is none; where this leads to no forces, the contrary. True if a set holds.
  bool decide_one_by_one(Set set, int& left) {
    if (left-- <= 0) return false;
    const Pressing p = only(set, contacts_, E_, Z_, lambda_);
    Vec own;
    const double missed = admissible_forces(p.contacts, p.E, p.lambda, own);
    if (!p.carries || !(missed <= not_carried * p.lambda.norm())) return false;
    const Vec F = with_idle(p, own, E_.cols());
    std::size_t worst = 0;
    double most = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double both = set[i] == Spring::either ? std::min(F[contacts_[i].normal], own[p.slack_of[i]]) : 0;
      if (both > most) worst = i, most = both;
    }
    if (most <= no_force_of_springs * size_) {
      const Set press = that_press(contacts_, F);
      if (!seen(press)) judge(press);
      return best_.spare >= -not_carried * size_;
    }
    const bool presses = F[contacts_[worst].normal] > own[p.slack_of[worst]];
    for (const Spring decided :
         {presses ? Spring::presses : Spring::parts, presses ? Spring::parts : Spring::presses}) {
      set[worst] = decided;
      if (decide_one_by_one(set, left)) return true;
    }
    return false;
  }

  void judge_neighbours() {
    const std::vector<Set> sets = seen_;
    for (const Set& set : sets)
      for (std::size_t i = 0; i < set.size(); ++i) {
        Set other = set;
        other[i] = other[i] == Spring::parts ? Spring::presses : Spring::parts;
        if (!seen(other)) keep_if_better(judged(other, std::max(best_.spare, least_spare * size_)));
      }
  }

  Vec judge(const Set& press) {
    Found found = judged(press);
    keep_if_better(found);
    return found.F;
  }

  void keep_if_better(const Found& found) {
    if (found.consistent && (best_.F.size() == 0 || found.better_than(best_))) best_ = found;
  }

  // With the least forces of the set, or those that leave their cones least: forces that spare most may be of any size
  // (a strut that locks). A set that spares less than `wanted` is not consistent.
  Found judged(const Set& press, double wanted = -std::numeric_limits<double>::infinity()) {
    seen_.push_back(press);
    Found found;
    found.consistent = false;
    found.pressing = only(press, contacts_, E_, Z_, lambda_);
    const Pressing& p = found.pressing;
    if (!p.carries && !std::isinf(wanted)) return found;
    Vec own;
    found.spare = std::min(much_to_spare * size_, spare_load(p.contacts, p.E, p.lambda, &own, wanted));
    if (found.spare < wanted) return found;
    found.consistent = springs_press_so(p, found.spare, own) && p.carries;
    found.F = with_idle(p, own, E_.cols());
    return found;
  }

  // Fills in the least ones.
  static bool have_forces(const Pressing& p, Vec& own) {
    return admissible_forces(p.contacts, p.E, p.lambda, own) <= not_carried * p.lambda.norm();
  }

  // Forces of the set exist, with slacks that are not negative: inside the cones, which the least ones show, or beyond
  // them by no more than the spare load lacks.
  static bool springs_press_so(const Pressing& p, double spare, Vec& own) {
    if (spare >= 0) return have_forces(p, own);
    const double error = not_carried * own.lpNorm<Eigen::Infinity>();
    if (!((p.E * own - p.lambda).norm() <= not_carried * p.lambda.norm())) return false;
    return std::all_of(p.contacts.begin(), p.contacts.end(), [&](const SharingContact& c) {
      const double N = (c.normal >= 0 ? own[c.normal] : c.given) - (c.carries ? spare : 0);
      return N >= -error && friction(c, own) <= c.coefficient * N + error;
    });
  }

  const std::vector<SharingContact>& contacts_;
  const Mat &E_, &push_;
  const Vec& lambda_;
  Mat Z_;
  double size_ = 0;  // of the forces
  std::vector<Set> seen_;
  Found best_;
};

}  // namespace

bool forces_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, double carried,
                       Vec& F) {
  admissible_forces(contacts, E, lambda, F);
  if (!carries(E, F, lambda, carried)) return false;
  const Mat push = E(Eigen::all, normals_of(contacts));
  if (!may_lock(contacts, push)) return true;
  const Vec springs = with_normals_of_springs(contacts, push, F);
  if (in_cones(contacts, springs)) {
    F = springs;
    return true;
  }
  const Found found = Search(contacts, E, push, lambda).among_all(F);
  if (found.F.size() == 0) return false;
  if (!(found.spare >= -carried * largest(contacts, found.F))) return false;
  if (found.pressing.columns.empty()) return true;  // nothing is to be carried
  Vec own;
  admissible_forces(found.pressing.contacts, found.pressing.E, found.pressing.lambda, own);
  F = with_idle(found.pressing, own, E.cols());
  return carries(E, F, lambda, carried);
}

double spare_load_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec* F) {
  return spare_load_as_springs(contacts, E, E(Eigen::all, normals_of(contacts)), lambda, F);
}

double spare_load_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push,
                             const Vec& lambda, Vec* F) {
  if (!may_lock(contacts, push)) return spare_load(contacts, E, lambda, F);
  Vec begin;
  const bool may_hold = spare_load(contacts, E, lambda, &begin) >= 0;
  if (may_hold) admissible_forces(contacts, E, lambda, begin);
  Search search(contacts, E, push, lambda);
  const Found found = may_hold ? search.among_all(begin) : search.among_followers(begin);
  const bool any = found.F.size() > 0;
  if (F) *F = any ? found.F : begin;
  return any ? found.spare : -lambda.norm();
}

}  // namespace trammel::complementarity
