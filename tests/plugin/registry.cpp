#include "plugin/registry.hpp"

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
#include "plugin/process_settings.hpp"
#include "plugin/rehearsal.hpp"
#include "test_library.hpp"

namespace trammel::plugin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Registry empty_registry() {
  return Registry(Registry::Start::empty);
}

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

std::string unknown(Registry& registry, Kind kind, const std::string& name) {
  try {
    registry.find(kind, name);
    return "";
  } catch (const UnknownComponent& e) {
    return e.what();
  }
}

scene::Value scene_of(const std::string& text) {
  return scene::Scene::parse(text, "scene.json").root();
}

// --- what it finds ---

TEST(Registry, FindsAComponentOfALoadedLibrary) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  const Entry& entry = registry.find(Kind::integrator, "good");
  EXPECT_EQ(entry.declaration.summary, "explicit Euler");
  EXPECT_EQ(entry.file, std::filesystem::canonical(library("good")));
}

TEST(Registry, FindsEveryComponentOfALibrary) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  EXPECT_EQ(registry.find(Kind::contact, "good_contact").declaration.kind, Kind::contact);
}

TEST(Registry, LoadsOnlyTheLibraryThatIsNamed) {
  const Folder folder;
  const auto good = folder.copy("good", "good.so");
  folder.copy("spoilt_step", "spoilt_step.so");
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_THAT(registry.files(), IsEmpty());
  registry.find(Kind::integrator, "good");
  EXPECT_THAT(registry.files(), ElementsAre(std::filesystem::canonical(good)));
}

TEST(Registry, FindsAComponentInALibraryOfAnotherName) {
  const Folder folder;
  folder.copy("good", "collection.so");
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_EQ(registry.find(Kind::contact, "good_contact").declaration.name, "good_contact");
}

TEST(Registry, SearchesTheEnvironmentsPath) {
  const Folder first, second;
  first.copy("good", "good.so");
  const auto file = second.copy("spoilt_force", "library_of_a_friend.so");
  ::setenv("TRAMMEL_PLUGIN_PATH", (first.path().string() + "::" + file.string()).c_str(), 1);
  Registry registry;
  ::unsetenv("TRAMMEL_PLUGIN_PATH");
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
  EXPECT_EQ(registry.find(Kind::body, "spoilt_force").declaration.name, "spoilt_force");
}

TEST(Registry, SearchesTheScenesPluginsBesideTheSceneFile) {
  const Folder folder;
  folder.copy("good", "good.so");
  write(folder / "scene.json", R"({"plugins": ["good.so"]})");
  const scene::Scene scene = scene::Scene::load((folder / "scene.json").string());
  Registry registry = empty_registry();
  registry.allow_scene_plugins();
  scene::Problems problems;
  registry.search_scene(scene.root(), problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
}

TEST(Registry, LoadsNothingThatASceneNamesWithoutConsent) {
  const Folder folder;
  folder.copy("good", "good.so");
  write(folder / "scene.json", R"({"plugins": ["good.so", "."]})");
  const scene::Scene scene = scene::Scene::load((folder / "scene.json").string());
  Registry registry = empty_registry();
  scene::Problems problems;
  registry.search_scene(scene.root(), problems);
  ASSERT_EQ(problems.errors().size(), 2u);
  EXPECT_THAT(problems.errors()[0].text(), HasSubstr("scene.json:1:14: plugins[0]: "));
  EXPECT_THAT(problems.errors()[0].text(), HasSubstr("--allow-scene-plugins"));
  EXPECT_TRUE(registry.files().empty());
}

TEST(Registry, TrustsAScenesPluginsInAFolderThatIsSearchedAndNoLinkOutOfIt) {
  const Folder trusted, stranger;
  trusted.copy("good", "good.so");
  const auto elsewhere = stranger.copy("spoilt_force", "spoilt_force.so");
  std::filesystem::create_symlink(elsewhere, trusted / "link.so");
  Registry registry = empty_registry();
  registry.search(trusted.path());
  scene::Problems problems;
  const auto naming = [&](const char* file) {
    return scene_of((R"({"plugins": [")" + (trusted / file).string() + R"("]})").c_str());
  };
  registry.search_scene(naming("good.so"), problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(registry.files().size(), 1u);
  registry.search_scene(naming("link.so"), problems);
  EXPECT_EQ(problems.errors().size(), 1u);
  EXPECT_EQ(registry.files().size(), 1u);
}

TEST(Registry, SearchesTheUsersFolder) {
  const Folder data;
  std::filesystem::create_directories(data / "trammel/plugins");
  std::filesystem::copy_file(library("good"), data / "trammel/plugins/good.so");
  ::setenv("XDG_DATA_HOME", data.path().c_str(), 1);
  Registry registry;
  ::unsetenv("XDG_DATA_HOME");
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
}

TEST(Registry, NeverSearchesTheCurrentFolder) {
  const Folder here;
  here.copy("good", "good.so");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(here.path());
  ::setenv("XDG_DATA_HOME", "relative", 1);  // no absolute path is no path of the user's, and an empty entry no folder
  ::setenv("TRAMMEL_PLUGIN_PATH", ":", 1);
  std::filesystem::create_directories("relative/trammel/plugins");
  std::filesystem::copy_file("good.so", "relative/trammel/plugins/good.so");
  Registry registry;
  ::unsetenv("XDG_DATA_HOME"), ::unsetenv("TRAMMEL_PLUGIN_PATH");
  const std::string answer = unknown(registry, Kind::integrator, "good");
  std::filesystem::current_path(before);
  EXPECT_THAT(answer, HasSubstr("no integrator \"good\""));
}

// Which of two methods of one name has run must never be a matter of the order of folders.
TEST(Registry, RefusesOneNameInTwoFoldersOfTheSearchPath) {
  const Folder first, second;
  first.copy("good", "good.so"), second.copy("good", "good.so");
  Registry registry = empty_registry();
  registry.search(first.path()), registry.search(second.path());
  try {
    registry.find(Kind::integrator, "good");
    FAIL() << "took one of the two";
  } catch (const PluginError& e) {
    EXPECT_THAT(std::string(e.what()), HasSubstr(first.path().string()));
    EXPECT_THAT(std::string(e.what()), HasSubstr(second.path().string()));
  }
}

TEST(Registry, ReportsAMissingPluginOfTheSceneWhereItIsNamed) {
  Registry registry = empty_registry();
  scene::Problems problems;
  registry.search_scene(scene_of(R"({"plugins": ["no_such.so"]})"), problems);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].text(),
              HasSubstr("scene.json:1:14: plugins[0]: no such file or folder: no_such.so"));
}

