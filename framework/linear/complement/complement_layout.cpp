#include "linear/complement/complement_layout.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "linear/dense/prefetch.hpp"
#include "linear/order/elimination_tree.hpp"

namespace trammel::numerics {

namespace {

// Measured on chains of hinges and of balls.
constexpr EliminationTree::Costs costs{.along = 1, .front = 300, .entry = 1};

struct Nodes {
  std::vector<std::vector<int>> rows;       // of each node
  std::vector<std::vector<int>> of_bodies;  // nodes that touch each body
};

Nodes join_rows(const std::vector<std::span<const int>>& rows_of_bodies, int nc) {
  std::vector<std::vector<int>> bodies(static_cast<std::size_t>(nc));
  for (std::size_t k = 0; k < rows_of_bodies.size(); ++k)
    for (const int row : rows_of_bodies[k]) bodies[std::size_t(row)].push_back(int(k));
  Nodes nodes{.rows = {}, .of_bodies = std::vector<std::vector<int>>(rows_of_bodies.size())};
  std::map<std::vector<int>, int> known;
  for (int row = 0; row < nc; ++row) {
    const auto [node, fresh] = known.try_emplace(bodies[std::size_t(row)], int(nodes.rows.size()));
    if (fresh) {
      nodes.rows.emplace_back();
      for (const int k : node->first) nodes.of_bodies[std::size_t(k)].push_back(node->second);
    }
    nodes.rows[std::size_t(node->second)].push_back(row);
  }
  return nodes;
}

// The block of a body belongs to the first front that eliminates one of its rows.
std::vector<std::vector<int>> bodies_of(const std::vector<EliminationTree::Front>& fronts, const Nodes& nodes,
                                        const std::vector<std::span<const int>>& rows_of_bodies, int nc) {
  std::vector<std::size_t> front_of(static_cast<std::size_t>(nc));
  for (std::size_t i = 0; i < fronts.size(); ++i)
    for (const int node : fronts[i].eliminated)
      for (const int row : nodes.rows[std::size_t(node)]) front_of[std::size_t(row)] = i;
  std::vector<std::vector<int>> bodies(fronts.size());
  for (std::size_t k = 0; k < rows_of_bodies.size(); ++k) {
    if (rows_of_bodies[k].empty()) continue;
    std::size_t first = fronts.size();
    for (const int row : rows_of_bodies[k]) first = std::min(first, front_of[std::size_t(row)]);
    bodies[first].push_back(int(k));
  }
  return bodies;
}

EliminationTree eliminate(const Nodes& nodes) {
  std::vector<int> weight;
  for (const std::vector<int>& rows : nodes.rows) weight.push_back(int(rows.size()));
  EliminationTree tree;
  tree.build(nodes.of_bodies, weight, costs);
  return tree;
}

// The rows of nodes in the order of elimination, the same in all fronts.
std::vector<int> rows_in_order(std::vector<int> members, const Nodes& nodes, const EliminationTree& tree) {
  std::sort(members.begin(), members.end(), [&](int a, int b) { return tree.place(a) < tree.place(b); });
  std::vector<int> rows;
  for (const int node : members)
    rows.insert(rows.end(), nodes.rows[std::size_t(node)].begin(), nodes.rows[std::size_t(node)].end());
  return rows;
}

// Allocates parts of an array of numbers and takes them back.
class Places {
 public:
  struct Part {
    std::size_t begin, size;
  };
  Part take(std::size_t size) {
    if (const auto fit = free_.lower_bound(size); fit != free_.end()) {
      const Part part = {fit->second, fit->first};
      free_.erase(fit);
      return part;
    }
    numbers_ += size;
    return {numbers_ - size, size};
  }
  void give_back(Part part) { free_.emplace(part.size, part.begin); }
  std::size_t numbers() const { return numbers_; }

