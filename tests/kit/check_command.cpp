// What `trammel check` and `trammel new` print, ask for and refuse.
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "support.hpp"
#include "testing/kit/catalogue.hpp"

namespace kit_test {
namespace {

using cli::trammel;
using testing::HasSubstr;

const std::string good = bad_plugins + "kit_components.so", heun = bad_plugins + "kit_integrators.so";

const char* const interfaces[] = {"integrator",    "body",        "joint",           "force",
                                  "contact force", "restitution", "smooth friction", "set-valued friction",
                                  "correction"};

// Without white space, line ends of comments included.
std::string squeezed(const std::string& text) {
  return std::regex_replace(std::regex_replace(text, std::regex("\\n\\s*//"), "\n"), std::regex("\\s+"), "");
}

TEST(KitWords, QuoteLinesThatStandInThePublicHeaders) {
  for (const char* interface : interfaces)
    for (const auto& check : trammel::kit::catalogue(interface)) {
      const auto& contract = check.words.contract;
      std::ifstream file(TRAMMEL_SOURCE_DIR "/framework/include/" + contract.header);
      std::stringstream text;
      text << file.rdbuf();
      EXPECT_NE(squeezed(text.str()).find(squeezed(contract.line)), std::string::npos)
          << check.words.name << " quotes " << contract.header << ": " << contract.line;
    }
}

TEST(KitWords, NameEachCheckOnceAndSayWhatItClaims) {
  for (const char* interface : interfaces) {
    std::set<std::string> names;
    for (const auto& check : trammel::kit::catalogue(interface)) {
      EXPECT_TRUE(names.insert(check.words.name).second) << check.words.name;
      EXPECT_TRUE(check.words.claim.ends_with(".")) << check.words.name << ": " << check.words.claim;
      EXPECT_NE(check.words.equation, "") << check.words.name;
    }
    EXPECT_GE(names.size(), 14u) << interface;
  }
}

TEST(CheckCommand, CountsWhatRanAndSaysWhyTheRestDidNot) {
  const auto json = check(good, {"--component", "good_spring"}, 0);
  const auto& c = json["components"][0];
  EXPECT_EQ(c["ran"].get<int>() + c["skipped"].get<int>(), c["of"].get<int>());
  EXPECT_EQ(c["of"].get<std::size_t>(), c["checks"].size());
  EXPECT_EQ(c["passed"], c["ran"]);
  for (const auto& one : c["checks"])
    if (one["verdict"] == "skipped") {
      EXPECT_NE(one["found"], "") << one["name"];
    }
}

TEST(CheckCommand, SaysOfAFailureTheEquationTheNumbersTheContractAndHowToRunItAlone) {
  const auto result =
      trammel({"check", heun, "--component", "claims_order_3", "--only", "integrator.order-on-the-pendulum"});
  EXPECT_EQ(result.exit_code, 1);
  for (const char* part :
       {"FAILED", "p = Traits::order", "found 2.0", "trammel/integrator.hpp: \"Of q and v with constant steps",
        "--only integrator.order-on-the-pendulum --in-process", "--component claims_order_3"})
    EXPECT_THAT(result.out, HasSubstr(part));
}

TEST(CheckCommand, RunsOneCheckInItsOwnProcess) {
  const auto result =
      trammel({"check", heun, "--component", "good_heun", "--only", "integrator.moves-on-in-time", "--in-process"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 of 1 checks ran: 1 passed"));
}

TEST(CheckCommand, AcceptsAnExpectedFailureWithItsReason) {
  const std::vector<std::string> words = {"check",          heun,     "--component",
                                          "claims_order_3", "--only", "integrator.order-on-the-pendulum"};
  auto expecting = words;
  expecting.insert(expecting.end(), {"--expect", "integrator.order-on-the-pendulum=a draft"});
  const auto result = trammel(expecting);
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("expected: a draft"));
}

TEST(CheckCommand, ListsItsChecksWithoutRunningThem) {
  const auto result = trammel({"check", good, "--component", "good_hertz", "--list"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("contact.never-pulls"));
  EXPECT_THAT(result.out, HasSubstr("The contact force is never negative."));
}

TEST(CheckCommand, RefusesWhatIsNotThere) {
  const auto none = trammel({"check", "newmrk"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("newmark"));
  const auto check = trammel({"check", good, "--component", "good_hertz", "--only", "contact.never-puls"});
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_THAT(check.err, HasSubstr("Did you mean \"contact.never-pulls\"?"));
  const auto component = trammel({"check", good, "--component", "good_herz"});
  EXPECT_EQ(component.exit_code, 2);
  EXPECT_THAT(component.err, HasSubstr("good_hertz"));
  EXPECT_EQ(trammel({"check", good, "--level", "deep"}).exit_code, 2);
  EXPECT_EQ(trammel({"check", good, "--seed", "one"}).exit_code, 2);
  EXPECT_EQ(trammel({"check", good, "--with", "mass=2"}).exit_code, 2);
}

TEST(CheckCommand, SaysOfALibraryThatCannotBeLoadedWhy) {
  for (const char* library : {"crashes_at_load.so", "not_a_plugin.so", "other_abi.so"}) {
    const auto result = trammel({"check", bad_plugins + library});
    EXPECT_EQ(result.exit_code, 3) << library << result.out << result.err;
    EXPECT_THAT(result.err, HasSubstr(library));
  }
}

// The measured radius stands beside the theory's; figures of every kind are there, and the page is one HTML file.
TEST(CheckReport, ShowsTheSpectralRadiusOfTheoryAndEveryBuiltInBeside) {
  cli::TemporaryFolder folder;
  const std::string file = (folder.path() / "hht.html").string();
  const auto json = check(installed + "hht_alpha.so", {"--only", "integrator.moves-on-in-time", "--report", file}, 0);
  EXPECT_THAT(cli::read_file(file), HasSubstr("<html"));
  const auto& page = json["components"][0]["page"];
  std::set<std::string> curves;
  int radii = 0;
  for (const auto& figure : page["figures"])
    for (const auto& curve : figure["curves"]) {
      curves.insert(curve["name"]);
      if (figure["title"] != "Spectral radius" || curve["name"] == "measured") continue;
      const auto& measured = figure["curves"][0]["points"];
      for (const auto& theory : curve["points"])
        for (const auto& point : measured)
          if (point[0] == theory[0]) {
            ++radii;
            // Roots that have died out within the first steps are found by the matrix pencil to some digits only.
            EXPECT_NEAR(point[1].get<double>(), theory[1].get<double>(), 1e-4) << "omega h = " << point[0];
          }
    }
  EXPECT_GE(radii, 30);
  for (const char* built_in : {"newmark", "generalized_alpha", "runge_kutta_4", "dormand_prince", "dop853"})
    EXPECT_TRUE(curves.contains(built_in)) << built_in;
  EXPECT_THAT(page["sentences"].dump(), HasSubstr("Deception rate"));
}

TEST(NewCommand, RefusesNamesThatCannotBe) {
  cli::TemporaryFolder folder;
  const auto made = [&](const std::string& kind, const std::string& name) {
    return trammel({"new", kind, name}, {.folder = folder.path()});
  };
  EXPECT_THAT(made("integrater", "mine").err, HasSubstr("integrator"));
  EXPECT_THAT(made("integrator", "newmark").err, HasSubstr("choose another name"));
  for (const char* name : {"My_method", "2nd", "my-method", "all", ""})
    EXPECT_EQ(made("integrator", name).exit_code, 2) << name;
  EXPECT_EQ(trammel({"new", "integrator"}, {.folder = folder.path()}).exit_code, 2);
  EXPECT_EQ(made("force", "mine").exit_code, 0);
  EXPECT_THAT(made("joint", "mine").err, HasSubstr("exists already"));
}

TEST(NewCommand, LeavesNoPlaceholder) {
  cli::TemporaryFolder folder;
  for (const char* kind : {"integrator", "body", "joint", "force", "contact", "friction", "correction"}) {
    const std::string name = std::string("own_") + kind;
    ASSERT_EQ(trammel({"new", kind, name}, {.folder = folder.path()}).exit_code, 0) << kind;
    for (const char* file : {"/CMakeLists.txt", "/README.md", "/test.cpp"}) {
      const std::string text = cli::read_file(folder.path() / (name + file));
      EXPECT_THAT(text, HasSubstr(name));
      for (const char* placeholder : {"my_", "KIND", "HEADER", "USE", "to change\""})
        EXPECT_THAT(text, testing::Not(HasSubstr(placeholder))) << kind << file;
    }
    EXPECT_THAT(cli::read_file(folder.path() / name / (name + ".cpp")), HasSubstr("(\"" + name + "\","));
  }
}

}  // namespace
}  // namespace kit_test
