#include "complementarity/shares/springs_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "complementarity/shares/pressing_forces.hpp"
#include "complementarity/shares/spare_load.hpp"
#include "complementarity/shares/spring_equations.hpp"

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
// Of the resultants: contacts too few to carry them carry those of a single instant. Then their equations miss as
// little at the instant found for it, but more than this.
constexpr double round_off_of_equations = 1e-11;
constexpr double no_part_in_self_stress = 1e-12;
// Of the largest force: sets that can spare as much are as good as any, those that lack as much have no forces.
constexpr double much_to_spare = 0.25, least_spare = -1e6;
// Of the resultants: at the instant found for the end of a set, its forces exist up to this. If more is missing, the
// loads have jumped.
constexpr double error_at_end = 1e-6;

std::vector<Index> normals_of(const std::vector<SharingContact>& contacts) {
  std::vector<Index> normals;
  for (const SharingContact& c : contacts)
    if (c.normal >= 0) normals.push_back(c.normal);
  return normals;
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

SpringSet that_press(const std::vector<SharingContact>& contacts, const Vec& F) {
  const double least = no_force_of_springs * largest(contacts, F);
  SpringSet press;
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
  SpringSet set;
  double spare = -std::numeric_limits<double>::infinity();
  SpringEquations equations;
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
      const SpringSet press = that_press(contacts_, with_normals_of_springs(contacts_, push_, F));
      if (seen(press)) break;
      if (std::none_of(press.begin(), press.end(), [](Spring spring) { return spring == Spring::presses; })) {
        if (round == 0) best_ = {press, -lambda_.norm(), {}, Vec::Zero(E_.cols()), true};  // nothing carries
        break;
      }
      F = judge(press);
    }
    return best_;
  }

  // The set that held before, where it still does; otherwise the best of those that are reached from it. Nothing if it
  // misses so much that its loads have jumped.
  Found among_reached(const SpringSet& before, double round_off) {
    best_ = of_set(before);
    if (best_.spare >= -round_off) return std::move(best_);
    if (!(best_.spare >= -error_at_end * size_)) return {};
    const std::vector<std::size_t> parting = that_may_part();
    std::vector<SpringSet> reached = {before};
    for (std::size_t k = 0; k < reached.size() && reached.size() < most_sets; ++k)
      for (const std::size_t i : parting) {
        SpringSet next = reached[k], limit = reached[k];
        next[i] = next[i] == Spring::parts ? Spring::presses : Spring::parts, limit[i] = Spring::touches;
        if (std::find(reached.begin(), reached.end(), next) != reached.end() || !nearly_has_forces(limit)) continue;
        reached.push_back(next);
        keep_if_better(of_set(next));
      }
    return std::move(best_);
  }

  // Also its slacks are spared: how far the set is from its end.
  Found of_set(const SpringSet& set) {
    size_ = lambda_.norm();
    Found found;
    found.set = set;
    found.equations = spring_equations(set, contacts_, E_, Z_, lambda_);
    SpringEquations& p = found.equations;
    p.unload_slacks();
    Vec own;
    found.spare = std::min(much_to_spare * size_, spare_load(p.contacts, p.E, p.lambda, &own));
    if (!(p.missed <= round_off_of_equations)) found.spare = std::min(found.spare, -p.missed * size_);
    found.F = p.forces_of_all(own, E_.cols());
    return found;
  }

  // If these hold nothing, all sets; of many contacts one that is found by decisions one after the other. If springs
  // press in none of them, those that differ from the first in one contact.
  Found among_all(Vec F) {
    among_followers(std::move(F));
    if (best_.spare >= -not_carried * size_) return std::move(best_);
    const std::vector<std::size_t> parting = that_may_part();
    if (count_sets(parting.size()) <= most_sets)
      judge_all(SpringSet(contacts_.size(), Spring::presses), parting, 0, Z_.cols());
    else
      judge_some(parting);
    if (best_.F.size() == 0) judge_neighbours();
    return std::move(best_);
  }

 private:
  bool seen(const SpringSet& press) const { return std::find(seen_.begin(), seen_.end(), press) != seen_.end(); }

  // At the instant found for the end of another set.
  bool nearly_has_forces(const SpringSet& set) const {
    const SpringEquations p = spring_equations(set, contacts_, E_, Z_, lambda_);
    Vec own;
    return p.missed <= error_at_end &&
           admissible_forces(p.contacts, p.E, p.lambda, own) <= error_at_end * p.lambda.norm();
  }

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
  void judge_all(SpringSet press, const std::vector<std::size_t>& parting, std::size_t first, Index more) {
    if (!seen(press)) judge_those_of(press);
    if (more == 0) return;
    for (std::size_t k = first; k < parting.size(); ++k) {
      press[parting[k]] = Spring::parts;
      judge_all(press, parting, k + 1, more - 1);
      press[parting[k]] = Spring::presses;
    }
  }

  // Of contacts that may press some have no force: without these more can be spared.
  void judge_those_of(const SpringSet& may_press) {
    const Found found = judged(may_press, -not_carried * size_);
    if (!(found.spare >= -not_carried * size_)) return;
    keep_if_better(found);
    const SpringSet press = that_press(contacts_, found.F);
    if (!seen(press)) judge(press);
  }

  void judge_some(const std::vector<std::size_t>& parting) {
    SpringSet set(contacts_.size(), Spring::presses);
    for (const std::size_t i : parting) set[i] = Spring::undecided;
    int left = most_decisions;
    (void)decide_one_by_one(set, left);
  }

  // In the least forces of contacts that may do either, the one whose force and slack are both the largest is to do
  // what the larger one says, until there is none; where this leads to no forces, the contrary. True if a set holds.
  bool decide_one_by_one(SpringSet set, int& left) {
    if (left-- <= 0) return false;
    const SpringEquations p = spring_equations(set, contacts_, E_, Z_, lambda_);
    Vec own;
    const double missed = admissible_forces(p.contacts, p.E, p.lambda, own);
    if (!(p.missed <= not_carried) || !(missed <= not_carried * p.lambda.norm())) return false;
    const Vec F = p.forces_of_all(own, E_.cols());
    std::size_t worst = 0;
    double most = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double both = set[i] == Spring::undecided ? std::min(F[contacts_[i].normal], own[p.slack_of[i]]) : 0;
      if (both > most) worst = i, most = both;
    }
    if (most <= no_force_of_springs * size_) {
      const SpringSet press = that_press(contacts_, F);
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
    const std::vector<SpringSet> sets = seen_;
    for (const SpringSet& set : sets)
      for (std::size_t i = 0; i < set.size(); ++i) {
        SpringSet other = set;
        other[i] = other[i] == Spring::parts ? Spring::presses : Spring::parts;
        if (!seen(other)) keep_if_better(judged(other, std::max(best_.spare, least_spare * size_)));
      }
  }

  Vec judge(const SpringSet& press) {
    Found found = judged(press);
    keep_if_better(found);
    return found.F;
  }

  void keep_if_better(const Found& found) {
    if (found.consistent && (best_.F.size() == 0 || found.better_than(best_))) best_ = found;
  }

  // With the least forces of the set, or those that leave their cones least: forces that spare most may be of any size
  // (a strut that locks). A set that spares less than `wanted` is not consistent.
  Found judged(const SpringSet& press, double wanted = -std::numeric_limits<double>::infinity()) {
    seen_.push_back(press);
    Found found;
    found.consistent = false;
    found.set = press;
    found.equations = spring_equations(press, contacts_, E_, Z_, lambda_);
    const SpringEquations& p = found.equations;
    if (!(p.missed <= not_carried) && !std::isinf(wanted)) return found;
    Vec own;
    found.spare = std::min(much_to_spare * size_, spare_load(p.contacts, p.E, p.lambda, &own, wanted));
    if (found.spare < wanted) return found;
    found.consistent = springs_press_so(p, found.spare, own) && p.missed <= not_carried;
    found.F = p.forces_of_all(own, E_.cols());
    return found;
  }

  // Fills in the least ones.
  static bool have_forces(const SpringEquations& p, Vec& own) {
    return admissible_forces(p.contacts, p.E, p.lambda, own) <= not_carried * p.lambda.norm();
  }

  // Forces of the set exist, with slacks that are not negative: inside the cones, which the least ones show, or beyond
  // them by no more than the spare load lacks.
  static bool springs_press_so(const SpringEquations& p, double spare, Vec& own) {
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
  std::vector<SpringSet> seen_;
  Found best_;
};