 private:
  std::multimap<std::size_t, std::size_t> free_;  // by size
  std::size_t numbers_ = 0;
};

}  // namespace

bool ComplementLayout::is_built_for(const std::vector<BodyBlock>& bodies, int nc) const {
  if (nc != nc_ || bodies.size() != of_bodies_.size()) return false;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    look_ahead(k, bodies.size(),
               [&](std::size_t next) { prefetch(bodies[next].rows.data(), bodies[next].rows.size() * sizeof(int)); });
    const std::span<const int> known = part(rows_, of_bodies_[k]);
    const std::vector<int>& rows = bodies[k].rows;
    if (rows.size() < known.size() || !std::equal(known.begin(), known.end(), rows.begin())) return false;
    if (rows.size() > known.size() && rows[known.size()] < nc) return false;
  }
  return true;
}

void ComplementLayout::find(const std::vector<BodyBlock>& bodies, int nc) {
  take_rows(bodies, nc);
  std::vector<std::span<const int>> rows_of_bodies;
  for (const List& of_body : of_bodies_) rows_of_bodies.push_back(part(rows_, of_body));
  const Nodes nodes = join_rows(rows_of_bodies, nc);
  const EliminationTree tree = eliminate(nodes);
  const std::vector<std::vector<int>> bodies_of_fronts = bodies_of(tree.fronts(), nodes, rows_of_bodies, nc);
  Places places;
  std::vector<Places::Part> R;  // for each front
  for (const EliminationTree::Front& of : tree.fronts()) {
    Front& front = add_front(rows_in_order(of.eliminated, nodes, tree), rows_in_order(of.boundary, nodes, tree),
                             bodies_of_fronts[fronts_.size()], of.children);
    front.R = R.emplace_back(places.take(std::size_t(front.stride() * (front.size - front.eliminated)))).begin;
    for (const int child : of.children) places.give_back(R[std::size_t(child)]);
  }
  R_ = places.numbers();
}

// The rows of each body; without fronts.
void ComplementLayout::take_rows(const std::vector<BodyBlock>& bodies, int nc) {
  nc_ = nc;
  of_bodies_.clear(), rows_.clear();
  for (const BodyBlock& body : bodies) {
    const auto end = std::lower_bound(body.rows.begin(), body.rows.end(), nc);
    of_bodies_.push_back({rows_.size(), std::size_t(end - body.rows.begin())});
    rows_.insert(rows_.end(), body.rows.begin(), end);
  }
  fronts_.clear(), shares_.clear(), numbers_.clear();
  place_.resize(static_cast<std::size_t>(nc));
  L_ = 0, largest_ = 0;
}

ComplementLayout::Front& ComplementLayout::add_front(std::vector<int> eliminated, const std::vector<int>& boundary,
                                                     const std::vector<int>& bodies, const std::vector<int>& children) {
  Front front;
  front.eliminated = int(eliminated.size());
  std::vector<int>& rows = eliminated;
  rows.insert(rows.end(), boundary.begin(), boundary.end());
  front.size = int(rows.size());
  front.rows = keep(rows);
  place_shares(front, bodies, children);
  front.L = L_;
  L_ += std::size_t(front.stride() * front.eliminated);
  largest_ = std::max(largest_, front.size);
  return fronts_.emplace_back(front);
}

ComplementLayout::List ComplementLayout::keep(const std::vector<int>& numbers) {
  const List list{numbers_.size(), numbers.size()};
  numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
  return list;
}

void ComplementLayout::place_shares(Front& front, const std::vector<int>& bodies, const std::vector<int>& children) {
  for (int i = 0; i < front.size; ++i) place_[std::size_t(rows(front)[std::size_t(i)])] = i;
  std::vector<int> order, places;
  front.bodies = {shares_.size(), bodies.size()};
  for (const int body : bodies) {
    const std::span<const int> of_body = part(rows_, of_bodies_[std::size_t(body)]);
    const auto place_of = [&](int i) { return place_[std::size_t(of_body[std::size_t(i)])]; };
    order.resize(of_body.size()), places.clear();
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int i, int j) { return place_of(i) < place_of(j); });
    for (const int i : order) places.push_back(place_of(i));
    shares_.push_back({body, keep(order), keep(places)});
  }
  front.children = {shares_.size(), children.size()};
  for (const int c : children) {
    const Front& child = fronts_[std::size_t(c)];
    places.clear();
    for (const int row : rows(child).subspan(std::size_t(child.eliminated))) places.push_back(place_[std::size_t(row)]);
    shares_.push_back({c, {}, keep(places)});
  }
}

}  // namespace trammel::numerics
