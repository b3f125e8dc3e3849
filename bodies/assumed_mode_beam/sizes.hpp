// Lengths of the beam's loops: each is an int, or known to the compiler, because for the usual few modes the overhead
// of a loop costs as much as its body (tools/bench/README.md).
#pragma once

#include "vector_loops.hpp"

namespace trammel::beam {

template <class Modes, class Length, class Row>
struct Sizes {
  Modes n_axial, N;
  Length size;  // of the basis of the foreshortening's functions, 0 without; inertia_basis.hpp
  Row row;      // of these functions' rows

  // Places of theta, A_i and B_i in a matrix counted from A_1's entry.
  static constexpr int theta = -1;
  static constexpr int A(int i) { return i; }
  constexpr int B(int i) const { return n_axial + i; }
};
using AnySizes = Sizes<int, int, int>;
template <int modes, int size>
using KnownSizes = Sizes<Fixed<modes>, Fixed<size>, Fixed<size + padded(modes)>>;

// Calls f(sizes) with compile-time sizes where there are such.
template <class F>
void with_known(const AnySizes& any, F&& f) {
  const auto are = [&](const auto& known) {
    return any.N == known.N && any.n_axial == known.n_axial && any.size == known.size && any.row == known.row;
  };
  if (const KnownSizes<3, 8> known; are(known)) return f(known);
  if (const KnownSizes<5, 16> known; are(known)) return f(known);
  if (const KnownSizes<7, 24> known; are(known)) return f(known);
  if (const KnownSizes<9, 32> known; are(known)) return f(known);
  f(any);
}

}  // namespace trammel::beam