TEST(Registry, ReportsPluginsThatAreNoArray) {
  Registry registry = empty_registry();
  scene::Problems problems;
  registry.search_scene(scene_of(R"({"plugins": "good.so"})"), problems);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].message, HasSubstr("expected an array"));
}

TEST(Registry, TakesTheSameFileTwice) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  registry.load(library("good").parent_path() / "." / "good.so");
  EXPECT_EQ(registry.files().size(), 1u);
}

TEST(Registry, ListsByKindAndName) {
  Registry registry = empty_registry();
  registry.load(library("spoilt_step"));
  registry.load(library("good"));
  std::vector<std::string> names;
  for (const Entry* entry : registry.all()) names.push_back(entry->declaration.name);
  EXPECT_THAT(names, ElementsAre("good", "spoilt_step", "good_contact"));
}

TEST(Registry, ListsWhatWorksAndNamesWhatDoesNot) {
  const Folder folder;
  folder.copy("good", "good.so");
  folder.copy("other_abi", "other_abi.so");
  folder.copy("not_a_plugin", "libpng.so");  // other libraries may lie in the same folder
  write(folder / "cut.so", content(library("good")).substr(0, 1000));
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_EQ(registry.all().size(), 2u);
  ASSERT_EQ(registry.failures().size(), 2u);
  EXPECT_THAT(registry.failures()[0].what(), HasSubstr("cut.so: truncated"));
  EXPECT_THAT(registry.failures()[1].what(), HasSubstr("other_abi.so: built for another program"));
}

// --- names it does not know ---

TEST(Registry, OffersTheNearestName) {
  Registry registry = empty_registry();
  registry.load(library("spoilt_step"));
  EXPECT_THAT(unknown(registry, Kind::integrator, "spoilt_steps"), HasSubstr("\"spoilt_step\"?"));
}

TEST(Registry, TellsTheKindANameReallyHas) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  EXPECT_THAT(unknown(registry, Kind::body, "good"), HasSubstr("\"good\" is an integrator"));
}

TEST(Registry, SaysWhenNothingIsSearched) {
  Registry registry = empty_registry();
  EXPECT_THAT(unknown(registry, Kind::body, "rigid_body"), HasSubstr("--plugin"));
}

TEST(Registry, SaysWhichLibrariesItCouldNotSearch) {
  const Folder folder;
  folder.copy("other_abi", "mine.so");
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_THAT(unknown(registry, Kind::integrator, "good"), HasSubstr("mine.so: built for another program"));
}

TEST(Registry, RefusesANameThatWouldLeaveTheFolder) {
  const Folder folder;
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_THAT(unknown(registry, Kind::body, "../../tests/plugins/spoilt_force"), HasSubstr("no body"));
}

TEST(Registry, ReportsAnUnknownTypeWhereItStands) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  scene::Problems problems;
  EXPECT_EQ(entry_of(registry, Kind::integrator, scene_of("{\n  \"type\": \"goood\"\n}"), problems), nullptr);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].text(), HasSubstr("scene.json:2:11: type: no integrator \"goood\""));
}

TEST(Registry, ReportsAnObjectWithoutType) {
  Registry registry = empty_registry();
  scene::Problems problems;
  EXPECT_EQ(entry_of(registry, Kind::body, scene_of("{}"), problems), nullptr);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].message, HasSubstr("\"type\" is missing"));
}

// --- plugins that are bad, each in its way ---

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

// --- across the boundary, with symbols hidden in the plugin ---

TEST(Boundary, AnAbilityIsFoundByDynamicCast) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  const auto component = registry.find(Kind::integrator, "good").declaration.make();
  EXPECT_NE(dynamic_cast<Integrator*>(component.get()), nullptr);
  EXPECT_NE(dynamic_cast<DenseOutput*>(component.get()), nullptr);
  EXPECT_EQ(dynamic_cast<ErrorEstimate*>(component.get()), nullptr);
}

TEST(Boundary, AParameterErrorOfThePluginIsCaughtAsSuch) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  scene::Problems problems;
  const scene::Value object = scene_of("{\n \"type\": \"good\", \"step\": 1,\n \"damping\": 0.25}");
  const Made<Integrator> made = make<Integrator>(registry, Kind::integrator, object, World{}, problems);
  EXPECT_EQ(made.component, nullptr);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_EQ(problems.errors()[0].text(), "scene.json:3:13: damping: a quarter is not possible");
}

TEST(Boundary, AComponentOutlivesItsRegistry) {
  std::unique_ptr<Component> component;
  {
    Registry registry = empty_registry();
    registry.load(library("good"));
    component = registry.find(Kind::integrator, "good").declaration.make();
  }
  EXPECT_EQ(dynamic_cast<Integrator&>(*component).traits().order, 1);
}

}  // namespace
}  // namespace trammel::plugin
