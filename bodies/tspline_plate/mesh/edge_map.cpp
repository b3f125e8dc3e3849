#include "tspline_plate/mesh/edge_map.hpp"

namespace trammel::plate {

EdgeMap::EdgeMap(int lines_u, int lines_v) : lines_{lines_u, lines_v} {
  for (std::size_t d : {0, 1}) pieces_[d].assign(std::size_t(lines_[d] * (lines_[1 - d] - 1)), 0);
}

void EdgeMap::draw(int d, int line, int from, int to) {
  for (int piece = from; piece < to; ++piece) pieces_[std::size_t(d)][at(d, line, piece)] = 1;
}

void EdgeMap::insert_line(int d, int after) {
  const int along = lines(1 - d) - 1;
  auto& own = pieces_[std::size_t(d)];
  own.insert(own.begin() + (after + 1) * along, std::size_t(along), 0);

  // The lines of the other direction have one piece more: the one that was cut stands twice.
  const auto& old = pieces_[std::size_t(1 - d)];
  std::vector<char> fresh;
  fresh.reserve(old.size() + std::size_t(lines(1 - d)));
  const int pieces = lines(d) - 1;
  for (int line = 0; line < lines(1 - d); ++line)
    for (int piece = 0; piece < pieces; ++piece) {
      const char drawn = old[std::size_t(line * pieces + piece)];
      fresh.push_back(drawn);
      if (piece == after) fresh.push_back(drawn);
    }
  pieces_[std::size_t(1 - d)] = std::move(fresh);
  ++lines_[std::size_t(d)];
}

Index2 EdgeMap::next(Index2 from, int axis, int sign) const {
  const auto a = std::size_t(axis);
  const int across = from[1 - a];
  do {
    from[a] += sign;
  } while (from[a] > 0 && from[a] < lines_[a] - 1 && !touches(axis, from[a], across));
  return from;
}

std::vector<Box<int>> EdgeMap::faces(int low) const {
  const int end_u = lines(0) - 1 - low, end_v = lines(1) - 1 - low;
  std::vector<char> taken(std::size_t(lines(0) * lines(1)), 0);
  std::vector<Box<int>> result;
  for (int j = low; j < end_v; ++j)
    for (int i = low; i < end_u; ++i) {
      if (taken[std::size_t(j * lines(0) + i)]) continue;
      Box<int> face{{i, j}, {i + 1, j + 1}};
      while (face.high[0] < end_u && !edge(0, face.high[0], j)) ++face.high[0];
      while (face.high[1] < end_v && !edge(1, face.high[1], i)) ++face.high[1];
      for (int t = face.low[1]; t < face.high[1]; ++t)
        for (int s = face.low[0]; s < face.high[0]; ++s) taken[std::size_t(t * lines(0) + s)] = 1;
      result.push_back(face);
    }
  return result;
}

}  // namespace trammel::plate
