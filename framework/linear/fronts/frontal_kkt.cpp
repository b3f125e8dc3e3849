#include "linear/fronts/frontal_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "linear/dense/prefetch.hpp"
#include "linear/dense/short_sums.hpp"
#include "linear/fronts/row_elimination.hpp"

namespace trammel::numerics {

namespace {

// Number of rows that vanish: they are in no front.
int rows_of_nothing(const FrontLayout& layout, int nc) {
  int apart = 0;
  for (int i = 0; i < nc; ++i) apart += layout.merged().takes(i) ? 0 : 1;
  return apart - int(layout.all_own_rows());
}

}  // namespace

bool FrontalKkt::factorise(const std::vector<BodyBlock>& bodies, int nc, bool identity, double rank_tolerance) {
  lay_out(bodies, nc, false);
  identity_ = identity;
  rank_tolerance_ = rank_tolerance;
  const bool positive = eliminate_fronts(bodies);
  dependent_ += rows_of_nothing(layout_, nc);
  return positive;
}

void FrontalKkt::lay_out(const std::vector<BodyBlock>& bodies, int nc, bool springs) {
  const bool known = is_built_for(bodies, nc) && layout_.merges_still_hold(bodies);
  if (known && springs == springs_) return;
  springs_ = springs;
  if (!known) layout_.build(bodies, nc);
  place_store(bodies);
}

bool FrontalKkt::eliminate_fronts(const std::vector<BodyBlock>& bodies) {
  dependent_ = layout_.merged().idle();
  stored_ = 0;
  if (!identity_) pieces_.place_masses(layout_, bodies);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k + 1 < places_.size()) prefetch_rows(k + 1, bodies);
    if (k > 0) prefetch_place_for_factors(k - 1);
    if (!sum_rows(k, bodies)) {
      layout_.extend(bodies);
      place_store(bodies);
      return eliminate_fronts(bodies);
    }
    springs_ ? keep_rows(k) : eliminate_rows(k);
    sum_masses(k, bodies);
    if (springs_) add_springs(k);
    if (!reduce_masses(k)) return false;
  }
  return true;
}

void FrontalKkt::place_store(const std::vector<BodyBlock>& bodies) {
  std::size_t size = 0;
  int rows = 0, unknowns = 0;
  for (const FrontLayout::Front& front : layout_.fronts()) {
    const int m = springs_ ? front.own_rows : front.most_rows, n = front.unknowns, F = front.eliminated;
    const int most_told = springs_ ? 0 : std::min(m, F);
    size += std::size_t(front.boundary() + 2 * F + F * n + m * m + most_told * n);
    rows = std::max(rows, m), unknowns = std::max(unknowns, n);
  }
  places_.assign(layout_.fronts().size(), {});
  place_passed_on();
  store_.setZero(Eigen::Index(size));
  scale_.assign(layout_.all_own_rows(), 1);
  columns_.assign(layout_.all_unknowns(), 0);
  pieces_.build(layout_, bodies);
  const int width = RowElimination::width(rows, unknowns);
  rows_.resize(rows * width);
  K_.resize(unknowns * unknowns);
  w_.resize(rows);
  scratch_.resize(2 * width);
  place_of_.resize(std::size_t(unknowns));
}

// Places of equal size; the last one released is used first.
void FrontalKkt::place_passed_on() {
  std::size_t size = 0;
  std::map<int, std::vector<std::size_t>> left;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const FrontLayout::Front& front = layout_.fronts()[k];
    const int nb = front.boundary();
    std::vector<std::size_t>& open = left[nb];
    if (open.empty()) open.push_back(size), size += std::size_t(2 * nb * nb);
    places_[k].K = open.back();
    open.pop_back();
    for (const FrontLayout::Child& child : layout_.children(front))
      left[layout_.fronts()[std::size_t(child.front)].boundary()].push_back(places_[std::size_t(child.front)].K);
  }
  passed_on_.setZero(Eigen::Index(size));
}

