#include "simulate/checkpoint.hpp"

#include <bit>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "scene/no_memory.hpp"
#include "simulate/log_file.hpp"

namespace trammel::simulate {
namespace {

using nlohmann::json;

// Fowler, Noll, Vo: FNV-1a, 64 bits.
class Hash {
 public:
  void bytes(const void* data, std::size_t size) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3ULL;
  }
  void text(std::string_view s) {
    number(s.size());
    bytes(s.data(), s.size());
  }
  void number(std::uint64_t x) { bytes(&x, sizeof x); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

void add(Hash& hash, const scene::Value& value) {
  using Type = scene::Value::Type;
  if (value.path() == "simulate.until") return;
  hash.number(static_cast<std::uint64_t>(value.type()));
  scene::Problems ignored;
  switch (value.type()) {
    case Type::null:
      break;
    case Type::boolean:
      hash.number(value.boolean());
      break;
    case Type::number:
      hash.number(std::bit_cast<std::uint64_t>(value.read_number(ignored).value_or(0)));
      break;
    case Type::text:
      hash.text(value.text());
      break;
    case Type::array:
      hash.number(value.items().size());
      for (const scene::Value& item : value.items()) add(hash, item);
      break;
    case Type::object:
      hash.number(value.members().size());
      for (const auto& [key, member] : value.members()) {
        hash.text(key);
        add(hash, member);
      }
      break;
  }
}

std::uint64_t checksum(const std::vector<std::uint8_t>& data) {
  Hash hash;
  hash.bytes(data.data(), data.size());
  return hash.value();
}

constexpr int format = 2;

}  // namespace

template <class T>
void JsonArchive::transfer(std::string_view name, T& value) {
  if (direction_ == Direction::write) {
    if (!data_.emplace(std::string(name), value).second)
      throw std::logic_error(fmt::format("\"{}\" is archived twice", name));  // one would be lost
  } else {
    value = data_.at(std::string(name)).get<T>();
  }
}

void JsonArchive::operator()(std::string_view name, bool& value) {
  transfer(name, value);
}
void JsonArchive::operator()(std::string_view name, int& value) {
  transfer(name, value);
}
void JsonArchive::operator()(std::string_view name, long long& value) {
  transfer(name, value);
}
void JsonArchive::operator()(std::string_view name, std::string& value) {
  transfer(name, value);
}

// As 64 bits: JSON would lose the payload of NaN.
void JsonArchive::operator()(std::string_view name, double& value) {
  auto bits = std::bit_cast<std::uint64_t>(value);
  transfer(name, bits);
  value = std::bit_cast<double>(bits);
}

void JsonArchive::operator()(std::string_view name, Vec& value) {
  std::vector<std::uint64_t> bits(std::size_t(value.size()));
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = std::bit_cast<std::uint64_t>(value[Eigen::Index(i)]);
  transfer(name, bits);
  value.resize(Eigen::Index(bits.size()));
  for (std::size_t i = 0; i < bits.size(); ++i) value[Eigen::Index(i)] = std::bit_cast<double>(bits[i]);
}

JsonArchive JsonArchive::nested(std::string_view name) {
  json& inner =
      direction_ == Direction::write ? (data_[std::string(name)] = json::object()) : data_.at(std::string(name));
  return {inner, direction_};
}

std::uint64_t resume_hash(const scene::Value& root) {
  Hash hash;
  add(hash, root);
  return hash.value();
}

void write_checkpoint(const std::filesystem::path& file, std::uint64_t scene_hash, const json& data) {
  const std::vector<std::uint8_t> content = json::to_cbor(data);
  const json whole = {{"trammel_checkpoint", format},
                      {"scene_hash", scene_hash},
                      {"checksum", checksum(content)},
                      {"content", json::binary(content)}};
  const std::vector<std::uint8_t> bytes = json::to_cbor(whole);
  write_whole(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

json read_checkpoint(const std::filesystem::path& file, std::uint64_t scene_hash) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    scene::require_memory(errno);
    refuse_checkpoint(file, "there is no checkpoint to resume from");
  }
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const json whole = json::from_cbor(bytes, true, false);
  const bool complete = whole.is_object() && whole.contains("trammel_checkpoint") && whole.contains("scene_hash") &&
                        whole.contains("checksum") && whole.contains("content") && whole["content"].is_binary();
  if (!complete) refuse_checkpoint(file, "the file is damaged or no checkpoint; start the run anew");
  if (whole["trammel_checkpoint"] != format)
    refuse_checkpoint(file, "it was written by another version of the program; start the run anew");
  const std::vector<std::uint8_t>& content = whole["content"].get_binary();
  const json data = json::from_cbor(content, true, false);
  if (whole["checksum"] != checksum(content) || data.is_discarded())
    refuse_checkpoint(file, "the file is damaged: its checksum does not match; start the run anew");
  if (whole["scene_hash"] != scene_hash)
    refuse_checkpoint(
        file,
        "it belongs to another scene, or the scene was changed since, or is called with other --set values; only "
        "simulate.until may be changed");
  return data;
}

void refuse_checkpoint(const std::filesystem::path& file, const std::string& why) {
  throw scene::SceneError({scene::Problem{{file.string(), 0, 0}, "", fmt::format("cannot resume: {}", why)}});
}

}  // namespace trammel::simulate