SpringSet set_of(const std::vector<SharingContact>& contacts) {
  SpringSet set;
  for (const SharingContact& c : contacts) set.push_back(c.spring);
  return set;
}

bool contains(const SpringSet& set, Spring spring) {
  return std::find(set.begin(), set.end(), spring) != set.end();
}

SpringsThatHold not_wedged_in(const SpringSet& set) {
  return {set, std::vector<std::optional<double>>(set.size())};
}

// In the least forces of the set: where contacts rest without having been wedged in. Beside contacts that slide nothing
// is known.
std::vector<std::optional<double>> push_of(const SpringEquations& p, const std::vector<SharingContact>& contacts,
                                           Index columns) {
  std::vector<std::optional<double>> push(contacts.size());
  const auto slides = [](const SharingContact& c) { return !c.carries; };
  if (std::any_of(contacts.begin(), contacts.end(), slides)) return push;
  Vec own;
  admissible_forces(p.contacts, p.E, p.lambda, own);
  const Vec F = p.forces_of_all(own, columns);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i].normal >= 0) push[i] = p.slack_of[i] >= 0 ? -own[p.slack_of[i]] : F[contacts[i].normal];
  return push;
}

// A force along this column that may be of any size.
void add_force_of_either_sign(Index column, std::vector<SharingContact>& forces, Mat& E) {
  forces.emplace_back().normal = column;
  forces.emplace_back().normal = E.cols();
  E.conservativeResize(Eigen::NoChange, E.cols() + 1);
  E.rightCols(1) = -E.col(column);
}

