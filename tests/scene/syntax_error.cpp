// Texts that are no JSON: the message stands where the mistake is and says what to write.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "scene/syntax_error.hpp"

namespace trammel::scene {
namespace {

struct Mistake {
  const char* text;  // '@' stands where the mistake is, and is taken out
  const char* message;
};

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreNamedAtTheirOwnPlace) {
  std::string text = GetParam().text;
  const std::size_t at = text.find('@');
  ASSERT_NE(at, std::string::npos);
  text.erase(at, 1);
  const auto found = find_syntax_error(text);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->at, at) << found->message;
  EXPECT_NE(found->message.find(GetParam().message), std::string::npos) << found->message;
}

INSTANTIATE_TEST_SUITE_P(
    OfPeople, Mistakes,
    testing::Values(
        Mistake{R"({"a": 1@,})", "a comma too much here, before }"},
        Mistake{"{\"a\": [1, 2@,\n  ]}", "a comma too much here, before ]"},
        Mistake{R"({"a": 1,@, "b": 2})", "a comma too much"}, Mistake{R"({"a": [@,1]})", "a comma too much"},
        Mistake{"{\"a\": 1@\n \"b\": 2}", R"(a comma is missing here, before "b")"},
        Mistake{R"({"a": [1@ 2]})", R"(a comma is missing here, before "2")"},
        Mistake{"{\"a\": {\"b\": 1}@ // ends\n \"c\": 2}", R"(a comma is missing here, before "c")"},
        Mistake{R"({"a"@ 1})", "a colon is missing here"}, Mistake{R"({"a" @= 1})", "expected :"},
        Mistake{R"({@mass: 1})", R"(found mass, a key stands in double quotes: "mass")"},
        Mistake{R"({@'a': 1})", "double quotes"}, Mistake{R"({"a": @'b'})", "double quotes"},
        Mistake{"{@# a comment\n\"a\": 1}", "a comment begins with //"},
        Mistake{"{\"a\": 1 @/ a comment\n}", "a comment begins with //"},
        Mistake{"{\"a\": 1 @/* a comment }", "never closed by */"}, Mistake{R"({"a": @NaN})", "NaN is no number"},
        Mistake{R"({"a": @-Infinity})", "-Infinity is no number"}, Mistake{R"({"a": @-})", "expected a digit"},
        Mistake{R"({"a": @inf})", "no number"}, Mistake{R"({"a": @True})", "it is written true"},
        Mistake{R"({"a": @None})", "it is written null"},
        Mistake{R"({"a": @revolute})", R"(double quotes: "revolute")"}, Mistake{R"({"a": @.5})", "write 0.5"},
        Mistake{R"({"a": @+5})", "no leading +"}, Mistake{R"({"a": @1.})", "expected a digit behind the point"},
        Mistake{R"({"a": @01})", "does not begin with a 0"}, Mistake{R"({"a": @1e})", "exponent"},
        Mistake{R"({"a": @2*pi})", "an expression is a string"}, Mistake{R"({"a": @5kg})", "a unit does not stand"},
        Mistake{R"({"a": "x@\d"})", "no such escape"}, Mistake{R"({"a": "x@\u12g4"})", "four hexadecimal digits"},
        Mistake{"{\"a\": @\"open,\n \"b\": 1}", "no closing \" on its line"},
        Mistake{"{\"a\": \"@\xC3\"}", "save the file as UTF-8"}, Mistake{"{\"a\": @\xFF}", "the byte 0xFF"},
        Mistake{"{\"a\": @[1, 2", "the text ends before the [ that begins here is closed"},
        Mistake{"@{\"a\": [1, 2]", "the text ends before the { that begins here is closed"},
        Mistake{"{\"a\": [1, 2@}}", "found }, expected ], which closes the [ of line 1"},
        Mistake{"{\"a\": {\"b\": 1@]}", "found ], expected }, which closes the { of line 1"},
        Mistake{"{\"a\": 1}@}", "after the end of the scene"},
        Mistake{"{\"a\": [\"b\"@: 1]}", "named values stand in an object"},
        Mistake{"{\"a\": 1@; \"b\": 2}", "found ;, expected a comma"},
        Mistake{R"({@, "a": 1})", "before the first key"}, Mistake{R"([1,@, 2])", "before another"},
        Mistake{R"({"a": 1 @m, "b": 2})", "behind a number, expected a comma or }: a unit"},
        Mistake{R"({"a": [1, 2 @mm]})", "behind a number, expected a comma or ]: a unit"},
        Mistake{R"({"a": @=2*pi*N, "b": 1})", R"(an expression is a string: "=2*pi*N")"},
        Mistake{R"({"a": [1, 2@)})", "found ')', expected a comma or ]"},
        Mistake{"{\"a\": @\u201Cb\u201D}", "plain double quote"}, Mistake{"{@\u2018a\u2019: 1}", "plain double quote"},
        Mistake{R"({"a": "x@\ud800 y"})", "half of a character"}, Mistake{R"({"a": "@\uDFFF"})", "half of a character"},
        Mistake{R"({"a": "@\ud83d\u0041"})", "half of a character"},
        Mistake{"{\"a\": [1,\n \"b\"@: 1}", "the [ of line 1 is not closed by ] before it"},
        Mistake{"@{\"a\": 1,\n\"b\": {\"c\": [1]}\n", R"(the last key in it is "b" of line 2)"},
        Mistake{"@{\"a\": 1,\n\"b\": {\"c\": [1]},", R"(the last key in it is "b" of line 2)"},
        Mistake{"@{\"a\": 1,\n\"b\": ", R"(the last key in it is "b" of line 2)"}));

// The parser decides, the scanner explains: they agree on texts with one random change.
TEST(SyntaxError, IsFoundInEveryTextThatTheParserRefusesAndInNoOther) {
  const std::string scene =
      "{\"a\": [1, -2.5e-3, {\"b\": \"x\\n\xC3\xA4\"}], // c\n \"d\": {\"e\": true, \"f\": null} /* g */}";
  ASSERT_FALSE(find_syntax_error(scene));
  ASSERT_FALSE(find_syntax_error(R"(["\ud83d\uDE00", "\u00e4"])"));
  const std::string characters = "{}[]\",:0123456789.eE+-/*#' \n\ttruefalsn\\u\xC3\xA4\xFF";
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    std::string text = scene;
    for (int changes = 1 + int(random() % 3); changes-- > 0;) {
      const std::size_t at = random() % text.size();
      const char c = characters[random() % characters.size()];
      if (random() % 3 == 0)
        text.erase(at, 1);
      else if (random() % 2 == 0)
        text.insert(at, 1, c);
      else
        text[at] = c;
    }
    const bool valid = nlohmann::json::accept(text, true);
    EXPECT_EQ(!valid, find_syntax_error(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace trammel::scene
