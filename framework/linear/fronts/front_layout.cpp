#include "linear/fronts/front_layout.hpp"

#include <algorithm>
#include <utility>

namespace trammel::numerics {

namespace {

// Measured on trusses: fronts of one unit for masts, of two units for hoops.
constexpr EliminationTree::Costs costs_of_bodies{.front = 400, .entry = 2};

void make_set(std::vector<int>& x) {
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
}

int end_of(const BodyBlock& body) {
  return body.v0 + int(body.M.rows());
}

}  // namespace

void FrontLayout::build(const std::vector<BodyBlock>& bodies, int nc, Unknowns unknowns) {
  nc_ = nc;
  rows_of_bodies_.take(bodies, nc);
  const int nv = bodies.empty() ? 0 : end_of(bodies.back());
  unknowns == Unknowns::merged ? merged_.find(bodies, nv, nc) : merged_.take_none(nv, nc);
  points_of_row_.assign(std::size_t(nc), {});
  extend(bodies);
}

void FrontLayout::extend(const std::vector<BodyBlock>& bodies) {
  std::vector<int> weight;
  const std::vector<int> point = find_points(bodies, weight);
  find_rows(bodies, point);
  std::vector<std::vector<int>> cliques = points_of_row_;
  for (const BodyBlock& body : bodies) {
    std::vector<int>& points = cliques.emplace_back();
    for (int j = body.v0; j < end_of(body); ++j) points.push_back(point[std::size_t(merged_.of(j))]);
  }
  for (std::vector<int>& clique : cliques) make_set(clique);
  std::sort(cliques.begin(), cliques.end());
  cliques.erase(std::unique(cliques.begin(), cliques.end()), cliques.end());
  tree_.build(cliques, weight, costs_of_bodies);
  place(bodies, point);
}

// Merged unknowns of the same bodies form one point: they have the same neighbours.
std::vector<int> FrontLayout::find_points(const std::vector<BodyBlock>& bodies, std::vector<int>& weight) const {
  std::vector<std::vector<int>> bodies_of(static_cast<std::size_t>(merged_.count()));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int j = bodies[b].v0; j < end_of(bodies[b]); ++j) {
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

void FrontLayout::find_rows(const std::vector<BodyBlock>& bodies, const std::vector<int>& point) {
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

FrontLayout::Parts FrontLayout::divide(const std::vector<BodyBlock>& bodies, const std::vector<int>& point) const {
  const std::size_t fronts = tree_.fronts().size();
  const auto front_of = [&](const std::vector<int>& points) {
    const int first =
        *std::min_element(points.begin(), points.end(), [&](int p, int q) { return tree_.place(p) < tree_.place(q); });
    return std::size_t(tree_.front_of(first));
  };
  Parts parts;
  parts.rows.resize(fronts), parts.sources.resize(fronts), parts.masses.resize(fronts);
  std::vector<int> row_place(std::size_t(nc_), -1);
  for (int i = 0; i < nc_; ++i) {
    if (points_of_row_[std::size_t(i)].empty()) continue;
    std::vector<int>& here = parts.rows[front_of(points_of_row_[std::size_t(i)])];
    row_place[std::size_t(i)] = int(here.size());
    here.push_back(i);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyBlock& body = bodies[b];
    std::vector<int> points;
    for (int j = body.v0; j < end_of(body); ++j) points.push_back(point[std::size_t(merged_.of(j))]);
    if (!points.empty()) parts.masses[front_of(points)].push_back({int(b), 0, -1});
    for (std::size_t i = 0; i < body.rows.size() && body.rows[i] < nc_; ++i)
      if (const int place = row_place[std::size_t(body.rows[i])]; place >= 0)
        parts.sources[front_of(points_of_row_[std::size_t(body.rows[i])])].push_back({int(b), int(i), place});
  }
  return parts;
}

void FrontLayout::place(const std::vector<BodyBlock>& bodies, const std::vector<int>& point) {
  const auto& fronts = tree_.fronts();
  Parts parts = divide(bodies, point);
  std::vector<std::vector<int>> of_point(tree_.nodes());
  for (int u = 0; u < merged_.count(); ++u) of_point[std::size_t(point[std::size_t(u)])].push_back(u);
  std::vector<int> column(std::size_t(merged_.count()), -1);
  KnownMaps known;
  fronts_.assign(fronts.size(), {});
  unknowns_.clear(), own_rows_.clear(), maps_.clear(), sources_.clear(), children_.clear();
  for (std::size_t k = 0; k < fronts.size(); ++k) {
    Front& front = fronts_[k];
    front.first_unknown = int(unknowns_.size());
    front.eliminated = take_unknowns(front, fronts[k].eliminated, of_point, column);
    front.unknowns = take_unknowns(front, fronts[k].boundary, of_point, column);

    front.first_row = int(own_rows_.size());
    front.own_rows = front.most_rows = int(parts.rows[k].size());
    own_rows_.insert(own_rows_.end(), parts.rows[k].begin(), parts.rows[k].end());
    front.rows = take_sources(bodies, parts.sources[k], point, column, known);
    front.masses = take_sources(bodies, parts.masses[k], point, column, known);

    front.children.begin = int(children_.size());
    for (const int c : fronts[k].children) {
      const Front& child = fronts_[std::size_t(c)];
      std::vector<int> map;
      for (int j = child.eliminated; j < child.unknowns; ++j) map.push_back(column[std::size_t(unknowns(child)[j])]);
      children_.push_back({c, place_map(std::move(map), known)});
      front.most_rows += child.boundary();
    }
    front.children.end = int(children_.size());
  }
}

int FrontLayout::place_map(std::vector<int> map, KnownMaps& known) {
  const auto [found, is_new] = known.try_emplace(std::move(map), int(maps_.size()));
  if (is_new) maps_.insert(maps_.end(), found->first.begin(), found->first.end());
  return found->second;
}

// Returns the number of the front's unknowns.
int FrontLayout::take_unknowns(const Front& front, const std::vector<int>& points,
                               const std::vector<std::vector<int>>& of_point, std::vector<int>& column) {
  for (const int p : points)
    for (const int u : of_point[std::size_t(p)]) {
      column[std::size_t(u)] = int(unknowns_.size()) - front.first_unknown;
      unknowns_.push_back(u);
    }
  return int(unknowns_.size()) - front.first_unknown;
}

FrontLayout::Range FrontLayout::take_sources(const std::vector<BodyBlock>& bodies, std::vector<Source>& some,
                                             const std::vector<int>& point, const std::vector<int>& column,
                                             KnownMaps& known) {
  const int begin = int(sources_.size());
  for (Source& source : some) {
    const BodyBlock& body = bodies[std::size_t(source.body)];
    source.size = int(body.M.rows()), source.v0 = body.v0;
    source.constant =
        source.row < 0 ? body.constant_mass
                       : std::size_t(source.column) < body.constant.size() && body.constant[std::size_t(source.column)];
    std::vector<int> map;
    for (int j = body.v0; j < end_of(body); ++j) {
      const int u = merged_.of(j);
      bool there = true;
      if (source.row >= 0) {
        const auto& points = points_of_row_[std::size_t(body.rows[std::size_t(source.column)])];
        there = std::find(points.begin(), points.end(), point[std::size_t(u)]) != points.end();
      }
      map.push_back(there ? column[std::size_t(u)] : -1);
    }
    source.map = place_map(std::move(map), known);
    sources_.push_back(source);
  }
  return {begin, int(sources_.size())};
}

}  // namespace trammel::numerics