// Whether no other springs press than those of the set.
bool press_only(const SpringSet& set, const SpringSet& press) {
  for (std::size_t i = 0; i < set.size(); ++i)
    if (press[i] == Spring::presses && set[i] != Spring::presses) return false;
  return true;
}

// All sets count, unless nothing holds.
Found best_of_all(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push, const Vec& lambda,
                  Vec& begin) {
  const bool may_hold = spare_load(contacts, E, lambda, &begin) >= 0;
  if (may_hold) admissible_forces(contacts, E, lambda, begin);
  Search search(contacts, E, push, lambda);
  return may_hold ? search.among_all(begin) : search.among_followers(begin);
}

}  // namespace

bool can_be_wedged_in(const std::vector<SharingContact>& contacts, const Mat& E) {
  std::vector<SharingContact> free;
  Mat balanced = Mat::Zero(E.rows() + 1, E.cols());
  balanced.topRows(E.rows()) = E;
  for (const SharingContact& c : contacts) {
    if (c.normal < 0) {
      for (const Index k : c.tangents) add_force_of_either_sign(k, free, balanced);
      continue;
    }
    free.push_back(c);
    balanced(E.rows(), c.normal) = 1;
  }
  if (free.empty()) return false;
  const Vec of_size_1 = Vec::Unit(E.rows() + 1, E.rows());
  Vec F;
  return admissible_forces(free, balanced, of_size_1, F) <= not_carried;
}

bool forces_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, double carried,
                       Vec& F) {
  const SpringSet set = set_of(contacts);
  const bool decided = !contains(set, Spring::undecided);
  if (contains(set, Spring::locked)) return false;
  admissible_forces(contacts, E, lambda, F);
  if (!carries(E, F, lambda, carried)) return false;
  const Mat push = E(Eigen::all, normals_of(contacts));
  if (!may_lock(contacts, push)) return true;
  const Vec springs = with_normals_of_springs(contacts, push, F);
  if (in_cones(contacts, springs) && (!decided || press_only(set, that_press(contacts, springs)))) {
    F = springs;
    return true;
  }
  SpringEquations p;
  if (decided) {
    p = spring_equations(set, contacts, E, self_stress(push), lambda);
    const double none = -carried * lambda.norm();  // beyond its end: cheaper to see than that there are no forces
    if (spare_load(p.contacts, p.E, p.lambda, nullptr, none) < none) return false;
  } else {
    Found found = Search(contacts, E, push, lambda).among_all(F);
    if (found.F.size() == 0 || !(found.spare >= -carried * largest(contacts, found.F))) return false;
    p = std::move(found.equations);
  }
  if (p.columns.empty()) return true;  // nothing is to be carried
  Vec own;
  admissible_forces(p.contacts, p.E, p.lambda, own);
  F = p.forces_of_all(own, E.cols());
  return carries(E, F, lambda, carried);
}

double spare_load_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec* F) {
  return spare_load_as_springs(contacts, E, E(Eigen::all, normals_of(contacts)), lambda, F);
}

double spare_load_as_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push,
                             const Vec& lambda, Vec* F) {
  const SpringSet set = set_of(contacts);
  if (contains(set, Spring::locked) || !may_lock(contacts, push)) return spare_load(contacts, E, lambda, F);
  Vec begin;
  const Found found = contains(set, Spring::undecided) ? best_of_all(contacts, E, push, lambda, begin)
                                                       : Search(contacts, E, push, lambda).of_set(set);
  const bool any = found.F.size() > 0;
  if (F) *F = any ? found.F : begin;
  return any ? found.spare : -lambda.norm();
}

std::optional<SpringsThatHold> find_springs(const std::vector<SharingContact>& contacts, const Mat& E, const Mat& push,
                                            const Vec& lambda, double round_off) {
  const SpringSet before = set_of(contacts), any(contacts.size(), Spring::undecided);
  if (!may_lock(contacts, push)) {
    if (spare_load(contacts, E, lambda) >= -round_off) return not_wedged_in(any);
    return std::nullopt;
  }
  Found found;
  if (!contains(before, Spring::undecided) && !contains(before, Spring::locked))
    found = Search(contacts, E, push, lambda).among_reached(before, round_off);
  const bool wedged_in = can_be_wedged_in(contacts, E);
  Vec begin;
  if (found.F.size() == 0 || (!(found.spare >= -round_off) && !wedged_in))
    found = best_of_all(contacts, E, push, lambda, begin);
  if (found.F.size() == 0 || !(found.spare >= -round_off)) return std::nullopt;
  if (!wedged_in) return not_wedged_in(found.set);
  return SpringsThatHold{found.set, push_of(found.equations, contacts, E.cols())};
}

}  // namespace trammel::complementarity
