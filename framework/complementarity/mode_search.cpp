#include "complementarity/mode_search.hpp"

#include <algorithm>
#include <cmath>

#include "complementarity/nonnegative_least_squares.hpp"
#include "complementarity/polyhedral_cone.hpp"

namespace trammel::complementarity {
namespace {

// What equations must miss to count as contradictory, and what counts as 0, of the size of b [1].
constexpr double contradictory = 1e-8, zero = 1e-9;

// [M, -1] (z, w) = -q
class Search {
 public:
  Search(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, int most_nodes,
         const std::function<bool(const Vec&)>& accept)
      : points_(points), cone_(points, A, b, 0), nodes_left_(most_nodes), accept_(accept) {
    const Mat& M = cone_.M();
    const Eigen::Index n = M.rows();
    B_.resize(n, 2 * n);
    B_ << M, -Mat::Identity(n, n);
    d_ = -cone_.q();
    usable_.assign(std::size_t(2 * n), true);
    chosen_.assign(points.size(), false);
  }

  LcpOutcome run() {
    if (visit()) return LcpOutcome::solved;
    return doubtful_ || nodes_left_ <= 0 ? LcpOutcome::gave_up : LcpOutcome::no_solution;
  }

 private:
  using Place = PolyhedralCone::Place;
  enum class Mode { open, press, stick, slide };
  struct Choice {
    Mode mode;
    int beta = 0;  // of a slide: the one that is not 0
    double off = 0;
  };

  double z(int i) const { return x_[i]; }
  double w(int i) const { return x_[B_.rows() + i]; }

  // How far what was found for the contact is from each of its modes: the sum of all that would be 0.
  std::vector<Choice> choices(const Place& p) const {
    std::vector<Choice> all;
    double betas = 0;
    for (int k = 0; k < p.betas; ++k) betas += z(p.first_beta + k);
    if (p.normal >= 0) all.push_back({Mode::open, 0, z(p.normal) + betas});
    const double apart = p.normal >= 0 ? w(p.normal) : 0;
    if (p.lambda < 0) {
      all.push_back({Mode::press, 0, apart});
    } else {
      double moves = z(p.lambda);
      for (int k = 0; k < p.betas; ++k) moves += w(p.first_beta + k);
      all.push_back({Mode::stick, 0, apart + moves});
      for (int k = 0; k < p.betas; ++k)
        all.push_back({Mode::slide, k, apart + w(p.lambda) + w(p.first_beta + k) + betas - z(p.first_beta + k)});
    }
    std::stable_sort(all.begin(), all.end(), [](const Choice& a, const Choice& b) { return a.off < b.off; });
    return all;
  }

  // What the mode says is 0.
  std::vector<int> zeros(const Place& p, const Choice& choice) const {
    const int of_w = int(B_.rows());
    std::vector<int> all;
    if (choice.mode == Mode::open) {
      all.push_back(p.normal);
      for (int k = 0; k < p.betas; ++k) all.push_back(p.first_beta + k);
      return all;
    }
    if (p.normal >= 0) all.push_back(of_w + p.normal);
    if (choice.mode == Mode::stick) all.push_back(p.lambda);
    if (choice.mode == Mode::slide) all.push_back(of_w + p.lambda);
    for (int k = 0; k < p.betas; ++k) {
      const bool moves_so = choice.mode == Mode::slide && k != choice.beta;
      all.push_back((moves_so ? 0 : of_w) + p.first_beta + k);
    }
    return all;
  }

  bool try_mode(const Place& place, const Choice& choice) {
    const std::vector<int> barred = zeros(place, choice);
    for (const int i : barred) usable_[std::size_t(i)] = false;
    const bool found = visit();
    for (const int i : barred) usable_[std::size_t(i)] = true;
    return found;
  }

  bool visit() {
    if (--nodes_left_ < 0) return false;
    if (nonnegative_least_squares(B_, d_, x_, usable_) > contradictory) return false;
    std::size_t next = points_.size();
    double worst = zero;
    std::vector<Choice> branches;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (chosen_[i]) continue;
      std::vector<Choice> all = choices(cone_.places()[i]);
      if (all.front().off > worst) worst = all.front().off, next = i, branches = std::move(all);
    }
    if (next == points_.size()) {
      const bool accepted = accept_(cone_.forces(x_.head(B_.rows())));
      doubtful_ = doubtful_ || !accepted;
      return accepted;
    }
    chosen_[next] = true;
    for (const Choice& choice : branches)
      if (try_mode(cone_.places()[next], choice)) return true;
    chosen_[next] = false;
    return false;
  }

  const std::vector<ContactPoint>& points_;
  PolyhedralCone cone_;
  int nodes_left_;
  const std::function<bool(const Vec&)>& accept_;
  Mat B_;
  Vec d_, x_;
  std::vector<bool> usable_, chosen_;
  bool doubtful_ = false;
};

}  // namespace

LcpOutcome search_modes(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, int most_nodes,
                        const std::function<bool(const Vec&)>& accept) {
  return Search(points, A, b, most_nodes, accept).run();
}

}  // namespace trammel::complementarity
