#include "tspline_plate/mesh/t_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace trammel::plate {

namespace {

constexpr const char* axis_name[] = {"u", "v"};

// Distinct knots, ends included, with multiplicities inside: made open.
std::vector<double> opened(std::span<const double> knots, const char* name) {
  if (knots.size() < 2)
    throw std::invalid_argument(fmt::format("{}: found {} knots, expected 2 or more", name, knots.size()));
  for (double k : knots)
    if (!std::isfinite(k)) throw std::invalid_argument(fmt::format("{}: a knot is not finite", name));
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (knots[i] < knots[i - 1])
      throw std::invalid_argument(fmt::format("{}: knots must ascend; {} follows {}", name, knots[i], knots[i - 1]));
    const bool end = knots[i] == knots.front() || knots[i - 1] == knots.back();
    if (knots[i] == knots[i - 1] && end)
      throw std::invalid_argument(
          fmt::format("{}: the end {} is given more than once; it is repeated by itself", name, knots[i]));
    if (i >= 2 && knots[i] == knots[i - 2])
      throw std::invalid_argument(
          fmt::format("{}: the knot {} stands three times, a C0 line; a plate needs C1: two at most", name, knots[i]));
  }
  std::vector<double> result(knots.begin(), knots.end());
  result.insert(result.begin(), degree, knots.front());
  result.insert(result.end(), degree, knots.back());
  return result;
}

}  // namespace

TMesh::TMesh(std::vector<double> u, std::vector<double> v)
    : knots_{std::move(u), std::move(v)}, edges_(int(knots_[0].size()), int(knots_[1].size())) {}

TMesh TMesh::tensor(std::span<const double> u, std::span<const double> v, std::span<const PartialLine> partial) {
  TMesh mesh(opened(u, "u"), opened(v, "v"));
  const auto is_partial = [&](int d, int line) {
    return std::any_of(partial.begin(), partial.end(),
                       [&](const PartialLine& p) { return p.direction == d && p.line + degree == line; });
  };
  for (int d : {0, 1})
    for (int line = 0; line < mesh.edges_.lines(d); ++line)
      if (!is_partial(d, line)) mesh.edges_.draw(d, line, 0, mesh.edges_.lines(1 - d) - 1);
  for (const PartialLine& p : partial) {
    const int last = mesh.edges_.lines(p.direction) - 1 - 2 * degree,
              end = mesh.edges_.lines(1 - p.direction) - 1 - 2 * degree;
    if (p.line <= 0 || p.line >= last || p.from < 0 || p.to > end || p.from >= p.to)
      throw std::invalid_argument(
          fmt::format("line {} = {} from {} to {}: expected a line between 1 and {}, from < to within 0 to {}",
                      axis_name[p.direction], p.line, p.from, p.to, last - 1, end));
    mesh.draw(p.direction, p.line + degree, p.from + degree, p.to + degree);
  }
  mesh.check();
  return mesh;
}

TMesh TMesh::uniform(int elements_u, int elements_v) {
  const auto even = [](int n) {
    std::vector<double> knots;
    for (int i = 0; i <= n; ++i) knots.push_back(double(i) / n);
    return knots;
  };
  return tensor(even(elements_u), even(elements_v));
}

void TMesh::shift(double by) {
  for (double& u : knots_[0]) u += by;
}

// Every inner point is crossed by nothing, by one straight line, or is a vertex with three or four pieces.
void TMesh::check() const {
  for (int j = degree + 1; j < edges_.lines(1) - 1 - degree; ++j)
    for (int i = degree + 1; i < edges_.lines(0) - 1 - degree; ++i) {
      const int along_u = edges_.edge(1, j, i - 1) + edges_.edge(1, j, i);
      const int along_v = edges_.edge(0, i, j - 1) + edges_.edge(0, i, j);
      const bool straight = along_u % 2 == 0 && along_v % 2 == 0;
      if (straight || along_u + along_v == 3) continue;
      throw std::invalid_argument(fmt::format("a line {} at (u, v) = ({}, {}); expected it to end on another line",
                                              along_u + along_v == 1 ? "ends in the open" : "turns a corner",
                                              knot(0, i), knot(1, j)));
    }
}

std::vector<Box<int>> TMesh::elements() const {
  auto faces = edges_.faces(degree);
  std::erase_if(faces, [&](const Box<int>& f) {
    return knot(0, f.low[0]) == knot(0, f.high[0]) || knot(1, f.low[1]) == knot(1, f.high[1]);
  });
  return faces;
}

Box<double> TMesh::parameters(const Box<int>& box) const {
  return {{knot(0, box.low[0]), knot(1, box.low[1])}, {knot(0, box.high[0]), knot(1, box.high[1])}};
}

Box<int> TMesh::indices(const Box<double>& box) const {
  Box<int> result{};
  for (std::size_t d : {0, 1}) {
    const auto& k = knots_[d];
    result.low[d] = int(std::upper_bound(k.begin(), k.end(), box.low[d]) - k.begin()) - 1;
    result.high[d] = int(std::lower_bound(k.begin(), k.end(), box.high[d]) - k.begin());
  }
  return result;
}

void TMesh::draw(int d, int line, int from, int to) {
  const int last = edges_.lines(1 - d) - 1;
  if (from == degree) from = 0;
  if (to == last - degree) to = last;
  edges_.draw(d, line, from, to);
}

int TMesh::middle_line(int d, double low, double high, EdgeMap* alongside) {
  auto& knots = knots_[std::size_t(d)];
  const double middle = low + (high - low) / 2, near = (high - low) / 4;
  int best = -1;
  for (int i = 0; i < int(knots.size()); ++i) {
    const double distance = std::abs(knot(d, i) - middle);
    if (distance <= near && (best < 0 || distance < std::abs(knot(d, best) - middle))) best = i;
  }
  if (best >= 0) return best;
  const int after = int(std::upper_bound(knots.begin(), knots.end(), middle) - knots.begin()) - 1;
  knots.insert(knots.begin() + after + 1, middle);
  edges_.insert_line(d, after);
  if (alongside) alongside->insert_line(d, after);
  return after + 1;
}

void TMesh::cross(std::span<const Box<double>> elements, EdgeMap* alongside) {
  for (const auto& element : elements) {
    const int middle_u = middle_line(0, element.low[0], element.high[0], alongside);
    const int middle_v = middle_line(1, element.low[1], element.high[1], alongside);
    const Box<int> box = indices(element);
    draw(0, middle_u, box.low[1], box.high[1]);
    draw(1, middle_v, box.low[0], box.high[0]);
  }
}

}  // namespace trammel::plate
