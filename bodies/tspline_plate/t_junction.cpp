#include "t_junction.hpp"

#include <algorithm>

namespace trammel::plate {

std::vector<TJunction> t_junctions(const TMesh& mesh) {
  const EdgeMap& e = mesh.edges();
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
  for (const TJunction& t : t_junctions(mesh)) {
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

// `covered` goes on from the T-junction beyond its face extension.
bool too_short(const EdgeMap& edges, const TJunction& t, const EdgeMap& covered) {
  const auto a = std::size_t(t.axis);
  const int end = face_end(edges, t)[a];
  return covered.edge(1 - t.axis, t.at[1 - a], t.sign > 0 ? end : end - 1);
}

// T-junctions that must be prolonged, and how many reasons there are.
struct Conflicts {
  std::vector<TJunction> junctions;
  int reasons = 0;
};

Conflicts conflicts(const TMesh& mesh, const EdgeMap* covered) {
  const auto all = t_junctions(mesh);
  const auto pairs = crossings(mesh, all);
  std::vector<char> involved(all.size(), 0);
  for (const auto& pair : pairs)
    for (int t : pair) involved[std::size_t(t)] = 1;
  Conflicts result{{}, int(pairs.size())};
  for (std::size_t t = 0; t < all.size(); ++t) {
    const bool lags = covered && too_short(mesh.edges(), all[t], *covered);
    if (lags) ++result.reasons;
    if (lags || involved[t]) result.junctions.push_back(all[t]);
  }
  return result;
}

bool is_t_junction(const EdgeMap& e, const TJunction& t) {
  const auto a = std::size_t(t.axis);
  return !e.edge(1 - t.axis, t.at[1 - a], t.sign > 0 ? t.at[a] : t.at[a] - 1);
}

void prolong_cheapest(TMesh& mesh, const Conflicts& found, const EdgeMap* covered) {
  const TJunction* best = nullptr;
  std::array<std::size_t, 2> least{};
  for (const TJunction& t : found.junctions) {
    TMesh trial = mesh;
    prolong(trial, t);
    const std::array<std::size_t, 2> cost = {std::size_t(conflicts(trial, covered).reasons), trial.elements().size()};
    if (!best || cost < least) best = &t, least = cost;
  }
  prolong(mesh, *best);
}

void close_over(TMesh& mesh, Closure closure, const EdgeMap* covered) {
  if (closure == Closure::none) return;
  for (Conflicts found = conflicts(mesh, covered); found.reasons > 0; found = conflicts(mesh, covered)) {
    if (closure == Closure::greedy) {
      prolong_cheapest(mesh, found, covered);
      continue;
    }
    for (const TJunction& t : found.junctions)
      if (is_t_junction(mesh.edges(), t)) prolong(mesh, t);  // one before it may have filled the gap
  }
}

}  // namespace

void close(TMesh& mesh, Closure closure) {
  close_over(mesh, closure, nullptr);
}

void refine(TMesh& mesh, std::span<const Box<double>> elements, Closure closure) {
  EdgeMap covered = extended(mesh);
  mesh.cross(elements, &covered);
  close_over(mesh, closure, &covered);
}

}  // namespace trammel::plate
