// Repeated units: a body, joint, force or contact with "for" is replaced by one copy per value.
//
//     "bodies": {"strut_{i}": {"for": {"i": "=n"}, "type": "bar", "from": ["={i}*a", 0], "to": ["=({i}+1)*a", 0], ...}}
//     "joints": {"pin_{i}": {"for": {"i": "=n-1"}, "type": "revolute",
//                            "between": ["strut_{i}.to", "strut_{i+1}.from"]}}
//
// "i": N counts 0 ... N - 1, "i": [a, b] counts a ... b; several names give all combinations. In the names and texts of
// the copies, {...} is an expression of these names and the scene's parameters and is replaced by its value, a whole
// number. The same holds in other members of these groups and under "record": "strut_{n-1}.to.x".
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/builder.hpp"
#include "scene/expression.hpp"
#include "scene/limits.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {
namespace {

constexpr std::array groups = {"bodies", "joints", "forces", "contacts"};
constexpr double most_copies = 1e6;    // of one unit
constexpr double nearly_whole = 1e-9;  // off a whole number: round-off of an expression
constexpr double largest_whole = 1e9;  // far above any number of copies

using Counters = std::vector<std::pair<std::string, double>>;

class Repetition {
 public:
  Repetition(const Value::Parameters& parameters, Problems& problems) : parameters_(parameters), problems_(problems) {}

  // The members of one group, with the units replaced by their copies.
  Members all(Members&& units) {
    Members members;
    for (auto& [name, value] : units) {
      if (value.find("for")) {
        repeat(name, value, members);
        continue;
      }
      fill(value, {});
      members.emplace_back(filled(name, {}, value), std::move(value));
    }
    require_single_names(members);
    return members;
  }

  // Visits every text of a value.
  void fill(Value& value, const Counters& at) {
    if (value.type() == Value::Type::text) {
      if (value.text().find('{') != std::string::npos) value = Builder::like(value, filled(value.text(), at, value));
    } else if (value.type() == Value::Type::array) {
      for (Value& item : Builder::items(value)) fill(item, at);
    } else if (value.type() == Value::Type::object) {
      bool renamed = false;
      for (auto& [name, member] : Builder::members(value)) {
        renamed = renamed || name.find('{') != std::string::npos;
        name = filled(name, at, member), fill(member, at);
      }
      if (renamed) require_single_names(value.members());
    }
  }

 private:
  struct Range {
    std::string name;
    int first = 0, last = -1;
  };

  // "a{i}" and "a0" may give the same name.
  void require_single_names(const Members& members) {
    std::set<std::string_view> known;
    for (const auto& [name, value] : members)
      if (!known.insert(name).second)
        return problems_.error(value.problem(fmt::format("there are several of the name \"{}\"", name)));
  }

  void repeat(const std::string& name, Value& unit, Members& members) {
    const Value ranges_of = *unit.find("for");
    std::vector<Range> ranges;
    if (!read(ranges_of, ranges)) return;
    std::erase_if(Builder::members(unit), [](const auto& member) { return member.first == "for"; });
    double copies = 1;
    for (const Range& range : ranges) copies *= std::max(0.0, double(range.last) - range.first + 1);
    if (copies > most_copies)
      return problems_.error(
          ranges_of.problem(fmt::format("found {:.6g} copies, expected at most {:.6g}", copies, most_copies)));
    values_ += copies * double(Builder::size(unit));
    if (values_ > double(limits::values))
      return problems_.error(ranges_of.problem(fmt::format(
          "{:.6g} copies of {} values, with the copies before more than the {} values that a scene may have", copies,
          Builder::size(unit), limits::values)));
    Counters at;
    for (const Range& range : ranges) at.emplace_back(range.name, range.first);
    if (copies == 0) return;
    const std::size_t before = problems_.errors().size();
    for (;;) {
      Value copy = unit;
      fill(copy, at);
      std::string own_name = filled(name, at, unit);
      if (problems_.errors().size() > before) return;  // the other copies have the same problems
      members.emplace_back(std::move(own_name), std::move(copy));
      std::size_t k = ranges.size();  // the last varies fastest
      while (k > 0 && at[k - 1].second == ranges[k - 1].last) --k, at[k].second = ranges[k].first;
      if (k == 0) return;
      at[k - 1].second += 1;
    }
  }

