// A checkpoint: everything that decides how a run continues, bit for bit, in one CBOR file that is renamed into place.
// A damaged or forged one is refused: reading checks all types, ranges and lengths.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include <trammel/archive.hpp>
#include <trammel/types.hpp>

#include "scene/value.hpp"

namespace trammel::simulate {

inline constexpr int checkpoint_format = 8;

// Writes values into a JSON object, or reads them back.
class JsonArchive final : public Archive {
 public:
  enum class Direction { write, read };
  JsonArchive(nlohmann::json& data, Direction direction) : data_(data), direction_(direction) {}
  using Archive::operator();
  void operator()(std::string_view name, bool& value) override;
  void operator()(std::string_view name, int& value) override;
  void operator()(std::string_view name, long long& value) override;
  void operator()(std::string_view name, double& value) override;
  void operator()(std::string_view name, std::string& value) override;
  void operator()(std::string_view name, Vec& value) override;

  // An object inside this one, for a component whose names might repeat ours.
  JsonArchive nested(std::string_view name);
  // Vectors whose names end in _q, _v, _a or _lambda (a number may follow) must have the system's lengths nq, nv, nv
  // and nc, or be empty; those that also begin with now_ must not be empty. Throws std::length_error.
  void require_lengths(const Sizes& sizes) const;
  bool reading() const { return direction_ == Direction::read; }

 private:
  template <class T>
  void transfer(std::string_view name, T& value);
  nlohmann::json& data_;
  Direction direction_;
};

// Hash of everything in the scene except simulate.until: a run may be resumed with a later end.
std::uint64_t resume_hash(const scene::Value& root);

// The previous file stays as checkpoint.previous.cbor beside it.
void write_checkpoint(const std::filesystem::path& file, std::uint64_t scene_hash, const nlohmann::json& data);
// Throws SceneError if the file is missing, damaged, or of another scene.
nlohmann::json read_checkpoint(const std::filesystem::path& file, std::uint64_t scene_hash);

nlohmann::json decode_checkpoint(const std::string& bytes, const std::filesystem::path& file, std::uint64_t scene_hash);

// Throws a SceneError about a checkpoint that is well formed and does not fit.
[[noreturn]] void refuse_checkpoint(const std::filesystem::path& file, const std::string& why);

}  // namespace trammel::simulate
