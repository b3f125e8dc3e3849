#include "simulate/pictures/field_line.hpp"

#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace trammel::simulate {
namespace {

void append_numbers(const Eigen::Ref<const Vec>& numbers, std::string& out) {
  const char* separator = "[";
  for (const double x : numbers) {
    fmt::format_to(std::back_inserter(out), "{}{:.6g}", separator, x);
    separator = ",";
  }
  out += ']';
}

void append_numbers(const FieldPatch& patch, std::string& out) {
  fmt::format_to(std::back_inserter(out), "{{\"along\":{},\"points\":[", patch.along);
  for (Eigen::Index k = 0; k < patch.points.cols(); ++k) {
    if (k > 0) out += ',';
    append_numbers(patch.points.col(k), out);
  }
  out += "],\"values\":[";
  for (Eigen::Index k = 0; k < patch.values.rows(); ++k) {
    if (k > 0) out += ',';
    append_numbers(patch.values.row(k).transpose(), out);
  }
  out += "]}";
}

}  // namespace

FieldLine::FieldLine(const model::Model& model) {
  for (const model::BodyEntry& entry : model.bodies)
    if (const auto* fields = dynamic_cast<const HasFields*>(entry.body.get())) shown_.push_back({&entry, fields});
}

void FieldLine::append(const State& state, std::string& out) {
  fmt::format_to(std::back_inserter(out), "{{\"t\":{:.9g},\"bodies\":{{", state.t);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const auto& [entry, body] = shown_[i];
    body->fields_at(state.t, state.q.segment(entry->q0, entry->nq), state.v.segment(entry->v0, entry->nv), patches_);
    const auto names = body->fields();
    fmt::format_to(std::back_inserter(out), "{}{}:{{\"fields\":{},\"patches\":[", i > 0 ? "," : "",
                   nlohmann::json(entry->name).dump(),
                   nlohmann::json(std::vector<std::string>(names.begin(), names.end())).dump());
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      if (k > 0) out += ',';
      append_numbers(patches_[k], out);
    }
    out += "]}";
  }
  out += "}}\n";
}

}  // namespace trammel::simulate
