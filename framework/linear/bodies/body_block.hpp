// The equations of many bodies, body by body: masses and rows of G as dense blocks, and their products with vectors.
#pragma once

#include <vector>

#include <trammel/types.hpp>

namespace trammel::numerics {

// The part of one body: its mass and its columns of the rows of G that touch it.
struct BodyBlock {
  int v0 = 0;                  // index of its first velocity
  bool constant_mass = false;  // known never to change
  std::vector<int> rows;       // ascending
  Mat Gt;                      // n x rows.size(): its columns of those rows of G, transposed
  Mat M;                       // n x n
  std::vector<char> constant;  // by row: known never to change; empty: none is
  Mat Wt;                      // the same part of W, where it is not G
};

// Prefetches the body's part of G (prefetch.hpp).
void prefetch_rows(const BodyBlock& body);

// rc += c G x,  r += c G^T y,  r += c W^T y,  r += c M a. Rows beyond the length of rc or y are skipped.
void add_rows_times(const std::vector<BodyBlock>& bodies, double c, const Vec& x, Vec& rc);
void add_rows_force(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r);
void add_reaction(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r);
void add_mass_times(const std::vector<BodyBlock>& bodies, double c, const Vec& a, Vec& r);

}  // namespace trammel::numerics
