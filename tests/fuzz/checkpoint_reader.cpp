// The reader of checkpoints: any bytes are read, or refused with an error. The second reading has a checksum that fits,
// as somebody who forges a checkpoint would make it.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulate/results/checkpoint.hpp"
#include "scene/fnv_hash.hpp"

namespace {

using namespace trammel;
using namespace trammel::simulate;

constexpr std::uint64_t scene_hash = 7;

// Every value as every type: one fits, the others are refused.
template <class T>
void read_as(nlohmann::json& data, const std::string& name) {
  T value{};
  try {
    JsonArchive(data, JsonArchive::Direction::read)(name, value);
  } catch (const nlohmann::json::exception&) {
  } catch (const std::range_error&) {
  } catch (const std::length_error&) {
  }
}

void read(const std::string& bytes) {
  try {
    nlohmann::json data = decode_checkpoint(bytes, "checkpoint.cbor", scene_hash);
    std::vector<std::string> names;
    for (const auto& [name, value] : data.items()) names.push_back(name);
    for (const std::string& name : names) {
      read_as<bool>(data, name), read_as<int>(data, name), read_as<long long>(data, name), read_as<double>(data, name);
      read_as<std::string>(data, name), read_as<Vec>(data, name);
      read_as<std::vector<Vec>>(data, name.substr(0, name.rfind('.')));
    }
    try {
      JsonArchive(data, JsonArchive::Direction::read).require_lengths({3, 2, 1});
    } catch (const std::length_error&) {
    }
  } catch (const scene::SceneError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read(std::string(reinterpret_cast<const char*>(data), size));
  scene::FnvHash sum;
  sum.bytes(data, size);
  const nlohmann::json forged = {{"trammel_checkpoint", checkpoint_format},
                                 {"scene_hash", scene_hash},
                                 {"checksum", sum.value()},
                                 {"content", nlohmann::json::binary({data, data + size})}};
  const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(forged);
  read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return 0;
}
