#include "simulate/results/checkpoint.hpp"

#include <bit>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "scene/fnv_hash.hpp"
#include "scene/no_memory.hpp"
#include "simulate/results/log_file.hpp"
#include "simulate/results/results_folder.hpp"

namespace trammel::simulate {
namespace {

using nlohmann::json;

void add(scene::FnvHash& hash, const scene::Value& value) {
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
  scene::FnvHash hash;
  hash.bytes(data.data(), data.size());
  return hash.value();
}

constexpr std::uintmax_t largest = 1u << 30;  // [bytes]
constexpr int nested = 8;                     // more than any component needs

// Parses every value of a CBOR text without storing it; false: too deep, or no CBOR.
class Shallow : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= nested; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t) override { return ++depth_ <= nested; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

 private:
  int depth_ = 0;
};

// Null if the text is no CBOR or is nested without end.
template <class Bytes>
std::optional<json> decoded(const Bytes& bytes) {
  Shallow shallow;
  try {
    if (!json::sax_parse(bytes, &shallow, json::input_format_t::cbor)) return std::nullopt;
    json value = json::from_cbor(bytes, true, false);
    return value.is_discarded() ? std::nullopt : std::optional(std::move(value));
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

// A number may not fit the requested type, and the JSON library would truncate it silently.
template <class T>
T number_in(const json& value) {
  if (!value.is_number_integer()) throw std::range_error("a whole number was expected");
  if (value.is_number_unsigned()) {
    const auto x = value.get<std::uint64_t>();
    if (x > std::uint64_t(std::numeric_limits<T>::max())) throw std::range_error("a number is too large");
    return T(x);
  }
  const auto x = value.get<std::int64_t>();
  if (x < 0 && (std::is_unsigned_v<T> || x < std::int64_t(std::numeric_limits<T>::min())))
    throw std::range_error("a number is too small");
  return T(x);
}

template <class T>
T read_as(const json& value) {
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    return number_in<T>(value);
  } else if constexpr (std::is_same_v<T, std::vector<std::uint64_t>>) {
    std::vector<std::uint64_t> numbers;
    for (const json& entry : value.get_ref<const json::array_t&>()) numbers.push_back(number_in<std::uint64_t>(entry));
    return numbers;
  } else {
    return value.get<T>();  // checks the type
  }
}

}  // namespace

template <class T>
void JsonArchive::transfer(std::string_view name, T& value) {
  if (direction_ == Direction::write) {
    if (!data_.emplace(std::string(name), value).second)
      throw std::logic_error(fmt::format("\"{}\" is archived twice", name));  // one would be lost
  } else {
    value = read_as<T>(data_.at(std::string(name)));
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

// As 64 bits: JSON would lose the payload of a NaN.
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

namespace {

// "past_lambda_3" and "lambda": "lambda".
std::string_view last_word(std::string_view name) {
  const auto words_end = name.find_last_not_of("0123456789");
  if (words_end != name.npos && name[words_end] == '_' && words_end > 0) name = name.substr(0, words_end);
  return name.substr(name.rfind('_') + 1);
}

}  // namespace

void JsonArchive::require_lengths(const Sizes& sizes) const {
  for (const auto& [name, value] : data_.items()) {
    if (!value.is_array()) continue;
    const std::string_view word = last_word(name);
    const auto length = static_cast<long long>(value.size());
    for (const auto& [ending, expected] :
         {std::pair("q", sizes.nq), std::pair("v", sizes.nv), std::pair("a", sizes.nv), std::pair("lambda", sizes.nc)})
      if (word == ending && length != expected && (length > 0 || name.starts_with("now_")))
        throw std::length_error(fmt::format("\"{}\" has {} numbers, expected {}", name, length, expected));
  }
}

std::uint64_t resume_hash(const scene::Value& root) {
  scene::FnvHash hash;
  add(hash, root);
  return hash.value();
}

void write_checkpoint(const std::filesystem::path& file, std::uint64_t scene_hash, const json& data) {
  const std::vector<std::uint8_t> content = json::to_cbor(data);
  const json whole = {{"trammel_checkpoint", checkpoint_format},
                      {"scene_hash", scene_hash},
                      {"checksum", checksum(content)},
                      {"content", json::binary(content)}};
  const std::vector<std::uint8_t> bytes = json::to_cbor(whole);
  write_whole(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()},
              file.parent_path() / checkpoint_before);
}

json read_checkpoint(const std::filesystem::path& file, std::uint64_t scene_hash) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(file, error);
  if (!std::filesystem::exists(status)) refuse_checkpoint(file, "there is no checkpoint to resume from");
  if (!std::filesystem::is_regular_file(status)) refuse_checkpoint(file, "it is no regular file");
  if (std::filesystem::file_size(file, error) > largest) refuse_checkpoint(file, "it is longer than 1 GiB");
  std::ifstream in(file, std::ios::binary);
  if (!in) scene::require_memory(errno);
  return decode_checkpoint(std::string(std::istreambuf_iterator<char>(in), {}), file, scene_hash);
}

json decode_checkpoint(const std::string& bytes, const std::filesystem::path& file, std::uint64_t scene_hash) {
  const std::optional<json> whole = decoded(bytes);
  const auto member = [&](const char* key) -> const json& {
    const bool there = whole && whole->is_object() && whole->contains(key);
    if (!there) refuse_checkpoint(file, "the file is damaged or no checkpoint; start the run anew");
    return whole->at(key);
  };
  if (member("trammel_checkpoint") != checkpoint_format)
    refuse_checkpoint(file, "it was written by another version of the program; start the run anew");
  const json &sum = member("checksum"), &hash = member("scene_hash"), &bytes_within = member("content");
  if (!bytes_within.is_binary()) refuse_checkpoint(file, "the file is damaged; start the run anew");
  const std::vector<std::uint8_t>& content = bytes_within.get_binary();
  std::optional<json> data;
  if (sum == checksum(content)) data = decoded(content);
  if (!data || !data->is_object())
    refuse_checkpoint(file, "the file is damaged: its checksum does not match; start the run anew");
  if (hash != scene_hash)
    refuse_checkpoint(
        file,
        "it belongs to another scene, or the scene was changed since, or is called with other --set values; only "
        "simulate.until may be changed");
  return std::move(*data);
}

void refuse_checkpoint(const std::filesystem::path& file, const std::string& why) {
  throw scene::SceneError({scene::Problem{{file.string(), 0, 0}, "", fmt::format("cannot resume: {}", why)}});
}

}  // namespace trammel::simulate
