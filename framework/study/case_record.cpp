#include "study/case_record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulate/results/npz.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

struct Count {
  const char* name;
  long long CaseCounts::*member;
};
constexpr Count kCounts[] = {{"steps", &CaseCounts::steps},
                             {"rejected", &CaseCounts::rejected},
                             {"evaluations", &CaseCounts::evaluations},
                             {"jacobians", &CaseCounts::jacobians},
                             {"factorizations", &CaseCounts::factorizations},
                             {"newton_iterations", &CaseCounts::newton_iterations},
                             {"events", &CaseCounts::events},
                             {"impacts", &CaseCounts::impacts}};

std::string hex(std::uint64_t x) {
  return fmt::format("{:016x}", x);
}
std::uint64_t from_hex(const json& text) {
  return std::stoull(text.get<std::string>(), nullptr, 16);
}

// Quoted if it contains characters with a meaning in CSV (RFC 4180).
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::optional<double> as_number(const std::string& text) {
  const json value = json::parse(text, nullptr, false);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

}  // namespace

CaseRecord record_of(const Study& study, std::size_t index, std::uint64_t key, const CaseResult& result) {
  CaseRecord record{index, key,           result.scene_hash, to_string(result.status),      result.reason,
                    {},    result.counts, result.t_end,      result.cpu + result.cpu_set_up};
  for (const Reduction& one : study.reductions())
    record.values.push_back(result.done() ? one.of(result.series) : unknown);
  return record;
}

std::string to_line(const CaseRecord& r) {
  json numbers = json::array(), values = json::array();
  for (const Count& c : kCounts) numbers.push_back(r.counts.*c.member);
  for (const double x : r.values) values.push_back(std::isfinite(x) ? json(x) : json());
  return json{{"case", r.index},    {"key", hex(r.key)},  {"scene_hash", hex(r.scene_hash)},
              {"status", r.status}, {"reason", r.reason}, {"values", values},
              {"counts", numbers},  {"t_end", r.t_end},   {"cpu", r.cpu}}
             .dump(-1, ' ', false, json::error_handler_t::replace) +
         "\n";
}

std::optional<CaseRecord> from_line(const std::string& line) {
  try {
    const json j = json::parse(line);
    CaseRecord r{j.at("case").get<std::size_t>(),
                 from_hex(j.at("key")),
                 from_hex(j.at("scene_hash")),
                 j.at("status").get<std::string>(),
                 j.at("reason").get<std::string>(),
                 {},
                 {},
                 j.at("t_end").get<double>(),
                 j.at("cpu").get<double>()};
    for (const json& x : j.at("values")) r.values.push_back(x.is_null() ? unknown : x.get<double>());
    for (std::size_t k = 0; k < std::size(kCounts); ++k)
      r.counts.*kCounts[k].member = j.at("counts").at(k).get<long long>();
    return r;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string csv(const Study& study, const CaseRecords& records) {
  std::string text = "case,scene_hash,status";
  for (const std::string& path : study.paths()) text += "," + cell(path);
  for (const Reduction& one : study.reductions()) text += "," + cell(one.name);
  text += ",t_end";
  for (const Count& c : kCounts) text += fmt::format(",{}", c.name);
  text += ",reason\n";
  for (const auto& [i, r] : records) {
    text += fmt::format("{},{},{}", i, hex(r.scene_hash), r.status);
    for (const std::string& value : study.values(i)) text += "," + cell(without_quotes(value));
    for (const double x : r.values) text += std::isfinite(x) ? fmt::format(",{:.17g}", x) : ",nan";
    text += fmt::format(",{:.17g}", r.t_end);
    for (const Count& c : kCounts) text += fmt::format(",{}", r.counts.*c.member);
    text += "," + cell(r.reason) + "\n";
  }
  return text;
}

namespace {

// The values of the k-th path: an array of numbers if all of them are numbers, else of texts.
void add_values(simulate::NpzFile& npz, const Study& study, const CaseRecords& records, std::size_t k) {
  const auto is_number = [&](const auto& record) {
    const std::string& value = study.values(record.first)[k];
    return value.empty() || as_number(value);
  };
  if (std::all_of(records.begin(), records.end(), is_number)) {
    std::vector<double> numbers;
    for (const auto& [i, r] : records) numbers.push_back(as_number(study.values(i)[k]).value_or(unknown));
    npz.add(study.paths()[k], {records.size()}, numbers);
    return;
  }
  std::vector<std::string> texts;
  for (const auto& [i, r] : records) texts.push_back(without_quotes(study.values(i)[k]));
  npz.add(study.paths()[k], texts);
}

}  // namespace

void write_npz(const std::filesystem::path& file, const Study& study, const CaseRecords& records) {
  simulate::NpzFile npz(file);
  const std::size_t n = records.size();
  std::vector<std::int64_t> cases;
  std::vector<std::string> status, hashes;
  for (const auto& [i, r] : records) {
    cases.push_back(std::int64_t(i));
    status.push_back(r.status), hashes.push_back(hex(r.scene_hash));
  }
  npz.add("case", {n}, cases);
  npz.add("scene_hash", hashes), npz.add("status", status);
  for (std::size_t k = 0; k < study.paths().size(); ++k) add_values(npz, study, records, k);
  for (std::size_t k = 0; k < study.reductions().size(); ++k) {
    std::vector<double> numbers;
    for (const auto& [i, r] : records) numbers.push_back(r.values.at(k));
    npz.add(study.reductions()[k].name, {n}, numbers);
  }
  for (const Count& c : kCounts) {
    std::vector<std::int64_t> all;
    for (const auto& [i, r] : records) all.push_back(r.counts.*c.member);
    npz.add(c.name, {n}, all);
  }
  npz.close();
}

}  // namespace trammel::study
