#include "simulate/results/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "simulate/results/series_columns.hpp"

namespace trammel::simulate {
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
    : columns_(std::move(columns)),
      books_(books),
      event_line_(model),
      animation_line_(model),
      field_line_(model),
      field_times_(std::move(field_times)) {
  const auto open = [&](std::optional<LogFile>& log, const char* name, LogPart Lengths::*part) {
    keep ? log.emplace(folder / name, (*keep).*part) : log.emplace(folder / name);
  };
  open(series_, "series.csv", &Lengths::series);
  open(events_, "events.csv", &Lengths::events);
  if (animation_line_.possible()) open(animation_, "animation.ndjson", &Lengths::animation);
  if (!field_times_.empty()) open(fields_, "fields.ndjson", &Lengths::fields);
  if (keep) {
    next_field_time_ = std::size_t(keep->field_times);
    return;
  }
  series_->append(header());
  events_->append(event_line_.header());
}

std::string Recorder::header() const {
  std::string line = "t";
  const auto add = [&line](std::string_view name) { line.append(",").append(name); };
  for (const Column& column : columns_) add(column.name);
  std::for_each(energy_columns.begin(), energy_columns.end(), add);
  if (books_ == Books::kept) std::for_each(book_columns.begin(), book_columns.end(), add);
  std::for_each(norm_columns.begin(), norm_columns.end(), add);
  if (books_ == Books::kept) std::for_each(step_columns.begin(), step_columns.end(), add);
  return line + "\n";
}

void Recorder::row(model::AssembledSystem& system, const State& state, const Ledger::Totals& books, long long steps) {
  Moment moment(system, state);
  const auto number = [out = std::back_inserter(series_->buffer())](double x) { fmt::format_to(out, ",{:.17g}", x); };
  fmt::format_to(std::back_inserter(series_->buffer()), "{:.17g}", state.t);
  for (const Column& column : columns_) number(column.value(moment));
  const Energy& energy = moment.energy();
  number(energy.kinetic), number(energy.potential), number(energy.elastic), number(energy.total());
  if (books_ == Books::kept) number(books.supplied), number(books.dissipated);
  const ConstraintNorms norms = constraint_norms(system, state, scratch_);
  number(norms.position), number(norms.velocity), number(norms.acceleration);
  if (books_ == Books::kept) number(double(steps));
  series_->buffer() += '\n';
  series_->appended();
  if (animation_) {
    animation_line_.append(system, state, animation_->buffer());
    animation_->appended();
  }
  if (fields_) show_fields(state);
}

void Recorder::show_fields(const State& state) {
  const std::size_t before = next_field_time_;
  while (next_field_time_ < field_times_.size() && field_times_[next_field_time_] <= state.t) ++next_field_time_;
  if (next_field_time_ == before) return;
  field_line_.append(state, fields_->buffer());
  fields_->appended();
}

template <class Event>
void Recorder::log(const Event& event) {
  event_line_.append(event, events_->buffer());
  events_->appended();
}

void Recorder::event(const ContactEvent& event) {
  log(event);
}

void Recorder::event(const RefineEvent& event) {
  log(event);
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
  for (LogFile* file : files()) file->flush();  // each of them: one may still have room
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
