// Reads JSON with comments by the event parser of nlohmann-json. An iterator counts bytes and gives each value its
// position. This reader also refuses input that the parser accepts: duplicate keys, numbers that underflow or overflow,
// deep nesting.
#include <algorithm>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/builder.hpp"
#include "scene/limits.hpp"
#include "scene/shortened.hpp"
#include "scene/syntax_error.hpp"

namespace trammel::scene {

namespace {

constexpr std::string_view number_characters = "0123456789.+-eE";

// An iterator over a text whose copies share one counter of the position.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *furthest_ = ++at_;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** furthest_;
};

class Lines {
 public:
  Lines(const std::string& text, const std::string& file) : file_(file) {
    starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') starts_.push_back(i + 1);
  }
  std::pair<int, int> numbers_at(std::size_t offset) const {  // line and column
    const auto line = std::upper_bound(starts_.begin(), starts_.end(), offset) - starts_.begin();
    return {int(line), int(offset - starts_[std::size_t(line - 1)]) + 1};
  }
  Position at(std::size_t offset) const {
    const auto [line, column] = numbers_at(offset);
    return {file_, line, column};
  }

 private:
  const std::string& file_;
  std::vector<std::size_t> starts_;
};

class Tree {
 public:
  Tree(const std::string& text, const std::string& file)
      : text_(text),
        begin_(text.data()),
        furthest_(text.data()),
        lines_(text, file),
        in_file_(Builder::make({}, {file, 0, 0})) {}

  Value parse() {
    const char* end = begin_ + text_.size();
    nlohmann::json::sax_parse(CountingIterator(begin_, &furthest_), CountingIterator(end, &furthest_), this,
                              nlohmann::json::input_format_t::json, true, true);
    problems_.throw_if_any();
    return std::move(root_);
  }

  // --- events ---
  bool null() { return scalar({}, consumed() - 4); }
  bool boolean(bool value) { return scalar(value, consumed() - (value ? 4 : 5)); }
  bool number_integer(std::int64_t value) { return scalar(double(value), number_start()); }
  bool number_unsigned(std::uint64_t value) { return scalar(double(value), number_start()); }
  bool number_float(double value, const std::string& digits) {
    if (value == 0 && digits.substr(0, digits.find_first_of("eE")).find_first_of("123456789") != std::string::npos)
      return refuse(number_start(), fmt::format("{} is too small for a number, it would become 0", shortened(digits)));
    return scalar(value, number_start());
  }
  // A NUL would cut the messages of components that quote the text.
  bool string(std::string& value) {
    if (has_control_characters(value, "\n\t")) refuse(string_start(), "a control character in a text");
    return scalar(std::move(value), string_start());
  }
  bool binary(std::vector<std::uint8_t>&) { return false; }