FrontalKkt::Parts FrontalKkt::parts(std::size_t k) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const Place& at = places_[k];
  Parts p{};
  p.m = at.all_rows, p.n = front.unknowns, p.r = at.pivots, p.passed = at.passed;
  p.rest = p.n - p.r, p.free = front.eliminated - p.r, p.nb = front.boundary();
  p.unknowns = layout_.unknowns(front), p.columns = columns_.data() + front.first_unknown;
  p.K = passed_on_.data() + at.K, p.up = p.K + p.nb * p.nb;
  p.passed_right = store_.data() + at.factors;
  p.t = p.passed_right + p.nb, p.z = p.t + p.r, p.u = p.z + p.free;
  p.SP = p.u + p.r, p.Q = p.SP + p.r * (p.rest + p.m);
  p.W = p.Q + p.passed * p.m, p.LV = p.W + p.r * p.rest, p.K11 = p.LV + p.free * p.rest;
  return p;
}

FrontalKkt::Below FrontalKkt::passed_by(const FrontLayout::Child& child) {
  const int nb = layout_.fronts()[std::size_t(child.front)].boundary();
  const Place& at = places_[std::size_t(child.front)];
  double* const K = passed_on_.data() + at.K;
  return {nb, at.passed, K, K + nb * nb, store_.data() + at.factors};
}

// Allocates the front's factors, after the ranks of its rows are known.
FrontalKkt::Parts FrontalKkt::place_factors(std::size_t k, int pivots, int passed) {
  Place& at = places_[k];
  at.pivots = pivots, at.passed = passed, at.factors = stored_;
  const Parts p = parts(k);
  stored_ = std::size_t(p.K11 + pivots * pivots - store_.data());
  return p;
}

// Prefetches what sum_rows will read from bodies.
void FrontalKkt::prefetch_rows(std::size_t k, const std::vector<BodyBlock>& bodies) const {
  for (const FrontLayout::Source& source : layout_.rows(layout_.fronts()[k]))
    if (!source.constant)
      prefetch(bodies[std::size_t(source.body)].Gt.data() + source.column * source.size, source.size * sizeof(double));
}

// Prefetches the memory of the factors, presumably of about the same size as those of front k before.
void FrontalKkt::prefetch_place_for_factors(std::size_t k) const {
  const std::size_t left = std::size_t(store_.size()) - stored_;
  prefetch(store_.data() + stored_, std::min(stored_ - places_[k].factors, left) * sizeof(double));
}

// Forms C: the front's own rows at length one, then those of its children. False: a row no longer fits the pattern.
bool FrontalKkt::sum_rows(std::size_t k, const std::vector<BodyBlock>& bodies) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  Place& at = places_[k];
  const int n = front.unknowns;
  at.all_rows = front.own_rows;
  for (const FrontLayout::Child& child : layout_.children(front))
    at.all_rows += places_[std::size_t(child.front)].passed;
  const int width = springs_ ? n : RowElimination::width(at.all_rows, n);
  double* const C = rows_.data();
  std::fill_n(C, at.all_rows * width, 0.0);
  std::size_t piece_at = std::size_t(front.rows.begin);
  for (const FrontLayout::Source& source : layout_.rows(front)) {
    const int size = source.size, *const map = layout_.map(source.map);
    const double* const piece = pieces_.update(piece_at++, source, bodies);
    double* const row = C + source.row * width;
    for (int j = 0; j < size; ++j)
      if (map[j] >= 0)
        row[map[j]] += piece[j];
      else if (piece[j] != 0)
        return false;
  }
  for (int i = 0; i < front.own_rows; ++i) {
    double* const row = C + i * width;
    const double length = std::sqrt(dot(n, row, row)), scale = length > 0 ? 1 / length : 0;
    for (int j = 0; j < n; ++j) row[j] *= scale;
    scale_[std::size_t(front.first_row + i)] = scale;
  }
  double* row = C + front.own_rows * width;
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Below below = passed_by(child);
    const int* const map = layout_.map(child.map);
    for (int i = 0; i < below.passed; ++i, row += width)
      for (int j = 0; j < below.nb; ++j) row[map[j]] = below.up[i * below.nb + j];
  }
  return true;
}

