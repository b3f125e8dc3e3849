#include "numerics/frontal_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace trammel::numerics {

namespace {

using Block = Eigen::Map<Mat, 0, Eigen::OuterStride<>>;
using Segment = Eigen::Map<Vec>;

Block block(double* at, int rows, int columns, int stride) {
  return {at, rows, columns, Eigen::OuterStride<>(stride)};
}

// (1 - tau v v^T) x
void apply(double tau, const double* v, double* x, int n) {
  const Eigen::Map<const Vec> along(v, n);
  Segment rest(x, n);
  rest.noalias() -= (tau * along.dot(rest)) * along;
}

}  // namespace

bool FrontalKkt::factorise(const std::vector<BodyBlock>& bodies, int nc, bool identity, double rank_tolerance) {
  const int nv = bodies.empty() ? 0 : bodies.back().v0 + int(bodies.back().M.rows());
  if (!know(bodies, nc) || !merged_.hold(bodies)) {
    nc_ = nc;
    rows_of_bodies_.clear();
    for (const BodyBlock& body : bodies)
      rows_of_bodies_.insert(rows_of_bodies_.end(), body.rows.begin(), body.rows.end());
    merged_.find(bodies, nv, nc);
    points_of_row_.assign(std::size_t(nc), {});
    analyse(bodies, nv);
  }
  identity_ = identity;
  dependent_ = merged_.idle();
  for (std::size_t k = 0; k < fronts_.size(); ++k) {
    Front& front = fronts_[k];
    if (!sum_rows(front, bodies)) {
      analyse(bodies, nv);
      return factorise(bodies, nc, identity, rank_tolerance);
    }
    eliminate_rows(front, rank_tolerance);
    sum_masses(front, bodies);
    if (!reduce_masses(front)) return false;
  }
  return true;
}

bool FrontalKkt::know(const std::vector<BodyBlock>& bodies, int nc) const {
  if (nc != nc_) return false;
  std::size_t at = 0;
  for (const BodyBlock& body : bodies) {
    if (at + body.rows.size() > rows_of_bodies_.size() ||
        !std::equal(body.rows.begin(), body.rows.end(), rows_of_bodies_.begin() + std::ptrdiff_t(at)))
      return false;
    at += body.rows.size();
  }
  return at == rows_of_bodies_.size();
}

void FrontalKkt::analyse(const std::vector<BodyBlock>& bodies, int nv) {
  std::vector<int> weight;
  const std::vector<int> point = find_points(bodies, nv, weight);
  find_rows(bodies, point);
  std::vector<std::vector<int>> cliques = points_of_row_;
  for (const BodyBlock& body : bodies) {
    std::vector<int>& points = cliques.emplace_back();
    for (int j = body.v0; j < body.v0 + int(body.M.rows()); ++j) points.push_back(point[std::size_t(merged_.of(j))]);
  }
  for (std::vector<int>& clique : cliques) {
    std::sort(clique.begin(), clique.end());
    clique.erase(std::unique(clique.begin(), clique.end()), clique.end());
  }
  std::sort(cliques.begin(), cliques.end());
  cliques.erase(std::unique(cliques.begin(), cliques.end()), cliques.end());
  tree_.build(cliques, weight);
  lay_out(bodies, point);
  place_store();
}

// Merged unknowns of the same bodies are one point: they have the same neighbours.
std::vector<int> FrontalKkt::find_points(const std::vector<BodyBlock>& bodies, int nv, std::vector<int>& weight) const {
  std::vector<std::vector<int>> bodies_of(static_cast<std::size_t>(merged_.count()));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int j = bodies[b].v0; j < std::min(nv, bodies[b].v0 + int(bodies[b].M.rows())); ++j) {
      std::vector<int>& of = bodies_of[std::size_t(merged_.of(j))];
      if (of.empty() || of.back() != int(b)) of.push_back(int(b));
    }
  std::map<std::vector<int>, int> known;
  std::vector<int> point;
  for (std::vector<int>& of : bodies_of) {
    const int p = known.try_emplace(std::move(of), int(known.size())).first->second;
    if (p == int(weight.size())) weight.push_back(0);
    ++weight[std::size_t(p)];
    point.push_back(p);
  }
  return point;
}

