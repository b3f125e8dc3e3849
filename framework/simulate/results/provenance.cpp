#include "simulate/results/provenance.hpp"

#include <chrono>
#include <filesystem>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <trammel/plugin.hpp>

#include "trammel_commit.hpp"  // made by framework/cmake/Commit.cmake

namespace trammel::simulate {

using json = nlohmann::ordered_json;

#if defined(__clang__)
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "gcc " __VERSION__;
#endif

BuildInfo build_info() {
  return {TRAMMEL_VERSION, TRAMMEL_COMMIT, TRAMMEL_BUILD_TYPE, *TRAMMEL_ARCH ? TRAMMEL_ARCH : "the compiler's default",
          compiler,        TRAMMEL_FLAGS};
}

json program_json() {
  const BuildInfo build = build_info();
  return {{"version", build.version},       {"commit", build.commit},
          {"build_type", build.build_type}, {"instruction_set", build.instruction_set},
          {"compiler", build.compiler},     {"flags", build.flags}};
}

json libraries_json(const std::vector<plugin::Identity>& plugins) {
  json libraries = json::array();
  for (const plugin::Identity& library : plugins)
    libraries.push_back({{"name", std::filesystem::path(library.file).stem().string()},
                         {"file", library.file},
                         {"sdk", library.sdk},
                         {"compiler", library.compiler},
                         {"hash", fmt::format("{:016x}", library.hash)}});
  return libraries;
}

std::string host_instruction_set() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const auto all = [](auto... has) { return (... && (has != 0)); };
  if (!all(__builtin_cpu_supports("sse4.2"), __builtin_cpu_supports("popcnt"), __builtin_cpu_supports("ssse3")))
    return "x86-64";
  if (!all(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("fma"), __builtin_cpu_supports("bmi2")))
    return "x86-64-v2";
  if (!all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512bw"), __builtin_cpu_supports("avx512cd"),
           __builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512vl")))
    return "x86-64-v3";
  return "x86-64-v4";
#else
  return "unknown";
#endif
}

std::string utc_now() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

json provenance(const scene::Scene& scene, const std::vector<std::string>& command,
                const std::vector<plugin::Identity>& plugins) {
  json set = json::array();
  for (const scene::Override& override : scene.overrides()) set.push_back(override.path + "=" + override.value);
  return {{"made",
           {{"command", command},
            {"set", set},
            {"date", utc_now()},
            {"program", program_json()},
            {"host", {{"instruction_set", host_instruction_set()}}}}},
          {"versions",
           {{"trammel_sdk", fmt::format("{}.{}", TRAMMEL_SDK_MAJOR, TRAMMEL_SDK_MINOR)},
            {"compiler", __VERSION__},
            {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}}},
          {"plugins", libraries_json(plugins)}};
}

}  // namespace trammel::simulate