// Rows without a component along the front's unknowns are passed to the parent if they are independent. Then S = R^-1
// (R_12 R_1B) is stored in their place, with P beside it.
void FrontalKkt::eliminate_rows(std::size_t k) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const int m = places_[k].all_rows, F = front.eliminated, width = RowElimination::width(m, front.unknowns);
  const auto C = [&](int i) { return rows_.data() + i * width; };
  RowElimination rows(rows_.data(), m, front.unknowns);
  const auto rank = rows.run(F, rank_tolerance_, columns_.data() + front.first_unknown, scratch_.data());
  dependent_ += m - rank.pivots - rank.passed;
  const Parts p = place_factors(k, rank.pivots, rank.passed);
  for (int i = 0; i < p.passed; ++i) {
    const double* const row = C(p.r + i) + F;
    const double scale = 1 / std::sqrt(dot(p.nb, row, row));
    for (int j = 0; j < p.nb; ++j) p.up[i * p.nb + j] = scale * row[j];
    for (int j = 0; j < m; ++j) p.Q[i * m + j] = scale * row[p.nb + j];
  }
  const int wide = p.rest + m;
  for (int i = p.r - 1; i >= 0; --i) {
    const double *const row = C(i) + p.r, inverse = 1 / C(i)[i];
    double* const S_i = p.S(i);
    for (int j = 0; j < wide; ++j) S_i[j] = inverse * row[j];
    for (int l = 0; l < i; ++l) add(wide, -C(l)[i], S_i, C(l) + p.r);
  }
}

// Forms K, in the present order of the front's columns.
void FrontalKkt::sum_masses(std::size_t k, const std::vector<BodyBlock>& bodies) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const Parts p = parts(k);
  for (int i = 0; i < p.n; ++i) place_of_[std::size_t(p.columns[i])] = i;
  std::fill_n(K_.data(), p.n * p.n, 0.0);
  const auto sum = [&](const int* map, int size, const auto& entry) {
    for (int j = 0; j < size; ++j) {
      double* const column = K_.data() + place_of_[std::size_t(map[j])] * p.n;
      for (int i = 0; i < size; ++i) column[place_of_[std::size_t(map[i])]] += entry(i, j);
    }
  };
  std::size_t piece_at = std::size_t(front.masses.begin);
  for (const FrontLayout::Source& source : layout_.masses(front)) {
    const int size = source.size;
    if (identity_) {
      sum(layout_.map(source.map), size, [](int i, int j) { return i == j ? 1.0 : 0.0; });
    } else {
      const double* const piece = pieces_.update(piece_at++, source, bodies);
      sum(layout_.map(source.map), size, [&](int i, int j) { return piece[j * size + i]; });
    }
  }
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Below below = passed_by(child);
    sum(layout_.map(child.map), below.nb, [&](int i, int j) { return below.K[j * below.nb + i]; });
  }
}

// W = K_1r - K_11 S,  K' = K_rr - K_r1 S - S^T W, its lower triangle;  K'_22 = L L^T, V^T = K'_B2 L^-T, K'' = K'_BB -
// V^T V.
bool FrontalKkt::reduce_masses(std::size_t k) {
  const Parts p = parts(k);
  const int r = p.r, rest = p.rest;
  double* const K = K_.data();
  const auto T = [&](int i, int j) -> double& { return K[(r + j) * p.n + r + i]; };
  for (int j = 0; j < r; ++j)
    for (int i = 0; i < r; ++i) p.K11[j * r + i] = K[j * p.n + i];
  for (int j = 0; j < rest; ++j) {
    double* const column = K + (r + j) * p.n;
    for (int l = 0; l < r; ++l) add(p.n, -p.S(l)[j], K + l * p.n, column);
    for (int l = 0; l < r; ++l) {
      p.W[l * rest + j] = column[l];
      add(rest - j, -column[l], p.S(l) + j, &T(j, j));
    }
  }
  for (int j = 0; j < p.free; ++j) {
    if (!(T(j, j) > 0) || !std::isfinite(T(j, j))) return false;
    double* const column = p.LV + j * rest;
    const double root = column[j] = std::sqrt(T(j, j));
    for (int i = j + 1; i < rest; ++i) column[i] = T(i, j) / root;
    for (int l = j + 1; l < rest; ++l) add(rest - l, -column[l], column + l, &T(l, l));
  }
  for (int j = 0; j < p.nb; ++j)
    for (int i = j; i < p.nb; ++i) p.K[j * p.nb + i] = p.K[i * p.nb + j] = T(p.free + i, p.free + j);
  return true;
}

}  // namespace trammel::numerics
