// What one evaluation of the flexible beam costs: M and f, the tangent, a marker. Per number of modes (axial =
// transverse).
//
//     tools/bench/run beam_evaluation --benchmark_filter=full
//
// A hand-written tensor code takes 0.14, 0.46, 1.17, 2.7 us for M and f at N = 3, 5, 7, 9 (Xeon 2.5 GHz, -ffast-math).
#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "../../bodies/assumed_mode_beam/beam.hpp"
#include "main.hpp"

namespace trammel::beam {
namespace {

// A beam in mid-swing, and where to put what it says.
struct Bench {
  AssumedModeBeam beam;
  Vec q, v, a, f;
  Mat S;

  Bench(int N, Coupling coupling) {
    beam.length = 1, beam.area = 3.14e-4, beam.second_moment = 7.85e-9;
    beam.density = 2766.7, beam.youngs_modulus = 6.8952e10;
    beam.axial_modes = beam.transverse_modes = N;
    beam.coupling = coupling;
    beam.hinge = Vec3(Eigen::Vector2d(0, 0));
    beam.prepare({Space::planar, Eigen::Vector2d(0, -9.81)});
    const int n = beam.coordinates().nv();
    q = Vec::LinSpaced(n, 1e-3, -2e-3), v = Vec::LinSpaced(n, -1, 1.5), a = Vec::LinSpaced(n, 20, -30);
    f = Vec::Zero(n), S = Mat::Zero(n, n);
  }
};

void mass_and_force(benchmark::State& state, Bench b) {
  Matrix M = Matrix::onto(b.S);
  for (auto _ : state) {
    b.beam.mass_and_force(0, b.q, b.v, M, b.f);
    benchmark::ClobberMemory();
  }
}

void tangent(benchmark::State& state, Bench b) {
  Matrix S = Matrix::onto(b.S);
  for (auto _ : state) {
    b.beam.add_tangent(0, b.q, b.v, b.a, {1, 1e-3, 1e-6}, S);
    benchmark::ClobberMemory();
  }
}

void tip_motion(benchmark::State& state, Bench b) {
  Motion tip;
  for (auto _ : state) {
    b.beam.motion(1, 0, b.q, b.v, tip);
    benchmark::ClobberMemory();
  }
}

void register_benchmarks() {
  const std::pair<const char*, void (*)(benchmark::State&, Bench)> functions[] = {
      {"mass_and_force", mass_and_force}, {"tangent", tangent}, {"tip_motion", tip_motion}};
  const std::pair<const char*, Coupling> couplings[] = {
      {"full", Coupling::full}, {"linear", Coupling::linear}, {"none", Coupling::none}};
  for (const auto& [name, function] : functions)
    for (const auto& [coupling_name, coupling] : couplings)
      for (const int N : {3, 5, 7, 9, 15, 20, 30})
        benchmark::RegisterBenchmark((std::string(name) + "/" + coupling_name + "/" + std::to_string(N)).c_str(),
                                     [=](benchmark::State& state) { function(state, Bench(N, coupling)); });
}

}  // namespace
}  // namespace trammel::beam

void trammel::bench::register_all() {
  beam::register_benchmarks();
}