void FrontalKkt::find_rows(const std::vector<BodyBlock>& bodies, const std::vector<int>& point) {
  for (const BodyBlock& body : bodies)
    for (std::size_t i = 0; i < body.rows.size() && body.rows[i] < nc_; ++i) {
      if (merged_.takes(body.rows[i])) continue;
      std::vector<int>& points = points_of_row_[std::size_t(body.rows[i])];
      for (Eigen::Index k = 0; k < body.Gt.rows(); ++k) {
        const int p = point[std::size_t(merged_.of(body.v0 + int(k)))];
        if (body.Gt(k, Eigen::Index(i)) != 0 && std::find(points.begin(), points.end(), p) == points.end())
          points.push_back(p);
      }
    }
}

void FrontalKkt::lay_out(const std::vector<BodyBlock>& bodies, const std::vector<int>& point) {
  const auto& fronts = tree_.fronts();
  std::vector<std::vector<int>> unknowns_of_point(tree_.nodes());
  for (int u = 0; u < merged_.count(); ++u) unknowns_of_point[std::size_t(point[std::size_t(u)])].push_back(u);
  const auto front_of = [&](const std::vector<int>& points) {
    const int first =
        *std::min_element(points.begin(), points.end(), [&](int p, int q) { return tree_.place(p) < tree_.place(q); });
    return std::size_t(tree_.front_of(first));
  };
  // What each front is made of.
  std::vector<std::vector<int>> rows(fronts.size());
  std::vector<int> row_place(std::size_t(nc_), -1);
  std::vector<std::vector<Source>> sources(fronts.size()), masses(fronts.size());
  for (int i = 0; i < nc_; ++i) {
    if (points_of_row_[std::size_t(i)].empty()) continue;
    std::vector<int>& here = rows[front_of(points_of_row_[std::size_t(i)])];
    row_place[std::size_t(i)] = int(here.size());
    here.push_back(i);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyBlock& body = bodies[b];
    std::vector<int> points;
    for (int j = body.v0; j < body.v0 + int(body.M.rows()); ++j) points.push_back(point[std::size_t(merged_.of(j))]);
    if (!points.empty()) masses[front_of(points)].push_back({int(b), 0, -1, 0});
    for (std::size_t i = 0; i < body.rows.size() && body.rows[i] < nc_; ++i)
      if (const int place = row_place[std::size_t(body.rows[i])]; place >= 0)
        sources[front_of(points_of_row_[std::size_t(body.rows[i])])].push_back({int(b), int(i), place, 0});
  }

  fronts_.assign(fronts.size(), {});
  unknowns_.clear(), own_rows_.clear(), maps_.clear(), sources_.clear(), children_.clear();
  std::vector<int> column(std::size_t(merged_.count()), -1);
  for (std::size_t k = 0; k < fronts.size(); ++k) {
    Front& front = fronts_[k];
    front.first_unknown = int(unknowns_.size());
    const auto take = [&](const std::vector<int>& points) {
      for (const int p : points)
        for (const int u : unknowns_of_point[std::size_t(p)]) {
          column[std::size_t(u)] = int(unknowns_.size()) - front.first_unknown;
          unknowns_.push_back(u);
        }
      return int(unknowns_.size()) - front.first_unknown;
    };
    front.eliminated = take(fronts[k].eliminated);
    front.unknowns = take(fronts[k].boundary);

    front.first_row = int(own_rows_.size());
    front.own_rows = front.most_rows = int(rows[k].size());
    own_rows_.insert(own_rows_.end(), rows[k].begin(), rows[k].end());
    const auto place = [&](std::vector<Source>& some, Range& range) {
      range.begin = int(sources_.size());
      for (Source& source : some) {
        const BodyBlock& body = bodies[std::size_t(source.body)];
        source.map = int(maps_.size());
        for (int j = body.v0; j < body.v0 + int(body.M.rows()); ++j) {
          const int u = merged_.of(j);
          bool there = true;
          if (source.row >= 0) {
            const auto& points = points_of_row_[std::size_t(body.rows[std::size_t(source.column)])];
            there = std::find(points.begin(), points.end(), point[std::size_t(u)]) != points.end();
          }
          maps_.push_back(there ? column[std::size_t(u)] : -1);
        }
        sources_.push_back(source);
      }
      range.end = int(sources_.size());
    };
    place(sources[k], front.rows);
    place(masses[k], front.masses);

    front.children.begin = int(children_.size());
    for (const int c : fronts[k].children) {
      const Front& child = fronts_[std::size_t(c)];
      children_.push_back({c, int(maps_.size())});
      for (int j = child.eliminated; j < child.unknowns; ++j)
        maps_.push_back(column[std::size_t(unknowns_[std::size_t(child.first_unknown + j)])]);
      front.most_rows += child.boundary();
    }
    front.children.end = int(children_.size());
  }
}

