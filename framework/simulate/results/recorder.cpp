#include "simulate/results/recorder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulate/results/series_columns.hpp"

namespace trammel::simulate {
namespace {

// "name=1", or "name_x=1 name_y=0 name_z=0" in space.
std::string components(const char* name, const Vec3& x) {
  if (x.size() == 1) return fmt::format("{}={:.17g}", name, x[0]);
  return fmt::format("{0}_x={1:.17g} {0}_y={2:.17g} {0}_z={3:.17g}", name, x[0], x[1], x[2]);
}

}  // namespace

void ConstraintNorms::raise_to(const ConstraintNorms& other) {
  position = std::max(position, other.position);
  velocity = std::max(velocity, other.velocity);
  acceleration = std::max(acceleration, other.acceleration);
}

ConstraintNorms constraint_norms(model::AssembledSystem& system, const State& state, Vec& scratch) {
  ConstraintNorms norms;
  if (system.sizes().nc == 0) return norms;
  norms.position = system.g().norm();
  norms.velocity = system.g_dot().norm();
  system.constraint_acceleration(state.a, scratch);
  norms.acceleration = scratch.norm();
  return norms;
}

Recorder::Recorder(const std::filesystem::path& folder, const model::Model& model, std::vector<Column> columns,
                   std::optional<Lengths> keep, std::vector<double> field_times, Books books)
    : model_(model),
      columns_(std::move(columns)),
      books_(books),
      field_line_(model),
      field_times_(std::move(field_times)) {
  const bool drawn =
      std::any_of(model.bodies.begin(), model.bodies.end(), [](const auto& entry) { return entry.drawn != nullptr; });
  const auto open = [&](std::optional<LogFile>& log, const char* name, LogPart Lengths::*part) {
    keep ? log.emplace(folder / name, (*keep).*part) : log.emplace(folder / name);
  };
  open(series_, "series.csv", &Lengths::series);
  open(events_, "events.csv", &Lengths::events);
  if (drawn) open(animation_, "animation.ndjson", &Lengths::animation);
  if (!field_times_.empty()) open(fields_, "fields.ndjson", &Lengths::fields);
  if (keep) {
    next_field_time_ = std::size_t(keep->field_times);
    return;
  }
  series_->append(header());
  events_->append("t,kind,component,detail\n");
}

std::string Recorder::header() const {
  std::string line = "t";
  const auto add = [&line](std::string_view name) { line.append(",").append(name); };
  for (const Column& column : columns_) add(column.name);
  std::for_each(energy_columns.begin(), energy_columns.end(), add);
  if (books_ == Books::kept) std::for_each(book_columns.begin(), book_columns.end(), add);
  std::for_each(norm_columns.begin(), norm_columns.end(), add);
  return line + "\n";
}

void Recorder::row(model::AssembledSystem& system, const State& state, const Ledger::Totals& books) {
  Moment moment(system, state);
  const auto number = [out = std::back_inserter(series_->buffer())](double x) { fmt::format_to(out, ",{:.17g}", x); };
  fmt::format_to(std::back_inserter(series_->buffer()), "{:.17g}", state.t);
  for (const Column& column : columns_) number(column.value(moment));
  const Energy& energy = moment.energy();
  number(energy.kinetic), number(energy.potential), number(energy.elastic), number(energy.total());
  if (books_ == Books::kept) number(books.supplied), number(books.dissipated);
  const ConstraintNorms norms = constraint_norms(system, state, scratch_);
  number(norms.position), number(norms.velocity), number(norms.acceleration);
  series_->buffer() += '\n';
  series_->appended();
  if (animation_) animate(state);
  if (fields_) show_fields(state);
}

void Recorder::show_fields(const State& state) {
  const std::size_t before = next_field_time_;
  while (next_field_time_ < field_times_.size() && field_times_[next_field_time_] <= state.t) ++next_field_time_;
  if (next_field_time_ == before) return;
  field_line_.append(state, fields_->buffer());
  fields_->appended();
}

void Recorder::animate(const State& state) {
  std::string& line = animation_->buffer();
  fmt::format_to(std::back_inserter(line), "{{\"t\":{:.9g},\"shapes\":{{", state.t);
  const char* separator = "";
  for (const model::BodyEntry& entry : model_.bodies) {
    if (!entry.drawn) continue;
    entry.drawn->shape(state.t, state.q.segment(entry.q0, entry.nq), shape_);
    fmt::format_to(std::back_inserter(line), "{}{}:[", separator, nlohmann::json(entry.name).dump());
    separator = ",";
    for (Eigen::Index j = 0; j < shape_.cols(); ++j) {
      line += j ? ",[" : "[";
      for (Eigen::Index i = 0; i < shape_.rows(); ++i)
        fmt::format_to(std::back_inserter(line), "{}{:.5g}", i ? "," : "", shape_(i, j));
      line += ']';
    }
    line += ']';
  }
  line += "}}\n";
  animation_->appended();
}

void Recorder::event(const ContactEvent& event) {
  auto out = std::back_inserter(events_->buffer());
  const std::string friction = components("friction", event.friction);
  fmt::format_to(out, "{:.17g},{},{},", event.t, to_string(event.kind), model_.contacts[event.contact].path());
  if (event.kind == ContactEvent::Kind::impact || event.kind == ContactEvent::Kind::latch)
    fmt::format_to(out, "impulse={:.17g} approach={:.17g} separation={:.17g} energy_lost={:.17g} {}", event.impulse,
                   event.approach + 0.0, event.separation + 0.0, event.energy_lost + 0.0, friction);  // no -0
  else if (event.kind == ContactEvent::Kind::stick)
    fmt::format_to(out, "{}", friction);
  else if (event.kind == ContactEvent::Kind::slip || event.kind == ContactEvent::Kind::reversal)
    fmt::format_to(out, "{} {}", friction, components("direction", event.direction));
  else if (event.kind == ContactEvent::Kind::close)
    fmt::format_to(out, "approach={:.17g}", event.approach + 0.0);
  else
    fmt::format_to(out, "separation={:.17g}", event.separation + 0.0);
  events_->buffer() += '\n';
  events_->appended();
}

void Recorder::event(const RefineEvent& event) {
  auto out = std::back_inserter(events_->buffer());
  fmt::format_to(out, "{:.17g},refine,bodies.{},cause={}", event.t, model_.bodies[std::size_t(event.body)].name,
                 event.cause);
  const auto pair = [&out](const char* what, auto before, auto after) {
    fmt::format_to(out, " {0}_before={1:.17g} {0}_after={2:.17g}", what, before, after);
  };
  const RefineEvent::Side &before = event.before, &after = event.after;
  pair("coordinates", double(before.sizes.nq), double(after.sizes.nq));
  pair("kinetic", before.energy.kinetic, after.energy.kinetic);
  pair("potential", before.energy.potential, after.energy.potential);
  pair("elastic", before.energy.elastic, after.energy.elastic);
  if (before.momentum && after.momentum) {
    static constexpr std::array axes = {"x", "y", "z"};
    pair("mass", before.momentum->mass, after.momentum->mass);
    for (Eigen::Index i = 0; i < before.momentum->linear.size(); ++i)
      pair(fmt::format("momentum_{}", axes[std::size_t(i)]).c_str(), before.momentum->linear(i),
           after.momentum->linear(i));
    const auto spins = before.momentum->angular.size();
    for (Eigen::Index i = 0; i < spins; ++i)
      pair(fmt::format("spin_{}", axes[std::size_t(spins == 1 ? 2 : i)]).c_str(), before.momentum->angular(i),
           after.momentum->angular(i));
  }
  events_->buffer() += '\n';
  events_->appended();
}

Recorder::Lengths Recorder::lengths() const {
  const auto part = [](const std::optional<LogFile>& file) { return file ? file->part() : LogPart(); };
  return {part(series_), part(events_), part(animation_), part(fields_), (long long)(next_field_time_)};
}

std::string Recorder::damage(const std::filesystem::path& folder, const Lengths& keep) {
  for (const auto& [name, part] :
       {std::pair("series.csv", &keep.series), std::pair("events.csv", &keep.events),
        std::pair("animation.ndjson", &keep.animation), std::pair("fields.ndjson", &keep.fields)})
    if (part->bytes != 0)
      if (std::string why = damage_of(folder / name, *part); !why.empty()) return why;
  return "";
}

std::vector<LogFile*> Recorder::files() {
  std::vector<LogFile*> all = {&*series_, &*events_};
  for (std::optional<LogFile>* file : {&animation_, &fields_})
    if (*file) all.push_back(&**file);
  return all;
}

void Recorder::flush() {
  for (LogFile* file : files()) file->flush();  // each: one may still find room
  check();
}

void Recorder::sync() {
  for (LogFile* file : files()) file->sync();
  check();
}

void Recorder::check() const {
  for (const std::optional<LogFile>* file : {&series_, &events_, &animation_, &fields_})
    if (*file && !(*file)->problem().empty()) throw OutputError((*file)->problem());
}

std::string Recorder::missing() {
  std::string text;
  for (const LogFile* file : files())
    if (const long long lines = file->unwritten_lines(); lines > 0)
      text += fmt::format("{}{} lacks its last {} line{}", text.empty() ? "" : ", ", file->name(), lines,
                          lines == 1 ? "" : "s");
  return text;
}

void Recorder::rescue() const noexcept {
  for (const std::optional<LogFile>* file : {&series_, &events_, &animation_, &fields_})
    if (*file) (*file)->rescue();
}

}  // namespace trammel::simulate
