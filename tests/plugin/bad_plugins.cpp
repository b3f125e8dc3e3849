// Plugins that are bad, each in its way: the registry refuses them with a reason and goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <chrono>
#include <clocale>
#include <cstdlib>

#include <trammel/body.hpp>
#include <trammel/integrator.hpp>

#include "plugin/parameters.hpp"
#include "plugin/process/settings.hpp"
#include "plugin/rehearsal.hpp"
#include "registry_of_test.hpp"
#include "test_library.hpp"

namespace trammel::plugin {
namespace {

using testing::HasSubstr;

// Why the registry refuses a library; "" if it loads it. The message must name the library itself.
std::string refusal(const std::filesystem::path& file) {
  Registry registry = empty_registry();
  try {
    registry.load(file);
    return "";
  } catch (const PluginError& e) {
    EXPECT_THAT(e.what(), HasSubstr(file.filename().string()));
    return e.cause();
  }
}

TEST(BadPlugin, Missing) {
  EXPECT_EQ(refusal(library("no_such_library")), "no such file");
}

TEST(BadPlugin, NotAPlugin) {
  EXPECT_THAT(refusal(library("not_a_plugin")), HasSubstr("not a Trammel plugin"));
}

TEST(BadPlugin, OfAnotherAbi) {
  EXPECT_EQ(refusal(library("other_abi")),
            "built for another program: eigen_align: the plugin has 32, this program 64");
}

TEST(BadPlugin, Truncated) {
  const Folder folder;
  const std::string whole = content(library("good"));
  for (const std::size_t tenths : {1, 3, 5, 7, 9}) {
    write(folder / "cut.so", whole.substr(0, whole.size() * tenths / 10));
    EXPECT_THAT(refusal(folder / "cut.so"), HasSubstr("truncated"));
  }
}

TEST(BadPlugin, ThrowingAtLoad) {
  EXPECT_EQ(refusal(library("throws_at_load")), "it threw while it was loaded: no licence found");
}

TEST(BadPlugin, EndingTheProgramAtLoad) {
  EXPECT_EQ(refusal(library("exits_at_load")), "it ends the program with code 7 while it is loaded");
}

TEST(BadPlugin, CrashingAtLoad) {
  EXPECT_EQ(refusal(library("crashes_at_load")), "it crashes while it is loaded: Killed");
}

// It writes to every descriptor that it finds: a pipe of the program's whose reader has gone would end it by a signal.
TEST(BadPlugin, FindsNoFilesOfTheProgram) {
  std::array<int, 2> ends;
  ASSERT_EQ(::pipe(ends.data()), 0);
  ::close(ends[0]);
  try {
    rehearse(library("writes_for_ever"), std::chrono::milliseconds(500));
    FAIL() << "it finishes";
  } catch (const PluginError& e) {
    EXPECT_EQ(e.cause(), "it did not finish within 500 ms while it is loaded");
  }
  ::close(ends[1]);
}

// Each waits for ever, or writes for ever. The limit is one on the whole, so that signs of life do not prolong it.
TEST(BadPlugin, NeverFinishing) {
  using std::chrono::steady_clock;
  const std::chrono::milliseconds limit(2000);  // a busy machine gets to each place by then
  for (const auto& [name, where] :
       {std::pair{"never_loaded", "while it is loaded"},
        {"writes_for_ever", "while it is loaded"},
        {"hangs_while_declaring", "while it declares its components"},
        {"hangs_in_constructor", "in the constructor of correction \"hangs_in_constructor\""}}) {
    const auto began = steady_clock::now();
    try {
      rehearse(library(name), limit);
      FAIL() << name << " goes on for ever";
    } catch (const PluginError& e) {
      EXPECT_EQ(e.cause(), std::string("it did not finish within 2000 ms ") + where);
    }
    EXPECT_LT(steady_clock::now() - began, limit + std::chrono::seconds(5)) << name;  // of a busy machine
  }
}

// A process is gone when it has no entry in /proc, or is a zombie that nobody has asked for.
bool is_gone(const std::string& process) {
  const std::string status = content("/proc/" + process + "/stat");
  return status.empty() || status.find(") Z") != std::string::npos;
}

TEST(BadPlugin, LeavingAProcessBehindThatIsEnded) {
  const Folder folder;
  const std::string mark = folder / "process";
  ::setenv("TRAMMEL_TEST_FILE", mark.c_str(), 1);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(refusal(library("leaves_a_process")),
            "it starts a process while it is loaded that goes on when this one ends");
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));  // it would go on for 60 s
  ::unsetenv("TRAMMEL_TEST_FILE");
  std::string process = content(mark);
  ASSERT_FALSE(process.empty());
  process.pop_back();
  for (int i = 0; i < 200 && !is_gone(process); ++i) ::usleep(10'000);
  EXPECT_TRUE(is_gone(process)) << process;
}

TEST(BadPlugin, CrashingWhileDeclaring) {
  EXPECT_THAT(refusal(library("crashes_while_declaring")), HasSubstr("while it declares its components"));
}

TEST(BadPlugin, EndingTheProcessWhileDeclaring) {
  EXPECT_EQ(refusal(library("ends_while_declaring")),
            "it ends the program with code 0 while it declares its components");
}

TEST(BadPlugin, EndingTheProcessInAConstructor) {
  EXPECT_EQ(refusal(library("ends_in_constructor")),
            "it ends the program with code 0 in the constructor of correction \"ends_in_constructor\"");
}

TEST(BadPlugin, ChangingTheArithmeticOfTheProcessLeavesItAsItWas) {
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  EXPECT_EQ(refusal(library("changes_arithmetic")), "");
  EXPECT_STREQ(arithmetic_fault(), "");
  EXPECT_EQ(std::setlocale(LC_ALL, nullptr), locale);
}

// Every library that fails before it is loaded, in one folder with a sound one.
TEST(BadPlugin, DoesNotKeepOthersOfItsFolderFromBeingFound) {
  const Folder folder;
  folder.copy("good", "m.so");
  const std::vector<std::string> bad = {"crashes_at_load",         "exits_at_load",        "throws_at_load",
                                        "crashes_while_declaring", "ends_while_declaring", "throws_while_declaring",
                                        "ends_in_constructor",     "missing_symbol",       "hides_its_entry"};
  for (const std::string& name : bad) folder.copy(name, name + ".so");
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
  EXPECT_EQ(registry.failures().size(), bad.size());
}

TEST(BadPlugin, ThrowingWhileDeclaring) {
  EXPECT_EQ(refusal(library("throws_while_declaring")),
            "it threw while declaring its components: no name comes to mind");
}

TEST(BadPlugin, MissingASymbol) {
  const std::string cause = refusal(library("missing_symbol"));
  EXPECT_THAT(cause, HasSubstr("undefined symbol"));
  EXPECT_THAT(cause, HasSubstr("a_function_that_nobody_defines"));
  EXPECT_THAT(cause, testing::Not(HasSubstr("Bad file descriptor")));  // Boost.DLL's own, misleading
}

TEST(BadPlugin, HidingItsEntry) {
  EXPECT_EQ(refusal(library("hides_its_entry")),
            "it exports no function trammel_declarations; is it hidden by a linker script?");
}

TEST(BadPlugin, DeclaringANameTwice) {
  EXPECT_EQ(refusal(library("twice")), "it declares correction \"idle\" twice");
}

TEST(BadPlugin, DeclaringTheNameOfAnother) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  try {
    registry.load(library("same_name"));
    FAIL() << "two libraries declare \"good\"";
  } catch (const PluginError& e) {
    EXPECT_THAT(e.what(), HasSubstr("same_name.so: it declares integrator \"good\", which "));
    EXPECT_THAT(e.what(), HasSubstr("good.so declares already"));
  }
}

