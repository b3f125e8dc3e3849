#include "tspline_plate/mesh/t_junction.hpp"

#include <algorithm>

namespace trammel::plate {

std::vector<TJunction> t_junctions(const EdgeMap& e) {
  std::vector<TJunction> result;
  for (int j = degree + 1; j < e.lines(1) - 1 - degree; ++j)
    for (int i = degree + 1; i < e.lines(0) - 1 - degree; ++i) {
      const bool left = e.edge(1, j, i - 1), right = e.edge(1, j, i), down = e.edge(0, i, j - 1), up = e.edge(0, i, j);
      if (left + right + down + up != 3) continue;
      const int axis = left && right ? 1 : 0;
      result.push_back({{i, j}, axis, (axis == 0 ? left : down) ? 1 : -1});
    }
  return result;
}

namespace {

Index2 face_end(const EdgeMap& e, const TJunction& t) {
  return e.next(e.next(t.at, t.axis, t.sign), t.axis, t.sign);
}

}  // namespace

Extension extension(const TMesh& mesh, const TJunction& t) {
  const auto a = std::size_t(t.axis);
  const int forward = face_end(mesh.edges(), t)[a], back = mesh.edges().next(t.at, t.axis, -t.sign)[a];
  return {t.axis, t.at[1 - a], std::min(forward, back), std::max(forward, back)};
}

std::vector<std::array<int, 2>> crossings(const TMesh& mesh, const std::vector<TJunction>& junctions) {
  std::vector<Extension> extensions;
  for (const TJunction& t : junctions) extensions.push_back(extension(mesh, t));
  std::vector<std::array<int, 2>> result;
  for (int a = 0; a < int(extensions.size()); ++a) {
    const Extension& along_u = extensions[std::size_t(a)];
    if (along_u.axis != 0) continue;
    for (int b = 0; b < int(extensions.size()); ++b) {
      const Extension& along_v = extensions[std::size_t(b)];
      if (along_v.axis != 1) continue;
      if (along_u.from <= along_v.line && along_v.line <= along_u.to && along_v.from <= along_u.line &&
          along_u.line <= along_v.to)
        result.push_back({a, b});
    }
  }
  return result;
}

EdgeMap extended(const TMesh& mesh) {
  EdgeMap result = mesh.edges();
  for (const TJunction& t : t_junctions(mesh.edges())) {
    const auto a = std::size_t(t.axis);
    const int end = face_end(mesh.edges(), t)[a];
    result.draw(1 - t.axis, t.at[1 - a], std::min(t.at[a], end), std::max(t.at[a], end));
  }
  return result;
}

namespace {

void prolong(TMesh& mesh, const TJunction& t) {
  const auto a = std::size_t(t.axis);
  const int end = mesh.edges().next(t.at, t.axis, t.sign)[a];
  mesh.draw(1 - t.axis, t.at[1 - a], std::min(t.at[a], end), std::max(t.at[a], end));
}

// The present end of the line of `t`, which may have been prolonged. A gap of one bay does not end it, because no line
// in between could change the knots of the functions: they are those of the continuous line.
TJunction line_end(const EdgeMap& edges, TJunction t) {
  const auto a = std::size_t(t.axis);
  const auto goes_on = [&](const Index2& at) {
    return edges.edge(1 - t.axis, at[1 - a], t.sign > 0 ? at[a] : at[a] - 1);
  };
  for (;;) {
    if (goes_on(t.at)) {
      t.at[a] += t.sign;
      continue;
    }
    const Index2 next = edges.next(t.at, t.axis, t.sign);
    if (!goes_on(next)) return t;
    t.at = next;
  }
}

}  // namespace

std::vector<Reach> reaches(const EdgeMap& edges) {
  std::vector<Reach> result;
  for (const TJunction& t : t_junctions(edges)) result.push_back({t, face_end(edges, t)[std::size_t(t.axis)]});
  return result;
}

std::vector<TJunction> too_short(const EdgeMap& edges, const std::vector<Reach>& before) {
  std::vector<TJunction> result;
  for (const Reach& reach : before) {
    const TJunction t = line_end(edges, reach.of);
    const auto a = std::size_t(t.axis);
    const auto missing = [&](int end) { return t.sign * (reach.end - end) > 0; };
    if (missing(t.at[a]) && missing(face_end(edges, t)[a])) result.push_back(t);
  }
  return result;
}

namespace {

// T-junctions that must be prolonged, and how many reasons there are.
struct Conflicts {
  std::vector<TJunction> junctions;
  int reasons = 0;
};

Conflicts conflicts(const TMesh& mesh, const std::vector<Reach>& before) {
  const auto all = t_junctions(mesh.edges());
  const auto pairs = crossings(mesh, all);
  const auto lagging = too_short(mesh.edges(), before);
  std::vector<char> involved(all.size(), 0);
  for (const auto& pair : pairs)
    for (int t : pair) involved[std::size_t(t)] = 1;
  Conflicts result{{}, int(pairs.size() + lagging.size())};
  for (std::size_t t = 0; t < all.size(); ++t)
    if (involved[t] || std::find(lagging.begin(), lagging.end(), all[t]) != lagging.end())
      result.junctions.push_back(all[t]);
  return result;
}

bool is_t_junction(const EdgeMap& e, const TJunction& t) {
  const auto a = std::size_t(t.axis);
  return !e.edge(1 - t.axis, t.at[1 - a], t.sign > 0 ? t.at[a] : t.at[a] - 1);
}

void prolong_cheapest(TMesh& mesh, const Conflicts& found, const std::vector<Reach>& before) {
  const TJunction* best = nullptr;
  std::array<std::size_t, 2> least{};
  for (const TJunction& t : found.junctions) {
    TMesh trial = mesh;
    prolong(trial, t);
    const std::array<std::size_t, 2> cost = {std::size_t(conflicts(trial, before).reasons), trial.elements().size()};
    if (!best || cost < least) best = &t, least = cost;
  }
  prolong(mesh, *best);
}

void close_over(TMesh& mesh, Closure closure, const std::vector<Reach>& before) {
  if (closure == Closure::none) return;
  for (Conflicts found = conflicts(mesh, before); found.reasons > 0; found = conflicts(mesh, before)) {
    if (closure == Closure::greedy) {
      prolong_cheapest(mesh, found, before);
      continue;
    }
    for (const TJunction& t : found.junctions)
      if (is_t_junction(mesh.edges(), t)) prolong(mesh, t);  // one before it may have filled the gap
  }
}

}  // namespace

void close(TMesh& mesh, Closure closure) {
  close_over(mesh, closure, {});
}

void refine(TMesh& mesh, std::span<const Box<double>> elements, Closure closure) {
  EdgeMap before = mesh.edges();
  mesh.cross(elements, &before);
  close_over(mesh, closure, reaches(before));
}

}  // namespace trammel::plate
