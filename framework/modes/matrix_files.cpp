#include "modes/matrix_files.hpp"

#include <array>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <trammel/decompositions.hpp>

#include "simulate/results/log_file.hpp"
#include "simulate/results/npz.hpp"

namespace trammel::simulate {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> velocity_names(const model::Model& model) {
  std::vector<std::string> names;
  for (const model::BodyEntry& body : model.bodies)
    for (int i = 0; i < body.nv; ++i) names.push_back(fmt::format("{}[{}]", body.name, i));
  return names;
}

std::vector<std::string> row_names(model::AssembledSystem& system) {
  std::vector<std::string> names(std::size_t(system.sizes().nc));
  for (const model::RowGroup& group : model::row_groups(system.model()))
    for (int i = 0; i < group.count; ++i) names[std::size_t(group.first + i)] = fmt::format("{}[{}]", group.path, i);
  constexpr std::array directions = {"normal", "tangent_1", "tangent_2"};
  const auto& contacts = system.model().contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (k == 0 || system.modes().contacts[i].friction == model::ContactMode::Friction::stick)
        if (const int row = k <= system.tangents(int(i)) ? system.row({int(i), k}) : -1; row >= 0)
          names[std::size_t(row)] = fmt::format("{}.{}", contacts[i].path(), directions[std::size_t(k)]);
  return names;
}

// Non-zero entries by columns, counted from 1.
std::string matrix_market(const Mat& A, const std::string& what) {
  std::string entries;
  long long count = 0;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      if (A(i, j) != 0) fmt::format_to(std::back_inserter(entries), "{} {} {:.17g}\n", i + 1, j + 1, A(i, j)), ++count;
  return fmt::format("%%MatrixMarket matrix coordinate real general\n% {}\n{} {} {}\n{}", what, A.rows(), A.cols(),
                     count, entries);
}

struct Named {
  const char* name;
  const Mat* matrix;
  const char* what;
};
std::array<Named, 9> all_of(const Matrices& m) {
  return {Named{"M", &m.M, "mass matrix"},
          Named{"D", &m.D, "damping and gyroscopic matrix"},
          Named{"K", &m.K, "stiffness matrix, with that of the constraints' forces"},
          Named{"G", &m.G, "rows of the constraints"},
          Named{"M_r", &m.M_r, "mass matrix of independent coordinates y, dq = Z y"},
          Named{"D_r", &m.D_r, "damping and gyroscopic matrix of y"},
          Named{"K_r", &m.K_r, "stiffness matrix of y"},
          Named{"Z", &m.Z, "dq = Z y"},
          Named{"A", &m.A, "(y, y')' = A (y, y')"}};
}

void add(simulate::NpzFile& npz, const char* name, const Mat& A) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_rows = A;
  npz.add(name, {std::size_t(A.rows()), std::size_t(A.cols())},
          std::span<const double>(by_rows.data(), std::size_t(by_rows.size())));
}

fs::path stem(fs::path file) {
  if (file.extension() == ".npz" || file.extension() == ".mtx") file.replace_extension();
  return file;
}

}  // namespace

Matrices matrices(model::AssembledSystem& system, const State& state) {
  const simulate::Linearisation l = simulate::linearise(system, state);
  Matrices all;
  all.M_r = l.M, all.D_r = l.D, all.K_r = l.K, all.Z = l.Z;
  const Eigen::Index m = l.M.rows();
  all.A = Mat::Zero(2 * m, 2 * m);
  if (m > 0) {
    const Eigen::PartialPivLU<Mat> M(l.M);
    all.A.topRightCorner(m, m).setIdentity();
    all.A.bottomLeftCorner(m, m) = -M.solve(l.K);
    all.A.bottomRightCorner(m, m) = -M.solve(l.D);
  }
  system.move_to(state.t, state.q, state.v);
  all.M = simulate::tangent(system, {1, 0, 0}, state);
  all.D = simulate::tangent(system, {0, 1, 0}, state);
  all.K = simulate::tangent(system, {0, 0, 1}, state);
  system.move_to(state.t, state.q, state.v);
  all.G = Mat(system.sparse_rows());
  all.velocities = velocity_names(system.model());
  all.rows = row_names(system);
  return all;
}

void write_matrices(const fs::path& file, const Matrices& m) {
  const std::string base = stem(file).string();
  if (stem(file).has_parent_path()) fs::create_directories(stem(file).parent_path());
  simulate::NpzFile npz(base + ".npz");
  for (const Named& one : all_of(m)) {
    add(npz, one.name, *one.matrix);
    simulate::write_whole(fmt::format("{}_{}.mtx", base, one.name), matrix_market(*one.matrix, one.what));
  }
  npz.add("velocities", std::span<const std::string>(m.velocities));
  npz.add("rows", std::span<const std::string>(m.rows));
  npz.close();
  simulate::write_whole(base + "_velocities.txt", fmt::format("{}\n", fmt::join(m.velocities, "\n")));
  simulate::write_whole(base + "_rows.txt", fmt::format("{}\n", fmt::join(m.rows, "\n")));
}

}  // namespace trammel::simulate
