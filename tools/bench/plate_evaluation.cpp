// What one evaluation of the T-spline plate costs, in all and per quadrature point: force, tangent of the cells, a
// refinement.
//
//     tools/bench/run plate_evaluation
//
// The target is a tangent under 2 us per quadrature point; a plain loop over the same formulas takes 2.5 to 4.3 us,
// force
// 0.17 to 0.25 us (Xeon 2.5 GHz, 3 x 3 points a cell).
#include <string>

#include <benchmark/benchmark.h>

#include "main.hpp"
#include "tspline_plate/shell/cell_forces.hpp"
#include "tspline_plate/plate.hpp"

namespace trammel::plate {
namespace {

std::unique_ptr<TsplinePlate> clamped(int n) {
  auto plate = std::make_unique<TsplinePlate>();
  plate->sole_patch.along_u = Eigen::Vector3d(2, 0, 0), plate->sole_patch.along_v = Eigen::Vector3d(0, 2, 0);
  plate->sole_patch.elements = std::to_string(n) + "x" + std::to_string(n);
  plate->thickness = 0.1, plate->youngs_modulus = 2e7, plate->density = 7810;
  plate->sole_patch.edge_u0 = plate->sole_patch.edge_u1 = plate->sole_patch.edge_v0 = plate->sole_patch.edge_v1 =
      "clamped";
  plate->prepare({Space::spatial, Eigen::Vector3d(0, 0, -9.81)});
  return plate;
}

void count_points(benchmark::State& state, const TsplinePlate& plate) {
  double points = 0;
  for (const Cell& cell : plate.mesh().cells) points += double(cell.points.size());
  state.counters["per_point"] =
      benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void force(benchmark::State& state) {
  const auto plate = clamped(int(state.range(0)));
  const Vec q = Vec::LinSpaced(plate->coordinates().nq(), -0.01, 0.02), v = Vec::Zero(q.size());
  Vec f = v;
  for (auto _ : state) {
    plate->force(0, q, v, f);
    benchmark::ClobberMemory();
  }
  count_points(state, *plate);
}

void tangent_of_cells(benchmark::State& state) {
  const auto plate = clamped(int(state.range(0)));
  const Vec q = Vec::LinSpaced(plate->coordinates().nq(), -0.01, 0.02);
  CellVectors u;
  Mat block(3 * most_functions, 3 * most_functions);
  for (auto _ : state) {
    for (const Cell& cell : plate->mesh().cells) {
      gather(cell, q, u);
      cell_tangent(cell, u, nullptr, 0, {1, 0, 1e-6}, 0, block.data());
    }
    benchmark::ClobberMemory();
  }
  count_points(state, *plate);
}

// The mesh of the ball example: the four elements round the centre.
void refinement(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    const auto plate = clamped(int(state.range(0)));
    const TMesh& mesh = plate->mesh().basis.patch(0).mesh();
    const auto faces = mesh.elements();
    std::vector<Box<double>> boxes;
    for (std::size_t e : {44, 45, 54, 55}) boxes.push_back(mesh.parameters(faces[e]));
    state.ResumeTiming();
    benchmark::DoNotOptimize(plate->refine_elements_in(boxes));
  }
}

void register_benchmarks() {
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("force", force)->Arg(10)->Arg(14)->Arg(40)->Unit(benchmark::kMicrosecond);
  RegisterBenchmark("tangent_of_cells", tangent_of_cells)->Arg(10)->Arg(14)->Arg(40)->Unit(benchmark::kMicrosecond);
  RegisterBenchmark("refinement", refinement)->Arg(10)->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace trammel::plate

void trammel::bench::register_all() {
  plate::register_benchmarks();
}
