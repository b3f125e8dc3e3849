// A scene as a tree of values. Each value has its position: file, line, column and dotted JSON path.
//
// Typed readers report what was found and what was expected and then continue, so that all problems of a file are
// reported at once (`Problems`).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <trammel/time_function.hpp>

namespace trammel::scene {

struct Position {
  std::string file;  // as given on the command line; "--set" for an override
  int line = 0;      // from 1; 0: no line (a whole file)
  int column = 0;    // from 1, in bytes
};

struct Problem {
  Position at;
  std::string path;          // dotted JSON path, "" for the file itself
  std::string message;       // what was found, what was expected, the nearest valid name
  std::string text() const;  // "beam_impact.json:14:21: contacts.tip.between[0]: no marker ..."
};

// Bad input: one or more problems. what() contains all their texts, one line each. Exit code 2.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

// Collects problems and warnings while a file is read.
class Problems {
 public:
  void error(Problem problem);
  void warning(Problem problem);
  bool empty() const { return errors_.empty(); }
  const std::vector<Problem>& errors() const { return errors_; }
  const std::vector<Problem>& warnings() const { return warnings_; }
  void throw_if_any() const;  // SceneError

 private:
  std::vector<Problem> errors_, warnings_;
};

class Value;
using Members = std::vector<std::pair<std::string, Value>>;  // in file order, keys unique
using Items = std::vector<Value>;

class Formula;

// JSON's null. Its copy constructor is not trivial: otherwise libstdc++ assumes that the variant can never be
// valueless, and destroys a copy that ran out of memory as if it were complete, which is undefined behaviour.
struct Null {
  Null() = default;
  Null(const Null&) noexcept {}
  Null& operator=(const Null&) noexcept { return *this; }
};

class Value {
 public:
  enum class Type { null, boolean, number, text, array, object };

  Type type() const;
  const char* type_name() const;  // "a number", "an object", ... for messages
  Position position() const { return {file(), line_, column_}; }
  const std::string& file() const;
  std::string path() const;
  Problem problem(std::string message) const { return {position(), path(), std::move(message)}; }

  // The raw content; check type() first.
  bool boolean() const { return std::get<bool>(content_); }
  double number() const { return std::get<double>(content_); }
  const std::string& text() const { return std::get<std::string>(content_); }  // also the source text of an expression
  const Items& items() const { return std::get<Items>(content_); }
  const Members& members() const { return std::get<Members>(content_); }
  const Value* find(std::string_view key) const;  // nullptr: no such member, or not an object
  const Value* at_path(std::string_view dotted) const;

  // Typed readers. An expression string ("=2*pi*E") is evaluated in the scene's parameters. On a mismatch they report
  // to `problems` and return nothing.
  std::optional<double> read_number(Problems&) const;  // finite
  std::optional<int> read_integer(Problems&) const;    // 3 or 3.0, not 3.7
  std::optional<bool> read_boolean(Problems&) const;
  std::optional<std::string> read_text(Problems&) const;  // an expression may name a text parameter
  std::optional<std::vector<double>> read_numbers(Problems&) const;
  // A number, an expression that may contain t, or a table (motion_table.hpp).
  std::optional<TimeFunction> read_time_function(Problems&) const;
  // "=..." over these dotted names, which change from call to call, and the scene's parameters.
  std::optional<Formula> read_formula(const std::vector<std::string>& names, Problems&) const;

  using Parameter = std::variant<double, std::string, Null>;  // never null
  using Parameters = std::vector<std::pair<std::string, Parameter>>;

 private:
  friend class Builder;
  // What the values of one array or object have in common, so that millions of values take little memory.
  struct Siblings {
    std::string file, path;                        // the file that contains them; the path of the array or object
    std::shared_ptr<const Parameters> parameters;  // of the whole scene
  };
  const Parameters* parameters() const { return siblings_ ? siblings_->parameters.get() : nullptr; }

  std::variant<Null, bool, double, std::string, Items, Members> content_;
  std::shared_ptr<const Siblings> siblings_;
  int line_ = 0, column_ = 0;
  std::string name_;                                 // a key of the object, or "[3]" in an array
  std::shared_ptr<const std::vector<int>> by_name_;  // only in large finished objects: members sorted by name
};

struct Override {
  std::string path;   // "contacts.tip.restitution"
  std::string value;  // JSON, or bare text: 0.3, true, "abc", abc, [1,2]
};

// A scene read from a file: comments, includes, overrides and parameters are resolved.
class Scene {
 public:
  // Throws SceneError with every problem found.
  static Scene load(const std::string& file, const std::vector<Override>& overrides = {});
  static Scene parse(const std::string& text, const std::string& name, const std::vector<Override>& overrides = {});

  const Value& root() const { return root_; }
  const std::string& file() const { return file_; }
  const std::vector<Problem>& warnings() const { return warnings_; }
  std::uint64_t hash() const { return hash_; }  // of the resolved content: equal for scenes of the same meaning
  const std::vector<Override>& overrides() const { return overrides_; }
  // The text of one file with the same meaning: includes and overrides applied, file names absolute, "for" kept.
  std::string resolved() const;

 private:
  Scene(const std::string& text, const std::string& file, const std::vector<Override>& overrides);

  Value root_;
  std::optional<Value> before_repetition_;  // if something is repeated
  std::string file_;
  std::vector<Override> overrides_;
  std::vector<Problem> warnings_;
  std::uint64_t hash_ = 0;
};

}  // namespace trammel::scene