// Of each front: C; the reflections; W, K_11, L and V; K''; rows that go up; the vectors t with z, u, the passed rows' scale and
// right side.
void FrontalKkt::place_store() {
  std::size_t size = 0;
  int reflections = 0;
  const auto place = [&size](int numbers) {
    const std::size_t at = size;
    size += std::size_t(numbers);
    return at;
  };
  for (Front& front : fronts_) {
    front.C = place(front.most_rows * front.unknowns);
    front.H = place(front.most_rows * front.most_reflections());
    front.first_reflection = reflections;
    reflections += front.most_reflections();
    front.reduced = place(front.eliminated * front.unknowns);
    front.K = place(front.boundary() * front.boundary());
    front.up = place(front.boundary() * front.boundary());
    front.vectors = place(2 * front.unknowns + 2 * front.boundary());
  }
  store_.assign(size, 0);
  scale_.assign(own_rows_.size(), 1);
  columns_.assign(unknowns_.size(), 0);
  reflections_.assign(std::size_t(reflections), {});
}

// C: the front's own rows at length one, then those of its children. False: a row is not of the pattern any more.
bool FrontalKkt::sum_rows(Front& front, const std::vector<BodyBlock>& bodies) {
  front.all_rows = front.own_rows;
  for (int k = front.children.begin; k < front.children.end; ++k)
    front.all_rows += fronts_[std::size_t(children_[std::size_t(k)].front)].passed;
  const int m = front.all_rows;
  double* const C = store_.data() + front.C;
  std::fill_n(C, m * front.unknowns, 0.0);
  for (int k = front.rows.begin; k < front.rows.end; ++k) {
    const Source& source = sources_[std::size_t(k)];
    const Mat& Gt = bodies[std::size_t(source.body)].Gt;
    const double* const from = Gt.data() + source.column * Gt.rows();
    const int* const map = maps_.data() + source.map;
    for (Eigen::Index j = 0; j < Gt.rows(); ++j) {
      if (map[j] >= 0)
        C[map[j] * m + source.row] += from[j];
      else if (from[j] != 0)
        return false;
    }
  }
  for (int i = 0; i < front.own_rows; ++i) {
    Eigen::Map<Vec, 0, Eigen::InnerStride<>> row(C + i, front.unknowns, Eigen::InnerStride<>(m));
    const double length = row.norm();
    if (length > 0) row /= length;
    scale_[std::size_t(front.first_row + i)] = length > 0 ? 1 / length : 0;
  }
  int row = front.own_rows;
  for (int k = front.children.begin; k < front.children.end; ++k) {
    const Front& child = fronts_[std::size_t(children_[std::size_t(k)].front)];
    const int* const map = maps_.data() + children_[std::size_t(k)].map;
    const double* from = store_.data() + child.up;
    for (int j = 0; j < child.boundary(); ++j, from += child.passed)
      std::copy_n(from, child.passed, C + map[j] * m + row);
    row += child.passed;
  }
  return true;
}

// Column by column, the longest first.
class FrontalKkt::RowElimination {
 public:
  RowElimination(FrontalKkt& all, Front& front)
      : all_(all), front_(front), m_(front.all_rows), n_(front.unknowns), C_(all.store_.data() + front.C) {
    front.reflections = 0;
    all.norms_.resize(std::size_t(n_));
  }
  double* column(int j) { return C_ + j * m_; }

