// The unit pieces of lines that are drawn in an axis-aligned T-mesh, in index space.
//
// Lines of direction 0 are u = const, of direction 1 v = const; each direction counts its lines 0, 1, 2, ... A line of
// direction d runs along the other axis 1 - d; its piece s lies between lines s and s + 1 of that direction. A point of
// index space is {i, j}: line i of direction 0 meets line j of direction 1.
#pragma once

#include <array>
#include <vector>

namespace trammel::plate {

using Index2 = std::array<int, 2>;

// A rectangle of index space, or of the parameters (u, v).
template <class T>
struct Box {
  std::array<T, 2> low, high;
  bool operator==(const Box&) const = default;
};

class EdgeMap {
 public:
  EdgeMap(int lines_u, int lines_v);  // nothing drawn

  int lines(int d) const { return lines_[std::size_t(d)]; }
  bool edge(int d, int line, int piece) const {
    return piece >= 0 && piece < lines(1 - d) - 1 && pieces_[std::size_t(d)][at(d, line, piece)] != 0;
  }
  void draw(int d, int line, int from, int to);
  void insert_line(int d, int after);  // a new line next to `after`, without drawn pieces

  // A piece of this line begins or ends where it meets line `across` of the other direction.
  bool touches(int d, int line, int across) const { return edge(d, line, across - 1) || edge(d, line, across); }
  // From `from` along `axis`, forwards or backwards by `sign`, to the first line that touches the ray.
  Index2 next(Index2 from, int axis, int sign) const;

  // The faces inside the box of lines `low` to lines - 1 - low, by rows. The map must be free of dangling pieces.
  std::vector<Box<int>> faces(int low) const;

 private:
  std::size_t at(int d, int line, int piece) const { return std::size_t(line * (lines(1 - d) - 1) + piece); }
  Index2 lines_;
  std::array<std::vector<char>, 2> pieces_;
};

}  // namespace trammel::plate
