// Runs `trammel modes` in this process, for its tests.
#pragma once

#include <vector>

#include "modes/modal_analysis.hpp"
#include "run_scene.hpp"

namespace trammel::test {

struct Modes {
  nlohmann::json result;
  std::string shapes;
  double frequency(std::size_t mode) const { return result["modes"].at(mode)["frequency_rad_s"]; }
  double real(std::size_t mode) const { return result["modes"].at(mode)["eigenvalue"]["real"]; }
  std::string kind(std::size_t mode) const { return result["modes"].at(mode)["kind"]; }
  std::size_t count() const { return result["modes"].size(); }
  std::vector<std::string> kinds() const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < count(); ++i) all.push_back(kind(i));
    return all;
  }
  std::vector<double> oscillations() const {  // [rad/s] frequencies of modes of the kind "oscillation", ascending
    std::vector<double> all;
    for (std::size_t i = 0; i < count(); ++i)
      if (kind(i) == "oscillation") all.push_back(frequency(i));
    return all;
  }
  double growth() const {  // [1/s] rate of the fastest growing mode; 0: none grows
    double most = 0;
    for (std::size_t i = 0; i < count(); ++i) most = std::max(most, real(i));
    return most;
  }
};

Modes modes_of(const scene::Scene& scene, simulate::ModesOptions options = {});
Modes modes_of(const std::string& text, const Overrides& overrides = {}, simulate::ModesOptions options = {});
Modes modes_of_file(const std::string& file, const Overrides& overrides, simulate::ModesOptions options = {});

}  // namespace trammel::test