  // Of columns first ... last - 1 on rows begin ... end - 1, while one is longer than `least`; how many. `swap`: they come first.
  int run(int first, int last, int begin, int end, double least, bool swap) {
    double* const norms = all_.norms_.data();
    for (int j = first; j < last; ++j) norms[j] = Segment(column(j) + begin, end - begin).squaredNorm();
    int row = begin;
    for (; row < end && first < last; ++row) {
      int j = int(std::max_element(norms + first, norms + last) - norms);
      if (!(norms[j] > least * least)) break;
      if (swap) {
        if (j != first) {
          std::swap_ranges(column(j), column(j) + m_, column(first));
          std::swap(all_.columns_[std::size_t(front_.first_unknown + j)],
                    all_.columns_[std::size_t(front_.first_unknown + first)]);
          std::swap(norms[j], norms[first]);
        }
        j = first++;
      }
      reflect(j, row, end);
    }
    return row - begin;
  }

 private:
  void reflect(int j, int row, int end) {
    double* const norms = all_.norms_.data();
    const int length = end - row;
    const std::size_t place = front_.H + std::size_t(front_.reflections * front_.most_rows);
    double *const v = all_.store_.data() + place, *const x = column(j) + row;
    const double norm = std::sqrt(norms[j]), beta = x[0] > 0 ? -norm : norm;
    std::copy_n(x, length, v);
    v[0] -= beta;
    const double tau = -1 / (beta * v[0]);
    all_.reflections_[std::size_t(front_.first_reflection + front_.reflections++)] = {row, end, tau, place};
    x[0] = beta;
    std::fill_n(x + 1, length - 1, 0.0);
    norms[j] = 0;
    for (int i = 0; i < n_; ++i) {
      if (i == j || i < std::min(row, front_.eliminated)) continue;  // zero there: told by rows before
      apply(tau, v, column(i) + row, length);
      norms[i] = Segment(column(i) + row + 1, length - 1).squaredNorm();
    }
  }

  FrontalKkt& all_;
  Front& front_;
  int m_, n_;
  double* C_;
};

// Rows that tell nothing of the front's unknowns go up, as far as they are independent.
void FrontalKkt::eliminate_rows(Front& front, double rank_tolerance) {
  const int m = front.all_rows, n = front.unknowns, F = front.eliminated;
  std::iota(columns_.begin() + front.first_unknown, columns_.begin() + front.first_unknown + n, 0);
  RowElimination rows(*this, front);
  front.told = rows.run(0, F, 0, m, rank_tolerance, true);
  front.passed = rows.run(F, n, front.told, m, rank_tolerance, false);
  dependent_ += m - front.told - front.passed;

  double* const scale = store_.data() + front.vectors + 2 * n;
  Block up = block(store_.data() + front.up, front.passed, n - F, front.passed);
  up = block(rows.column(F) + front.told, front.passed, n - F, m);
  for (int i = 0; i < front.passed; ++i) {
    scale[i] = 1 / up.row(i).norm();
    up.row(i) *= scale[i];
  }
  // S = R_11^-1 (R_12 R_1B) in their place.
  Block S = block(rows.column(front.told), front.told, n - front.told, m);
  block(rows.column(0), front.told, front.told, m).triangularView<Eigen::Upper>().solveInPlace(S);
}

void FrontalKkt::reflect_all(const Front& front, bool backwards, Vec& w) const {
  for (int s = 0; s < front.reflections; ++s) {
    const Reflection& r =
        reflections_[std::size_t(front.first_reflection + (backwards ? front.reflections - 1 - s : s))];
    apply(r.tau, store_.data() + r.v, w.data() + r.begin, r.end - r.begin);
  }
}

void FrontalKkt::sum_masses(const Front& front, const std::vector<BodyBlock>& bodies) {
  K_.setZero(front.unknowns, front.unknowns);
  for (int k = front.masses.begin; k < front.masses.end; ++k) {
    const Mat& M = bodies[std::size_t(sources_[std::size_t(k)].body)].M;
    const int* const map = maps_.data() + sources_[std::size_t(k)].map;
    for (Eigen::Index j = 0; j < M.cols(); ++j)
      if (identity_)
        K_(map[j], map[j]) += 1;
      else
        for (Eigen::Index i = 0; i < M.rows(); ++i) K_(map[i], map[j]) += M(i, j);
  }
  for (int k = front.children.begin; k < front.children.end; ++k) {
    const Front& child = fronts_[std::size_t(children_[std::size_t(k)].front)];
    const int* const map = maps_.data() + children_[std::size_t(k)].map;
    const double* from = store_.data() + child.K;
    for (int j = 0; j < child.boundary(); ++j)
      for (int i = 0; i < child.boundary(); ++i) K_(map[i], map[j]) += *from++;
  }
}

