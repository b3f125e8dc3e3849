#include "report/animation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/base64.hpp"

namespace trammel::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_frames = 4000;

// The positions just after each end of line, where the next line begins; first 0.
std::vector<long long> line_ends(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<long long> ends = {0};
  std::vector<char> block(1 << 18);
  long long at = 0;
  while (in.read(block.data(), std::streamsize(block.size())) || in.gcount() > 0) {
    for (const char *p = block.data(), *end = p + in.gcount(); (p = std::find(p, end, '\n')) != end; ++p)
      ends.push_back(at + (p - block.data()) + 1);
    at += in.gcount();
  }
  return ends;
}

class Lines {
 public:
  explicit Lines(const std::filesystem::path& file)
      : file_(file), ends_(line_ends(file)), in_(file, std::ios::binary) {}
  std::size_t count() const { return ends_.size() - 1; }
  Json operator[](std::size_t k) {
    std::string text(std::size_t(ends_[k + 1] - ends_[k]), '\0');
    in_.seekg(ends_[k]);
    in_.read(text.data(), std::streamsize(text.size()));
    try {
      return Json::parse(text);
    } catch (const Json::exception& e) {
      throw std::runtime_error(fmt::format("{}:{}: no JSON: {}", file_.string(), k + 1, e.what()));
    }
  }

 private:
  std::filesystem::path file_;
  std::vector<long long> ends_;
  std::ifstream in_;
};

// Entry `key` of a line, or an empty object.
const Json& part(const Json& line, const char* key) {
  static const Json none = Json::object();
  const auto found = line.find(key);
  return found == line.end() ? none : *found;
}

// Number of bytes that a line takes as a frame.
std::size_t bytes_of(const Json& line) {
  std::size_t points = part(line, "joints").size() + part(line, "balls").size(), values = 0;
  for (const auto& [name, shape] : part(line, "shapes").items()) points += shape.size();
  for (const auto& [name, faces] : part(line, "faces").items())
    points += faces.at("points").size(), values += faces.at("values").size();
  const std::size_t arrows = part(line, "contacts").size() + part(line, "forces").size();
  return 16 + 3 * 2 * points + 2 * values + 4 * 10 * arrows;
}

class Frames {
 public:
  explicit Frames(int dimension) : dimension_(dimension), low_(3, infinity), high_(3, -infinity) {}

  void add(const Json& line) {
    times_.push_back(line.at("t").get<double>());
    lay_out(line);
    for (const auto& [name, shape] : part(line, "shapes").items())
      for (const Json& point : shape) add_point(point);
    for (const auto& [name, faces] : part(line, "faces").items()) {
      for (const Json& point : faces.at("points")) add_point(point);
      for (const Json& value : faces.at("values")) values_.push_back(number(value));
    }
    for (const char* key : {"joints", "balls"})
      for (const auto& [name, point] : part(line, key).items()) add_point(point);
    const std::size_t before = arrows_;
    add_arrows(line, "contacts", contacts_);
    add_arrows(line, "forces", forces_);
    counts_.push_back(std::uint16_t(arrows_ - before));
  }

  Json json() const {
    double side = 0;
    Json low = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
      const bool any = low_[i] <= high_[i];
      low.push_back(any ? low_[i] : 0.0);
      if (any) side = std::max(side, high_[i] - low_[i]);
    }
    const double step = side > 0 ? side / 65535 : 1;
    const auto [least, largest] = std::minmax_element(values_.begin(), values_.end());
    const double low_value = values_.empty() ? 0 : *least, high_value = values_.empty() ? 0 : *largest;
    std::vector<std::uint16_t> points, values;
    for (std::size_t k = 0; k < points_.size(); ++k)
      points.push_back(quantised(points_[k], low[k % std::size_t(dimension_)].get<double>(), step));
    for (const double x : values_)
      values.push_back(quantised(x, low_value, high_value > low_value ? (high_value - low_value) / 65535 : 1));
    return {{"frames", times_.size()},
            {"dimension", dimension_},
            {"times", base64_of(times_)},
            {"low", low},
            {"step", step},
            {"layouts", layouts_},
            {"points", base64_of(points)},
            {"values", base64_of(values)},
            {"low_value", low_value},
            {"high_value", high_value},
            {"contacts", contacts_},
            {"forces", forces_},
            {"arrows", {{"counts", base64_of(counts_)}, {"data", base64_of(arrow_data_)}}}};
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static double number(const Json& x) { return x.is_number() ? x.get<double>() : 0.0; }
  static std::uint16_t quantised(double x, double low, double step) {
    return std::uint16_t(std::clamp(std::round((x - low) / step), 0.0, 65535.0));
  }

