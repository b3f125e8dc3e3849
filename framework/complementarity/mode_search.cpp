#include "complementarity/mode_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "complementarity/mode_relaxation.hpp"

namespace trammel::complementarity {
namespace {

using Eigen::Vector2d;
using Kind = DecidedMode::Kind;
using Verdict = RelaxedForces::Verdict;

constexpr double zero = 1e-9;                         // relative to b [1]
constexpr double narrowest = std::numbers::pi / 180;  // [rad]
// Forces within `zero` of a solution from which no solution follows: each costs as much as ten other sets of modes and
// proves nothing, and where there are some there are thousands.
constexpr int most_refused = 50;

Vector2d part(const Vec& x, const ContactPoint& p) {
  Vector2d both = Vector2d::Zero();
  both.head(p.tangents) = x.segment(p.tangent, p.tangents);
  return both;
}

class Search {
 public:
  Search(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, int most_nodes,
         const std::function<bool(const Vec&)>& accept)
      : points_(points), A_(A), b_(b), nodes_left_(most_nodes), accept_(accept), modes_(points.size()) {}

  LcpOutcome run() {
    if (visit()) return LcpOutcome::solved;
    return doubtful_ || nodes_left_ < 0 ? LcpOutcome::gave_up : LcpOutcome::no_solution;
  }

 private:
  struct Choice {
    DecidedMode mode;
    double off = 0;
  };

  double stiffness(int row) const { return A_(row, row); }

  // For each mode of the contact: how far the forces found are from it, as the sum of all terms that would be 0.
  std::vector<Choice> choices(std::size_t i, const RelaxedForces& found) const {
    const ContactPoint& p = points_[i];
    const double N = p.normal >= 0 ? found.F[p.normal] : p.given,
                 apart = p.normal >= 0 ? std::abs(found.a[p.normal]) : 0;
    std::vector<Choice> all;
    if (p.normal >= 0) all.push_back({{Kind::open}, stiffness(p.normal) * N});
    if (!p.held()) {
      all.push_back({{Kind::pressing}, apart});
    } else {
      const Vector2d T = part(found.F, p), a_t = part(found.a, p);
      all.push_back({{Kind::sticking}, apart + a_t.norm()});
      const auto add_slide = [&](double from, double to) {
        all.push_back({{Kind::sliding, from, to}, apart + slides_off(p, N, T, a_t, (from + to) / 2)});
      };
      constexpr double quarter = std::numbers::pi / 2;
      if (p.tangents == 1) add_slide(0, 0), add_slide(2 * quarter, 2 * quarter);
      for (int k = 0; k < 4 && p.tangents == 2; ++k) add_slide(k * quarter, (k + 1) * quarter);
    }
    std::stable_sort(all.begin(), all.end(), [](const Choice& a, const Choice& b) { return a.off < b.off; });
    return all;
  }

  double slides_off(const ContactPoint& p, double N, const Vector2d& T, const Vector2d& a_t, double angle) const {
    const Vector2d e(std::cos(angle), p.tangents == 2 ? std::sin(angle) : 0);
    return stiffness(p.tangent) * (T - p.coefficient * N * e).norm() + (a_t + a_t.norm() * e).norm();
  }

  // Distance of the forces from the contact's law; for an undecided contact, from the nearest mode.
  double off(std::size_t i, const RelaxedForces& found) const {
    const ContactPoint& p = points_[i];
    if (modes_[i].kind == Kind::undecided && !(p.held() && p.tangents == 2)) return choices(i, found).front().off;
    return violation({p}, A_, b_, found.F) * b_.lpNorm<Eigen::Infinity>();
  }

  bool can_be_split(std::size_t i) const {
    return modes_[i].kind == Kind::undecided ||
           (modes_[i].kind == Kind::sliding && modes_[i].to - modes_[i].from > narrowest);
  }

  std::vector<Choice> parts(std::size_t i, const RelaxedForces& found) const {
    const DecidedMode& mode = modes_[i];
    if (mode.kind == Kind::undecided) return choices(i, found);
    const double middle = (mode.from + mode.to) / 2;
    std::vector<Choice> halves{{{Kind::sliding, mode.from, middle}}, {{Kind::sliding, middle, mode.to}}};
    const Vector2d T = part(found.F, points_[i]);
    if (T[1] * std::cos(middle) > T[0] * std::sin(middle)) std::swap(halves[0], halves[1]);
    return halves;
  }

  bool visit() {
    if (--nodes_left_ < 0) return false;
    const RelaxedForces found = relaxed_forces(points_, A_, b_, modes_);
    doubtful_ = doubtful_ || found.verdict == Verdict::doubtful;
    if (found.verdict != Verdict::found) return false;
    std::size_t next = points_.size();
    const double nothing = zero * b_.lpNorm<Eigen::Infinity>();
    double worst = nothing;
    bool all_decided = true;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!can_be_split(i)) continue;
      const double amount = off(i, found);
      all_decided = all_decided && (modes_[i].kind != Kind::undecided || amount <= nothing);
      if (amount > worst) worst = amount, next = i;
    }
    if ((next == points_.size() || all_decided) && accept_(found.F)) return true;
    if (next == points_.size()) {
      doubtful_ = true;
      if (++refused_ == most_refused) nodes_left_ = 0;
      return false;
    }
    const DecidedMode before = modes_[next];
    for (const Choice& choice : parts(next, found)) {
      modes_[next] = choice.mode;
      if (visit()) return true;
    }
    modes_[next] = before;
    return false;
  }

  const std::vector<ContactPoint>& points_;
  const Mat& A_;
  const Vec& b_;
  int nodes_left_;
  const std::function<bool(const Vec&)>& accept_;
  std::vector<DecidedMode> modes_;
  bool doubtful_ = false;
  int refused_ = 0;
};

}  // namespace

LcpOutcome search_modes(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, int most_nodes,
                        const std::function<bool(const Vec&)>& accept) {
  return Search(points, A, b, most_nodes, accept).run();
}

}  // namespace trammel::complementarity