// W = K_1r - K_11 S,  K' = K_rr - S^T W - K_1r^T S;  then K'_22 = L L^T, V = L^-1 K'_2B, K'' = K'_BB - V^T V.
bool FrontalKkt::reduce_masses(const Front& front) {
  const int n = front.unknowns, r = front.told, rest = front.rest(), free = front.free(), nb = front.boundary();
  const int* const columns = columns_.data() + front.first_unknown;
  double* const at = store_.data() + front.reduced;
  Block W = block(at, r, rest, r), K11 = block(at + r * rest, r, r, r), L = block(at + r * n, free, free, free),
        V = block(at + r * n + free * free, free, nb, free), K = block(store_.data() + front.K, nb, nb, nb);
  const Block S = block(store_.data() + front.C + r * front.all_rows, r, rest, front.all_rows);
  for (int j = 0; j < r; ++j)
    for (int i = 0; i < r; ++i) K11(i, j) = K_(columns[i], columns[j]);
  for (int j = 0; j < rest; ++j)
    for (int i = 0; i < r; ++i) W(i, j) = K_(columns[i], columns[r + j]);
  T_.resize(rest, rest);
  for (int j = 0; j < rest; ++j)
    for (int i = j; i < rest; ++i) T_(i, j) = K_(columns[r + i], columns[r + j]);
  S_ = S.transpose();
  const auto subtract_lower = [&](const auto& transposed, const auto& factor) {
    for (int j = 0; j < rest; ++j)
      for (int k = 0; k < r; ++k) T_.col(j).tail(rest - j).noalias() -= factor(k, j) * transposed.col(k).tail(rest - j);
  };
  if (r > 0) {
    const Mat K_r1 = W.transpose();
    subtract_lower(K_r1, S);
    W.noalias() -= K11.lazyProduct(S);
    subtract_lower(S_, W);
  }
  for (int j = 0; j < free; ++j) {
    const double pivot = T_(j, j) - L.row(j).head(j).squaredNorm();
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    L(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < free; ++i) L(i, j) = (T_(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
  }
  V = T_.bottomLeftCorner(nb, free).transpose();
  L.triangularView<Eigen::Lower>().solveInPlace(V);
  for (int j = 0; j < nb; ++j)
    for (int i = j; i < nb; ++i) K(i, j) = K(j, i) = T_(free + i, free + j) - (free > 0 ? V.col(i).dot(V.col(j)) : 0.0);
  return true;
}

void FrontalKkt::forward(const Front& front, const Vec& c) {
  const int m = front.all_rows, n = front.unknowns, r = front.told, rest = front.rest(), free = front.free(),
            nb = front.boundary();
  const int* const columns = columns_.data() + front.first_unknown;
  const int* const unknowns = unknowns_.data() + front.first_unknown;
  double* const C = store_.data() + front.C;
  double* const vectors = store_.data() + front.vectors;
  w_.resize(m);
  for (int i = 0; i < front.own_rows; ++i)
    w_(i) = c(own_rows_[std::size_t(front.first_row + i)]) * scale_[std::size_t(front.first_row + i)];
  int row = front.own_rows;
  for (int k = front.children.begin; k < front.children.end; ++k) {
    const Front& child = fronts_[std::size_t(children_[std::size_t(k)].front)];
    const double* const passed = store_.data() + child.vectors + 2 * child.unknowns + child.boundary();
    std::copy_n(passed, child.passed, w_.data() + row);
    row += child.passed;
  }
  reflect_all(front, false, w_);
  for (int i = 0; i < front.passed; ++i) vectors[2 * n + nb + i] = w_(r + i) * vectors[2 * n + i];

  Segment t(vectors, r), u(vectors + n, r), z(vectors + r, free);
  t = w_.head(r);
  block(C, r, r, m).triangularView<Eigen::Upper>().solveInPlace(t);
  double* const at = store_.data() + front.reduced;
  const Block W = block(at, r, rest, r), K11 = block(at + r * rest, r, r, r), S = block(C + r * m, r, rest, m),
              L = block(at + r * n, free, free, free), V = block(at + r * n + free * free, free, nb, free);
  for (int i = 0; i < r; ++i) u(i) = b_(unknowns[columns[i]]);
  for (int j = 0; j < rest; ++j) {
    double change = 0;
    for (int i = 0; i < r; ++i) change += S(i, j) * u(i) + W(i, j) * t(i);
    b_(unknowns[columns[r + j]]) -= change;
  }
  u.noalias() -= K11.lazyProduct(t);
  if (free == 0) return;
  for (int i = 0; i < free; ++i) z(i) = b_(unknowns[columns[r + i]]);
  L.triangularView<Eigen::Lower>().solveInPlace(z);
  for (int j = 0; j < nb; ++j) b_(unknowns[front.eliminated + j]) -= V.col(j).dot(z);
}

void FrontalKkt::backward(const Front& front, Vec& y) {
  const int m = front.all_rows, n = front.unknowns, r = front.told, rest = front.rest(), free = front.free(),
            nb = front.boundary();
  const int* const columns = columns_.data() + front.first_unknown;
  const int* const unknowns = unknowns_.data() + front.first_unknown;
  double* const C = store_.data() + front.C;
  double* const vectors = store_.data() + front.vectors;
  double* const at = store_.data() + front.reduced;
  const Block W = block(at, r, rest, r), S = block(C + r * m, r, rest, m), L = block(at + r * n, free, free, free),
              V = block(at + r * n + free * free, free, nb, free);
  Segment t(vectors, r), u(vectors + n, r), z(vectors + r, free);
  w_.resize(m + rest);
  auto x = w_.tail(rest);
  for (int j = 0; j < nb; ++j) x(free + j) = X_(unknowns[front.eliminated + j]);
  if (free > 0) {
    x.head(free) = z;
    x.head(free).noalias() -= V.lazyProduct(x.tail(nb));
    L.triangularView<Eigen::Lower>().transpose().solveInPlace(x.head(free));
  }
  w_.head(m).setZero();
  w_.head(r) = u;
  for (int j = 0; j < rest; ++j) {
    t -= x(j) * S.col(j);
    w_.head(r) -= x(j) * W.col(j);
  }
  for (int i = 0; i < r; ++i) X_(unknowns[columns[i]]) = t(i);
  for (int i = 0; i < free; ++i) X_(unknowns[columns[r + i]]) = x(i);

  auto multipliers = w_.head(r);
  block(C, r, r, m).triangularView<Eigen::Upper>().transpose().solveInPlace(multipliers);
  for (int i = 0; i < front.passed; ++i) w_(r + i) = vectors[2 * n + nb + i] * vectors[2 * n + i];
  reflect_all(front, true, w_);
  for (int i = 0; i < front.own_rows; ++i)
    y(own_rows_[std::size_t(front.first_row + i)]) = w_(i) * scale_[std::size_t(front.first_row + i)];
  int row = front.own_rows;
  for (int k = front.children.begin; k < front.children.end; ++k) {
    const Front& child = fronts_[std::size_t(children_[std::size_t(k)].front)];
    std::copy_n(w_.data() + row, child.passed, store_.data() + child.vectors + 2 * child.unknowns + child.boundary());
    row += child.passed;
  }
}

void FrontalKkt::solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  const auto subtract_mass = [&](const Vec& a, Vec& from) {
    if (identity_)
      from -= a;
    else
      add_mass_times(bodies, -1, a, from);
  };
  left_ = b, c_ = c;
  merged_.offsets(c, offset_);
  if (!offset_.isZero(0)) {
    subtract_mass(offset_, left_);
    add_rows_times(bodies, -1, offset_, c_);
  }
  b_.setZero(merged_.count());
  for (Eigen::Index j = 0; j < b.size(); ++j) b_(merged_.of(int(j))) += left_(j);
  X_.resize(merged_.count());
  y.setZero(nc_);
  for (const Front& front : fronts_) forward(front, c_);
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) backward(*front, y);
  x = offset_;
  for (Eigen::Index j = 0; j < x.size(); ++j) x(j) += X_(merged_.of(int(j)));
  left_ = b;
  subtract_mass(x, left_);
  add_rows_force(bodies, -1, y, left_);
  merged_.multipliers(left_, y);
}

}  // namespace trammel::numerics