  void add_point(const Json& point) {
    for (std::size_t i = 0; i < std::size_t(dimension_); ++i) {
      const double x = number(point.at(i));
      points_.push_back(x);
      low_[i] = std::min(low_[i], x), high_[i] = std::max(high_[i], x);
    }
  }

  // Begins a new layout if the line has other parts than the one before.
  void lay_out(const Json& line) {
    Json bodies = Json::array(), faces = Json::array(), joints = Json::array(), balls = Json::array();
    for (const auto& [name, shape] : part(line, "shapes").items())
      bodies.push_back({{"name", name}, {"points", shape.size()}});
    for (const auto& [name, body] : part(line, "faces").items()) {
      std::vector<std::uint32_t> quads;
      for (const Json& quad : body.at("quads"))
        for (const Json& index : quad) quads.push_back(index.get<std::uint32_t>());
      faces.push_back({{"name", name}, {"points", body.at("points").size()}, {"quads", base64_of(quads)}});
    }
    for (const auto& [name, point] : part(line, "joints").items()) joints.push_back(name);
    for (const auto& [name, point] : part(line, "balls").items()) balls.push_back(name);
    Json layout = {{"bodies", bodies}, {"faces", faces}, {"joints", joints}, {"balls", balls}};
    if (!layouts_.empty()) layout["first"] = layouts_.back()["first"];
    if (!layouts_.empty() && layout == layouts_.back()) return;
    layout["first"] = times_.size() - 1;
    layouts_.push_back(std::move(layout));
  }

  static int index_of(const std::string& name, std::vector<std::string>& names) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return int(found - names.begin());
    names.push_back(name);
    return int(names.size()) - 1;
  }

  void add_arrows(const Json& line, const char* key, std::vector<std::string>& names) {
    for (const auto& [name, arrow] : part(line, key).items()) {
      ++arrows_;
      const int index = index_of(name, names);
      arrow_data_.push_back(float(&names == &contacts_ ? index : -1 - index));
      for (const Json& vector : arrow)
        for (const Json& x : vector) arrow_data_.push_back(float(number(x)));
    }
  }

  int dimension_;
  std::vector<double> times_, points_, values_, low_, high_;
  std::vector<std::string> contacts_, forces_;
  std::vector<std::uint16_t> counts_;
  std::vector<float> arrow_data_;
  std::size_t arrows_ = 0;
  Json layouts_ = Json::array();
};

// Dimension of the first point that the line draws.
int dimension_of(const Json& line) {
  for (const auto& [name, shape] : part(line, "shapes").items())
    if (!shape.empty()) return int(shape.front().size());
  return 2;
}

}  // namespace

Json read_animation(const std::filesystem::path& file, std::size_t most_bytes) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return nullptr;
  Lines lines(file);
  const std::size_t total = lines.count();
  if (total == 0) return nullptr;
  const Json last = lines[total - 1];
  const std::size_t bytes = std::max(bytes_of(lines[0]), bytes_of(last));
  const std::size_t frames = std::clamp<std::size_t>(most_bytes / bytes, 2, most_frames);
  const std::size_t stride = std::max<std::size_t>(1, (total - 1 + frames - 2) / (frames - 1));
  Frames all(dimension_of(last));
  for (std::size_t k = 0; k + 1 < total; k += stride) all.add(lines[k]);
  all.add(last);
  Json json = all.json();
  json["total"] = total, json["stride"] = stride;
  return json;
}

}  // namespace trammel::report
