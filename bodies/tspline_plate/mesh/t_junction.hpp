// T-junctions, their extensions, and the closure that makes a T-mesh analysis-suitable.
//
// At a T-junction one of the four pieces of a vertex is missing. Its extension runs two bays on where the piece is
// missing (the face extension) and one bay back (the edge extension), for cubics. A mesh is analysis-suitable when no
// extension along u meets one along v; then the blending functions are independent, have a dual basis, and unit weights
// sum to 1. Scott, Li, Sederberg, Hughes, CMAME 213-216, 2012; Beirao da Veiga, Buffa, Sangalli, Vazquez, M3AS 23,
// 2013.
#pragma once

#include "tspline_plate/mesh/t_mesh.hpp"

namespace trammel::plate {

struct TJunction {
  Index2 at;
  int axis, sign;  // the missing piece lies along `axis`, forwards (+1) or backwards (-1)
  bool operator==(const TJunction&) const = default;
};

// A straight piece along `axis`, on line `line` of direction 1 - axis.
struct Extension {
  int axis, line, from, to;
};

std::vector<TJunction> t_junctions(const EdgeMap& edges);
Extension extension(const TMesh& mesh, const TJunction& t);

// Pairs (by number) of T-junctions whose extensions meet.
std::vector<std::array<int, 2>> crossings(const TMesh& mesh, const std::vector<TJunction>& junctions);
inline bool analysis_suitable(const TMesh& mesh) {
  return crossings(mesh, t_junctions(mesh.edges())).empty();
}

// The mesh with all face extensions drawn: its faces are the Bezier cells, where every function is one polynomial.
EdgeMap extended(const TMesh& mesh);

// How to close: every T-junction whose extension meets another is prolonged by one bay until none does; or always only
// the one that leaves the fewest such meetings and elements; or not at all.
enum class Closure { both, greedy, none };
void close(TMesh& mesh, Closure closure);

// How far the face extension of a T-junction reaches, as a line number along its axis.
struct Reach {
  TJunction of;
  int end;
};
std::vector<Reach> reaches(const EdgeMap& edges);

// The refined functions contain the old ones exactly if the extension of every line of the old mesh, from the line's
// present end, reaches as far in its own direction as before; new lines across an extension shorten it. Other
// extensions do not help, because only functions of the line itself continue the old ones beyond its end. Returns the
// T-junctions whose extensions are too short. `edges` number the lines as `before` does.
std::vector<TJunction> too_short(const EdgeMap& edges, const std::vector<Reach>& before);

// Crosses elements and closes the mesh, also where an extension became too short.
// Scott, Thomas, Evans, CMAME 269, 2014.
void refine(TMesh& mesh, std::span<const Box<double>> elements, Closure closure);

}  // namespace trammel::plate
