#include "simulate/start/law_checks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "scene/laws/continuity.hpp"
#include "scene/laws/law_code.hpp"
#include "simulate/start/laws_of_scene.hpp"

namespace trammel::simulate {
namespace {

using scene::Problems;
using scene::Value;

constexpr double end_of_table = 1e-12;  // of the run's times: round-off of a table's first and last time

// The first of some instants at which the law or one of its derivatives is not finite, and which of them.
std::optional<std::pair<double, const char*>> find_not_finite(const TimeFunction& law, int derivatives, double begin,
                                                              double end) {
  constexpr int parts = 256;
  for (int i = 0; i <= parts; ++i) {
    const double t = begin + (end - begin) * i / parts;
    const TimeFunction::Jet jet = law.jet(t);
    if (!std::isfinite(jet.value)) return std::pair{t, "value"};
    if (derivatives > 0 && !std::isfinite(jet.rate)) return std::pair{t, "velocity"};
    if (derivatives > 1 && !std::isfinite(jet.second)) return std::pair{t, "acceleration"};
  }
  return {};
}

void check_law(const Value& value, const TimeFunction& law, int derivatives, double begin, double end,
               Problems& problems) {
  if (derivatives == 0) return;
  if (const auto at = find_not_finite(law, derivatives, begin, end))
    return problems.error(
        value.problem(fmt::format("at t = {:.9g} s the {} of this law is not finite", at->first, at->second)));
  if (const auto jump = scene::find_jump(law, derivatives, begin, end))
    problems.error(
        value.problem(fmt::format("this law must be differentiable, but at t = {:.9g} s its {} jumps by {:.6g}",
                                  jump->t, jump->derivative == 0 ? "value" : "velocity", jump->by)));
}

// A table ends with its last record. The scene must state how it continues: a record of 30 s in a run of 40 s may be a
// mistake.
void check_span(const Value& table, double begin, double end, Problems& problems) {
  Problems ignored;  // reported when the component was made
  const auto law = table.read_time_function(ignored);
  if (!law || !law->code()) return;
  const auto [first, last] = law->code()->span();
  const double round_off = end_of_table * std::max({std::abs(begin), std::abs(end), end - begin});
  std::string misses;
  if (first > begin + round_off)
    misses = fmt::format("begins at t = {:.9g} s, but the run at t = {:.9g} s", first, begin);
  if (last < end - round_off)
    misses +=
        fmt::format("{}ends at t = {:.9g} s, but the run at t = {:.9g} s", misses.empty() ? "" : "; it ", last, end);
  if (misses.empty()) return;
  problems.error(
      table.problem(fmt::format("{} {}; change simulate, or say what holds beyond the table: \"beyond\": \"hold\", "
                                "\"zero\" or \"repeat\"",
                                law->text(), misses)));
}

bool is_table(const Value& value) {
  const Value* file = value.find("table");
  return file && file->type() == Value::Type::text && !value.find("type");
}

// At any depth: in parts of a component, or in a list.
void check_tables(const Value& value, double begin, double end, Problems& problems) {
  if (is_table(value)) return check_span(value, begin, end, problems);
  if (value.type() == Value::Type::object)
    for (const auto& [name, member] : value.members()) check_tables(member, begin, end, problems);
  if (value.type() == Value::Type::array)
    for (const Value& item : value.items()) check_tables(item, begin, end, problems);
}

}  // namespace

void check_laws(const Value& root, plugin::Registry& registry, double begin, double end, Problems& problems) {
  for (const char* group : {"bodies", "joints", "forces", "contacts"})
    if (const Value* components = root.find(group)) check_tables(*components, begin, end, problems);
  for_each_law(root, registry, [&](const Value& value, const TimeFunction& law, const Parameter& parameter) {
    check_law(value, law, parameter.traits.derivatives, begin, end, problems);
  });
}

}  // namespace trammel::simulate
