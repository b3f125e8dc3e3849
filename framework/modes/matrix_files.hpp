// The matrices of a linearisation, for other tools.
//
//     M dv' + D dv + K dq + G^T dlambda = 0,   G dq = 0        all coordinates; dq: increments as velocities (nv)
//     M_r y'' + D_r y' + K_r y = 0,            dq = Z y        independent ones (linearisation.hpp)
//     (y, y')' = A (y, y')                                     A = [0 1; -M_r^-1 K_r  -M_r^-1 D_r]
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modes/linearisation.hpp"

namespace trammel::simulate {

struct Matrices {
  Mat M, D, K, G, M_r, D_r, K_r, Z, A;
  std::vector<std::string> velocities;  // names of dq: "beam[0]"; of the rows of M, D, K, Z and the columns of G
  std::vector<std::string> rows;        // names of the rows of G: "joints.hinge[0]", "contacts.tip.normal"
};
// At `state`, which includes a and lambda, with the system's contacts in its modes. Throws like `linearise`.
Matrices matrices(model::AssembledSystem& system, const State& state);

// Writes FILE.npz with all matrices, each also as FILE_M.mtx, ... (Matrix Market), and the names, one per line, to
// FILE_velocities.txt and FILE_rows.txt. FILE is `file` without an ending .npz or .mtx.
void write_matrices(const std::filesystem::path& file, const Matrices& matrices);

}  // namespace trammel::simulate
