#include "formats/run_formats.hpp"

#include <algorithm>
#include <array>

namespace trammel::formats {

namespace {

constexpr std::array all = {RunFormat{"npz", "series.npz and events.npz, for numpy.load", write_npz},
                            RunFormat{"vtu", "animation.pvd and fields.pvd, for ParaView", write_vtu}};

}  // namespace

std::span<const RunFormat> run_formats() {
  return all;
}

const RunFormat* find_run_format(std::string_view name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const RunFormat& format) { return format.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace trammel::formats
