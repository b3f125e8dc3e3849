// Runs the benchmarks that a file of this folder registers.
#include "main.hpp"

#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  trammel::bench::register_all();
  benchmark::RunSpecifiedBenchmarks();
}
