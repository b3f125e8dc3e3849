#include "scene/syntax_error.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "scene/shortened.hpp"

namespace trammel::scene {
namespace {

constexpr int deepest = 200;  // the parser refuses deeper nesting before it calls this scanner

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '$';
}

// Number of bytes of the UTF-8 character at the start of `text`; 0: invalid.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(0);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  // Overlong forms, surrogates, and codes above U+10FFFF.
  if ((lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) >= 0xA0)) return 0;
  if ((lead == 0xF0 && byte(1) < 0x90) || (lead == 0xF4 && byte(1) >= 0x90)) return 0;
  return length;
}

// Quotes that word processors put in place of " and '.
bool is_typographic_quote(std::string_view text) {
  for (const char* quote : {"\u2018", "\u2019", "\u201A", "\u201C", "\u201D", "\u201E", "\u00AB", "\u00BB"})
    if (text.starts_with(quote)) return true;
  return false;
}

std::string in_lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return lower;
}

bool names_no_number(std::string_view word) {
  const std::string lower = in_lower_case(word);
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

// Recursive descent over the grammar of JSON; each function returns false once the error is found.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) i_ = 3;  // a byte order mark
  }

  std::optional<SyntaxError> scan() {
    if (skip_blanks() && value() && skip_blanks() && !at_end())
      fault(i_, fmt::format("found {} after the end of the scene, which closes before it", found()));
    return std::move(error_);
  }

 private:
  bool at_end() const { return i_ >= text_.size(); }
  char here() const { return at_end() ? '\0' : text_[i_]; }

  bool fault(std::size_t at, std::string message) {
    error_ = {at, std::move(message)};
    return false;
  }

  std::string line_of(std::size_t at) const {
    return fmt::format("line {}", 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at), '\n'));
  }

  // The text at this position, quoted for a message.
  std::string found() const {
    if (at_end()) return "the end of the text";
    std::size_t end = i_;
    while (end < text_.size() && is_word(text_[end])) ++end;
    if (end > i_) return fmt::format("\"{}\"", shortened(text_.substr(i_, end - i_)));
    if (here() == '"') return "a string";
    const std::size_t length = utf8_length(text_.substr(i_));
    if (length == 0)
      return fmt::format("the byte 0x{:02X}, which is no UTF-8 text", static_cast<unsigned char>(here()));
    if (length == 1 && !std::isprint(static_cast<unsigned char>(here())))
      return fmt::format("the control character 0x{:02X}", static_cast<unsigned char>(here()));
    return fmt::format("'{}'", text_.substr(i_, length));
  }

  bool skip_blanks() {
    for (;;) {
      while (!at_end() && std::string_view(" \t\r\n").find(here()) != std::string_view::npos) ++i_;
      if (text_.substr(i_).starts_with("//")) {
        i_ = std::min(text_.find('\n', i_), text_.size());
      } else if (text_.substr(i_).starts_with("/*")) {
        const std::size_t end = text_.find("*/", i_ + 2);
        if (end == std::string_view::npos) return fault(i_, "the comment /* that begins here is never closed by */");
        i_ = end + 2;
      } else {
        return true;
      }
    }
  }

  // A character that cannot start a JSON value, with a remedy for common mistakes.
  bool stray(const char* expected) {
    switch (here()) {
      case '\'':
        return fault(i_, "found ', expected \": strings and keys stand in double quotes");
      case '#':
        return fault(i_, "found #; a comment begins with // here, or stands between /* and */");
      case '/':
        return fault(i_, "found a single /; a comment begins with //, or stands between /* and */");
      case '=':
        return fault(i_, fmt::format("an expression is a string: \"{}\"", bare_text()));
      default:
        if (is_typographic_quote(text_.substr(i_)))
          return fault(i_, fmt::format("found {}, expected the plain double quote \": strings and keys stand in these",
                                       found()));
        return fault(i_, fmt::format("found {}, expected {}", found(), expected));
    }
  }

  // The text from here to the end of the value or of the line.
  std::string bare_text() const {
    const std::size_t end = std::min(text_.find_first_of(",}]\"\r\n", i_), text_.size());
    std::string_view text = text_.substr(i_, end - i_);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
    return shortened(text);
  }

  bool value() {
    if (++depth_ > deepest) return false;
    const bool good = one_value();
    --depth_;
    return good;
  }

  bool one_value() {
    const char c = here();
    if (c == '{') return object();
    if (c == '[') return array();
    if (c == '"') return string();
    if (c == '-' || std::isdigit(static_cast<unsigned char>(c))) return number();
    if (c == '+') return fault(i_, "a number has no leading +; leave it out");
    if (c == '.') return fault(i_, "a number begins with a digit: write 0.5, not .5");
    if (is_word(c)) return word();
    if (at_end()) return unclosed(depth_ == 1 ? "a scene: {\"trammel\": 1, ...}" : "a value");
    return stray("a value: a number, a string, an object, an array, true, false or null");
  }

  bool word() {
    const std::size_t begin = i_;
    while (is_word(here())) ++i_;
    const std::string_view word = text_.substr(begin, i_ - begin);
    if (word == "true" || word == "false" || word == "null") return true;
    const std::string lower = in_lower_case(word);
    if (names_no_number(word)) return no_number(begin);
    for (const char* literal : {"true", "false", "null"})
      if (lower == literal) return fault(begin, fmt::format("found {}; it is written {}", word, literal));
    if (lower == "none") return fault(begin, "found None; it is written null, or leave the key out");
    return fault(begin, fmt::format("found {0}; a text stands in double quotes: \"{0}\", an expression too: \"=...\"",
                                    shortened(word)));
  }

  bool no_number(std::size_t begin) {
    return fault(begin, fmt::format("{} is no number of a scene; leave the key out if there is no limit",
                                    text_.substr(begin, i_ - begin)));
  }

  bool digits() {
    const std::size_t begin = i_;
    while (std::isdigit(static_cast<unsigned char>(here()))) ++i_;
    return i_ > begin;
  }

  bool number() {
    const std::size_t begin = i_;
    const auto wrong = [&](const std::string& message) {
      while (is_word(here()) || here() == '.' || here() == '+' || here() == '-') ++i_;
      return fault(begin, fmt::format("found {}, {}", shortened(text_.substr(begin, i_ - begin)), message));
    };
    if (here() == '-') ++i_;
    const std::size_t whole = i_;
    if (!digits()) {
      while (is_word(here())) ++i_;
      if (names_no_number(text_.substr(whole, i_ - whole))) return no_number(begin);
      return wrong(here() == '.' ? "expected a digit before the point: 0.5" : "expected a digit after the sign");
    }
    if (text_[whole] == '0' && i_ > whole + 1) return wrong("a number does not begin with a 0 before other digits");
    if (here() == '.' && (++i_, !digits())) return wrong("expected a digit behind the point: 1.0");
    if (here() == 'e' || here() == 'E') {
      ++i_;
      if (here() == '+' || here() == '-') ++i_;
      if (!digits()) return wrong("expected digits of the exponent: 1e-3");
    }
    if (is_word(here()) || here() == '.')
      return wrong("expected a number: a unit does not stand behind it, an expression is a string: \"=2*pi\"");
    if (here() == '*' || here() == '+' || here() == '-')
      return fault(begin, "an expression is a string that begins with =: \"=2*pi\"");
    return true;
  }

  bool string() {
    const std::size_t begin = i_++;
    for (; here() != '"'; ++i_) {
      if (at_end() || here() == '\n') return fault(begin, "the string that begins here has no closing \" on its line");
      if (static_cast<unsigned char>(here()) < 0x20)
        return fault(i_, fmt::format("found {} within a string; write \\t for a tabulator", found()));
      if (here() == '\\') {
        if (!escape()) return false;
        continue;
      }
      const std::size_t length = utf8_length(text_.substr(i_));
      if (length == 0) return fault(i_, fmt::format("found {}; save the file as UTF-8", found()));
      i_ += length - 1;
    }
    ++i_;
    return true;
  }

  bool escape() {
    const std::size_t begin = i_++;
    if (here() == 'u') return code_unit(begin);
    if (!at_end() && std::string_view("\"\\/bfnrt").find(here()) != std::string_view::npos) return true;
    return fault(begin, "no such escape: a backslash is written \\\\, a quote \\\"");
  }

  // \uXXXX; a character beyond 16 bits takes two, the first of D800 to DBFF, the second of DC00 to DFFF.
  bool code_unit(std::size_t begin) {
    unsigned code = 0;
    if (!hexadecimal(code)) return fault(begin, "expected four hexadecimal digits behind \\u");
    const auto within = [&](unsigned low, unsigned high) { return low <= code && code <= high; };
    const char* half = "this is half of a character: \\uD800 to \\uDBFF and \\uDC00 to \\uDFFF stand in pairs";
    if (within(0xDC00, 0xDFFF)) return fault(begin, half);
    if (!within(0xD800, 0xDBFF)) return true;
    if (!text_.substr(i_ + 1).starts_with("\\u")) return fault(begin, half);
    i_ += 2;
    if (!hexadecimal(code) || !within(0xDC00, 0xDFFF)) return fault(begin, half);
    return true;
  }

  // Reads four digits after this position; ends at the last of them.
  bool hexadecimal(unsigned& code) {
    code = 0;
    for (int k = 0; k < 4; ++k) {
      ++i_;
      if (!std::isxdigit(static_cast<unsigned char>(here()))) return false;
      const char digit = char(std::tolower(static_cast<unsigned char>(here())));
      code = 16 * code + unsigned(digit <= '9' ? digit - '0' : digit - 'a' + 10);
    }
    return true;
  }

  bool object() {
    const std::size_t opened = i_++;
    bracket_ = opened;
    last_key_.reset();
    std::optional<std::size_t> comma, last;
    for (;;) {
      if (!skip_blanks()) return false;
      if (here() == '}') return comma ? comma_too_much(*comma, "}") : close();
      if (here() == ',') return comma_too_much(i_, comma ? "another" : "the first key");
      bracket_ = opened;
      last_key_ = last;
      last = i_;
      if (!key()) return false;
      last_key_ = last;
      if (!skip_blanks() || !value()) return false;
      bracket_ = opened;
      last_key_ = last;
      const std::size_t end = i_;
      if (!skip_blanks()) return false;
      if (here() == '}') return close();
      if (here() != ',') return no_comma(end, opened, '}');
      comma = i_++;
    }
  }

  bool key() {
    if (at_end()) return unclosed("a key");
    if (here() != '"') {
      const std::size_t begin = i_;
      while (is_word(here())) ++i_;
      if (i_ > begin)
        return fault(begin, fmt::format("found {0}, a key stands in double quotes: \"{0}\"",
                                        shortened(text_.substr(begin, i_ - begin))));
      if (here() == ']') return other_bracket('}');
      return stray("a key in double quotes");
    }
    const std::size_t begin = i_;
    if (!string()) return false;
    const std::string name = shortened(text_.substr(begin, i_ - begin));
    const std::size_t end = i_;
    if (!skip_blanks()) return false;
    if (here() == '=') return fault(i_, fmt::format("found =, expected : between the key {} and its value", name));
    if (here() != ':')
      return fault(end, fmt::format("a colon is missing here, between the key {} and its value", name));
    ++i_;
    return true;
  }

  bool array() {
    const std::size_t opened = i_++;
    bracket_ = opened;
    last_key_.reset();
    std::optional<std::size_t> comma;
    for (;;) {
      if (!skip_blanks()) return false;
      if (here() == ']') return comma ? comma_too_much(*comma, "]") : close();
      if (here() == ',') return comma_too_much(i_, comma ? "another" : "the first value");
      if (here() == '}') return other_bracket(']');
      if (!value()) return false;
      bracket_ = opened;
      last_key_.reset();
      const std::size_t end = i_;
      if (!skip_blanks()) return false;
      if (here() == ']') return close();
      if (here() == ':')
        return fault(i_,
                     fmt::format("found : in an array, the [ of {} is not closed by ] before it; named values stand "
                                 "in an object: {{\"key\": value}}",
                                 line_of(opened)));
      if (here() != ',') return no_comma(end, opened, ']');
      comma = i_++;
    }
  }

  bool close() {
    ++i_;
    return true;
  }

  bool comma_too_much(std::size_t comma, const char* before) {
    return fault(comma, fmt::format("there is a comma too much here, before {}", before));
  }

  bool no_comma(std::size_t end, std::size_t opened, char closing) {
    if (at_end()) {
      bracket_ = opened;
      return unclosed(fmt::format("a comma or {}", closing));
    }
    if (here() == '}' || here() == ']') return other_bracket(closing);
    if (here() == ';') return fault(i_, "found ;, expected a comma");
    if (std::isdigit(static_cast<unsigned char>(text_[end - 1])) && std::isalpha(static_cast<unsigned char>(here())))
      return fault(i_, fmt::format("found {} behind a number, expected a comma or {}: a unit does not stand there",
                                   found(), closing));
    if (here() == '"' || here() == '{' || here() == '[' || here() == '-' || is_word(here()))
      return fault(end, fmt::format("a comma is missing here, before {}", next_text()));
    return stray(closing == '}' ? "a comma or }" : "a comma or ]");
  }

  // The following string or word, verbatim.
  std::string next_text() const { return here() == '"' ? text_of(i_) : found(); }

  // The string that begins at `begin`, verbatim.
  std::string text_of(std::size_t begin) const {
    const std::size_t end = text_.find_first_of("\"\n", begin + 1);
    return shortened(text_.substr(begin, end == std::string_view::npos ? end : end + (text_[end] == '"') - begin));
  }

  bool other_bracket(char expected) {
    return fault(i_, fmt::format("found {}, expected {}, which closes the {} of {}", here(), expected,
                                 expected == '}' ? '{' : '[', line_of(bracket_)));
  }

  bool unclosed(const std::string& expected) {
    if (depth_ == 0 || bracket_ >= text_.size()) return fault(i_, fmt::format("the text ends, expected {}", expected));
    std::string message = fmt::format("the text ends before the {} that begins here is closed", text_[bracket_]);
    if (last_key_) message += fmt::format("; the last key in it is {} of {}", text_of(*last_key_), line_of(*last_key_));
    return fault(bracket_, message);
  }

  std::string_view text_;
  std::size_t i_ = 0;
  std::size_t bracket_ = std::string_view::npos;  // the innermost open bracket
  std::optional<std::size_t> last_key_;           // the last key in it, if it is an object
  int depth_ = 0;
  std::optional<SyntaxError> error_;
};

}  // namespace

std::optional<SyntaxError> find_syntax_error(std::string_view text) {
  return Scanner(text).scan();
}

}  // namespace trammel::scene