  bool read(const Value& value, std::vector<Range>& ranges) {
    if (value.type() != Value::Type::object || value.members().empty()) {
      problems_.error(
          value.problem(fmt::format(R"(found {}, expected {{"i": 8}} or {{"i": [1, 8]}})", value.type_name())));
      return false;
    }
    for (const auto& [name, bounds] : value.members()) {
      if (find_parameter(parameters_, name))
        problems_.error(bounds.problem(fmt::format("\"{}\" is a parameter already", name)));
      if (!is_name(name) || name == "t" || name == "pi")
        problems_.error(
            bounds.problem(fmt::format("\"{}\" cannot be counted by: letters, digits and _, not t or pi", name)));
      const bool both = bounds.type() == Value::Type::array && bounds.items().size() == 2;
      const auto first = both ? bounds.items()[0].read_integer(problems_) : 0;
      const auto last_or_count = (both ? bounds.items()[1] : bounds).read_integer(problems_);
      if (!first || !last_or_count) continue;
      const Range range{name, *first, both ? *last_or_count : *last_or_count - 1};
      if (range.last < range.first - 1)
        problems_.error(bounds.problem(
            both ? fmt::format(R"("{}" counts from {} to {}, expected a last number of at least {} (no copy then))",
                               name, range.first, range.last, range.first - 1)
                 : fmt::format(R"("{}" counts {} copies, expected 0 or more)", name, range.last + 1)));
      ranges.push_back(range);
    }
    return problems_.empty();
  }

  std::string filled(const std::string& text, const Counters& at, const Value& where) {
    std::string result;
    std::size_t done = 0;
    for (std::size_t open; (open = text.find('{', done)) != std::string::npos;) {
      const std::size_t close = text.find('}', open);
      if (close == std::string::npos) {
        problems_.error(where.problem(fmt::format("\"{}\" has a {{ without its }}", shortened(text))));
        return text;
      }
      result.append(text, done, open - done);
      result += number(text.substr(open + 1, close - open - 1), at, where, text.starts_with("="));
      done = close + 1;
    }
    return result.append(text, done);
  }

  std::string number(const std::string& inner, const Counters& at, const Value& where, bool in_expression) {
    try {
      const double value =
          evaluate(inner, [&](std::string_view name, int column) { return look_up(name, column, at); });
      if (std::abs(value - std::round(value)) < nearly_whole && std::abs(value) < largest_whole) {
        const auto whole = static_cast<long long>(std::round(value));
        return whole < 0 && in_expression ? fmt::format("({})", whole) : fmt::format("{}", whole);
      }
      problems_.error(
          where.problem(fmt::format("found {{{}}} = {:.9g}, expected a whole number", shortened(inner), value)));
    } catch (const ExpressionError& error) {
      problems_.error(
          where.problem(fmt::format("in {{{}}}, column {}: {}", shortened(inner), error.column(), error.what())));
    }
    return "";
  }

  double look_up(std::string_view name, int column, const Counters& at) const {
    for (const auto& [key, value] : at)
      if (key == name) return value;
    if (const auto* value = find_parameter(parameters_, name))
      if (const double* x = std::get_if<double>(value)) return *x;
    std::vector<std::string> names;
    for (const auto& [key, value] : at) names.push_back(key);
    for (const auto& [key, value] : parameters_) names.push_back(key);
    throw ExpressionError(column,
                          fmt::format("nothing here counts by \"{}\"{}", shortened(name), did_you_mean(name, names)));
  }

  const Value::Parameters& parameters_;
  Problems& problems_;
  double values_ = 0;  // of all copies so far
};

}  // namespace

bool repeats_units(const Value& root) {
  return std::any_of(groups.begin(), groups.end(), [&](const char* group) {
    const Value* units = root.find(group);
    if (!units || units->type() != Value::Type::object) return false;
    return std::any_of(units->members().begin(), units->members().end(),
                       [](const auto& unit) { return unit.second.find("for") != nullptr; });
  });
}

void repeat_units(Value& root, const Value::Parameters& parameters) {
  Problems problems;
  Repetition repetition(parameters, problems);
  for (const char* group : groups)
    if (Value* units = Builder::find(root, group); units && units->type() == Value::Type::object)
      Builder::members(*units) = repetition.all(std::move(Builder::members(*units)));
  if (Value* record = Builder::find(root, "record")) repetition.fill(*record, {});
  problems.throw_if_any();
}

}  // namespace trammel::scene