  bool start_object(std::size_t) { return open(Members()); }
  bool key(std::string& name) {
    Frame& frame = open_.back();
    if (name.size() > limits::name) {
      problems_.error({lines_.at(string_start()), join(""),
                       fmt::format("a key of {} bytes, expected at most {}", name.size(), limits::name)});
      return false;
    }
    if (has_control_characters(name, ""))
      problems_.error({lines_.at(string_start()), join(name), "a control character in a key, expected text"});
    if (!frame.keys.insert(name).second) {
      problems_.error({lines_.at(string_start()), join(name),
                       fmt::format("the key \"{}\" stands here a second time; each key may stand once", name)});
    }
    frame.key = std::move(name);
    return true;
  }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(Items()); }
  bool end_array() { return close(); }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    std::string what = error.what();
    if (error.id == 406) {  // number overflow
      const std::size_t start = number_start(), length = text_.find_first_not_of(number_characters, start) - start;
      return refuse(
          start, fmt::format("{} is too large for a number", shortened(std::string_view(text_).substr(start, length))));
    }
    if (auto found = find_syntax_error(text_)) {
      problems_.error({lines_.at(found->at), here(), "not valid JSON: " + std::move(found->message)});
      return false;
    }
    // "[json.exception...] parse error at line 1, column 2: syntax error while parsing value - invalid literal; last
    // read..."
    if (const auto colon = what.find(": "); colon != std::string::npos) what = what.substr(colon + 2);
    const std::size_t at = std::min(consumed() ? consumed() - 1 : 0, text_.size());
    problems_.error({lines_.at(at), here(), "not valid JSON: " + what});
    return false;
  }

 private:
  struct Frame {
    Value value;
    std::string key;
    std::unordered_set<std::string> keys;
  };

  std::size_t consumed() const { return std::size_t(furthest_ - begin_); }

  // The parser has read one character past a number, unless the text ended.
  std::size_t number_start() const {
    const auto part = [](char c) { return number_characters.find(c) != std::string_view::npos; };
    std::size_t i = consumed();
    if (i > 0 && !part(text_[i - 1])) --i;
    while (i > 0 && part(text_[i - 1])) --i;
    return i;
  }
  // Inside a string, a quote follows an odd number of backslashes.
  std::size_t string_start() const {
    std::size_t i = consumed() - 1;
    for (;;) {
      do --i;
      while (i > 0 && text_[i] != '"');
      std::size_t backslashes = 0;
      while (backslashes < i && text_[i - 1 - backslashes] == '\\') ++backslashes;
      if (backslashes % 2 == 0) return i;
    }
  }

  std::string here() const {
    std::string path;
    for (const Frame& frame : open_) append(frame, frame.key, path);
    return path;
  }
  std::string join(const std::string& name) const {
    std::string path;
    for (const Frame& frame : open_) append(frame, &frame == &open_.back() ? name : frame.key, path);
    return path;
  }
  static void append(const Frame& frame, const std::string& key, std::string& path) {
    if (frame.value.type() == Value::Type::array)
      path += fmt::format("[{}]", frame.value.items().size());
    else if (!key.empty())
      path += (path.empty() ? "" : ".") + key;
  }

  bool refuse(std::size_t at, std::string message) {
    problems_.error({lines_.at(at), here(), std::move(message)});
    return false;
  }
  bool too_many(std::size_t at) {
    if (++values_ <= limits::values) return false;
    refuse(at, fmt::format("the scene has more than {} values", limits::values));
    return true;
  }
  Value make(Builder::Content content, std::size_t start) const {
    const auto [line, column] = lines_.numbers_at(start);
    return Builder::make(std::move(content), in_file_, line, column);
  }
  bool scalar(Builder::Content content, std::size_t start) {
    if (too_many(start)) return false;
    place(make(std::move(content), start));
    return true;
  }
  bool open(Builder::Content content) {
    const std::size_t start = consumed() - 1;
    if (too_many(start)) return false;
    if (open_.size() >= limits::nested)
      return refuse(start, fmt::format("nested deeper than {} levels", limits::nested));
    open_.push_back({make(std::move(content), start), {}, {}});
    return true;
  }
  bool close() {
    Value done = std::move(open_.back().value);
    open_.pop_back();
    place(std::move(done));
    return true;
  }
  void place(Value value) {
    if (open_.empty())
      root_ = std::move(value);
    else if (open_.back().value.type() == Value::Type::array)
      Builder::items(open_.back().value).push_back(std::move(value));
    else
      Builder::members(open_.back().value).emplace_back(open_.back().key, std::move(value));
  }

  const std::string& text_;
  const char* begin_;
  const char* furthest_;
  Lines lines_;
  Value in_file_;
  Problems problems_;
  std::vector<Frame> open_;
  std::size_t values_ = 0;
  Value root_;
};

[[noreturn]] void refuse(const std::string& file, std::string message) {
  throw SceneError({{{file, 0, 0}, "", std::move(message)}});
}

}  // namespace

Value parse_text(const std::string& text, const std::string& file) {
  if (text.find('\0') != std::string::npos) refuse(file, "holds binary data, expected a JSON text");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) refuse(file, "is empty, expected a JSON object");
  Value root = Tree(text, file).parse();
  if (root.type() != Value::Type::object)
    throw SceneError({root.problem(fmt::format("found {}, expected an object", root.type_name()))});
  return root;
}

}  // namespace trammel::scene