TEST(BadPlugin, DeclaringTheNameOfAnotherFolder) {
  const Folder mine, theirs;
  mine.copy("good", "good.so");
  theirs.copy("same_name", "good.so");
  Registry registry = empty_registry();
  registry.search(mine.path());
  registry.search(theirs.path());
  EXPECT_THROW(registry.find(Kind::integrator, "good"), PluginError);
}

// --- components that are bad ---

std::string made_badly(const std::string& name, Kind kind) {
  Registry registry = empty_registry();
  registry.load(library(name));
  scene::Problems problems;
  try {
    make<Body>(registry, kind, scene_of(R"({"type": ")" + name + "\"}"), World{}, problems);
    return "";
  } catch (const PluginError& e) {
    EXPECT_THAT(e.what(), HasSubstr(name + ".so"));
    return e.what();
  }
}

TEST(BadPlugin, ThrowingInItsConstructor) {
  EXPECT_THAT(made_badly("throws_in_constructor", Kind::correction),
              HasSubstr("correction throws_in_constructor: its constructor: it threw: out of luck"));
}

TEST(BadPlugin, ThrowingInPrepare) {
  EXPECT_THAT(made_badly("throws_in_prepare", Kind::correction),
              HasSubstr("prepare: it threw something that is no std::exception"));
}

TEST(BadPlugin, LyingAboutItsKind) {
  EXPECT_THAT(made_badly("lies_about_its_kind", Kind::body), HasSubstr("does not derive from that interface"));
}

}  // namespace
}  // namespace trammel::plugin
